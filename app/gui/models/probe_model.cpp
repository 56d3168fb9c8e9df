// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/probe_model.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <cmath>

namespace posewire::gui {
namespace {

using stage::ProbeState;
using ProbeColumn = TableColumn<ProbeState>;

PropertyValue stateOf(const ProbeState& probe) {
    if (!probe.isAlive) {
        return {tr("silent"), Health::Error,
                tr("Nothing is heard of it: it has ended, or no server can be reached from it.")};
    }
    if (!probe.problem.empty()) {
        return {QString::fromStdString(probe.problem), Health::Error, QString::fromStdString(probe.problem)};
    }
    if (probe.spoolBytes > 0) {
        return {tr("catching up"), Health::Warning,
                tr("What it received while no server took it comes now.")};
    }
    return {tr("alive"), Health::Good};
}

ProbeColumn countColumn(const QString& title, const QString& help, Health ifAny,
                        std::uint64_t ProbeState::*count, int order) {
    return valueColumn(
        ProbeColumn{.title = title,
                    .help = help,
                    .isNumber = true,
                    .room = {.usual = QStringLiteral("▲ 9999"), .order = order}},
        [count, ifAny](const ProbeState& probe) {
            return PropertyValue{grouped(probe.*count), probe.*count != 0 ? ifAny : Health::Unknown};
        });
}

QString spoolText(const ProbeState& probe) {
    return probe.spoolBytes == 0 ? dash()
                                 : tr("%1 MB").arg(fixed(static_cast<double>(probe.spoolBytes) / 1e6, 1));
}

QString clockText(const ProbeState& probe) {
    if (!probe.ahead) {
        return dash();
    }
    const double ms = log::millisecondsOf(*probe.ahead);
    return tr("%1 ± %2 ms")
        .arg((ms < 0 ? QStringLiteral("−") : QStringLiteral("+")) + fixed(std::abs(ms), 1),
             fixed(log::millisecondsOf(probe.uncertainty), 1));
}

std::vector<ProbeColumn> probeColumns() {
    const auto textOf = [](std::string ProbeState::*member) {
        return [member](const ProbeState& probe) { return QString::fromStdString(probe.*member); };
    };
    return {
        ProbeColumn::words(tr("Probe"), tr("The name that it was given"), textOf(&ProbeState::name))
            .in({.usual = QStringLiteral("STAGE-A"), .wish = QStringLiteral("STAGE-A-LEFT")}),
        valueColumn(ProbeColumn{.title = tr("State"), .room = {.usual = tr("● catching up"), .isOpen = true}},
                    stateOf),
        ProbeColumn::numbers(tr("Packets/s"), tr("That it published, over the last second"),
                             [](const ProbeState& probe) { return fixed(probe.rateHz, 0); })
            .in({.usual = QStringLiteral("99 999")}),
        countColumn(tr("Dropped there"),
                    tr("Datagrams that the probe's computer had no room for, since it began"), Health::Error,
                    &ProbeState::kernelDropped, 3),
        countColumn(tr("Lost on the way"), tr("Packets that it had received and that did not come here"),
                    Health::Warning, &ProbeState::lostOnWay, 4),
        ProbeColumn::numbers(tr("Spool"), tr("What no server has taken yet, on its disk"), spoolText)
            .in({.usual = QStringLiteral("999.9 MB"), .order = 2}),
        ProbeColumn::numbers(
            tr("Clock"),
            tr("What its clock is ahead of this computer's, and by how much that may be wrong: half "
               "of the shortest way there and back of late. Stamps are left as they are."),
            clockText)
            .in({.usual = QStringLiteral("+999.9 ± 99.9 ms")}),
        ProbeColumn::words(tr("Computer"), {}, textOf(&ProbeState::host))
            .in({.usual = QStringLiteral("stage-left"), .order = 1}),
        ProbeColumn::words(tr("Version"), tr("Of Posewire there"), textOf(&ProbeState::version))
            .in({.usual = QStringLiteral("0.2.0"), .order = 1}),
    };
}

} // namespace

ProbeModel::ProbeModel() : TableModel(withHelpInCells(probeColumns())) {}

} // namespace posewire::gui
