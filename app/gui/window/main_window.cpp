// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/main_window.h"

#include "app/gui/base/dock_layout.h"
#include "app/gui/inputs/inputs_page.h"
#include "app/gui/models/comparison_text.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/viewport_overlay.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/health_bar.h"
#include "app/gui/window/opening.h"
#include "app/gui/window/transport_bar.h"
#include "app/gui/window/verdict_bar.h"
#include "core/model/session/verdict.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QFileInfo>
#include <QKeyEvent>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QStatusBar>
#include <QTabBar>
#include <QTimer>
#include <QToolBar>
#include <QToolButton>
#include <QTreeView>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

/// Milliseconds: half the interval between two ticks.
constexpr int kAfterTick = 8;

bool isPlain(const QKeyEvent& event, std::initializer_list<int> keys) {
    return (event.modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier &&
           std::ranges::count(keys, event.key()) != 0;
}

/// The box in the current row of a table; invalid where it has none.
QModelIndex boxOf(const QAbstractItemView& view) {
    const QModelIndex current = view.currentIndex();
    const int columns = current.isValid() ? current.model()->columnCount(current.parent()) : 0;
    for (int column = 0; column < columns; ++column) {
        const QModelIndex cell = current.siblingAtColumn(column);
        if ((cell.flags() & Qt::ItemIsUserCheckable) != 0 && cell.data(Qt::CheckStateRole).isValid()) {
            return cell;
        }
    }
    return {};
}

void toggle(QAbstractItemView& view, const QModelIndex& box) {
    const bool isOn = box.data(Qt::CheckStateRole).toInt() == Qt::Checked;
    view.model()->setData(box, isOn ? Qt::Unchecked : Qt::Checked, Qt::CheckStateRole);
}

/// Arrows to the sides step through time, or with Alt go back, where they mean nothing else.
bool wantsArrows(QObject& watched, Qt::KeyboardModifiers modifiers) {
    const auto* tree = qobject_cast<QTreeView*>(&watched);
    const bool isOfMoves =
        tree != nullptr ? tree->rootIsDecorated() : qobject_cast<QTabBar*>(&watched) != nullptr;
    const bool isOfRange = qobject_cast<QAbstractSlider*>(&watched) != nullptr;
    return isOfMoves ? (modifiers & ~Qt::KeypadModifier) == Qt::NoModifier
                     : isOfRange && !modifiers.testFlag(Qt::AltModifier);
}

void press(QAbstractButton& button) {
    auto* tool = qobject_cast<QToolButton*>(&button);
    if (tool != nullptr && tool->menu() != nullptr && tool->popupMode() == QToolButton::InstantPopup) {
        tool->showMenu();
    } else {
        button.click();
    }
}

/// Raised when docks or tool bars change so that an old state would not fit.
constexpr int kStateVersion = 2;
constexpr QSize kDefaultSize(1600, 1000);
/// About the size of a desktop's frame around a window, which is not known before the window is there.
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

/// Enter presses the button or list of choices that has the focus, in the whole program. Space does so in
/// dialogs, where it toggles boxes of tables as well; in the window it plays and pauses.
class PressingKeys final : public QObject {
public:
    /// From now on, as long as the parent lives.
    explicit PressingKeys(QObject* parent) : QObject(parent) {
        QCoreApplication::instance()->installEventFilter(this);
    }

    bool eventFilter(QObject* watched, QEvent* event) override;
};

/// A shortcut takes a key before the widget that has the focus gets it, unless that says that it wants it.
bool PressingKeys::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress) {
        return false;
    }
    auto* key = static_cast<QKeyEvent*>(event);
    const bool isSideways = key->key() == Qt::Key_Left || key->key() == Qt::Key_Right;
    if (isSideways && event->type() == QEvent::ShortcutOverride && wantsArrows(*watched, key->modifiers())) {
        event->accept();
        return true;
    }
    auto* button = qobject_cast<QAbstractButton*>(watched);
    auto* list = qobject_cast<QComboBox*>(watched);
    auto* table = qobject_cast<QAbstractItemView*>(watched);
    if (button == nullptr && list == nullptr && table == nullptr) {
        return false;
    }
    const QWidget* window = static_cast<QWidget*>(watched)->window();
    const bool isOfWindow = window == parent() || qobject_cast<const QDockWidget*>(window) != nullptr;
    const bool isSpace = !isOfWindow && isPlain(*key, {Qt::Key_Space, Qt::Key_Select});
    // In a dialog Enter on a list is for the default button.
    const bool isEnter = (isOfWindow || list == nullptr) && isPlain(*key, {Qt::Key_Return, Qt::Key_Enter});
    const QModelIndex box = table != nullptr ? boxOf(*table) : QModelIndex();
    if (table != nullptr ? !isSpace || !box.isValid() : !isSpace && !isEnter) {
        return false;
    }
    event->accept();
    if (event->type() == QEvent::KeyPress && !key->isAutoRepeat()) {
        if (button != nullptr) {
            press(*button);
        } else if (list != nullptr) {
            list->showPopup();
        } else {
            toggle(*table, box);
        }
    }
    return true;
}

