// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/time_ruler.h"

#include "app/gui/models/text.h"

#include <QDateTime>

#include <algorithm>
#include <array>

namespace posewire::gui {

namespace {

using namespace std::chrono_literals;

/// The shortest round step that is at least as long.
log::Duration roundStep(log::Duration least) {
    constexpr std::array<log::Duration, 33> kSteps{1us,   2us,   5us, 10us, 20us, 50us, 100us, 200us, 500us,
                                                   1ms,   2ms,   5ms, 10ms, 20ms, 50ms, 100ms, 200ms, 500ms,
                                                   1s,    2s,    5s,  10s,  15s,  30s,  1min,  2min,  5min,
                                                   10min, 30min, 1h,  3h,   6h,   12h};
    const auto step = std::ranges::lower_bound(kSteps, least);
    return step == kSteps.end() ? log::Duration(24h) : *step;
}

/// As exact as the step needs.
QString tickText(log::WallTime time, log::Duration step) {
    const QString whole = timeOfDay(time);
    if (step >= 1s) {
        return whole.chopped(4);
    }
    const auto micros = std::chrono::floor<std::chrono::microseconds>(time).time_since_epoch() % 1ms;
    return step >= 1ms ? whole : whole + QStringLiteral("%1").arg(micros / 1us, 3, 10, QLatin1Char('0'));
}

} // namespace

std::vector<TimeTick> timeTicks(const model::SessionView& view, const model::TimeRange& window, int pixels,
                                const QFontMetrics& metrics) {
    const auto stepFor = [&](const QString& text) {
        return roundStep((window.to - window.from) * metrics.horizontalAdvance(text) / std::max(1, pixels));
    };
    const log::Duration coarse = stepFor(QStringLiteral("00:00:00.000   "));
    const log::Duration step = coarse < 1ms ? stepFor(QStringLiteral("00:00:00.000000   ")) : coarse;
    const auto wall = view.wallOf(window.from).time_since_epoch();
    const auto seconds = std::chrono::floor<std::chrono::seconds>(wall).count();
    const std::chrono::seconds offset(QDateTime::fromSecsSinceEpoch(seconds).offsetFromUtc());
    std::vector<TimeTick> ticks;
    for (log::Stamp tick = window.from - (wall + offset) % step; tick < window.to; tick += step) {
        ticks.push_back({tick, tickText(view.wallOf(tick), step)});
    }
    return ticks;
}

QString inSight(log::Duration length) {
    const double seconds = log::secondsOf(length);
    return seconds < 0.1 ? fixed(seconds * 1'000, 1) + QStringLiteral(" ms") : duration(seconds);
}

} // namespace posewire::gui
