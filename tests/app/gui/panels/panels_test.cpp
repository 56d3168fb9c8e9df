// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/panel.h"
#include "app/gui/panels/characters_panel.h"
#include "app/gui/panels/metadata_panel.h"
#include "app/gui/panels/packet_view.h"
#include "app/gui/panels/packets_panel.h"
#include "app/gui/panels/statistics_panel.h"
#include "app/gui/panels/timecode_panel.h"
#include "app/gui/panels/trackers_panel.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "tests/app/gui/panels/panel_stage.h"

#include <gmock/gmock.h>

#include <QFocusEvent>
#include <QHeaderView>
#include <QTest>
#include <QToolButton>

#include <algorithm>
#include <memory>
#include <set>

namespace posewire::gui {

namespace {

class PanelsTest : public testing::Test {
protected:
    template <class T>
    std::unique_ptr<T> open() {
        auto panel = make<T>();
        panel->resize(360, 420);
        panel->show();
        refresh(*panel);
        return panel;
    }
    template <class T>
    std::unique_ptr<T> make() {
        for (const PanelInfo& info : panelTable()) {
            std::unique_ptr<Panel> panel(info.make(m_stage.parts, nullptr));
            if (auto* wanted = qobject_cast<T*>(panel.get())) {
                static_cast<void>(panel.release());
                return std::unique_ptr<T>(wanted);
            }
        }
        return nullptr;
    }
    void refresh(Panel& panel) {
        m_stage.follow();
        panel.refresh();
    }
    static TableView* table(Panel& panel) { return panel.findChild<TableView*>(); }

    PanelStage m_stage;
};

TEST_F(PanelsTest, TableHasTheDocksThatScriptsKnowAndMakesEachOfThem) {
    std::set<std::string> ids;
    for (const PanelInfo& info : panelTable()) {
        EXPECT_TRUE(ids.insert(info.id).second) << info.id << " is there twice";
        EXPECT_NE(std::string(info.title), "") << info.id;
        const std::unique_ptr<Panel> panel(info.make(m_stage.parts, nullptr));
        panel->refresh();
    }
    // Names of docks are for good; a new dock need not be here.
    EXPECT_THAT(ids,
                testing::IsSupersetOf({"characters", "metadata", "timecode", "statistics", "inspector",
                                       "trackers", "packets", "nullpose", "events", "faults", "timeline"}));
}

TEST_F(PanelsTest, EmptyPanelsSayWhatToDo) {
    EXPECT_TRUE(table(*open<CharactersPanel>())->accessibleDescription().contains("add an input"));
    EXPECT_TRUE(table(*open<MetadataPanel>())->accessibleDescription().contains("No character selected"));
    EXPECT_TRUE(table(*open<TrackersPanel>())->accessibleDescription().contains("type 23"));
    EXPECT_EQ(open<CharactersPanel>()->summary(), "");
    EXPECT_EQ(open<TrackersPanel>()->summary(), "");
    const auto timecode = open<TimecodePanel>();
    EXPECT_EQ(timecode->findChild<ClockWidget*>()->text(), "--:--:--.---");
}

TEST_F(PanelsTest, EveryTableHasANameForScreenReaders) {
    for (const PanelInfo& info : panelTable()) {
        const std::unique_ptr<Panel> panel(info.make(m_stage.parts, nullptr));
        for (const TableView* view : panel->findChildren<TableView*>()) {
            EXPECT_FALSE(view->accessibleName().isEmpty()) << info.id;
        }
    }
}

TEST_F(PanelsTest, SummariesTellTheStateInAFewWords) {
    performer::Performer performer(sending(2, {2, 12, 23}));
    m_stage.perform(performer, 0, 60);
    EXPECT_EQ(open<CharactersPanel>()->summary(), "2 of 2 good");
    EXPECT_EQ(open<StatisticsPanel>()->summary(), "all, 0.2 s · 6 streams");
    EXPECT_EQ(open<TrackersPanel>()->summary(), QStringLiteral("Pelvis · 1"));
    EXPECT_EQ(open<MetadataPanel>()->summary(),
              QString::fromStdString(m_stage.session.roster().displayName(m_stage.key()).shown()));
    m_stage.now += 5s;
    EXPECT_EQ(open<CharactersPanel>()->summary(), "0 of 2 good");
}

TEST_F(PanelsTest, PlotsOfATrackerThatIsNoLongerSentAreDimmed) {
    performer::Performer performer(sending(1, {2, 23}));
    m_stage.perform(performer, 0, 480);
    const auto panel = open<TrackersPanel>();
    panel->resize(500, 700);
    const auto pixelsOf = [&](const QColor& colour) {
        refresh(*panel);
        QTest::qWait(1); // plots paint by themselves
        const QImage image = panel->findChild<TimePlot*>()->grab().toImage();
        int count = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                count += image.pixelColor(x, y) == colour ? 1 : 0;
            }
        }
        return count;
    };
    EXPECT_GT(pixelsOf(theme().plotFourth), 0);
    EXPECT_FALSE(panel->summary().contains("stale"));
    m_stage.now += 3s;
    EXPECT_EQ(pixelsOf(theme().plotFourth), 0);
    EXPECT_TRUE(panel->summary().endsWith("stale 3.0 s")) << panel->summary().toStdString();
    for (const TableView* one : panel->findChildren<TableView*>()) {
        EXPECT_EQ(one->model()->index(0, 1).data(Qt::ForegroundRole), QVariant(theme().dim));
    }
}

