// SPDX-License-Identifier: GPL-3.0-or-later
// What docks show: a page of what is live each, and one of the file that is open.
#include "app/gui/window/docks.h"
#include "app/gui/window/health_bar.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/transport_bar.h"

#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QStatusBar>

#include <utility>

namespace posewire::gui {

void MainWindow::makeDocks() {
    QMenu* menu = menuAt(*menuBar(), QStringLiteral("&View"));
    QAction* before = menu->actions().value(0);
    for (const PanelInfo& info : panelTable()) {
        auto* dock = new QDockWidget(QCoreApplication::translate("Panel", info.title), this);
        dock->setObjectName(QLatin1String(info.id));
        const Page page = makePage(info, dock);
        page.panel->restoreState(m_settings.panels[QLatin1String(info.id)].toObject());
        dock->setWidget(page.scroll);
        auto* title = new DockTitle(dock);
        dock->setTitleBarWidget(title);
        addDockWidget(info.area, dock);
        dock->hide(); // the layout says which ones show: all of them would make the window too wide
        menu->insertAction(before, dockAction(dock));
        m_docks.push_back({&info, dock, title, page, {}, page.panel});
        connect(dock, &QDockWidget::visibilityChanged, this, [this, i = m_docks.size() - 1](bool isVisible) {
            if (isVisible) {
                m_docks[i].panel->refresh();
            }
        });
    }
    menu->insertSeparator(before);
}

MainWindow::Page MainWindow::makePage(const PanelInfo& info, QDockWidget* dock) {
    Panel* panel =
        info.make({m_driver.commands().session(), m_driver.commands(), m_driver.playback(),
                   m_driver.files().comparing(), m_driver.receiving().state(), m_driver.health().health()},
                  dock);
    return {scrolling(panel, dock), panel};
}

/// What the operator set in a dock is of the dock: it goes along from page to page.
void MainWindow::showSession() {
    Commands& commands = m_driver.commands();
    const bool isFile = commands.isFileShown();
    for (Dock& dock : m_docks) {
        if (isFile && dock.file.panel == nullptr) {
            dock.file = makePage(*dock.info, dock.dock);
        }
        const Page& page = isFile ? dock.file : dock.live;
        if (page.panel != dock.panel) {
            page.panel->restoreState(dock.panel->state());
        }
        dock.dock->setWidget(page.scroll);
        page.scroll->show();
        dock.panel = page.panel;
    }
    if (isFile && m_fileHealth == nullptr) {
        m_fileHealth = new HealthBar(commands.session(), commands, this);
        statusBar()->insertWidget(0, m_fileHealth, 1);
    }
    HealthBar* const before = std::exchange(m_health, isFile ? m_fileHealth : m_liveHealth);
    before->hide();
    m_health->show();
    if (before != m_health) {
        m_health->takeMessage(*before);
    }
    m_transport->showSession(commands.session(), !isFile);
    m_viewport->showSession(commands.session(), isFile ? m_driver.files().file()->name() : QString());
    m_menus.showStates();
    showReceiving();
    refreshPanels();
}

/// Its session is about to go.
void MainWindow::forgetFile() {
    for (Dock& dock : m_docks) {
        delete std::exchange(dock.file, {}).scroll;
    }
    delete std::exchange(m_fileHealth, nullptr);
}

void MainWindow::refreshPanels() {
    for (const Dock& dock : m_docks) {
        const bool isInSight = dock.isInSight();
        if (isInSight) {
            dock.panel->refresh();
            dock.title->setSummary(dock.panel->summary());
            dock.title->setTabbed(!tabifiedDockWidgets(dock.dock).isEmpty());
        }
        for (Panel* panel : {dock.live.panel, dock.file.panel}) {
            const bool isDone = isInSight && panel == dock.panel;
            if (panel != nullptr && panel->hasWindow() && !isDone) {
                panel->refresh();
            }
        }
    }
}

} // namespace posewire::gui
