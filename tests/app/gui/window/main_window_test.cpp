// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/gui/window/main_window_fixture.h"

#include "app/gui/base/dock_layout.h"
#include "app/gui/inputs/inputs_page.h"
#include "app/gui/panels/find_bar.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/window/health_bar.h"
#include "app/gui/window/menus.h"
#include "app/gui/window/transport_bar.h"

#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QUdpSocket>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace posewire::gui {
namespace {

TEST_F(MainWindowTest, HasADockForEveryRowOfTheTable) {
    const auto window = makeWindow();
    ASSERT_FALSE(panelTable().empty());
    for (const PanelInfo& info : panelTable()) {
        QDockWidget* found = dock(*window, info.id);
        ASSERT_NE(found, nullptr) << info.id;
        EXPECT_FALSE(found->windowTitle().isEmpty());
    }
    EXPECT_NE(window->findChild<ViewportWidget*>("viewport"), nullptr);
}

TEST_F(MainWindowTest, RestoresDocksAsTheyWereInANewWindow) {
    Settings kept;
    {
        const auto window = makeWindow();
        dock(*window, "metadata")->close();
        window->addDockWidget(Qt::RightDockWidgetArea, dock(*window, "characters"));
        kept = window->settings();
    }
    const auto window = makeWindow(kept);
    EXPECT_TRUE(dock(*window, "metadata")->isHidden());
    EXPECT_FALSE(dock(*window, "characters")->isHidden());
    EXPECT_EQ(window->dockWidgetArea(dock(*window, "characters")), Qt::RightDockWidgetArea);
}

TEST_F(MainWindowTest, RestoresFilterCameraAndAxes) {
    Settings kept;
    {
        const auto window = makeWindow();
        driver.commands().setDisplayFilter("type == 02");
        window->viewport().choice().setAxes(AxesMode::Selected);
        window->viewport().choice().toggleProjection();
        kept = window->settings();
        EXPECT_TRUE(kept.file.isEmpty()) << "what is live was shown";
    }
    driver.commands().setDisplayFilter({});
    const auto window = makeWindow(kept);
    EXPECT_EQ(driver.commands().live().choices().displayFilter, "type == 02");
    EXPECT_EQ(window->viewport().choice().axes(), AxesMode::Selected);
    EXPECT_EQ(window->viewport().choice().projection(), render::Projection::Orthographic);
    EXPECT_EQ(window->settings().viewport, kept.viewport);
}

TEST_F(MainWindowTest, FallsBackToItsLayoutWhereTheKeptDocksMakeNoSense) {
    Settings settings;
    settings.docks = "no state of docks";
    const auto window = makeWindow(settings);
    EXPECT_FALSE(dock(*window, "characters")->isHidden());
}

TEST_F(MainWindowTest, WritesItsSettingsWhenItCloses) {
    makeWindow()->close();
    QString problem;
    EXPECT_FALSE(file.read(&problem).docks.isEmpty());
    EXPECT_TRUE(problem.isEmpty());
}

TEST_F(MainWindowTest, WritesItsSettingsOnceTheyHaveChanged) {
    const auto window = makeWindow();
    window->kept().recentFiles = {"/takes/1.pcapng"};
    window->writeSettings();
    QString problem;
    EXPECT_EQ(file.read(&problem).recentFiles, window->kept().recentFiles);
    ASSERT_TRUE(QFile::remove(folder.filePath("settings.json")));
    window->writeSettings();
    EXPECT_FALSE(QFile::exists(folder.filePath("settings.json")));
}

TEST_F(MainWindowTest, KeepsAtOnceThatARelayWasStopped) {
    const auto window = makeWindow();
    WaysOut& relaying = driver.receiving().waysOut();
    relaying.add({"192.0.2.7", 9763, true});
    relaying.setOn(0, false);
    emit driver.wayOutStopped();
    QString problem;
    const Settings kept = file.read(&problem);
    ASSERT_EQ(kept.inputs.waysOut.size(), 1U) << problem.toStdString();
    EXPECT_FALSE(kept.inputs.waysOut[0].isOn);
    EXPECT_FALSE(kept.inputs.inputs.has_value()) << "nobody has chosen any";
}

TEST_F(MainWindowTest, ShowsInTheSizeThatItWasGiven) {
    EXPECT_EQ(makeWindow()->size(), QSize(1280, 800));
}

TEST_F(MainWindowTest, FitsASmallScreenInEveryLayout) {
    const auto window = makeWindow();
    for (const QString& layout : layoutNames()) {
        window->useLayout(layout);
        QTest::qWait(1);
        window->resize(1280, 720);
        QTest::qWait(1);
        EXPECT_EQ(window->size(), QSize(1280, 720)) << layout.toStdString();
    }
}

TEST_F(MainWindowTest, ScrollsDocksThatAreLowerThanTheirContent) {
    const auto window = makeWindow();
    window->useLayout("Debug");
    QDockWidget* timecode = dock(*window, "timecode");
    timecode->setFloating(true);
    timecode->resize(400, 120);
    QTest::qWait(1);
    const auto* area = timecode->findChild<QAbstractScrollArea*>(QString(), Qt::FindDirectChildrenOnly);
    ASSERT_NE(area, nullptr);
    EXPECT_GT(area->verticalScrollBar()->maximum(), 0);
    timecode->resize(400, 700);
    QTest::qWait(1);
    EXPECT_EQ(area->verticalScrollBar()->maximum(), 0);
}

TEST_F(MainWindowTest, MenuChecksTheTimesThatPacketsShow) {
    const auto window = makeWindow();
    QMenu* times = menuAt(*window->menuBar(), QStringLiteral("&View/&Packet times"));
    const auto checked = [&] {
        emit times->aboutToShow();
        QStringList ids;
        for (const QAction* action : times->actions()) {
            ids += action->isChecked() ? QStringList(action->objectName()) : QStringList();
        }
        return ids;
    };
    EXPECT_EQ(checked(), QStringList({"timeSinceFirst", "deltaInStream"}));
    action(*window, "timeOfDay")->trigger();
    action(*window, "deltaToRowAbove")->trigger();
    EXPECT_EQ(checked(), QStringList({"timeOfDay", "deltaToRowAbove"}));
}

TEST_F(MainWindowTest, DockAllBringsFloatingDocksBack) {
    const auto window = makeWindow();
    dock(*window, "statistics")->setFloating(true);
    dock(*window, "statistics")->move(-5000, -5000);
    window->docks().dockAll();
    EXPECT_FALSE(dock(*window, "statistics")->isFloating());
}

TEST_F(MainWindowTest, ResetLayoutOpensWhatWasClosedAndDocksWhatFloats) {
    const auto window = makeWindow();
    dock(*window, "characters")->close();
    dock(*window, "trackers")->setFloating(true);
    action(*window, "resetLayout")->trigger();
    EXPECT_FALSE(dock(*window, "characters")->isHidden());
    EXPECT_FALSE(dock(*window, "trackers")->isFloating());
}

TEST_F(MainWindowTest, LayoutsOpenTheirDocksAndCloseTheOthers) {
    const auto window = makeWindow();
    window->useLayout("Check");
    EXPECT_FALSE(dock(*window, "characters")->isHidden());
    EXPECT_TRUE(dock(*window, "statistics")->isHidden());
    EXPECT_EQ(window->settings().layout, "Check");
}

TEST_F(MainWindowTest, AnUnknownLayoutChangesNothing) {
    const auto window = makeWindow();
    window->useLayout("no-such-layout");
    EXPECT_FALSE(dock(*window, "statistics")->isHidden());
    EXPECT_EQ(window->settings().layout, "Debug");
}

TEST_F(MainWindowTest, EveryEntryIsInItsMenuOnceAndNoKeyIsUsedTwice) {
    std::map<QString, QString> keys;
    const auto window = makeWindow();
    for (const auto& [info, panel] : menuEntries()) {
        if (info->run == nullptr) {
            continue;
        }
        EXPECT_EQ(window->findChildren<QAction*>(info->id).size(), 1) << info->id;
        EXPECT_TRUE(menuAt(*window->menuBar(), info->menu)->actions().contains(action(*window, info->id)))
            << info->id;
        if (const QString key = info->shortcut; !key.isEmpty()) {
            EXPECT_TRUE(keys.emplace(key, info->id).second) << info->id << " shares its key with another";
            EXPECT_FALSE(QKeySequence(key, QKeySequence::PortableText).isEmpty()) << info->id;
        }
    }
}

TEST_F(MainWindowTest, MenusHoldEveryEntryOfEveryPanel) {
    const auto entries = menuEntries();
    for (const PanelInfo& panel : panelTable()) {
        for (const ActionInfo& info : panel.actions()) {
            EXPECT_EQ(std::ranges::count(entries, &info, &MenuEntry::action), 1) << info.menu << info.text;
        }
    }
}

TEST_F(MainWindowTest, AnEntryOfAPanelBringsItsDockToTheFront) {
    const auto window = makeWindow();
    window->useLayout("Check");
    ASSERT_TRUE(dock(*window, "packets")->isHidden());
    action(*window, "nextProblem")->trigger();
    EXPECT_FALSE(dock(*window, "packets")->isHidden());
    const auto* message = dock(*window, "packets")->findChild<QLabel*>("message");
    EXPECT_EQ(message->text(), "No problem after this packet.");
}

TEST_F(MainWindowTest, KeysReachThePanels) {
    const auto window = makeWindow();
    QTest::keyClick(window.get(), Qt::Key_F, Qt::ControlModifier);
    EXPECT_TRUE(dock(*window, "packets")->findChild<FindBar*>()->isVisible());
}

TEST_F(MainWindowTest, EntriesOfTheWindowDoWhatTheySay) {
    const auto window = makeWindow();
    action(*window, "orthographic")->trigger();
    EXPECT_EQ(window->viewport().choice().projection(), render::Projection::Orthographic);
    EXPECT_EQ(window->viewport().choice().axes(), AxesMode::Selected);
    action(*window, "axes")->trigger();
    EXPECT_EQ(window->viewport().choice().axes(), AxesMode::None);
    action(*window, "layoutInspect")->trigger();
    EXPECT_EQ(window->settings().layout, "Inspect");
    action(*window, "themeLight")->trigger();
    EXPECT_EQ(window->settings().theme, ThemeChoice::Light);
    EXPECT_TRUE(action(*window, "themeLight")->isChecked());
    EXPECT_FALSE(action(*window, "themeSystem")->isChecked());
    action(*window, "themeLight")->trigger();
    EXPECT_TRUE(action(*window, "themeLight")->isChecked()) << "chosen again";
    action(*window, "inputs")->trigger();
    EXPECT_TRUE(window->findChild<InputsDialog*>()->isVisible());
    action(*window, "themeSystem")->trigger();
}

TEST_F(MainWindowTest, EntriesShowWhatElsewhereSwitchedOn) {
    const auto window = makeWindow();
    driver.commands().setGhostVisible(true);
    EXPECT_TRUE(action(*window, "ghost")->isChecked());
    window->viewport().choice().toggleProjection();
    EXPECT_TRUE(action(*window, "orthographic")->isChecked());
}

TEST_F(MainWindowTest, APillOfAnInputTellsMoreAboutIt) {
    const auto window = makeWindow();
    QUdpSocket taken;
    ASSERT_TRUE(taken.bind(QHostAddress::LocalHost, 0, QAbstractSocket::DontShareAddress));
    driver.receiving().addPort({"127.0.0.1", 0});
    driver.receiving().addPort({"127.0.0.1", taken.localPort()});
    ASSERT_TRUE(QTest::qWaitFor([&] {
        driver.tick();
        const auto* pill = window->findChild<ColourText*>("inputPill1");
        return pill != nullptr && pill->level() == Health::Error;
    }));
    for (const int row : {1, 0}) {
        window->findChild<ColourText*>(QStringLiteral("inputPill%1").arg(row))->click();
        auto* inputs = window->findChild<InputsDialog*>();
        ASSERT_NE(inputs, nullptr);
        EXPECT_TRUE(inputs->isVisible());
        EXPECT_EQ(inputs->inputs().table().currentIndex().row(), row);
    }
}

TEST_F(MainWindowTest, SaysThatThereIsNoInput) {
    const auto window = makeWindow();
    const auto* live = window->findChild<QToolButton*>("modeButton");
    const auto* board = dock(*window, "characters")->findChild<TableView*>();
    driver.tick();
    EXPECT_EQ(live->accessibleName(), "No input");
    EXPECT_TRUE(board->accessibleDescription().contains("add an input"));
    driver.receiving().addPort({"127.0.0.1", 0});
    ASSERT_TRUE(QTest::qWaitFor([&] {
        driver.tick();
        return live->accessibleName() == "Waiting";
    }));
    EXPECT_TRUE(board->accessibleDescription().contains("Network Streamer"));
}

TEST_F(MainWindowTest, AFloatingDockHasAnEdge) {
    const auto window = makeWindow();
    QDockWidget* floating = dock(*window, "timecode");
    floating->show();
    floating->setFloating(true);
    QTest::qWait(1);
    const QImage picture = floating->grab().toImage();
    for (const QPoint& edge :
         {QPoint(0, picture.height() / 2), QPoint(picture.width() - 1, picture.height() / 2),
          QPoint(picture.width() / 2, picture.height() - 1)}) {
        EXPECT_EQ(picture.pixelColor(edge), theme().dim) << edge.x() << ", " << edge.y();
    }
}

TEST_F(MainWindowTest, ATitleDoesNotRepeatWhatItsTabSays) {
    const auto window = makeWindow();
    window->useLayout("Check");
    const auto name = [&](const char* of) {
        return dock(*window, of)->titleBarWidget()->findChild<QLabel*>();
    };
    ASSERT_EQ(name("events")->text(), "Incidents");
    EXPECT_TRUE(name("events")->isHidden());
    EXPECT_FALSE(name("characters")->isHidden());
    dock(*window, "events")->setFloating(true);
    emit driver.tableTick();
    EXPECT_TRUE(QTest::qWaitFor([&] { return !name("events")->isHidden(); }));
}

TEST_F(MainWindowTest, EveryButtonOfADockIsInAMenu) {
    const std::map<QString, QString> entries{{"Trouble first", "troubleFirst"},
                                             {"Detail", "characterDetail"},
                                             {"▸ 0 ended senders", "showEnded"},
                                             {"↑", "findPrevious"},
                                             {"↓", "findNext"},
                                             {"Forget", "forgetEnded"},
                                             {"Header", "clockOfHeader"},
                                             {"Type 25", "clockOfType25"},
                                             {"10 s", "figures10s"},
                                             {"1 min", "figuresMinute"},
                                             {"Since reset", "figuresSinceReset"},
                                             {"All", "figuresOfAll"},
                                             {"‹", "previousOfStream"},
                                             {"›", "nextOfStream"},
                                             {"Hold", "holdPacket"},
                                             {"Compare ▾", "comparePrevious"},
                                             {"Compare with a recording…", "compareWith"},
                                             {"◀", "nudgeEarlier"},
                                             {"▶", "nudgeLater"},
                                             {"Beside", "compareBeside"},
                                             {"Ghost", "ghost"},
                                             {"Export ▾", "exportNullPose"},
                                             {"Current", "currentIncidents"},
                                             {"History", "incidentHistory"},
                                             {"■ 0", "listErrors"},
                                             {"▲ 0", "listWarnings"},
                                             {"● 0", "listNotes"},
                                             {"Mark seen", "markIncidentsSeen"},
                                             {"Export…", "exportEvents"},
                                             {"+", "saveFilter"},
                                             {"Live", "live"},
                                             {"−", "timelineZoomOut"}};
    // Selection ends a range, which All does; saved filters and groups are lists of their own.
    const QStringList others{
        "",      "»", "Selection", "Groups ▾", "Problems", "Pose", "Meta && scale", "×", "Clear the filter",
        "Cancel"};
    const auto window = makeWindow();
    for (const auto* each : window->findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
        for (const auto* button : each->widget()->findChildren<QToolButton*>()) {
            const auto entry = entries.find(button->text());
            EXPECT_TRUE(entry != entries.end() || others.contains(button->text()))
                << each->objectName().toStdString() << ": " << button->text().toStdString();
            EXPECT_TRUE(entry == entries.end() || action(*window, entry->second) != nullptr)
                << button->text().toStdString();
        }
    }
}

TEST_F(MainWindowTest, TheMenuOfFiguresChoosesTheirRange) {
    const auto window = makeWindow();
    action(*window, "figures10s")->trigger();
    EXPECT_EQ(driver.commands().session().choices().range,
              (model::RangeChoice{.last = std::chrono::seconds(10)}));
    EXPECT_TRUE(action(*window, "figures10s")->isChecked());
    EXPECT_FALSE(action(*window, "figuresOfAll")->isChecked());
    action(*window, "figuresOfAll")->trigger();
    EXPECT_EQ(driver.commands().session().choices().range, model::RangeChoice());
    EXPECT_TRUE(action(*window, "figuresOfAll")->isChecked());
}

TEST_F(MainWindowTest, TheMenuOfIncidentsDoesWhatItsButtonsDo) {
    const auto window = makeWindow();
    window->useLayout("Check");
    const auto* current = dock(*window, "events")->findChild<QToolButton*>("currentEvents");
    action(*window, "currentIncidents")->trigger();
    EXPECT_TRUE(current->isChecked());
    EXPECT_FALSE(action(*window, "incidentHistory")->isChecked());
    action(*window, "incidentHistory")->trigger();
    EXPECT_FALSE(current->isChecked());
    const auto* notes = dock(*window, "events")->findChild<QToolButton*>("notes");
    EXPECT_TRUE(notes->isChecked());
    action(*window, "listNotes")->trigger();
    EXPECT_FALSE(notes->isChecked());
}

TEST_F(MainWindowTest, NamesTheDocksOfALayoutThatDoNotExist) {
    const auto window = makeWindow();
    const QString path = folder.filePath("mine.json");
    QFile layout(path);
    ASSERT_TRUE(layout.open(QIODevice::WriteOnly));
    layout.write(R"({"name": "Mine", "areas": {"left": {"places": [{"docks": ["characters", "charts"]}]}}})");
    layout.close();
    window->useLayout(path);
    EXPECT_FALSE(dock(*window, "characters")->isHidden());
    EXPECT_TRUE(window->findChild<HealthBar*>()->findChild<QLabel*>("message")->text().contains("charts"));
}

TEST_F(MainWindowTest, SpacePausesAndEndGoesBackToLive) {
    const auto window = makeWindow();
    QTest::keyClick(window.get(), Qt::Key_Space);
    EXPECT_TRUE(driver.playback().isPaused());
    QTest::keyClick(window.get(), Qt::Key_End);
    EXPECT_FALSE(driver.playback().isPaused());
}

TEST_F(MainWindowTest, GivesTheKeyboardToTheViewportWhenALayoutTakesItFromADock) {
    const auto window = makeWindow();
    window->useLayout("Debug");
    dock(*window, "packets")->findChild<QLineEdit*>()->setFocus();
    window->useLayout("Check");
    EXPECT_EQ(window->focusWidget(), &window->viewport());
}

TEST_F(MainWindowTest, F6GoesThroughTheDocksAndBackToTheViewport) {
    const auto window = makeWindow();
    for (const char* const name :
         {"compare", "joints", "plots", "plots2", "probes"}) { // no layout opens them
        dock(*window, name)->show();
    }
    window->viewport().setFocus();
    std::set<QWidget*> visited;
    for (std::size_t i = 0; i <= panelTable().size(); ++i) {
        window->moveFocus(1);
        visited.insert(window->focusWidget());
    }
    EXPECT_EQ(visited.size(), panelTable().size() + 1);
    EXPECT_TRUE(visited.contains(&window->viewport()));
}

TEST_F(MainWindowTest, F6BringsADockBehindATabToTheFront) {
    const auto window = makeWindow();
    window->useLayout("Debug");
    QTest::qWait(1);
    window->viewport().setFocus();
    for (std::size_t i = 0; i <= panelTable().size(); ++i) {
        window->moveFocus(1);
        const QWidget* focused = window->focusWidget();
        ASSERT_NE(focused, nullptr);
        QTest::qWait(1);
        EXPECT_TRUE(window->rect().contains(focused->mapTo(window.get(), QPoint(1, 1))))
            << focused->accessibleName().toStdString();
    }
}

TEST_F(MainWindowTest, TheMenuBringsADockBehindATabToTheFrontAndClosesOneThatIsSeen) {
    const auto window = makeWindow();
    const auto [packets, events] = tabbed(*window, "packets", "events");
    QAction* entry = nullptr;
    for (QAction* one : menuAt(*window->menuBar(), QStringLiteral("&View"))->actions()) {
        entry = one->text() == packets->windowTitle() ? one : entry;
    }
    ASSERT_NE(entry, nullptr);
    EXPECT_TRUE(entry->isChecked());
    entry->trigger();
    QTest::qWait(1);
    EXPECT_TRUE(window->rect().intersects(packets->geometry())) << "it was not seen";
    EXPECT_TRUE(entry->isChecked());
    entry->trigger();
    EXPECT_TRUE(packets->isHidden());
    EXPECT_FALSE(entry->isChecked());
    entry->trigger();
    EXPECT_FALSE(packets->isHidden());
    EXPECT_TRUE(entry->isChecked());
}

TEST_F(MainWindowTest, ADockThatTheLayoutDoesNotPlaceComesAsATabAndCoversNoOther) {
    const auto window = makeWindow();
    window->useLayout(QStringLiteral("Check"));
    QTest::qWait(1);
    for (const char* name : {"packets", "statistics", "metadata"}) {
        window->docks().show(QLatin1String(name));
        QTest::qWait(1);
        const QRect opened = dock(*window, name)->geometry();
        EXPECT_TRUE(window->rect().contains(opened)) << name;
        for (const PanelInfo& info : panelTable()) {
            const QDockWidget* other = dock(*window, info.id);
            EXPECT_TRUE(info.id == QLatin1String(name) || other->isHidden() ||
                        !other->geometry().intersects(opened))
                << name << " lies on " << info.id;
        }
    }
    EXPECT_TRUE(window->tabifiedDockWidgets(dock(*window, "events")).contains(dock(*window, "packets")));
    EXPECT_TRUE(window->tabifiedDockWidgets(dock(*window, "timecode")).contains(dock(*window, "metadata")));
}

TEST_F(MainWindowTest, GoingBackFromPacketsBringsTheDockBeforeThemToTheFront) {
    const auto window = makeWindow();
    const auto [packets, events] = tabbed(*window, "packets", "events");
    const auto isInFront = [&](QDockWidget* one) { return window->rect().intersects(one->geometry()); };
    ASSERT_TRUE(isInFront(events) && !isInFront(packets));
    driver.commands().jump(0, "type == 02");
    driver.commands().showDock("packets");
    QTest::qWait(1);
    ASSERT_TRUE(isInFront(packets) && !isInFront(events));
    driver.commands().goBack();
    QTest::qWait(1);
    EXPECT_TRUE(isInFront(events) && !isInFront(packets));
    EXPECT_TRUE(events->isAncestorOf(QApplication::focusWidget()));
}

TEST_F(MainWindowTest, GoingBackFromPacketsThatTheLayoutDoesNotPlaceBringsTheDockBeforeThemToTheFront) {
    const auto window = makeWindow();
    window->useLayout(QStringLiteral("Check"));
    QTest::qWait(1);
    driver.commands().jump(0, "type == 02");
    driver.commands().showDock("packets");
    QTest::qWait(1);
    EXPECT_FALSE(window->rect().intersects(dock(*window, "events")->geometry()));
    driver.commands().goBack();
    QTest::qWait(1);
    EXPECT_TRUE(window->rect().intersects(dock(*window, "events")->geometry()));
}

TEST_F(MainWindowTest, RefreshesDocksInSightAlsoWhereTheirContentCoversThem) {
    const auto window = makeWindow();
    window->useLayout("Debug");
    QTest::qWait(1);
    const auto isRefreshed = [&](const char* name) {
        auto* summary = dock(*window, name)->titleBarWidget()->findChild<ElidedLabel*>();
        summary->setText({}, "of the last tick");
        window->docks().refresh();
        return summary->text() != "of the last tick";
    };
    auto* panel = dock(*window, "characters")->findChild<Panel*>();
    auto* cover = new QWidget(panel);
    cover->setAutoFillBackground(true);
    cover->setGeometry(panel->rect());
    cover->show();
    ASSERT_TRUE(panel->visibleRegion().isEmpty());
    EXPECT_TRUE(isRefreshed("characters"));
    dock(*window, "inspector")->raise();
    QTest::qWait(1);
    EXPECT_TRUE(isRefreshed("inspector"));
    EXPECT_FALSE(isRefreshed("nullpose")) << "behind the inspector as a tab";
    dock(*window, "nullpose")->setFloating(true);
    QTest::qWait(1);
    EXPECT_TRUE(isRefreshed("nullpose"));
}

TEST(OnScreen, RefusesPlacesThatCannotBeSeen) {
    const QRect room = QGuiApplication::primaryScreen()->availableGeometry();
    EXPECT_TRUE(onScreen({}).isEmpty());
    EXPECT_TRUE(onScreen(QRect(room.right() + 500, 10, 800, 600)).isEmpty());
    EXPECT_TRUE(onScreen(QRect(room.left(), room.top() - 400, 800, 600)).isEmpty());
    const QRect inside(room.left() + 10, room.top() + 10, 300, 200);
    EXPECT_EQ(onScreen(inside), inside);
    EXPECT_LE(onScreen(QRect(room.topLeft(), QSize(90'000, 90'000))).width(), room.width());
}

TEST(OnScreen, MovesWhatReachesBeyondTheScreens) {
    const QRect room = QGuiApplication::primaryScreen()->availableGeometry();
    const QRect beyond(room.center(), room.size() * 0.75);
    EXPECT_EQ(onScreen(beyond).size(), beyond.size());
    EXPECT_EQ(onScreen(beyond).bottomRight(), room.bottomRight());
    EXPECT_EQ(onScreen(QRect(room.center(), room.size() * 2)), room);
    EXPECT_EQ(onScreen(QRect(room.left() - 200, room.top(), 400, 300)).left(), room.left());
}

TEST_F(MainWindowTest, LeavesRoomForItsFrameAtTheFirstStart) {
    const MainWindow window(driver, file, {});
    const QSize room = window.screen()->availableSize();
    EXPECT_LT(window.height(), room.height());
    EXPECT_LT(window.width(), room.width());
}

} // namespace
} // namespace posewire::gui