TEST_F(PanelsTest, FactsOfATrackerAreWholeBesideItsTable) {
    performer::Performer performer(sending(1, {2, 23}));
    m_stage.perform(performer, 0, 240);
    const auto panel = open<TrackersPanel>();
    panel->resize(576, 230);
    refresh(*panel);
    QTest::qWait(1);
    const auto tables = panel->findChildren<TableView*>();
    const TableView* facts =
        *std::ranges::find(tables, QString("Selected tracker"), &QWidget::accessibleName);
    const QString vector = QStringLiteral("−39.24 −39.24 −39.24");
    EXPECT_GE(facts->columnWidth(1), QFontMetrics(tabularFont()).horizontalAdvance(vector));
}

TEST_F(PanelsTest, ClickingACharacterSelectsItForAllPanels) {
    performer::Performer performer(sending(2, {2, 12}));
    m_stage.perform(performer, 0, 10);
    const auto panel = open<CharactersPanel>();
    TableView* view = table(*panel);
    const QModelIndex second = view->model()->index(1, 0);
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, view->visualRect(second).center());
    EXPECT_EQ(m_stage.session.choices().selection.character, m_stage.key(1));
    EXPECT_EQ(m_stage.session.choices().selection.sender, m_stage.sender());
    QTest::mouseDClick(view->viewport(), Qt::LeftButton, {}, view->visualRect(second).center());
    ASSERT_EQ(m_stage.asked.framed.size(), 1U);
    EXPECT_EQ(m_stage.asked.framed.front(), m_stage.key(1));
}

TEST_F(PanelsTest, ThePacketsGoOnWhenADialogOverThemIsClosed) {
    performer::Performer performer(sending(1, {2}));
    m_stage.perform(performer, 0, 100);
    const auto panel = open<PacketsPanel>();
    QFocusEvent back(QEvent::FocusIn, Qt::ActiveWindowFocusReason);
    QCoreApplication::sendEvent(panel->findChild<PacketView*>(), &back);
    EXPECT_FALSE(m_stage.session.choices().selection.packet);
    EXPECT_EQ(panel->summary(), QStringLiteral("following · 100"));
}

TEST_F(PanelsTest, WhatIsOfTheSelectedCharacterSaysWhereNoneIs) {
    performer::Performer performer(sending(2, {2, 12}));
    m_stage.perform(performer, 0, 10);
    const auto panel = open<CharactersPanel>();
    const auto* message = panel->findChild<PassingMessage*>();
    panel->soloSelected();
    EXPECT_EQ(message->said(), "No character is selected.");
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(1), -1});
    panel->soloSelected();
    EXPECT_EQ(message->said(), "");
    EXPECT_TRUE(m_stage.session.roster().isHidden(m_stage.key(0)) &&
                !m_stage.session.roster().isHidden(m_stage.key(1)));
    m_stage.session.setSelection({});
    panel->soloSelected();
    EXPECT_FALSE(m_stage.session.roster().isHidden(m_stage.key(0))) << "show all needs none";
}

TEST_F(PanelsTest, CharactersFollowASelectionMadeElsewhereWithoutAskingForIt) {
    performer::Performer performer(sending(2, {2, 12}));
    m_stage.perform(performer, 0, 10);
    const auto panel = open<CharactersPanel>();
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(1), 3});
    refresh(*panel);
    EXPECT_EQ(table(*panel)->currentIndex().row(), 1);
    EXPECT_EQ(m_stage.asked.count, 0);
    EXPECT_EQ(m_stage.session.choices().selection.segment, 3);
}

TEST_F(PanelsTest, TwentyCharactersAreInViewAtOnce) {
    performer::Performer performer(sending(20, {2}));
    m_stage.perform(performer, 0, 10);
    const auto panel = open<CharactersPanel>();
    panel->resize(620, 440);
    refresh(*panel);
    TableView* view = table(*panel);
    ASSERT_EQ(view->model()->rowCount(), 20);
    EXPECT_LE(view->visualRect(view->model()->index(19, 0)).bottom(), view->viewport()->height());
    EXPECT_GE(view->visualRect(view->model()->index(0, 0)).height(), view->fontMetrics().height());
}

