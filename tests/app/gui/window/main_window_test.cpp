// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/main_window.h"

#include "app/gui/theme/elided_label.h"
#include "app/gui/window/actions.h"
#include "app/gui/window/dock_layout.h"
#include "app/gui/window/dock_title.h"
#include "app/gui/window/transport_bar.h"

#include <QDockWidget>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace posewire::gui {
namespace {

class MainWindowTest : public testing::Test {
protected:
    std::unique_ptr<MainWindow> makeWindow(const Settings& settings = {}) {
        auto window = std::make_unique<MainWindow>(driver, file, settings);
        window->resize(1280, 800);
        window->show();
        QTest::qWait(1);
        return window;
    }
    static QDockWidget* dock(MainWindow& window, const QString& name) {
        return window.findChild<QDockWidget*>(name);
    }

    QTemporaryDir folder;
    SettingsFile file{folder.filePath("settings.json")};
    log::SystemClock clock;
    SessionDriver driver{clock};
};

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
    window->inDock("packets", "timeOfDay");
    window->inDock("packets", "deltaToRowAbove");
    EXPECT_EQ(checked(), QStringList({"timeOfDay", "deltaToRowAbove"}));
}

TEST_F(MainWindowTest, DockAllBringsFloatingDocksBack) {
    const auto window = makeWindow();
    dock(*window, "statistics")->setFloating(true);
    dock(*window, "statistics")->move(-5000, -5000);
    window->dockAll();
    EXPECT_FALSE(dock(*window, "statistics")->isFloating());
}

TEST_F(MainWindowTest, ResetLayoutOpensWhatWasClosedAndDocksWhatFloats) {
    const auto window = makeWindow();
    dock(*window, "characters")->close();
    dock(*window, "trackers")->setFloating(true);
    window->resetLayout();
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

TEST_F(MainWindowTest, EveryEntryOfTheMenusDoesSomethingAndNoKeyIsUsedTwice) {
    std::set<QString> ids;
    std::map<QString, QString> keys;
    for (const ActionInfo& info : actionTable()) {
        if (QString(info.id).isEmpty()) {
            continue;
        }
        EXPECT_NE(info.run, nullptr) << info.id;
        EXPECT_TRUE(ids.insert(info.id).second) << info.id << " is there twice";
        if (const QString key = info.shortcut; !key.isEmpty()) {
            EXPECT_TRUE(keys.emplace(key, info.id).second) << info.id << " shares its key with another";
            EXPECT_FALSE(QKeySequence(key, QKeySequence::PortableText).isEmpty()) << info.id;
        }
    }
    const auto window = makeWindow();
    for (const QString& id : ids) {
        EXPECT_NE(window->findChild<QAction*>(id), nullptr) << id.toStdString();
    }
}

TEST_F(MainWindowTest, SpacePausesAndEndGoesBackToLive) {
    const auto window = makeWindow();
    QTest::keyClick(window.get(), Qt::Key_Space);
    EXPECT_TRUE(driver.isPaused());
    QTest::keyClick(window.get(), Qt::Key_End);
    EXPECT_FALSE(driver.isPaused());
}

TEST_F(MainWindowTest, F6GoesThroughTheDocksAndBackToTheViewport) {
    const auto window = makeWindow();
    window->viewport().setFocus();
    std::set<QWidget*> visited;
    for (std::size_t i = 0; i <= panelTable().size(); ++i) {
        window->nextDock();
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
        window->nextDock();
        const QWidget* focused = window->focusWidget();
        ASSERT_NE(focused, nullptr);
        QTest::qWait(1);
        EXPECT_TRUE(window->rect().contains(focused->mapTo(window.get(), QPoint(1, 1))))
            << focused->accessibleName().toStdString();
    }
}

TEST_F(MainWindowTest, RefreshesDocksInSightAlsoWhereTheirContentCoversThem) {
    const auto window = makeWindow();
    window->useLayout("Debug");
    QTest::qWait(1);
    const auto isRefreshed = [&](const char* name) {
        auto* title = dock(*window, name)->findChild<DockTitle*>();
        title->setSummary("of the last tick");
        emit driver.tableTick();
        return title->findChild<ElidedLabel*>()->text() != "of the last tick";
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

} // namespace
} // namespace posewire::gui
