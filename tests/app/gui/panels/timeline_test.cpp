// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/timeline_panel.h"
#include "app/gui/panels/timeline_view.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "tests/app/gui/models/stage.h"

#include <QTest>
#include <QToolButton>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <numeric>

namespace posewire::gui {
namespace {

/// Two characters for ten seconds, 60 a second; nothing between 4 and 5 s.
class TimelineTest : public testing::Test {
protected:
    void SetUp() override {
        performer::Performer performer(sending(2, {2, 25}, 60.0));
        m_stage.perform(performer, 0, 600, [](std::uint64_t frame) { return frame < 240 || frame >= 300; });
        m_stage.follow();
        m_timeline.resize(900, 260);
        m_timeline.show();
        m_timeline.refresh();
    }

    static log::Stamp at(log::Duration time) { return Stage::kStart + time; }
    /// In the strip of a row, at a moment.
    [[nodiscard]] QPoint place(log::Duration time, int row = 0) const {
        const int y = m_timeline.rulerHeight() + m_timeline.rowHeight() * row + m_timeline.rowHeight() / 2;
        return {static_cast<int>(m_timeline.placeOf(at(time))), y};
    }
    [[nodiscard]] QPoint inRuler(log::Duration time) const { return {place(time).x(), 3}; }
    [[nodiscard]] double cursorSeconds() const {
        return log::secondsOf(m_stage.session.cursorStamp() - Stage::kStart);
    }

