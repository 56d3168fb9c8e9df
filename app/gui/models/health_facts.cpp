// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/health_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

namespace posewire::gui {

namespace {

/// Fuller than this, a pause of the receiving thread may cost datagrams.
constexpr double kFullBuffer = 0.5;
/// Of a core; more than this and the window lags behind.
constexpr double kMuchFollowing = 0.5;

QString percent(const std::optional<double>& share, int decimals = 0) {
    return share ? fixed(*share * 100, decimals) + QStringLiteral(" %") : QStringLiteral("–");
}

std::uint64_t droppedHere(model::SessionView& view) {
    std::uint64_t dropped = 0;
    for (const model::Sender& sender : view.senders()) {
        dropped += sender.kernelDrops;
    }
    return dropped;
}

PropertyValue computer(model::SessionView& view, const MonitorHealth& health) {
    const std::uint64_t dropped = droppedHere(view);
    const bool isFull = health.bufferFill.value_or(0) >= kFullBuffer;
    const Health state = dropped != 0 ? Health::Error : isFull ? Health::Warning : Health::Good;
    return {tr("buffer %1 · dropped %2 · %3 fps")
                .arg(percent(health.bufferFill), grouped(dropped), fixed(health.framesPerSecond, 0)),
            state,
            tr("The most that the receive buffers were filled in the last half second, datagrams that this "
               "computer lost for want of room, and pictures of the viewport a second")};
}

PropertyValue processor(const MonitorHealth& health) {
    return {
        tr("receiving %1 · program %2").arg(percent(health.receiverShare, 1), percent(health.processShare)),
        Health::Unknown, tr("Share of one core that the receiving thread takes, and all threads together")};
}

PropertyValue accounting(const MonitorHealth& health) {
    const QString each = health.followUsPerPacket > 0
                             ? tr("%1 µs a packet").arg(fixed(health.followUsPerPacket, 2))
                             : QStringLiteral("–");
    return {tr("%1 · %2").arg(each, percent(health.followShare, 1)),
            health.followShare > kMuchFollowing ? Health::Warning : Health::Unknown,
            tr("Time to decode, count and index a packet, and the share of the window's time that takes; "
               "receiving does not wait for it")};
}

PropertyValue memory(model::SessionView& view, const MonitorHealth& health) {
    const log::LogFigures figures = view.figures();
    const QString own = health.memoryBytes ? megabytes(*health.memoryBytes) : QStringLiteral("–");
    return {tr("%1 · history %2 of %3")
                .arg(own, grouped(figures.memoryInUse >> 20), megabytes(figures.memoryCap)),
            Health::Unknown,
            tr("Memory of this program, and of it that of the packets kept with its limit; at the limit the "
               "oldest go")};
}

} // namespace

std::vector<Property> healthFacts(model::SessionView& view, const std::function<MonitorHealth()>& health) {
    return {{tr("This computer"), [&view, health] { return computer(view, health()); }},
            {tr("Processor"), [health] { return processor(health()); }},
            {tr("Accounting"), [health] { return accounting(health()); }},
            {tr("Memory"), [&view, health] { return memory(view, health()); }}};
}

} // namespace posewire::gui
