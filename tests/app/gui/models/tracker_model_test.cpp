// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/tracker_model.h"

#include "app/gui/theme/theme.h"
#include "core/model/body/spaces.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include <algorithm>

namespace posewire::gui {

namespace {

class TrackerModelTest : public testing::Test {
protected:
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    QString text(int row, int column) const { return m_model.index(row, column).data().toString(); }

    /// A tracker at rest on the right hand.
    static wire::Tracker atRest() {
        wire::Tracker tracker;
        tracker.id = 11;
        tracker.acceleration = {0, 0, 9.81F};
        tracker.magneticField = {0.6F, 0, -0.8F};
        return tracker;
    }
    void sendTracker(const wire::Tracker& tracker, std::uint32_t sample) {
        wire::TrackerKinematics body;
        body.trackers.push_back(tracker);
        m_stage.send(body, sample, sample * 10, Stage::kStart + sample * 10ms);
    }

    Stage m_stage;
    TrackerModel m_model{m_stage.session};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(TrackerModelTest, ShowsAllTrackersByTheNameOfTheirSegment) {
    performer::Performer performer(sending(1, {2, 23}));
    m_stage.perform(performer, 0, 100);
    QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    refresh();
    EXPECT_EQ(inserted.count(), 1);
    ASSERT_EQ(m_model.rowCount(), 17);
    EXPECT_EQ(text(0, TrackerModel::kName), "Pelvis");
    EXPECT_EQ(m_model.shownRow(), 0);
}

TEST_F(TrackerModelTest, ShowsNormsOfATrackerAtRest) {
    sendTracker(atRest(), 0);
    refresh();
    ASSERT_EQ(m_model.rowCount(), 1);
    EXPECT_EQ(text(0, TrackerModel::kName), "Right Hand");
    EXPECT_EQ(text(0, TrackerModel::kFree), "0.00");
    EXPECT_EQ(text(0, TrackerModel::kAcceleration), "9.81");
    EXPECT_EQ(text(0, TrackerModel::kGyro), "0.00");
    EXPECT_EQ(text(0, TrackerModel::kMagnetic), "1.00");
}

TEST_F(TrackerModelTest, MeasuresTheDipFromTheHorizontalInAnyAttitude) {
    wire::Tracker tracker = atRest();
    EXPECT_NEAR(dipDegrees(tracker), 53.13, 0.01);
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()));
    const Eigen::Vector3d field = turned.conjugate() * model::toVector(tracker.magneticField);
    tracker.orientation = model::toFloats(turned);
    tracker.magneticField = model::toFloats(field);
    EXPECT_NEAR(dipDegrees(tracker), 53.13, 0.01);
}

TEST_F(TrackerModelTest, FlagsADisturbedFieldAgainstItsOwnMedian) {
    for (std::uint32_t sample = 0; sample < 300; ++sample) {
        sendTracker(atRest(), sample);
    }
    refresh();
    EXPECT_EQ(text(0, TrackerModel::kState), QStringLiteral("●"));
    wire::Tracker disturbed = atRest();
    disturbed.magneticField = {0.72F, 0, -0.96F};
    sendTracker(disturbed, 300);
    refresh();
    EXPECT_EQ(text(0, TrackerModel::kState), QStringLiteral("▲ magnetic disturbance"));
    disturbed.magneticField = {0.66F, 0, -0.88F};
    sendTracker(disturbed, 301);
    refresh();
    EXPECT_EQ(text(0, TrackerModel::kState), QStringLiteral("●"));
}

TEST_F(TrackerModelTest, DimsWhatIsNoLongerSent) {
    for (std::uint32_t sample = 0; sample < 300; ++sample) {
        sendTracker(atRest(), sample);
    }
    refresh();
    EXPECT_FALSE(m_model.isStale());
    EXPECT_NE(m_model.index(0, TrackerModel::kMagnetic).data(Qt::ForegroundRole), QVariant(theme().dim));
    m_stage.now += 2s;
    refresh();
    EXPECT_TRUE(m_model.isStale());
    EXPECT_EQ(text(0, TrackerModel::kState), "stale 2.0 s");
    for (int column = 0; column < m_model.columnCount(); ++column) {
        EXPECT_EQ(m_model.index(0, column).data(Qt::ForegroundRole), QVariant(theme().dim)) << column;
    }
}

TEST_F(TrackerModelTest, DimsTheFactsOfWhatIsNoLongerSentAndSaysHowOldTheyAre) {
    PropertyModel facts(trackerFacts(m_model));
    facts.dimWhile([this] { return m_model.isStale(); });
    for (std::uint32_t sample = 0; sample < 300; ++sample) {
        sendTracker(atRest(), sample);
    }
    refresh();
    const int last = facts.rowCount() - 1;
    EXPECT_NE(facts.index(0, 1).data(Qt::ForegroundRole), QVariant(theme().dim));
    m_stage.now += 3s;
    refresh();
    facts.refresh();
    for (int row = 0; row <= last; ++row) {
        EXPECT_EQ(facts.index(row, 1).data(Qt::ForegroundRole), QVariant(theme().dim)) << row;
    }
    EXPECT_EQ(facts.index(last, 1).data().toString(), "stale 3.0 s");
}

TEST_F(TrackerModelTest, GivesASlowStreamTheTimeOfItsSamples) {
    for (std::uint32_t sample = 0; sample < 8; ++sample) {
        wire::TrackerKinematics body;
        body.trackers.push_back(atRest());
        m_stage.send(body, sample, sample * 1'000, Stage::kStart + sample * 1s);
    }
    m_stage.now += 2s;
    refresh();
    EXPECT_FALSE(m_model.isStale());
    m_stage.now += 1s;
    refresh();
    EXPECT_TRUE(m_model.isStale());
}

TEST_F(TrackerModelTest, FlagsSaturationOfASingleSampleForTenSeconds) {
    for (std::uint32_t sample = 0; sample < 200; ++sample) {
        wire::Tracker tracker = atRest();
        tracker.acceleration[1] = sample == 100 ? -156.9F : 0.0F;
        sendTracker(tracker, sample);
    }
    refresh();
    EXPECT_EQ(text(0, TrackerModel::kState), QStringLiteral("■ saturation"));
    for (std::uint32_t sample = 200; sample < 1200; ++sample) {
        sendTracker(atRest(), sample);
    }
    refresh();
    EXPECT_EQ(text(0, TrackerModel::kState), QStringLiteral("●"));
}

TEST_F(TrackerModelTest, KeepsTenSecondsOfTheShownTrackerWithItsGaps) {
    for (std::uint32_t sample = 0; sample < 1500; ++sample) {
        if (sample < 1200 || sample > 1204) {
            sendTracker(atRest(), sample);
        }
        if (sample % 100 == 0) {
            refresh();
        }
    }
    refresh();
    const auto& points = m_model.history().points();
    EXPECT_LE(points.back().stamp - points.front().stamp, TrackerHistory::kPlot);
    EXPECT_NEAR(static_cast<double>(points.size()), 996, 1);
    EXPECT_EQ(std::ranges::count_if(points, &TrackerHistory::Point::followsGap), 1);
}

TEST_F(TrackerModelTest, ReadsTheSameHistoryWhetherLookedAtOftenOrOnce) {
    performer::Performer performer(sending(1, {2, 23}));
    TrackerModel often(m_stage.session);
    for (std::uint64_t frame = 0; frame < 480; frame += 24) {
        m_stage.perform(performer, frame, frame + 24);
        m_stage.follow();
        often.refresh();
    }
    refresh();
    EXPECT_EQ(m_model.history().points().size(), 480U);
    EXPECT_EQ(often.history().points().size(), 480U);
}

TEST_F(TrackerModelTest, FollowsTheSelectedSegment) {
    performer::Performer performer(sending(1, {2, 23}));
    m_stage.perform(performer, 0, 50);
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(), 10});
    refresh();
    ASSERT_NE(m_model.shown(), nullptr);
    EXPECT_EQ(m_model.shown()->id, 11U);
    // A segment without a tracker leaves the tracker where it was.
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(), 5});
    refresh();
    EXPECT_EQ(m_model.shown()->id, 11U);
}

TEST_F(TrackerModelTest, SaysWhatTheShortFormLeavesOut) {
    wire::TrackerKinematics body;
    body.hasInertialData = false;
    body.trackers.push_back(atRest());
    m_stage.send(body, 0, 0, Stage::kStart);
    refresh();
    EXPECT_EQ(text(0, TrackerModel::kAcceleration), QStringLiteral("–"));
    PropertyModel facts(trackerFacts(m_model));
    EXPECT_EQ(facts.index(3, 1).data().toString(), "not in the 44-byte form");
}

TEST_F(TrackerModelTest, EmptiesWhereTheCursorLiesBeforeTheFirst) {
    m_stage.send(smallPose(), 0, 0, Stage::kStart);
    sendTracker(atRest(), 1);
    refresh();
    EXPECT_EQ(m_model.rowCount(), 1);
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 0});
    refresh();
    EXPECT_EQ(m_model.rowCount(), 0);
    EXPECT_EQ(m_model.shown(), nullptr);
}

} // namespace

} // namespace posewire::gui
