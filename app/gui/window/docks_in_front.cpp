// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/dock_layout.h"
#include "app/gui/window/health_bar.h"
#include "app/gui/window/main_window.h"

#include <QAbstractItemView>
#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QScreen>

#include <algorithm>
#include <utility>

/// Which dock lies in front, and where the keyboard is.
namespace posewire::gui {

namespace {

/// What takes the keyboard first within a part of the window; the part itself where nothing does.
QWidget* firstStop(QWidget* part) {
    const QList<QWidget*> children = part->findChildren<QWidget*>();
    const auto found = std::ranges::find_if(children, [](const QWidget* child) {
        return child->isVisible() && child->isEnabled() && (child->focusPolicy() & Qt::TabFocus) != 0;
    });
    return found == children.end() ? part : *found;
}

/// Where the keyboard is of most use in a dock: its table; what takes it first where there is none.
QWidget* mainStop(QWidget* panel) {
    const QList<QAbstractItemView*> tables = panel->findChildren<QAbstractItemView*>();
    const auto found = std::ranges::find_if(tables, [](const QWidget* table) {
        return table->isVisible() && (table->focusPolicy() & Qt::TabFocus) != 0;
    });
    return found == tables.end() ? firstStop(panel) : *found;
}

} // namespace

bool MainWindow::Dock::isInSight() const {
    // A dock behind another as a tab is not hidden but beside its window. What it covers with its own
    // children says nothing: visibleRegion() is empty also where those are opaque.
    return panel->isVisible() &&
           (dock->isWindow() || dock->parentWidget()->rect().intersects(dock->geometry()));
}

const MainWindow::Dock* MainWindow::findDock(const QString& name) const {
    const auto found =
        std::ranges::find(m_docks, name, [](const Dock& each) { return each.dock->objectName(); });
    return found == m_docks.end() ? nullptr : &*found;
}

/// The keyboard goes along where the dock that has it is covered: else nobody sees what keys do.
void MainWindow::showDock(const QString& dock) {
    const Dock* found = findDock(dock);
    if (found == nullptr) {
        return;
    }
    const auto hasKeyboard = [this](const Dock& each) { return each.dock->isAncestorOf(focusWidget()); };
    const auto with = std::ranges::find_if(m_docks, hasKeyboard);
    placeDock(*found->dock, found->info->area, *this);
    found->dock->show();
    const bool isCovered = with != m_docks.end() && with->dock != found->dock &&
                           tabifiedDockWidgets(found->dock).contains(with->dock);
    found->dock->raise();
    if (isCovered) {
        mainStop(found->panel)->setFocus();
    }
}

void MainWindow::showEvidence(std::optional<std::uint64_t> incident) {
    m_driver.commands().showLive();
    m_driver.commands().showIncident(incident);
    mainStop(findDock(QStringLiteral("events"))->panel)->setFocus();
}

QWidget* MainWindow::showPart(const QString& name) {
    auto* part = findChild<QWidget*>(name);
    for (const Dock& dock : m_docks) {
        if (part == dock.dock || dock.dock->isAncestorOf(part)) {
            showDock(dock.dock->objectName());
            refreshPanels();
        }
    }
    return part;
}

QStringList MainWindow::docksInSight() const {
    QStringList names;
    for (const Dock& dock : m_docks) {
        names += dock.isInSight() ? QStringList(dock.dock->objectName()) : QStringList();
    }
    return names;
}

/// Shows a dock, and keeps which one its tab covers.
void MainWindow::coverBy(const QString& name) {
    const QStringList before = docksInSight();
    showDock(name);
    m_covered.clear();
    const Dock* dock = findDock(name);
    if (dock == nullptr || before.contains(name)) {
        return;
    }
    for (const QDockWidget* neighbour : tabifiedDockWidgets(dock->dock)) {
        if (before.contains(neighbour->objectName())) {
            m_covered = neighbour->objectName();
        }
    }
}

/// Brings back what a jump to packets has covered, and the keyboard with it.
void MainWindow::uncover() {
    if (const Dock* dock = findDock(std::exchange(m_covered, {}))) {
        dock->dock->raise();
        mainStop(dock->panel)->setFocus();
    }
}

/// Opens and closes a dock; one that lies behind another is brought to the front instead, for it was not
/// seen.
QAction* MainWindow::dockAction(QDockWidget* dock) {
    auto* action = new QAction(dock->windowTitle(), dock);
    action->setCheckable(true);
    const auto showState = [dock, action] { action->setChecked(dock->toggleViewAction()->isChecked()); };
    connect(dock->toggleViewAction(), &QAction::toggled, action, showState);
    connect(action, &QAction::triggered, this, [this, dock, showState] {
        toggleDock(dock->objectName());
        showState();
    });
    return action;
}

void MainWindow::toggleDock(const QString& name) {
    const Dock* dock = findDock(name);
    if (dock != nullptr && dock->isInSight()) {
        dock->dock->close();
    } else if (dock != nullptr) {
        showDock(name);
        mainStop(dock->panel)->setFocus();
    }
}

void MainWindow::dockAll() {
    for (const Dock& dock : m_docks) {
        dock.dock->setFloating(false);
    }
    if (onScreen(geometry()).isEmpty()) {
        move(screen()->availableGeometry().topLeft());
    }
}

bool MainWindow::focusNextPrevChild(bool isNext) {
    const auto step = [isNext](QWidget* one) {
        return isNext ? one->nextInFocusChain() : one->previousInFocusChain();
    };
    // Docks behind others, and the tabs of an area without any, lie beside the window.
    const auto isInSight = [this](const QWidget* one) {
        while (one->parentWidget() != this) {
            one = one->parentWidget();
        }
        return rect().intersects(one->geometry());
    };
    QWidget* const from = focusWidget() != nullptr ? focusWidget() : this;
    for (QWidget* one = step(from); one != from; one = step(one)) {
        const bool takesTab = (one->focusPolicy() & Qt::TabFocus) == Qt::TabFocus &&
                              one->focusProxy() == nullptr && one->window() == this && one->isVisible() &&
                              one->isEnabled();
        if (takesTab && one != this && isInSight(one)) {
            one->setFocus(isNext ? Qt::TabFocusReason : Qt::BacktabFocusReason);
            return true;
        }
    }
    return false;
}

void MainWindow::moveFocus(int direction) {
    std::vector<QWidget*> stops{m_viewport};
    std::size_t current = 0;
    for (const Dock& dock : m_docks) {
        if (!dock.panel->isVisible()) {
            continue;
        }
        if (dock.dock->isAncestorOf(QApplication::focusWidget())) {
            current = stops.size();
        }
        stops.push_back(dock.panel);
    }
    if (m_health->firstEntry() != nullptr) {
        current = m_health->isAncestorOf(QApplication::focusWidget()) ? stops.size() : current;
        stops.push_back(m_health);
    }
    const std::size_t step = direction < 0 ? stops.size() - 1 : 1;
    QWidget* next = stops[(current + step) % stops.size()];
    const auto reached = std::ranges::find(m_docks, next, &Dock::panel);
    if (reached != m_docks.end()) {
        reached->dock->raise();
    }
    (next == m_viewport ? next : firstStop(next))->setFocus(Qt::TabFocusReason);
}

} // namespace posewire::gui