MainWindow::MainWindow(SessionDriver& driver, SettingsFile& file, const Settings& settings)
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
    setHelpPlace(*m_viewport, placeOf(HelpTopic::Viewport));
    addViewportButtons(*m_viewport, *menuAt(*menuBar(), QStringLiteral("&View/&Axes")),
                       *menuAt(*menuBar(), QStringLiteral("&View/O&verlays")));
    makeBars();
    m_docks = new Docks(driver, *this, *menuAt(*menuBar(), QStringLiteral("&View")), settings.panels);
    connectDriver();
    m_opening = new Opening(*this);
    m_driver.commands().setThresholds(m_settings.alerts.thresholds);
    m_driver.commands().setDisplayFilter(m_settings.filter);
    m_viewport->choice().restoreState(m_settings.viewport);
    m_viewport->pictures().setComparison(m_driver.files().comparing().state());
    new PressingKeys(this);
    new EventWatch(this, QEvent::ThemeChange, [this] { useTheme(m_settings.theme); }); // of the desktop
    keepHistory();
    restore();
}

void MainWindow::makeBars() {
    auto* name = plainLabel(QStringLiteral("Posewire"), this);
    name->setProperty("heading", true);
    name->setContentsMargins(12, 0, 6, 0);
    menuBar()->setCornerWidget(name, Qt::TopLeftCorner);
    m_layoutButton = flatButton({}, {}, this);
    m_layoutButton->setMenu(menuAt(*menuBar(), QStringLiteral("&View/La&yout")));
    m_layoutButton->setPopupMode(QToolButton::InstantPopup);
    m_layoutButton->setObjectName(QStringLiteral("layoutButton"));

    const auto action = [this](const char* id) { return m_menus.action(QLatin1String(id)); };
    m_transport = new TransportBar(m_driver.commands().session(),
                                   {action("record"), action("pause"), action("live"), action("inputs"),
                                    action("sampleBack"), action("sampleOn"), action("playBack"),
                                    action("loop"), menuAt(*menuBar(), QStringLiteral("&Time/Sp&eed"))},
                                   this);
    connect(m_transport, &TransportBar::inputRequested, this, [this](const InputAddress& input) {
        openInputs(InputsDialog::Page::Inputs);
        m_inputs->inputs().select(input);
    });
    setHelpPlace(*m_transport, placeOf(HelpTopic::TransportBar));
    m_transport->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    addToolBar(Qt::TopToolBarArea, fixedBar(tr("Transport"), QStringLiteral("transportBar"), m_transport));

    m_verdict = new VerdictBar(m_driver.commands().live(),
                               {action("resetForTake"), action("live"), action("showFile"),
                                action("closeFile"), action("endComparison"), action("recovered")},
                               this);
    setHelpPlace(*m_verdict, placeOf(HelpTopic::VerdictBar));
    m_verdict->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    addToolBarBreak(Qt::TopToolBarArea);
    addToolBar(Qt::TopToolBarArea, fixedBar(tr("Verdict"), QStringLiteral("verdict"), m_verdict));
    m_health = new HealthBar(m_driver.commands().live(), m_driver.commands(), this);
    setHelpPlace(*statusBar(), placeOf(HelpTopic::HealthBar));
    statusBar()->setSizeGripEnabled(false);
    statusBar()->addWidget(m_health, 1);
    connect(m_health, &HealthBar::waysOutRequested, m_menus.action("waysOut"), &QAction::trigger);
}

