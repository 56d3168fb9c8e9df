// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/main_window.h"

#include "app/gui/base/dock_layout.h"
#include "app/gui/help/help_pages.h"
#include "app/gui/inputs/inputs_page.h"
#include "app/gui/models/comparison_text.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/icons.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/viewport/viewport_overlay.h"
#include "app/gui/window/command_palette.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/health_bar.h"
#include "app/gui/window/history_dialog.h"
#include "app/gui/window/keyboard.h"
#include "app/gui/window/transport_bar.h"
#include "app/gui/window/verdict_bar.h"
#include "core/model/session/verdict.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

/// Raised when docks or tool bars change so that an old state would not fit.
constexpr int kStateVersion = 2;
constexpr QSize kDefaultSize(1600, 1000);
/// What a desktop puts around a window, about; it does not tell before the window is there.
constexpr QSize kFrame(16, 48);

/// A tool bar that stays where it is and holds one widget.
QToolBar* fixedBar(const QString& title, const QString& name, QWidget* content) {
    auto* bar = new QToolBar(title);
    bar->setObjectName(name);
    bar->setMovable(false);
    bar->toggleViewAction()->setVisible(false);
    bar->setContextMenuPolicy(Qt::PreventContextMenu);
    bar->addWidget(content);
    return bar;
}

} // namespace

MainWindow::MainWindow(SessionDriver& driver, const SettingsFile& file, const Settings& settings)
    : m_driver(driver),
      m_file(file),
      m_settings(settings),
      m_viewport(new ViewportWidget(driver.commands().session(), driver.commands(), this)),
      m_menus(*this, *menuBar()) {
    setWindowTitle(QStringLiteral("Posewire"));
    setDockOptions(AllowNestedDocks | AllowTabbedDocks | AnimatedDocks);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    setCentralWidget(m_viewport);
    layout()->setSizeConstraint(QLayout::SetNoConstraint); // docks give way; the window stays on its screen
    addViewportButtons(*m_viewport);
    makeBars();
    makeDocks();
    connectDriver();
    connectHelp();
    m_driver.commands().setThresholds(m_settings.alerts.thresholds);
    m_driver.commands().setDisplayFilter(m_settings.filter);
    connect(&m_viewport->choice().ownCharacters(), &OwnCharacters::failed, this,
            &MainWindow::sayAlsoAfterOpening);
    m_viewport->choice().restoreState(m_settings.viewport);
    m_viewport->pictures().setComparison(m_driver.files().comparing().state());
    new PressingKeys(this);
    new EventWatch(this, QEvent::ThemeChange, [this] { useTheme(m_settings.theme); }); // of the desktop
    keepHistory();
    restore();
}

void MainWindow::makeBars() {
    auto* name = plainLabel(QStringLiteral("Posewire"), this);
    QFont font = name->font();
    font.setWeight(QFont::Bold);
    name->setFont(font);
    name->setContentsMargins(12, 0, 6, 0);
    menuBar()->setCornerWidget(name, Qt::TopLeftCorner);
    m_layoutButton = new QToolButton(this);
    m_layoutButton->setProperty("flat", true);
    m_layoutButton->setMenu(menuAt(*menuBar(), QStringLiteral("&View/La&yout")));
    m_layoutButton->setPopupMode(QToolButton::InstantPopup);
    m_layoutButton->setObjectName(QStringLiteral("layoutButton"));
    menuBar()->setCornerWidget(m_layoutButton, Qt::TopRightCorner);

    const TimeControls::Actions time{
        m_menus.action("sampleBack"), m_menus.action("sampleOn"),
        m_menus.action("playBack"),   m_menus.action("play"),
        m_menus.action("loop"),       menuAt(*menuBar(), QStringLiteral("&Time/Sp&eed"))};
    m_transport = new TransportBar(m_driver.commands().session(),
                                   TransportBar::Actions{m_menus.action("record"), m_menus.action("pause"),
                                                         m_menus.action("live"), m_menus.action("inputs"),
                                                         m_menus.action("relay"), time},
                                   this);
    connect(m_transport, &TransportBar::inputRequested, this, [this](const InputAddress& input) {
        openInputs(InputsDialog::Page::Inputs);
        m_inputs->inputs().select(input);
    });
    m_transport->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    addToolBar(Qt::TopToolBarArea, fixedBar(tr("Transport"), QStringLiteral("transportBar"), m_transport));

    m_verdict =
        new VerdictBar(m_driver.commands().live(),
                       {m_menus.action("resetForTake"), m_menus.action("live"), m_menus.action("showFile"),
                        m_menus.action("closeFile"), m_menus.action("endComparison")},
                       this);
    m_verdict->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    addToolBarBreak(Qt::TopToolBarArea);
    addToolBar(Qt::TopToolBarArea, fixedBar(tr("Verdict"), QStringLiteral("verdict"), m_verdict));
    connect(m_verdict, &VerdictBar::evidenceRequested, this, &MainWindow::showEvidence);

    m_health = m_liveHealth = new HealthBar(m_driver.commands().live(), m_driver.commands(), this);
    statusBar()->setSizeGripEnabled(false);
    statusBar()->addWidget(m_health, 1);
    m_stopOpening =
        framedButton(tr("Stop"), tr("Stop opening the file (Esc); what was read of it stays"), this);
    m_stopOpening->setObjectName(QStringLiteral("stopOpeningButton"));
    connect(m_stopOpening, &QToolButton::clicked, m_menus.action("stopOpening"), &QAction::trigger);
    statusBar()->addPermanentWidget(m_stopOpening);
    showOpening();
}

