// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/computer_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/session/accounts.h"
#include "core/model/session/losses.h"
#include "core/model/session/memory_figures.h"
#include "core/model/session/roster.h"

#include <QStringList>

namespace posewire::gui {

namespace {

/// Fuller than this, a pause of the receiving thread may cost datagrams.
constexpr double kFullBuffer = 0.5;
/// Of a core; more than this and the window lags behind.
constexpr double kMuchFollowing = 0.5;
/// At the design load, 9,600 datagrams a second, this much lasts for 50 ms without the receiving thread.
constexpr std::int64_t kSmallBuffer = std::int64_t{1} << 20;
/// Behind what is received.
constexpr log::Duration kLate = std::chrono::milliseconds(250);
constexpr log::Duration kLongDelay = std::chrono::milliseconds(100);

struct Source {
    model::SessionView& view;
    const ReceivingState& receiving;
    const MonitorHealth& monitor;
};

QString percent(const std::optional<double>& share, int decimals = 0) {
    return share ? fixed(*share * 100, decimals) + QStringLiteral(" %") : dash();
}

PropertyValue lostByCause(const Source& from) {
    using enum model::LossCause;
    const model::Losses losses(from.view, from.view.range());
    model::LossesByCause lost{};
    std::uint64_t pending = 0;
    for (const model::Stream& stream : from.view.roster().streams()) {
        losses.addTo(lost, stream);
        pending += losses.of(stream).pending;
    }
    QStringList parts; // zeros only take room
    const auto add = [&](const QString& text, model::LossCause cause) {
        if (const std::uint64_t count = lost[static_cast<std::size_t>(cause)]; count != 0) {
            parts += text.arg(grouped(count));
        }
    };
    add(tr("network %1"), Network);
    add(tr("sender %1"), Sender);
    add(tr("here %1"), ThisComputer);
    add(tr("unknown %1"), Unknown);
    if (parts.isEmpty() && pending != 0) {
        return {tr("%1 not yet here").arg(grouped(pending)), Health::Unknown};
    }
    if (parts.isEmpty()) {
        return {tr("nothing lost"), Health::Good};
    }
    const bool isHere = lost[static_cast<std::size_t>(ThisComputer)] != 0;
    return {parts.join(QStringLiteral(" · ")), isHere ? Health::Error : Health::Unknown};
}

PropertyValue longestGap(const Source& from) {
    const model::Losses losses(from.view, from.view.range());
    std::uint64_t longest = 0;
    for (const model::Stream& stream : from.view.roster().streams()) {
        longest = std::max(longest, losses.longestGapOf(stream));
    }
    if (longest == 0) {
        return {tr("none"), Health::Good};
    }
    return {tr("%1 samples", nullptr, static_cast<int>(longest)).arg(grouped(longest))};
}

PropertyValue computer(const Source& from) {
    const MonitorHealth& health = from.monitor;
    const model::SenderTotals sums = from.view.accounts().allSenders();
    Health state = health.bufferFill.value_or(0) >= kFullBuffer ? Health::Warning : Health::Good;
    if (sums.kernelDrops != 0) {
        state = Health::Error;
    }
    const QString dropped = sums.hasUncountedDrops ? tr("drops not known here")
                                                   : tr("dropped %1 in all").arg(grouped(sums.kernelDrops));
    return {tr("buffer %1 · %2 · %3 fps")
                .arg(percent(health.bufferFill), dropped, fixed(health.framesPerSecond, 0)),
            state};
}

PropertyValue picture(const Source& from) {
    const MonitorHealth& health = from.monitor;
    if (health.picture.state.isEmpty()) {
        return {dash()};
    }
    // How we draw is no fault of a stream.
    return {health.picture.state, health.picture.isPoor ? Health::Unknown : Health::Good, health.picture.why};
}

PropertyValue processor(const Source& from) {
    const MonitorHealth& health = from.monitor;
    return {
        tr("receiving %1 · program %2").arg(percent(health.receiverShare, 1), percent(health.processShare))};
}

PropertyValue accounting(const Source& from) {
    const MonitorHealth& health = from.monitor;
    const QString each =
        health.followUsPerPacket > 0 ? tr("%1 µs a packet").arg(fixed(health.followUsPerPacket, 2)) : dash();
    const log::Duration behind = from.view.behind();
    const bool isLate = behind >= kLate;
    const QString late = isLate ? tr(" · %1 s behind").arg(fixed(log::secondsOf(behind), 1)) : QString();
    return {tr("%1 · %2").arg(each, percent(health.followShare, 1)) + late,
            isLate || health.followShare > kMuchFollowing ? Health::Warning : Health::Unknown};
}

model::MemoryFigures memoryFigures(const Source& from) {
    model::MemoryFigures figures = from.view.memory();
    const MonitorHealth& health = from.monitor;
    figures.parts.push_back({"meshes", "bodies drawn", health.meshBytes, health.mostMeshBytes});
    return figures;
}

PropertyValue memory(const Source& from) {
    const MonitorHealth& health = from.monitor;
    const model::MemoryFigures figures = memoryFigures(from);
    const QString own = health.memoryBytes ? megabytes(*health.memoryBytes) : dash();
    return {tr("%1 · kept %2 of %3").arg(own, grouped(figures.sum() >> 20), megabytes(figures.budget())),
            figures.sum() <= figures.budget() ? Health::Unknown : Health::Warning};
}

PropertyValue memoryParts(const Source& from) {
    QStringList parts; // zeros only take room
    QStringList all;
    for (const model::MemoryFigures::Part& part : memoryFigures(from).parts) {
        const QString text = translatedText(part.name) + QLatin1Char(' ') + megabytes(part.bytes);
        all += part.most == 0 ? text : tr("%1 of %2").arg(text, megabytes(part.most));
        if (part.bytes >> 20 != 0) {
            parts += translatedText(part.name) + QLatin1Char(' ') + grouped(part.bytes >> 20);
        }
    }
    return {parts.isEmpty() ? tr("below 1 MB") : parts.join(QStringLiteral(" · ")), Health::Unknown,
            tr("Received data by part, in MB. Packets and their index share one limit.\n%1")
                .arg(all.join(QLatin1Char('\n')))};
}

PropertyValue buffer(const Source& from) {
    const std::int64_t bytes = from.receiving.receiveBufferBytes;
    if (bytes == 0) {
        return {tr("no UDP port"), Health::Unknown, {}};
    }
    const bool isSmall = bytes < kSmallBuffer;
    const QString advice =
        isSmall ? tr(" It is small: raise it with sysctl -w net.core.rmem_max=4194304.") : QString();
    const auto size = static_cast<std::uint64_t>(bytes);
    return {isSmall ? tr("%1 KB").arg(grouped(size >> 10)) : megabytes(size),
            isSmall ? Health::Warning : Health::Good,
            tr("The buffer that the system granted each UDP port for datagrams waiting to be read.") +
                advice};
}

PropertyValue delay(const Source& from) {
    const log::Duration longest = from.receiving.longestDelay;
    const double milliseconds = log::millisecondsOf(longest);
    return {tr("%1 ms").arg(fixed(milliseconds, 1)), longest < kLongDelay ? Health::Good : Health::Warning};
}

PropertyValue history(const Source& from) {
    const log::LogFigures figures = from.view.log().figures();
    return {tr("%1 of %2").arg(grouped(figures.memoryInUse >> 20), megabytes(figures.memoryCap))};
}

PropertyValue packets(const Source& from) {
    const std::uint64_t end = from.view.end();
    const QString kept = grouped(end - from.view.begin());
    return {from.view.begin() == 0 ? kept : tr("%1 of %2").arg(kept, grouped(end))};
}

PropertyValue overtaken(const Source& from) {
    const std::uint64_t late = from.view.accounts().overtaken();
    const std::uint64_t beyond = from.view.accounts().unfollowed();
    const QString beyondText = tr("%1 of too many streams").arg(grouped(beyond));
    return {beyond == 0 ? grouped(late) : grouped(late) + QStringLiteral(" · ") + beyondText,
            late + beyond == 0 ? Health::Good : Health::Error};
}

PropertyValue retired(const Source& from) {
    const model::RetiredTotals& sums = from.view.accounts().retired();
    return sums.senders == 0
               ? PropertyValue{tr("none"), Health::Good}
               : PropertyValue{tr("%1 · %2 datagrams · %3 lost")
                                   .arg(grouped(sums.senders), grouped(sums.datagrams), grouped(sums.lost))};
}

} // namespace

std::vector<Property> computerFacts(model::SessionView& view, const ReceivingState& receiving,
                                    const MonitorHealth& monitor) {
    const Source from{view, receiving, monitor};
    std::vector<Property> facts;
    const auto add = [&facts, from](const QString& label, auto&& read, const QString& toolTip = {}) {
        facts.push_back({label, [=] {
                             PropertyValue value = read(from);
                             const bool isEarly = value.health == Health::Good && from.view.end() == 0;
                             value.health = isEarly ? Health::Unknown : value.health;
                             value.toolTip = value.toolTip.isEmpty() ? toolTip : value.toolTip;
                             return value;
                         }});
    };
    using Sums = model::SenderTotals;
    const auto trouble = [](std::uint64_t Sums::*counted, Health health) {
        return [=](const Source& source) {
            const std::uint64_t count = source.view.accounts().allSenders().*counted;
            return PropertyValue{grouped(count), count == 0 ? Health::Good : health};
        };
    };
    add(tr("Lost by cause"), lostByCause,
        tr("Samples lost and messages incomplete, by cause as far as there is evidence: the network, the "
           "sender, this computer, or unknown. The packet after a gap says why."));
    add(tr("Longest gap"), longestGap,
        tr("Most consecutive samples lost by one stream, and their duration at the current rate"));
    add(tr("This computer"), computer,
        tr("Peak fill of the receive buffers in the last half second, datagrams dropped because they were "
           "full, and frames of the viewport per second"));
    add(tr("Picture"), picture, tr("How the viewport is drawn"));
    add(tr("Processor"), processor, tr("Share of one core used by the receiving thread, and by all threads"));
    add(tr("Accounting"), accounting,
        tr("Time to decode, count and index a packet, and the share of the window's time that it takes; "
           "receiving does not wait for it. If packets arrive faster than they are processed: age of the "
           "last one processed"));
    add(tr("Memory"), memory,
        tr("Memory used by this program; the part that holds received data, and the limit of that part, at "
           "which the oldest data are dropped"));
    add(tr("Memory by part"), memoryParts);
    add(tr("Receive buffer"), buffer);
    add(tr("Longest delay"), delay,
        tr("Longest interval between two socket reads; the buffer must cover it"));
    add(tr("History"), history,
        tr("Memory used by the newest packets and their index, and its limit. At the limit the oldest are "
           "dropped from memory; they stay on disk if a history is kept there (File > History)"));
    add(tr("Packets kept"), packets,
        tr("Packets still available, in memory or on disk, out of all received"));
    add(
        tr("Dropped here"),
        [trouble](const Source& source) {
            const bool isUnknown = source.view.accounts().allSenders().hasUncountedDrops;
            return isUnknown ? PropertyValue{droppedText(0, false), Health::Unknown}
                             : trouble(&Sums::kernelDrops, Health::Error)(source);
        },
        tr("Datagrams that reached this computer and found its receive buffer full (SO_RXQ_OVFL)"));
    add(tr("Not looked at"), overtaken,
        tr("Packets dropped from memory before this program processed them; samples lost with them count as "
           "lost here"));
    add(
        tr("Not listened to"),
        [](const Source& source) {
            return PropertyValue{grouped(source.receiving.refusedDatagrams), Health::Good};
        },
        tr("Datagrams from hosts that are not on the list of those to listen to; they are not recorded"));
    add(tr("Malformed"), trouble(&Sums::malformed, Health::Error),
        tr("Datagrams that begin with MXTP and cannot be decoded"));
    add(tr("Foreign datagrams"), trouble(&Sums::foreign, Health::Warning),
        tr("Datagrams that do not begin with MXTP: another program sends to this port"));
    add(tr("Retired senders"), retired,
        tr("Senders that fell silent and made room for others. Their rows are gone; all totals include their "
           "sums."));
    return facts;
}

} // namespace posewire::gui
