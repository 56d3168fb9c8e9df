// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/menus.h"

#include "app/gui/window/actions.h"
#include "app/gui/window/main_window.h"

#include <QActionGroup>
#include <QCoreApplication>

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

QAction* makeAction(const ActionInfo& info, QMenu& menu, MainWindow& window) {
    auto* action = new QAction(QCoreApplication::translate("Action", info.text), &window);
    action->setObjectName(QLatin1String(info.id));
    action->setShortcut(QKeySequence(QLatin1String(info.shortcut), QKeySequence::PortableText));
    action->setCheckable(info.isCheckable);
    QObject::connect(action, &QAction::triggered, &window, [run = info.run, &window] { run(window); });
    if (info.isOn != nullptr) {
        QObject::connect(&menu, &QMenu::aboutToShow, action,
                         [action, isOn = info.isOn, &window] { action->setChecked(isOn(window)); });
    }
    // Also reachable while the menu bar is hidden.
    window.addAction(action);
    return action;
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

ActionMap makeMenus(MainWindow& window, QMenuBar& bar) {
    ActionMap actions;
    for (const ActionInfo& info : actionTable()) {
        QMenu* menu = menuAt(bar, QString::fromUtf8(info.menu));
        if (info.run == nullptr) {
            menu->addSeparator();
            continue;
        }
        QAction* action = makeAction(info, *menu, window);
        menu->addAction(action);
        actions.insert(QLatin1String(info.id), action);
    }
    auto* themes = new QActionGroup(&window);
    for (const char* id : {"themeSystem", "themeDark", "themeLight"}) {
        themes->addAction(actions[QLatin1String(id)]);
    }
    return actions;
}

} // namespace posewire::gui