void MainWindow::connectDriver() {
    const auto showStates = [this] { m_menus.showStates(); };
    const auto showTake = [this] { m_transport->showTake(m_driver.takes().state()); };
    const Commands& commands = m_driver.commands();
    connect(&commands, &Commands::changed, this, showStates);
    connect(&commands, &Commands::switched, this, &MainWindow::showSession);
    connect(&commands, &Commands::frameCharacter, m_viewport, &ViewportWidget::frameCharacter);
    connect(&commands, &Commands::showDock, this, &MainWindow::coverBy);
    connect(&commands, &Commands::wentBack, this, &MainWindow::uncover);
    connect(&m_driver, &SessionDriver::moved, m_viewport, &ViewportWidget::refresh);
    connect(&m_driver, &SessionDriver::moved, m_transport, &TransportBar::refresh);
    connect(&m_driver, &SessionDriver::tableTick, this, &MainWindow::refreshPanels);
    connect(&m_driver, &SessionDriver::tableTick, this, &MainWindow::showReceiving);
    connect(&m_driver, &SessionDriver::tableTick, this, &MainWindow::alert);
    connect(&m_driver, &SessionDriver::tableTick, this, &MainWindow::showOpening);
    connect(&m_driver, &SessionDriver::tableTick, m_transport, showTake);
    connect(&m_driver, &SessionDriver::relayStopped, this, &MainWindow::keepRelays);
    const Files& files = m_driver.files();
    connect(&files, &Files::closing, this, &MainWindow::forgetFile);
    connect(&files, &Files::opened, this, [this](bool isRead, const QString& text) {
        showOpening();
        // What there is to know of one that was read is told as long as it shows.
        if (isRead) {
            say(m_sayAgain);
        } else {
            say(text, HelpTopic::OpeningFailed);
        }
    });
    const Comparing& comparing = m_driver.files().comparing();
    connect(&comparing, &Comparing::askForRecording, this, &MainWindow::chooseComparison);
    connect(&comparing, &Comparing::changed, this, [this](const QString& text) {
        showOpening();
        showReceiving();
        if (!text.isEmpty()) {
            sayAlsoAfterOpening(text);
        }
    });
    connect(&m_driver.demo(), &Demo::changed, this, showStates);
    connect(&m_driver.takes(), &Takes::changed, this, [this, showTake](const QString& problem) {
        m_menus.showStates();
        showTake();
        say(problem, HelpTopic::RecordingFailed);
    });
    connect(&m_viewport->choice(), &ViewChoice::changed, this, showStates);
    showReceiving();
}

void MainWindow::restore() {
    const QRect place = onScreen(m_settings.window);
    if (place.isEmpty()) {
        const QRect room = screen()->availableGeometry();
        resize(kDefaultSize.boundedTo(room.size() - kFrame));
    } else {
        setGeometry(place);
    }
    if (m_settings.isMaximized) {
        setWindowState(windowState() | Qt::WindowMaximized);
    }
    showLayoutName(m_settings.layout);
    const auto layout = findLayout(m_settings.layout);
    m_verdict->setLarge(layout && layout->hasLargeVerdict);
}

/// Sizes of docks only hold once the window has its own.
void MainWindow::showEvent(QShowEvent* event) {
    QMainWindow::showEvent(event);
    if (m_isRestored) {
        return;
    }
    m_isRestored = true;
    if (m_settings.docks.isEmpty() || !restoreState(m_settings.docks, kStateVersion)) {
        useLayout(m_settings.layout);
    }
    for (const Dock& dock : m_docks) {
        if (dock.dock->isFloating() && onScreen(dock.dock->geometry()).isEmpty()) {
            dock.dock->setFloating(false);
        }
    }
}

