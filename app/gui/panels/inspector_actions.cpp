// SPDX-License-Identifier: GPL-3.0-or-later
// What the operator can do in the inspector, and the menus that offer it.
#include "app/gui/models/text.h"
#include "app/gui/panels/inspector_panel.h"

#include <QMenu>

namespace posewire::gui {

namespace {

using Do = ActionsOf<InspectorPanel>;
using Comparison = InspectorPanel::Comparison;

constexpr const char* kGo = "&Go";
constexpr const char* kCompare = QT_TRANSLATE_NOOP("Action", "&Edit/Co&mpare packet");

constexpr ActionInfo kActions[] = {
    {"holdPacket", kGo, QT_TRANSLATE_NOOP("Action", "&Hold this packet"), "",
     Do::call<&InspectorPanel::toggleHold>, Do::is<&InspectorPanel::isHeld>},
    {"compareNot", kCompare, QT_TRANSLATE_NOOP("Action", "Do &not compare"), "",
     Do::call<&InspectorPanel::compare, Comparison::None>,
     Do::is<&InspectorPanel::comparison, Comparison::None>},
    {"comparePrevious", kCompare, QT_TRANSLATE_NOOP("Action", "With the &previous packet of its stream"), "",
     Do::call<&InspectorPanel::compare, Comparison::Previous>,
     Do::is<&InspectorPanel::comparison, Comparison::Previous>},
    {"compareReference", kCompare, QT_TRANSLATE_NOOP("Action", "With the &reference"), "",
     Do::call<&InspectorPanel::compare, Comparison::Reference>,
     Do::is<&InspectorPanel::comparison, Comparison::Reference>},
    lineIn(kCompare),
    {"setReference", kCompare, QT_TRANSLATE_NOOP("Action", "&Set this packet as reference"), "",
     Do::call<&InspectorPanel::setReference>},
    {"onlyDifferences", kCompare, QT_TRANSLATE_NOOP("Action", "Only &differences"), "",
     Do::call<&InspectorPanel::toggleOnlyDifferences>, Do::is<&InspectorPanel::isOnlyDifferences>},
};

} // namespace

std::span<const ActionInfo> InspectorPanel::actionTable() {
    return kActions;
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
    return m_view.selection().packet.has_value();
}

void InspectorPanel::toggleHold() {
    hold(!isHeld());
}

} // namespace posewire::gui