TEST_F(PanelsTest, ANarrowBoardSaysInTheVerdictWhoseLossItIs) {
    performer::Performer two(sending(2, {2, 12}, 60.0));
    m_stage.perform(two, 0, 900, [](std::uint64_t frame) { return frame % 40 != 39; });
    m_stage.follow();
    const auto panel = open<CharactersPanel>();
    panel->resize(46 * panel->fontMetrics().averageCharWidth(), 300);
    for (int i = 0; i < 3; ++i) {
        panel->refresh();
        QTest::qWait(1);
    }
    const auto* board = panel->findChild<TableView*>(QStringLiteral("board"));
    ASSERT_TRUE(board->columns().isSectionHidden(CharacterModel::kLostOnNetwork));
    const QString said = board->model()->index(0, CharacterModel::kVerdict).data().toString();
    EXPECT_TRUE(said.contains(QStringLiteral("lost, "))) << said.toStdString();
    EXPECT_GT(board->columns().sectionSize(CharacterModel::kVerdict),
              board->fontMetrics().horizontalAdvance(said));
}

TEST_F(PanelsTest, TheBoardShowsDetailOfTheSelectedOnlyAndKeepsWhatWasSet) {
    performer::Performer performer(sending(2, {2, 21}));
    m_stage.perform(performer, 0, 10);
    const auto panel = open<CharactersPanel>();
    auto* streams = panel->findChild<TableView*>("characterStreams");
    panel->toggleDetail();
    EXPECT_FALSE(streams->isVisible()) << "nothing is selected";
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(1), -1});
    refresh(*panel);
    EXPECT_TRUE(streams->isVisible());
    EXPECT_EQ(streams->model()->rowCount(), 2);
    panel->setTroubleFirst(true);
    const auto other = open<CharactersPanel>();
    other->restoreState(panel->state());
    EXPECT_TRUE(other->isTroubleFirst() && other->isDetailShown());
}

TEST_F(PanelsTest, SoloHidesAllOthersAndShowsThemAgain) {
    performer::Performer performer(sending(3, {2}));
    m_stage.perform(performer, 0, 10);
    const auto panel = open<CharactersPanel>();
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(1), -1});
    panel->soloSelected();
    EXPECT_TRUE(m_stage.session.roster().isHidden(m_stage.key(0)) &&
                m_stage.session.roster().isHidden(m_stage.key(2)));
    EXPECT_FALSE(m_stage.session.roster().isHidden(m_stage.key(1)));
    panel->soloSelected();
    EXPECT_FALSE(m_stage.session.roster().isHidden(m_stage.key(0)) ||
                 m_stage.session.roster().isHidden(m_stage.key(2)));
    panel->toggleSelected();
    EXPECT_TRUE(m_stage.session.roster().isHidden(m_stage.key(1)));
    panel->showPacketsOfSelected();
    EXPECT_EQ(m_stage.session.choices().displayFilter, "character == 1");
}

TEST_F(PanelsTest, EndedSendersFoldAwayAndCanBeForgotten) {
    const auto sendFrom = [this](const std::string& address) {
        performer::Performer performer(sending(1, {2}));
        for (std::uint64_t frame = 0; frame < 20; ++frame) {
            m_stage.send(performer.frame(frame).front(), m_stage.now + 4ms, address);
        }
    };
    sendFrom("10.0.0.5:1000");
    const auto panel = open<CharactersPanel>();
    auto* ended = panel->findChild<QToolButton*>("endedSenders");
    EXPECT_FALSE(ended->isVisible());
    sendFrom("10.0.0.5:1001");
    sendFrom("10.0.0.5:1002");
    refresh(*panel);
    EXPECT_EQ(table(*panel)->model()->rowCount(), 1);
    EXPECT_TRUE(ended->isVisible());
    EXPECT_EQ(ended->accessibleName(), "2 ended senders");
    const std::uint64_t datagrams = m_stage.session.accounts().allSenders().datagrams;
    panel->findChild<QToolButton*>("forgetEnded")->click();
    EXPECT_FALSE(ended->isVisible());
    EXPECT_EQ(m_stage.session.roster().senders().size(), 1U);
    EXPECT_EQ(m_stage.session.accounts().allSenders().datagrams, datagrams);
}

TEST_F(PanelsTest, PickingATrackerSelectsItsSegmentAndBack) {
    performer::Performer performer(sending(1, {2, 23}));
    m_stage.perform(performer, 0, 60);
    const auto panel = open<TrackersPanel>();
    TableView* view = table(*panel);
    view->setFocus();
    QTest::keyClick(view, Qt::Key_Down);
    EXPECT_EQ(m_stage.session.choices().selection.segment, 4);
    EXPECT_EQ(m_stage.session.choices().selection.character, m_stage.key());
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(), 10});
    refresh(*panel);
    EXPECT_EQ(panel->summary(), QStringLiteral("Right Hand · 11"));
    EXPECT_EQ(m_stage.asked.count, 1);
}

