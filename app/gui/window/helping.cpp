// SPDX-License-Identifier: GPL-3.0-or-later
// The user guide, as the window offers it.
#include "app/gui/help/help_window.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/window/health_bar.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/texts.h"
#include "app/gui/window/transport_bar.h"
#include "app/gui/window/verdict_bar.h"

#include <QApplication>
#include <QDesktopServices>
#include <QDockWidget>
#include <QStatusBar>

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

void MainWindow::offerFirstSteps() {
    if (!m_settings.isGuideOffered && m_health->said().isEmpty()) {
        m_settings.isGuideOffered = true;
        say(tr("New here? The guide begins with the first steps: Help > First steps"), HelpTopic::FirstSteps);
    }
}

} // namespace posewire::gui
