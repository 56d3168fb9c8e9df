// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/menus.h"

#include "app/gui/window/main_window.h"

#include <QAction>
#include <QCoreApplication>
#include <QMenu>
#include <QMenuBar>

namespace posewire::gui {

namespace {

template <typename Parent>
QMenu* childMenu(Parent& parent, const QString& name) {
    for (QAction* action : parent.actions()) {
        if (action->menu() != nullptr && action->menu()->objectName() == name) {
            return action->menu();
        }
    }
    QMenu* menu = parent.addMenu(QCoreApplication::translate("Action", name.toUtf8().constData()));
    menu->setObjectName(name);
    return menu;
}

} // namespace

QMenu* menuAt(QMenuBar& bar, const QString& path) {
    const QStringList names = path.split(QLatin1Char('/'));
    QMenu* menu = childMenu(bar, names[0]);
    for (const QString& name : names.mid(1)) {
        menu = childMenu(*menu, name);
    }
    return menu;
}

Menus::Menus(MainWindow& window, QMenuBar& bar) : m_window(window), m_entries(menuEntries()) {
    for (const MenuEntry& entry : m_entries) {
        QMenu* menu = menuAt(bar, QString::fromUtf8(entry.action->menu));
        if (entry.action->run == nullptr) {
            menu->addSeparator();
            continue;
        }
        if (menu->isEmpty()) {
            QObject::connect(menu, &QMenu::aboutToShow, &window, [this] { showStates(); });
        }
        menu->addAction(makeAction(entry));
    }
}

QAction* Menus::makeAction(const MenuEntry& entry) {
    const ActionInfo& info = *entry.action;
    auto* action = new QAction(QCoreApplication::translate("Action", info.text), &m_window);
    action->setObjectName(QLatin1String(info.id));
    action->setShortcut(QKeySequence(QLatin1String(info.shortcut), QKeySequence::PortableText));
    action->setCheckable(info.isOn != nullptr);
    QObject::connect(action, &QAction::triggered, &m_window, [this, entry] {
        m_window.carryOut(entry);
        showStates();
    });
    // Also reachable while the menu bar is hidden.
    m_window.addAction(action);
    m_actions.insert(action->objectName(), action);
    return action;
}

void Menus::showStates() {
    for (const MenuEntry& entry : m_entries) {
        if (entry.action->isOn != nullptr) {
            m_actions[QLatin1String(entry.action->id)]->setChecked(m_window.isOn(entry));
        }
    }
}

} // namespace posewire::gui