TEST_F(PanelsTest, CopiesARowByKeyboard) {
    m_stage.sendMetadata("name:Factory\n", Stage::kStart);
    const auto panel = open<MetadataPanel>();
    TableView* view = table(*panel);
    view->setCurrentIndex(view->model()->index(0, 0));
    QTest::keySequence(view, QKeySequence::Copy);
    EXPECT_TRUE(copiedText().startsWith("name\tFactory"));
    EXPECT_TRUE(view->allText().contains("Revision"));
}

TEST_F(PanelsTest, CopiesAllOfATableByItsMenu) {
    m_stage.sendMetadata("name:Factory\n", Stage::kStart);
    const auto panel = open<MetadataPanel>();
    TableView* view = table(*panel);
    QTimer::singleShot(0, view, [view] {
        auto* menu = view->findChild<QMenu*>();
        for (QAction* action : menu->actions()) {
            if (action->text() == "Copy all as text") {
                action->trigger();
            }
        }
        menu->close();
    });
    QContextMenuEvent asked(QContextMenuEvent::Mouse, view->rect().center(), view->mapToGlobal(QPoint(5, 5)));
    QApplication::sendEvent(view->viewport(), &asked);
    EXPECT_EQ(copiedText(), view->allText());
}

TEST_F(PanelsTest, ClockFillsTheScreenAndLeavesItByEscape) {
    m_stage.send(smallPose(), 1, 639'175, Stage::kStart);
    const auto panel = open<TimecodePanel>();
    auto* clock = panel->findChild<ClockWidget*>();
    EXPECT_EQ(clock->text(), "00:10:39.175");
    QTest::keyClick(clock, Qt::Key_F);
    ASSERT_NE(panel->fullScreenClock(), nullptr);
    EXPECT_TRUE(panel->fullScreenClock()->isFullScreen());
    EXPECT_EQ(panel->fullScreenClock()->text(), "00:10:39.175");
    QTest::keyClick(const_cast<ClockWidget*>(panel->fullScreenClock()), Qt::Key_Escape);
    EXPECT_EQ(panel->fullScreenClock(), nullptr);
    QTest::mouseDClick(clock, Qt::LeftButton);
    EXPECT_NE(panel->fullScreenClock(), nullptr);
}

TEST_F(PanelsTest, ClockStaysLargeInALowDock) {
    const auto panel = open<TimecodePanel>();
    auto* clock = panel->findChild<ClockWidget*>();
    auto* table = panel->findChild<TableView*>();
    panel->resize(600, 600);
    EXPECT_EQ(table->height(), table->heightForRows(table->model()->rowCount()));
    panel->resize(600, 200);
    QApplication::processEvents(); // the layout
    EXPECT_GE(clock->height(), 200 / 3);
    EXPECT_LT(table->height(), table->heightForRows(table->model()->rowCount()));
    EXPECT_EQ(table->verticalScrollBarPolicy(), Qt::ScrollBarAsNeeded);
}

TEST_F(PanelsTest, ClockGrowsWithATallDock) {
    m_stage.send(smallPose(), 1, 639'175, Stage::kStart);
    const auto panel = open<TimecodePanel>();
    auto* clock = panel->findChild<ClockWidget*>();
    const auto inkOf = [&](int height) {
        panel->resize(1600, height);
        QApplication::processEvents(); // the layout
        const QImage image = clock->grab().toImage();
        const QRgb paper = image.pixel(image.width() / 2, 1);
        int ink = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                ink += image.pixel(x, y) != paper ? 1 : 0;
            }
        }
        return ink;
    };
    const int low = inkOf(300);
    EXPECT_GT(inkOf(1'000), 2 * low);
}

TEST_F(PanelsTest, ShowsThePastWhilePaused) {
    performer::Performer performer(sending(1, {2, 12, 23}));
    m_stage.perform(performer, 0, 240);
    const auto timecode = open<TimecodePanel>();
    const auto trackers = open<TrackersPanel>();
    const QString live = timecode->findChild<ClockWidget*>()->text();
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 200});
    refresh(*timecode);
    refresh(*trackers);
    const QString then = timecode->findChild<ClockWidget*>()->text();
    EXPECT_NE(then, live);
    m_stage.perform(performer, 240, 480);
    refresh(*timecode);
    EXPECT_EQ(timecode->findChild<ClockWidget*>()->text(), then);
}

} // namespace

} // namespace posewire::gui
