// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/receiving_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <QLocale>

namespace posewire::gui {

namespace {

/// At the design load, 9,600 datagrams a second, this much lasts for 50 ms without the receiving thread.
constexpr std::int64_t kSmallBuffer = std::int64_t{1} << 20;
constexpr log::Duration kLongDelay = std::chrono::milliseconds(100);

PropertyValue buffer(const ReceivingState& state) {
    if (state.receiveBufferBytes == 0) {
        return {tr("no UDP port"), Health::Unknown, {}};
    }
    const bool isSmall = state.receiveBufferBytes < kSmallBuffer;
    const QString advice =
        isSmall ? tr(" It is small: raise it with sysctl -w net.core.rmem_max=4194304.") : QString();
    const auto kilobytes = static_cast<std::uint64_t>(state.receiveBufferBytes >> 10);
    return {isSmall ? tr("%1 KB").arg(grouped(kilobytes))
                    : megabytes(static_cast<std::uint64_t>(state.receiveBufferBytes)),
            isSmall ? Health::Warning : Health::Good,
            tr("What the system granted each UDP port for datagrams that wait to be read.") + advice};
}

PropertyValue delay(const ReceivingState& state) {
    const double milliseconds = log::millisecondsOf(state.longestDelay);
    return {tr("%1 ms").arg(QLocale().toString(milliseconds, 'f', 1)),
            state.longestDelay < kLongDelay ? Health::Good : Health::Warning,
            tr("The longest time the receiving thread did not come to look at its ports; the buffer has to "
               "last that long")};
}

} // namespace

std::vector<Property> receivingFacts(std::function<ReceivingState()> state) {
    const auto row = [&state](const QString& label, PropertyValue (*read)(const ReceivingState&)) {
        return Property{label, [state, read] { return read(state()); }};
    };
    return {row(tr("Receive buffer"), buffer), row(tr("Longest delay"), delay)};
}

} // namespace posewire::gui