namespace {

/// On one screen, or on several side by side.
bool isAllSeen(const QRect& window) {
    QRegion hidden(window);
    for (const QScreen* screen : QGuiApplication::screens()) {
        hidden -= screen->availableGeometry();
    }
    return hidden.isEmpty();
}

/// As far as it has to be, and as large as it may be.
QRect movedInto(const QRect& room, const QRect& window) {
    QRect moved(window.topLeft(), window.size().boundedTo(room.size()));
    moved.moveRight(std::min(moved.right(), room.right()));
    moved.moveBottom(std::min(moved.bottom(), room.bottom()));
    moved.moveLeft(std::max(moved.left(), room.left()));
    return moved;
}

} // namespace

QRect onScreen(const QRect& window) {
    constexpr int kGrabbable = 80;
    if (window.width() < kGrabbable || window.height() < kGrabbable) {
        return {};
    }
    for (const QScreen* screen : QGuiApplication::screens()) {
        const QRect room = screen->availableGeometry();
        const QRect seen = room.intersected(window);
        if (seen.width() >= kGrabbable && seen.height() >= kGrabbable && window.top() >= room.top()) {
            return isAllSeen(window) ? window : movedInto(room, window);
        }
    }
    return {};
}

Settings MainWindow::settings() const {
    Settings settings = m_settings;
    settings.window = normalGeometry().isEmpty() ? geometry() : normalGeometry();
    settings.isMaximized = isMaximized();
    settings.docks = saveState(kStateVersion);
    for (const Dock& dock : m_docks) {
        if (const QJsonObject state = dock.panel->state(); !state.isEmpty()) {
            settings.panels[dock.dock->objectName()] = state;
        } else {
            settings.panels.remove(dock.dock->objectName());
        }
    }
    settings.viewport = m_viewport->choice().state();
    settings.filter = QString::fromStdString(m_driver.commands().live().choices().ownFilter());
    const auto pathOf = [](const OpenedFile* file) {
        return file != nullptr ? QDir().absoluteFilePath(file->path()) : QString();
    };
    OpenedFile* const file = m_driver.commands().isFileShown() ? m_driver.files().file() : nullptr;
    settings.file = pathOf(file);
    settings.fileFilter =
        file != nullptr ? QString::fromStdString(file->session().choices().ownFilter()) : QString();
    settings.comparedFile = pathOf(m_driver.files().comparing().file());
    return settings;
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (const QString problem = m_file.write(settings()); !problem.isEmpty()) {
        qWarning("Settings were not saved: %s", qUtf8Printable(problem));
    }
    event->accept();
}

void MainWindow::showReceiving() {
    const ReceivingState& state = m_driver.receiving().state();
    m_transport->setReceiving(state);
    m_health->refresh(state);
    m_viewport->setReceiving(state);
    showVerdict();
    if (m_inputs != nullptr) {
        m_inputs->refresh();
    }
    m_driver.health().setPictures(m_viewport->pictures().count(), m_viewport->pictures().health());
    if (const SceneBuilder* builder = m_viewport->pictures().builder()) {
        const BodyFits& bodies = builder->bodies();
        const OwnFigures& own = builder->ownFigures();
        m_driver.health().setMeshMemory(bodies.memoryBytes() + own.memoryBytes(),
                                        bodies.mostBytes() + own.mostBytes());
    }
}

void MainWindow::showVerdict() {
    const ComparisonState& comparison = m_driver.files().comparing().state();
    const bool hasPackets = m_driver.commands().live().end() != 0;
    ShownFile file;
    if (OpenedFile* opened = m_driver.files().file(); opened != nullptr && opened->session().end() != 0) {
        file = {opened->name(), m_driver.commands().isFileShown(),
                said(opened->verdict().said, words::Form::Headline), opened->notes()};
    }
    file.comparison = comparisonText(comparison);
    const std::vector<PortState>& ports = m_driver.receiving().state().ports;
    const bool hasInputs = !ports.empty() || hasPackets;
    const bool isBlocked = !ports.empty() && std::ranges::none_of(ports, [](const PortState& port) {
        return port.problem.isEmpty();
    });
    m_menus.action("pause")->setEnabled(!file.isShown);
    m_menus.action("live")->setEnabled(hasInputs || !file.isShown);
    m_menus.action("showFile")->setEnabled(!file.name.isEmpty() && !file.isShown);
    m_menus.action("closeFile")->setEnabled(!file.name.isEmpty());
    m_menus.action("endComparison")->setEnabled(comparison.isOpen);
    m_menus.action("resetForTake")->setEnabled(hasPackets);
    m_verdict->refresh(file, hasInputs, isBlocked ? ports.front().problem : QString());
}

/// At once: whatever ends this program, the next run must not begin with a loop.
void MainWindow::keepRelays() {
    m_settings.inputs.relays = m_driver.receiving().choices().relays;
    if (const QString problem = m_file.write(settings()); !problem.isEmpty()) {
        say(problem, HelpTopic::SettingsUnusable);
    }
}

