// SPDX-License-Identifier: GPL-3.0-or-later
// The user guide and the tour, as the window offers them.
#include "app/gui/help/help_window.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/window/health_bar.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/texts.h"
#include "app/gui/window/tour.h"
#include "app/gui/window/transport_bar.h"
#include "app/gui/window/verdict_bar.h"

#include <QApplication>
#include <QDesktopServices>
#include <QDockWidget>
#include <QMenuBar>
#include <QStatusBar>

#include <algorithm>

namespace posewire::gui {

MainWindow::~MainWindow() {
    QDesktopServices::unsetUrlHandler(QLatin1String(kHelpScheme));
}

void MainWindow::connectHelp() {
    QDesktopServices::setUrlHandler(QLatin1String(kHelpScheme), this, "followHelpLink");
    setHelpPlace(*m_viewport, placeOf(HelpTopic::Viewport));
    setHelpPlace(*m_transport, placeOf(HelpTopic::TransportBar));
    setHelpPlace(*m_verdict, placeOf(HelpTopic::VerdictBar));
    setHelpPlace(*statusBar(), placeOf(HelpTopic::HealthBar));
    for (const Dock& dock : m_docks) {
        setHelpPlace(*dock.dock, dock.dock->objectName());
    }
    setAcceptDrops(true);
}

void MainWindow::followHelpLink(const QUrl& link) {
    showHelp(link.hasFragment() ? link.path() + u'#' + link.fragment() : link.path());
}

void MainWindow::showHelp(const QString& place) {
    if (m_helpPages == nullptr) {
        m_helpPages = std::make_unique<HelpPages>(madeHelpParts());
    }
    // A dialog that waits for its answer lets only its own windows be used.
    QWidget* parent = QApplication::activeModalWidget();
    parent = parent == nullptr ? this : parent;
    auto* guide = parent->findChild<HelpWindow*>(QString(), Qt::FindDirectChildrenOnly);
    if (guide == nullptr) {
        guide = new HelpWindow(*m_helpPages, parent);
    }
    guide->open(place);
}

void MainWindow::showHelpHere() {
    showHelp(helpPlaceOf(QApplication::focusWidget()));
}

void MainWindow::showTour() {
    if (findChild<Tour*>() != nullptr) {
        return;
    }
    const auto key = [this](const char* action) {
        return m_menus.action(QLatin1String(action))->shortcut().toString(QKeySequence::NativeText);
    };
    const auto seen = std::ranges::find_if(m_docks, &Dock::isInSight);
    QWidget* dock = seen == m_docks.end() ? nullptr : seen->dock;
    const std::vector<TourStep> steps{
        {tr("Is the stream good?"),
         tr("The answer is always in this line. A click on it opens the evidence. Press Reset before take, "
            "and it speaks only of what comes from then on."),
         m_verdict},
        {tr("Who is on the air"),
         tr("The performers as they were received. Drag to orbit, wheel to zoom, %1 to see all of them. A "
            "figure that is not up to date dims, and then says for how long.")
             .arg(key("frame")),
         m_viewport},
        {tr("How each performer is doing"),
         tr("The worst comes first. Click a name to read why. At the right: what this computer receives, how "
            "far back it can look, and what it dropped itself."),
         m_health},
        {tr("Stop, look back, record"),
         tr("%1 stops the display, never the receiving; %2 goes back to live. %3 records a take.")
             .arg(key("pause"), key("live"), key("record")),
         m_transport},
        {tr("Docks explain the rest"),
         tr("All docks show the same moment and the performer that you click. The ? in a title explains the "
            "dock. %1 arranges them to check a stream, %2 to find lost packets, %3 to look at null poses.")
             .arg(key("layoutCheck"), key("layoutDebug"), key("layoutInspect")),
         dock},
        {tr("Everything is in a menu"),
         tr("%1 finds any command by its words. %2 opens the guide at the part of the window that you are "
            "in; Help > User guide begins with the three things that operators do most.")
             .arg(key("findCommand"), key("helpHere")),
         menuBar()}};
    auto* tour = new Tour(steps, this);
    connect(tour, &Tour::ended, this, [this] { m_settings.tour = Tour::kVersion; });
}

void MainWindow::offerTour() {
    if (m_settings.tour < Tour::kVersion) {
        showTour();
    }
}

} // namespace posewire::gui