    Stage m_stage;
    TimelineView m_timeline{m_stage.session, m_stage.commands, m_stage.playback, nullptr};
};

TEST_F(TimelineTest, HasAStripForEachCharacterWithItsGaps) {
    TimelineModel model(m_stage.session);
    model.refresh({at(0s), at(10s)}, 200);
    ASSERT_EQ(model.rows().size(), 2U);
    const TimelineModel::Row& row = model.shown(0);
    const model::RangeParts& parts = model.parts();
    std::uint32_t datagrams = 0;
    for (std::size_t i = 0; i < parts.count; ++i) {
        datagrams += row.parts[i].datagrams;
        const bool isInGap = parts.beginOf(i) >= at(4s) && parts.beginOf(i + 1) <= at(4900ms);
        const bool isSent = parts.beginOf(i) >= at(0s) && parts.beginOf(i + 1) <= at(3900ms);
        EXPECT_FALSE(isInGap && row.parts[i].datagrams != 0) << i;
        EXPECT_FALSE(isSent && row.parts[i].datagrams == 0) << i;
    }
    EXPECT_EQ(datagrams, 2U * 540U);
}

TEST_F(TimelineTest, FindsTheGapsAndNoneBetweenSamples) {
    TimelineModel model(m_stage.session);
    for (const std::size_t parts : {100U, 400U, 600U, 900U}) {
        model.refresh({at(0s), at(10s)}, parts);
        const auto gaps = TimelineModel::gapsIn(model.shown(0).parts);
        ASSERT_EQ(gaps.size(), 1U) << parts;
        const log::Duration most = 3 * model.parts().width;
        EXPECT_LT(std::chrono::abs(model.parts().beginOf(gaps[0].first) - at(4s)), most);
        EXPECT_LT(std::chrono::abs(model.parts().beginOf(gaps[0].second) - at(5s)), most);
    }
    model.refresh({at(1s), at(1s + 200ms)}, 600);
    EXPECT_TRUE(TimelineModel::gapsIn(model.shown(0).parts).empty()) << "single samples";
}

TEST_F(TimelineTest, EnterOpensTheStreamsOfTheSelectedCharacter) {
    const model::CharacterKey second = m_stage.session.roster().characters()[1].key;
    m_stage.session.setSelection({second.sender, second, -1});
    QTest::keyClick(&m_timeline, Qt::Key_Return);
    ASSERT_EQ(m_timeline.model().rows().size(), 4U);
    EXPECT_EQ(m_timeline.model().rows()[2].type, 2);
    QTest::keyClick(&m_timeline, Qt::Key_Return);
    EXPECT_EQ(m_timeline.model().rows().size(), 2U);
}

TEST_F(TimelineTest, LooksAtSingleDatagramsWhereItIsZoomedIn) {
    TimelineModel model(m_stage.session);
    model.refresh({at(1s), at(1s + 50ms)}, 500);
    model.toggle(model.rows()[0].character);
    model.refresh({at(1s), at(1s + 50ms)}, 500);
    ASSERT_EQ(model.rows().size(), 4U) << "its two streams";
    EXPECT_EQ(model.rows()[1].type, 2);
    const auto count = [&](std::size_t row) {
        const auto& parts = model.shown(row).parts;
        return std::ranges::count_if(parts, [](const model::RangePart& part) { return part.datagrams != 0; });
    };
    EXPECT_EQ(count(1), 3) << "one each 16.7 ms";
    EXPECT_EQ(count(0), 3) << "both types at the same moment";
}

TEST(TimelineModel, LeavesNothingOutWhereThereIsTooMuchToLookAtOneByOne) {
    constexpr std::uint32_t kSamples = TimelineModel::kMostArrivals / 2 + 10'000;
    Stage stage;
    wire::Datagram datagram;
    datagram.body = wire::CentreOfMass{};
    for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
        for (std::uint8_t character = 0; character < 2; ++character) {
            datagram.header.sampleCounter = sample;
            datagram.header.character = character;
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            stage.sendBytes(*wire::encode(datagram), Stage::kStart + sample * 200us);
        }
        if (sample % 50'000 == 0) {
            stage.follow();
        }
    }
    stage.follow();
    TimelineModel model(stage.session);
    const model::TimeRange window{Stage::kStart, Stage::kStart + kSamples * 200us};
    for (const std::size_t most : {std::size_t{20}, std::size_t{226}, std::size_t{2'000}}) {
        model.refresh(window, most);
        ASSERT_EQ(model.rows().size(), 2U);
        std::uint64_t datagrams = 0;
        for (const model::RangePart& part : model.shown(1).parts) {
            datagrams += part.datagrams;
        }
        EXPECT_EQ(datagrams, kSamples) << most;
    }
    model.refresh({Stage::kStart + 1s, Stage::kStart + 1100ms}, 226);
    EXPECT_LE(model.parts().width, 1ms) << "a short window is looked at closely";
}

/// Samples lost as the timeline paints them, looked at datagram by datagram.
std::uint64_t lostPainted(Stage& stage, log::Duration length) {
    stage.follow();
    TimelineModel model(stage.session);
    model.refresh({Stage::kStart, Stage::kStart + length}, 20'000);
    std::uint64_t lost = 0;
    for (const model::RangePart& part : model.shown(0).parts) {
        lost += part.lost;
    }
    return lost;
}

TEST(TimelineModel, PaintsNoLossWhereTheSenderChangesItsStep) {
    Stage stage;
    for (std::uint32_t i = 0; i < 600; ++i) {
        const std::uint32_t sample = i < 300 ? i : 300 + 2 * (i - 300);
        stage.send(smallPose(), sample, sample * 10, Stage::kStart + i * 10ms);
        if (i % 20 == 0) {
            EXPECT_EQ(lostPainted(stage, 6s), 0U) << i;
        }
    }
    EXPECT_EQ(lostPainted(stage, 6s), 0U);
}

TEST(TimelineModel, PaintsWhatCameLateAsNoLossAndWhatDidNotAsOne) {
    Stage stage;
    const auto send = [&](std::uint32_t sample, log::Duration at) {
        stage.send(smallPose(), sample, sample * 10, Stage::kStart + at);
    };
    for (std::uint32_t i = 0; i < 400; ++i) {
        if (i != 100 && i != 200) {
            send(i, i * 10ms);
        }
        if (i == 110) {
            send(100, 1'101ms);
        }
    }
    EXPECT_EQ(lostPainted(stage, 4s), 1U);
}

TEST(TimelineModel, PaintsASampleOfWhichOnlyAPartCameAsLost) {
    Stage stage;
    for (std::uint32_t i = 0; i < 200; ++i) {
        stage.send(smallPose(), i, i * 10, Stage::kStart + i * 10ms, 0x00);
        if (i != 50) {
            stage.send(smallPose(), i, i * 10, Stage::kStart + i * 10ms + 1ms, 0x81);
        }
    }
    EXPECT_EQ(lostPainted(stage, 2s), 1U);
}

/// What is counted coarsely and finely is the same.
TEST_F(TimelineTest, BothWaysOfCountingFindTheSame) {
    const auto sums = [this](std::size_t most) {
        TimelineModel model(m_stage.session);
        model.refresh({at(0s), at(11s)}, most);
        const auto& parts = model.shown(0).parts;
        return std::accumulate(
            parts.begin(), parts.end(), model::RangePart(),
            [](model::RangePart sum, const model::RangePart& part) { return sum += part; });
    };
    const model::RangePart coarse = sums(10);
    const model::RangePart fine = sums(5'000);
    EXPECT_EQ(coarse.datagrams, fine.datagrams);
    EXPECT_EQ(coarse.lost, fine.lost);
    EXPECT_EQ(coarse.lost, 2U * 60U);
}

TEST_F(TimelineTest, AClickShowsThatMomentAndADragInTheRulerMovesThroughTime) {
    QTest::mouseClick(m_timeline.viewport(), Qt::LeftButton, {}, place(2s));
    EXPECT_NEAR(cursorSeconds(), 2, 0.05);
    EXPECT_EQ(m_stage.session.choices().cursor.mode, model::Cursor::Mode::Paused);
    QTest::mousePress(m_timeline.viewport(), Qt::LeftButton, {}, inRuler(6s));
    EXPECT_NEAR(cursorSeconds(), 6, 0.05);
    QTest::mouseMove(m_timeline.viewport(), inRuler(7s));
    EXPECT_NEAR(cursorSeconds(), 7, 0.05);
    QTest::mouseRelease(m_timeline.viewport(), Qt::LeftButton, {}, inRuler(7s));
    EXPECT_FALSE(m_stage.session.choices().range.fixed);
}

TEST_F(TimelineTest, ADragInTheRowsSelectsARange) {
    QTest::mousePress(m_timeline.viewport(), Qt::LeftButton, {}, place(3s));
    QTest::mouseMove(m_timeline.viewport(), place(1s));
    QTest::mouseRelease(m_timeline.viewport(), Qt::LeftButton, {}, place(1s));
    const auto range = m_stage.session.range();
    ASSERT_TRUE(range);
    EXPECT_NEAR(log::secondsOf(range->from - at(0s)), 1, 0.05);
    EXPECT_NEAR(log::secondsOf(range->to - at(0s)), 3, 0.05);
    QTest::keyClick(&m_timeline, Qt::Key_Escape);
    EXPECT_FALSE(m_stage.session.range());
}

TEST_F(TimelineTest, TheWheelZoomsAboutThePointerBetweenAMillisecondAndAll) {
    const auto turn = [this](int angle) {
        const QPointF where = place(6s);
        QWheelEvent event(where, m_timeline.viewport()->mapToGlobal(where), {}, {0, angle}, {}, {},
                          Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(m_timeline.viewport(), &event);
    };
    const int before = place(6s).x();
    turn(240);
    EXPECT_NEAR(m_timeline.placeOf(at(6s)), before, 1.5);
    EXPECT_LT(m_timeline.window().to - m_timeline.window().from, 7s);
    for (int i = 0; i < 100; ++i) {
        turn(120);
    }
    EXPECT_EQ(m_timeline.window().to - m_timeline.window().from, TimelineView::kShortest);
    for (int i = 0; i < 100; ++i) {
        turn(-120);
    }
    EXPECT_EQ(m_timeline.window().from, at(0s));
    EXPECT_EQ(m_timeline.window().to, m_stage.session.now() + 1ns);
}

TEST_F(TimelineTest, KeysZoomAndMove) {
    const auto length = [this] { return m_timeline.window().to - m_timeline.window().from; };
    const log::Duration all = length();
    QTest::keyClick(&m_timeline, Qt::Key_Plus);
    EXPECT_NEAR(log::secondsOf(length()), log::secondsOf(all) / 2, 0.01);
    const log::Stamp from = m_timeline.window().from;
    QTest::keyClick(&m_timeline, Qt::Key_PageUp);
    EXPECT_LT(m_timeline.window().from, from);
    QTest::keyClick(&m_timeline, Qt::Key_0);
    EXPECT_EQ(length(), all);
}

TEST_F(TimelineTest, AClickOnANameOpensItsStreamsAndSelectsIt) {
    const model::CharacterKey second = m_stage.session.roster().characters()[1].key;
    const QPoint name(10, place(0s, 1).y());
    for (int turn = 0; turn < 2; ++turn) { // opened, its rows move to another place
        QTest::mouseClick(m_timeline.viewport(), Qt::LeftButton, {}, name);
        EXPECT_EQ(m_stage.session.choices().selection.character, second);
    }
}

TEST_F(TimelineTest, AnIncidentIsShownWhereItsMarkIsClicked) {
    const model::Incident* outage = nullptr;
    for (const model::Incident& incident : m_stage.session.verdicts().incidents().all()) {
        outage = incident.kind == model::IncidentKind::Outage ? &incident : outage;
    }
    ASSERT_NE(outage, nullptr);
    const QPoint mark(static_cast<int>(m_timeline.placeOf(outage->firstStamp)),
                      m_timeline.rulerHeight() - m_timeline.fontMetrics().height() / 2);
    QTest::mouseClick(m_timeline.viewport(), Qt::LeftButton, {}, mark);
    EXPECT_EQ(m_stage.session.choices().incidentRequest.number, outage->number);
}

TEST_F(TimelineTest, TheThumbnailShowsWhereTheWindowIsAndMovesIt) {
    TimelineThumbnail thumbnail(m_stage.session, m_timeline, nullptr);
    thumbnail.resize(900, thumbnail.sizeHint().height());
    thumbnail.show();
    thumbnail.refresh();
    EXPECT_NEAR(thumbnail.lens().width(), thumbnail.strip().width(), 1) << "all is in sight";
    m_timeline.setWindow({at(1s), at(2s)});
    EXPECT_NEAR(thumbnail.lens().width() / thumbnail.strip().width(), 0.1, 0.005);
    EXPECT_NEAR((thumbnail.lens().center().x() - thumbnail.strip().left()) / thumbnail.strip().width(), 0.15,
                0.005);
    const auto inStrip = [&](double share) {
        return QPoint(static_cast<int>(thumbnail.strip().left() + share * thumbnail.strip().width()), 5);
    };
    QTest::mouseClick(&thumbnail, Qt::LeftButton, {}, inStrip(0.7));
    EXPECT_NEAR(log::secondsOf(m_timeline.window().from - Stage::kStart), 6.5, 0.05);
    EXPECT_NEAR(log::secondsOf(m_timeline.window().to - m_timeline.window().from), 1, 1e-6);
    QTest::mouseClick(&thumbnail, Qt::LeftButton, {}, inStrip(0.999));
    EXPECT_LE(m_timeline.window().to, m_timeline.model().span()->to) << "no further than there is";
    m_timeline.setWindow({at(3s), at(3s + 1ms)});
    EXPECT_GE(thumbnail.lens().width(), 5) << "it can still be seen";
}

TEST_F(TimelineTest, TheThumbnailMarksLosses) {
    TimelineThumbnail thumbnail(m_stage.session, m_timeline, nullptr);
    thumbnail.resize(900, thumbnail.sizeHint().height());
    thumbnail.refresh();
    const QImage picture = thumbnail.grab().toImage();
    const auto hasLoss = [&](double from, double to) {
        const auto placeOf = [&](double share) {
            return static_cast<int>(thumbnail.strip().left() + share * thumbnail.strip().width());
        };
        for (int x = placeOf(from); x < placeOf(to); ++x) {
            if (picture.pixelColor(x, picture.height() - 3) == theme().warning) {
                return true;
            }
        }
        return false;
    };
    EXPECT_TRUE(hasLoss(0.39, 0.62)) << "as exact as the accounting's buckets";
    EXPECT_FALSE(hasLoss(0, 0.39));
    EXPECT_FALSE(hasLoss(0.62, 1));
}

TEST(TimelinePanelTest, ButtonsWithoutRoomGoIntoAMenu) {
    Stage stage;
    performer::Performer performer(sending(1, {2}));
    stage.perform(performer, 0, 100);
    stage.follow();
    TimelinePanel panel(stage.session, stage.commands, stage.playback, nullptr);
    panel.show();
    EXPECT_LE(panel.minimumSizeHint().width(), 200);
    for (const int width : {220, 300, 420, 800}) {
        panel.resize(width, 200);
        panel.refresh();
        QTest::qWait(1);
        for (const QToolButton* one : panel.findChildren<QToolButton*>()) {
            EXPECT_TRUE(!one->isVisible() ||
                        panel.rect().contains(QRect(one->mapTo(&panel, QPoint(0, 0)), one->size())))
                << one->text().toStdString() << " at " << width;
        }
    }
}

} // namespace
} // namespace posewire::gui
