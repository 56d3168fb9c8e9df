// SPDX-License-Identifier: GPL-3.0-or-later
// What the operator can do in the inspector, and the menus that offer it.
#include "app/gui/models/text.h"
#include "app/gui/panels/inspector_panel.h"

#include <QMenu>

namespace posewire::gui {

namespace {

using InspectorDo = ActionsOf<InspectorPanel>;
using Comparison = InspectorPanel::Comparison;

constexpr const char* kGoMenu = "&Go";
constexpr const char* kComparePacket = QT_TRANSLATE_NOOP("Action", "&Edit/Compar&e packet");

constexpr ActionInfo kInspectorActions[] = {
    {"holdPacket", kGoMenu, QT_TRANSLATE_NOOP("Action", "&Hold this packet"), "",
     InspectorDo::call<&InspectorPanel::toggleHold>, InspectorDo::is<&InspectorPanel::isHeld>},
    {"compareNot", kComparePacket, QT_TRANSLATE_NOOP("Action", "Do &not compare"), "",
     InspectorDo::call<&InspectorPanel::compare, Comparison::None>,
     InspectorDo::is<&InspectorPanel::comparison, Comparison::None>},
    {"comparePrevious", kComparePacket,
     QT_TRANSLATE_NOOP("Action", "With the &previous packet of its stream"), "",
     InspectorDo::call<&InspectorPanel::compare, Comparison::Previous>,
     InspectorDo::is<&InspectorPanel::comparison, Comparison::Previous>},
    {"compareReference", kComparePacket, QT_TRANSLATE_NOOP("Action", "With the &reference"), "",
     InspectorDo::call<&InspectorPanel::compare, Comparison::Reference>,
     InspectorDo::is<&InspectorPanel::comparison, Comparison::Reference>},
    lineIn(kComparePacket),
    {"setReference", kComparePacket, QT_TRANSLATE_NOOP("Action", "&Set this packet as reference"), "",
     InspectorDo::call<&InspectorPanel::setReference>},
    {"onlyDifferences", kComparePacket, QT_TRANSLATE_NOOP("Action", "Only &differences"), "",
     InspectorDo::call<&InspectorPanel::toggleOnlyDifferences>,
     InspectorDo::is<&InspectorPanel::isOnlyDifferences>},
};

} // namespace

std::span<const ActionInfo> InspectorPanel::actionTable() {
    return kInspectorActions;
}

void InspectorPanel::fillCompareMenu() {
    QMenu* menu = m_compare->menu();
    menu->clear();
    const auto add = [&](const QString& text, Comparison comparison) {
        QAction* action = menu->addAction(text, this, [this, comparison] { compare(comparison); });
        action->setCheckable(true);
        action->setChecked(m_comparison == comparison);
        return action;
    };
    add(tr("Do not compare"), Comparison::None);
    add(tr("With the previous packet of its stream"), Comparison::Previous);
    add(m_reference ? tr("With the reference, packet %1").arg(grouped(*m_reference))
                    : tr("With the reference"),
        Comparison::Reference)
        ->setEnabled(m_reference.has_value());
    menu->addSeparator();
    menu->addAction(tr("Set this packet as reference"), this, &InspectorPanel::setReference);
    QAction* only = menu->addAction(tr("Only differences"));
    only->setCheckable(true);
    only->setChecked(m_model.isOnlyDifferences());
    connect(only, &QAction::triggered, this, &InspectorPanel::toggleOnlyDifferences);
}

void InspectorPanel::toggleOnlyDifferences() {
    m_fields->change([this] { m_model.setOnlyDifferences(!m_model.isOnlyDifferences()); });
}

bool InspectorPanel::isHeld() const {
    return m_view.choices().selection.packet.has_value();
}

void InspectorPanel::toggleHold() {
    hold(!isHeld());
}

} // namespace posewire::gui