void MainWindow::openInputs(InputsDialog::Page page) {
    if (m_inputs == nullptr) {
        m_inputs = new InputsDialog(m_driver.receiving(), this);
        connect(m_inputs, &InputsDialog::openFileRequested, this, &MainWindow::openFile);
        connect(m_inputs, &InputsDialog::choicesChanged, this, [this] {
            m_settings.inputs = m_driver.receiving().choices();
            showReceiving();
        });
    }
    m_inputs->open(page);
}

void MainWindow::editThresholds() {
    ThresholdsDialog dialog(m_settings.alerts, this);
    if (dialog.exec() == QDialog::Accepted) {
        m_settings.alerts = dialog.choices();
        m_driver.commands().setThresholds(m_settings.alerts.thresholds);
    }
}

void MainWindow::alert() {
    if (m_sounds.isDue(m_driver.commands().live().verdicts().incidents(), m_settings.alerts)) {
        QApplication::beep();
    }
    m_notifier.look(m_verdict->verdict(), m_settings.alerts.hasNotification);
}

void MainWindow::useTheme(ThemeChoice choice) {
    m_settings.theme = choice;
    applyTheme(*qApp, choice);
}

void MainWindow::useLayout(const QString& nameOrFile) {
    const auto layout = findLayout(nameOrFile);
    if (!layout) {
        say(layout.error(), HelpTopic::UnknownLayout);
        return;
    }
    const QWidget* const hadKeyboard = focusWidget();
    if (const QStringList unknown = applyLayout(*layout, *this); !unknown.isEmpty()) {
        say(tr("Layout %1: there is no dock named %2").arg(layout->name, unknown.join(tr(" or "))),
            HelpTopic::UnknownLayout);
    }
    // Docks that are taken away leave it to the next button, and Space would press that.
    if (focusWidget() != hadKeyboard) {
        m_viewport->setFocus();
    }
    m_verdict->setLarge(layout->hasLargeVerdict);
    m_settings.layout = layoutNames().contains(layout->name) ? layout->name : nameOrFile;
    showLayoutName(layout->name);
    refreshPanels();
}

/// It may be the path of a file, and the button must not make the window wide.
void MainWindow::showLayoutName(const QString& name) {
    const QFontMetrics metrics = m_layoutButton->fontMetrics();
    const int most = metrics.averageCharWidth() * 30;
    m_layoutButton->setText(tr("Layout: %1 ▾").arg(metrics.elidedText(name, Qt::ElideMiddle, most)));
}

void MainWindow::findCommand() {
    CommandPalette palette(*menuBar(), this);
    palette.exec();
    if (QAction* chosen = palette.chosen()) {
        chosen->trigger();
    }
}

void MainWindow::editHistory() {
    HistoryDialog dialog(m_driver.commands().live(), m_driver.history(), m_settings.history, this);
    if (dialog.exec() == QDialog::Accepted && dialog.choice() != m_settings.history) {
        m_settings.history = dialog.choice();
        keepHistory();
    }
}

void MainWindow::keepHistory() {
    constexpr std::uint64_t gigabyte = 1'000'000'000;
    const HistoryChoice& choice = m_settings.history;
    const std::uint64_t most = static_cast<std::uint64_t>(choice.gigabytes) * gigabyte;
    if (const QString problem = m_driver.history().keep(choice.isOnDisk ? most : 0); !problem.isEmpty()) {
        say(problem, HelpTopic::HistoryOff);
    }
}

const QWidget& MainWindow::ownerOf(const MenuEntry& entry) const {
    const auto found = std::ranges::find(m_docks, entry.panel, &Dock::info);
    return found == m_docks.end() ? static_cast<const QWidget&>(*this) : *found->panel;
}

void MainWindow::carryOut(const MenuEntry& entry) {
    if (entry.panel != nullptr) {
        showDock(QLatin1String(entry.panel->id));
    }
    entry.action->run(const_cast<QWidget&>(ownerOf(entry)));
}

void MainWindow::list(const MenuEntry& entry, QMenu& menu) {
    entry.action->list(const_cast<QWidget&>(ownerOf(entry)), menu);
    for (QAction* action : entry.panel != nullptr ? menu.actions() : QList<QAction*>()) {
        connect(action, &QAction::triggered, this,
                [this, entry] { showDock(QLatin1String(entry.panel->id)); });
    }
}

bool MainWindow::isOn(const MenuEntry& entry) const {
    return entry.action->isOn(ownerOf(entry));
}

void MainWindow::say(const QString& text) {
    m_health->say(text);
}

void MainWindow::sayAlsoAfterOpening(const QString& text) {
    say(text);
    m_sayAgain = text;
}

void MainWindow::say(const QString& text, HelpTopic topic) {
    m_health->say(text, placeOf(topic));
}

} // namespace posewire::gui
