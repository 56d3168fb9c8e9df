// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/log_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

namespace posewire::gui {

namespace {

std::uint64_t sum(model::SessionView& view, std::uint64_t model::Sender::*count) {
    std::uint64_t total = 0;
    for (const model::Sender& sender : view.senders()) {
        total += sender.*count;
    }
    return total;
}

PropertyValue history(model::SessionView& view) {
    const log::LogFigures figures = view.figures();
    return {tr("%1 of %2").arg(grouped(figures.memoryInUse >> 20), megabytes(figures.memoryCap)),
            Health::Unknown, tr("Memory of the packets kept, and its limit; at the limit the oldest go")};
}

PropertyValue packets(model::SessionView& view) {
    const log::LogFigures figures = view.figures();
    const QString kept = grouped(figures.end - figures.begin);
    return {figures.begin == 0 ? kept : tr("%1 of %2").arg(kept, grouped(figures.end)), Health::Unknown,
            tr("Packets that can be looked back at, of all that were received")};
}

PropertyValue droppedHere(model::SessionView& view) {
    const std::uint64_t count = sum(view, &model::Sender::kernelDrops);
    return {grouped(count), count == 0 ? Health::Good : Health::Error,
            tr("Datagrams that reached this computer and found its receive buffer full (SO_RXQ_OVFL)")};
}

PropertyValue malformed(model::SessionView& view) {
    const std::uint64_t count = sum(view, &model::Sender::malformed);
    return {grouped(count), count == 0 ? Health::Good : Health::Error,
            tr("Datagrams that begin with MXTP and cannot be decoded")};
}

PropertyValue foreign(model::SessionView& view) {
    const std::uint64_t count = sum(view, &model::Sender::foreign);
    return {grouped(count), count == 0 ? Health::Good : Health::Warning,
            tr("Datagrams that do not begin with MXTP: another program sends to this port")};
}

} // namespace

std::vector<Property> logFacts(model::SessionView& view) {
    const auto row = [&view](const QString& label, PropertyValue (*read)(model::SessionView&)) {
        return Property{label, [&view, read] { return read(view); }};
    };
    return {row(tr("History"), history), row(tr("Packets kept"), packets),
            row(tr("Dropped here"), droppedHere), row(tr("Malformed"), malformed),
            row(tr("Foreign datagrams"), foreign)};
}

} // namespace posewire::gui