void MainWindow::connectDriver() {
    const auto showStates = [this] { m_menus.showStates(); };
    const auto showTake = [this] { m_transport->showTake(m_driver.takes().state()); };
    const Commands& commands = m_driver.commands();
    connect(&commands, &Commands::changed, this, showStates);
    connect(&commands, &Commands::switched, this, &MainWindow::showSession);
    connect(&commands, &Commands::frameCharacter, m_viewport, &ViewportWidget::frameCharacter);
    connect(&commands, &Commands::showDock, m_docks, &Docks::coverBy);
    connect(&commands, &Commands::wentBack, m_docks, &Docks::uncover);
    connect(m_verdict, &VerdictBar::evidenceRequested, m_docks, &Docks::showEvidence);
    connect(&m_driver, &SessionDriver::moved, m_viewport, &ViewportWidget::refresh);
    connect(&m_viewport->pictures(), &PictureLoop::due, &m_driver, &SessionDriver::tick);
    connect(&m_driver, &SessionDriver::moved, m_transport, &TransportBar::refresh);
    // Once the changes of the tick are painted: both in a row would delay mouse and keyboard.
    connect(&m_driver, &SessionDriver::tableTick, m_docks, [this] {
        if (m_driver.isInSight()) {
            QTimer::singleShot(kAfterTick, m_docks, &Docks::refresh);
        }
    });
    connect(&m_driver, &SessionDriver::tableTick, this, [this, showTake] {
        showReceiving();
        if (m_sounds.isDue(m_driver.commands().live().verdicts().incidents(), m_settings.alerts)) {
            QApplication::beep();
        }
        m_notifier.look(m_verdict->verdict(), m_settings.alerts.hasNotification);
        showTake();
    });
    // At once: the next run must not begin with a loop.
    connect(&m_driver, &SessionDriver::wayOutStopped, this, [this] {
        m_settings.inputs.waysOut = m_driver.receiving().choices().waysOut;
        writeSettings();
    });
    connect(&m_driver.files(), &Files::closing, m_docks, &Docks::forgetFile);
    const Comparing& comparing = m_driver.files().comparing();
    connect(&comparing, &Comparing::askForRecording, m_menus.action("compareWith"), &QAction::trigger);
    connect(&comparing, &Comparing::changed, this, &MainWindow::showReceiving);
    connect(&m_driver.demo(), &Demo::changed, this, showStates);
    connect(&m_driver.takes(), &Takes::changed, this, [this, showTake](const QString& problem) {
        m_menus.showStates();
        showTake();
        say(problem, HelpTopic::RecordingFailed);
    });
    connect(&m_driver.takes(), &Takes::recorded, this, [this](const QString& path, double seconds) {
        m_opening->noteRecent(path);
        const QFileInfo file(path);
        say(tr("Recorded %1, under File > Open recent: %2, in %3")
                .arg(duration(seconds), file.fileName(), QDir::toNativeSeparators(file.absolutePath())));
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
    m_docks->dockUnseen();
}

Settings MainWindow::settings() const {
    Settings settings = m_settings;
    settings.window = normalGeometry().isEmpty() ? geometry() : normalGeometry();
    settings.isMaximized = isMaximized();
    settings.docks = saveState(kStateVersion);
    settings.panels = m_docks->states(settings.panels);
    settings.viewport = m_viewport->choice().state();
    settings.filter = QString::fromStdString(m_driver.commands().live().choices().ownFilter());
    const auto pathOf = [](const OpenedFile* file) {
        return file != nullptr ? QDir().absoluteFilePath(file->path()) : QString();
    };
    OpenedFile* const file = m_driver.commands().isFileShown() ? m_driver.files().file() : nullptr;
    settings.file = pathOf(file);
    settings.fileFilter =
        file != nullptr ? QString::fromStdString(file->session().choices().ownFilter()) : QString();
    settings.take = m_driver.takes().state().value_or(TakeState{settings.take, 0, {}}).path;
    settings.comparedFile = pathOf(m_driver.files().comparing().file());
    return settings;
}

void MainWindow::writeSettings() {
    const QString problem = m_file.write(settings());
    if (std::exchange(m_settingsProblem, problem) != problem) {
        say(problem, HelpTopic::SettingsUnusable);
    }
}

void MainWindow::closeEvent(QCloseEvent* event) {
    static_cast<void>(m_driver.takes().end()); // so that it does not count as cut off
    if (const QString problem = m_file.write(settings()); !problem.isEmpty()) {
        qWarning("Settings were not saved: %s", qUtf8Printable(problem));
    }
    event->accept();
}

void MainWindow::showSession() {
    const Commands& commands = m_driver.commands();
    const bool isFile = commands.isFileShown();
    m_docks->showSession();
    m_health->showSession(commands.session());
    m_transport->showSession(commands.session(), !isFile);
    m_viewport->showSession(commands.session(), isFile ? m_driver.files().file()->name() : QString());
    m_menus.showStates();
    showReceiving();
    m_docks->refresh();
    m_transport->setFocus(); // what had it may be gone
}

void MainWindow::showReceiving() {
    const ReceivingState& state = m_driver.receiving().state();
    m_transport->setReceiving(state);
    if (m_driver.isInSight()) {
        m_health->refresh(state);
        m_viewport->setReceiving(state);
    }
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
        file = {opened->name(), m_driver.commands().isFileShown(), opened->verdict(), opened->notes()};
        file.notes.prepend(m_driver.files().openingText());
    }
    file.comparison = comparisonText(comparison);
    const ReceivingState& state = m_driver.receiving().state();
    const std::vector<PortState>& ports = state.ports;
    const bool hasInputs = !ports.empty() || !state.stage.isEmpty() || hasPackets;
    const bool isBlocked = !ports.empty() && std::ranges::none_of(ports, [](const PortState& port) {
        return port.problem.isEmpty();
    });
    m_menus.action("live")->setEnabled(hasInputs || !file.isShown);
    m_menus.action("showFile")->setEnabled(!file.name.isEmpty() && !file.isShown);
    m_menus.action("closeFile")->setEnabled(!file.name.isEmpty());
    m_menus.action("endComparison")->setEnabled(comparison.isOpen);
    m_menus.action("resetForTake")->setEnabled(hasPackets);
    m_verdict->refresh(file, hasInputs, isBlocked ? ports.front().problem : state.stageProblem);
}

void MainWindow::openInputs(InputsDialog::Page page) {
    if (m_inputs == nullptr) {
        m_inputs = new InputsDialog(m_driver.receiving(), this);
        connect(m_inputs, &InputsDialog::openFileRequested, m_menus.action("open"), &QAction::trigger);
        connect(m_inputs, &InputsDialog::choicesChanged, this, [this] {
            m_settings.inputs = m_driver.receiving().choices();
            showReceiving();
        });
    }
    m_inputs->open(page);
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
    m_docks->refresh();
}

/// It may be the path of a file, and the button must not make the window wide.
void MainWindow::showLayoutName(const QString& name) {
    const QFontMetrics metrics = m_layoutButton->fontMetrics();
    const int most = metrics.averageCharWidth() * 30;
    m_layoutButton->setText(
        tr("Layout: %1 ▾")
            .arg(metrics.elidedText(translatedText(name.toStdString()), Qt::ElideMiddle, most)));
    menuBar()->setCornerWidget(m_layoutButton, Qt::TopRightCorner); // as wide as the text
}

void MainWindow::keepHistory() {
    constexpr std::uint64_t gigabyte = 1'000'000'000;
    const HistoryChoice& choice = m_settings.history;
    const std::uint64_t most = static_cast<std::uint64_t>(choice.gigabytes) * gigabyte;
    if (const QString problem = m_driver.history().keep(choice.isOnDisk ? most : 0); !problem.isEmpty()) {
        say(problem, HelpTopic::HistoryOff);
    }
}

void MainWindow::moveFocus(int direction) {
    m_docks->moveFocus(direction, *m_viewport, m_health->firstEntry() != nullptr ? m_health : nullptr);
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

void MainWindow::say(const QString& text) {
    m_health->say(text);
}

void MainWindow::say(const QString& text, HelpTopic topic) {
    m_health->say(text, placeOf(topic));
}

QString MainWindow::message() const {
    return m_health->said();
}

} // namespace posewire::gui
