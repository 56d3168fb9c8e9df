// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/clock_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

namespace posewire::gui {

namespace {

PropertyValue header(const ClockHistory& clock) {
    const auto milliseconds = clock.headerMs();
    return {milliseconds ? tr("%1 · %2 ms").arg(milliClock(*milliseconds), grouped(*milliseconds))
                         : QStringLiteral("–"),
            Health::Unknown,
            tr("Time code of every header: since the start of a recording, or the sender's time "
               "of day when live")};
}

PropertyValue type25(const ClockHistory& clock) {
    return {clock.type25() ? QString::fromStdString(*clock.type25()) : tr("not on the air"), Health::Unknown,
            tr("Wall clock that the sender sends as text. In MVN: Network Streamer > Time Code (type 25)")};
}

PropertyValue offset(const ClockHistory& clock) {
    return {clock.offsetMs() ? clockDifference(*clock.offsetMs()) : QStringLiteral("–"), Health::Unknown,
            tr("Type 25 minus the header time code of the same datagram")};
}

PropertyValue drift(const ClockHistory& clock) {
    const QString toolTip =
        tr("How much faster the sender's header clock runs than this computer's: slope over "
           "the last minute of time code against receive stamps, ± its standard error");
    if (const auto found = clock.drift()) {
        return {tr("%1 ± %2 ppm").arg(signedFixed(found->ppm, 1), fixed(found->error, 1)), Health::Unknown,
                toolTip};
    }
    if (!clock.headerMs()) {
        return {QStringLiteral("–"), Health::Unknown, toolTip};
    }
    return {tr("after %1 s").arg(static_cast<int>(ClockHistory::kLeastDriftSeconds)), Health::Unknown,
            toolTip};
}

PropertyValue frameRate(const ClockHistory& clock) {
    const auto hz = clock.frameHz();
    return {hz ? tr("%1 Hz").arg(fixed(*hz, 2)) : QStringLiteral("–"), Health::Unknown,
            tr("How far the sample counter moves on in a second of the sender's time code")};
}

PropertyValue lastJump(const ClockHistory& clock) {
    const QString toolTip =
        tr("The newest place where the time code did not go on as its samples did, and when it "
           "was received");
    if (!clock.lastJump()) {
        return {clock.headerMs() ? tr("none") : QStringLiteral("–"), Health::Unknown, toolTip};
    }
    return {tr("%1 at %2")
                .arg(clockDifference(clock.lastJump()->milliseconds),
                     timeOfDay(clock.lastJump()->stamp).chopped(4)),
            Health::Warning, toolTip};
}

} // namespace

QString clockText(const ClockHistory& clock, ClockChoice choice) {
    const QString none = QStringLiteral("--:--:--.---");
    if (choice == ClockChoice::Type25) {
        return clock.type25() ? QString::fromStdString(*clock.type25()) : none;
    }
    return clock.headerMs() ? milliClock(*clock.headerMs()) : none;
}

std::vector<Property> clockFacts(const ClockHistory& clock) {
    const auto row = [&clock](const QString& label, PropertyValue (*read)(const ClockHistory&)) {
        return Property{label, [&clock, read] { return read(clock); }};
    };
    return {row(tr("Header"), header), row(tr("Type 25"), type25),       row(tr("Offset"), offset),
            row(tr("Drift"), drift),   row(tr("Frame rate"), frameRate), row(tr("Last jump"), lastJump)};
}

} // namespace posewire::gui
