// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/joint_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/theme/theme.h"
#include "core/model/body/spaces.h"
#include "tests/app/gui/models/stage.h"

#include <gmock/gmock.h>

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include <algorithm>
#include <thread>

namespace posewire::gui {

namespace {

class JointModelTest : public testing::Test {
protected:
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    /// Until all of the range has been read.
    void refreshAll() {
        refresh();
        while (!m_model.motion().isAtRest()) {
            std::this_thread::yield();
            m_model.refresh();
        }
    }
    QString text(int row, int column) const { return m_model.index(row, column).data().toString(); }
    int rowNamed(const QString& name) const {
        for (int row = 0; row < m_model.rowCount(); ++row) {
            if (text(row, JointModel::kName) == name) {
                return row;
            }
        }
        return -1;
    }
    const JointRow& joint(const QString& name) const {
        return m_model.rows().at(static_cast<std::size_t>(rowNamed(name)));
    }
    /// A T-pose with the right arm turned about the axis that points forward, sent as type 02.
    void sendArm(double abduction, std::uint32_t sample) {
        wire::PoseQuaternion pose;
        for (std::uint32_t id = 1; id <= 23; ++id) {
            const bool isArm = id >= 9 && id <= 11;
            const double turn = isArm ? (90 - abduction) * model::kRadiansPerDegree : 0.0;
            const Eigen::Quaterniond orientation(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX()));
            pose.segments.push_back({id, {0, 0, 1}, model::toFloats(orientation)});
        }
        m_stage.send(pose, sample, sample * 10, Stage::kStart + sample * 10ms);
    }
    /// Type 20 with the same angles for all joints.
    void sendAngles(wire::Vec3 degrees, std::uint32_t sample) {
        wire::JointAngles angles;
        for (const model::JointDefinition& one :
             std::span(model::jointDefinitions()).first<model::kBodyJointCount>()) {
            angles.joints.push_back({model::encodePointId(model::PointIdCoding::By256, one.parent),
                                     model::encodePointId(model::PointIdCoding::By256, one.child), degrees});
        }
        m_stage.send(angles, sample, sample * 10, Stage::kStart + sample * 10ms);
    }

    Stage m_stage;
    JointModel m_model{m_stage.session};
    AngleModel m_angles{m_model};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(JointModelTest, ShowsWhatIsSentBesideWhatIsComputed) {
    performer::Performer performer(sending(1, {2, 13, 20}));
    m_stage.perform(performer, 0, 120);
    QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    refresh();
    EXPECT_EQ(inserted.count(), 1);
    ASSERT_EQ(m_model.rowCount(), 22);
    EXPECT_EQ(m_model.sourceText(), "sent · computed from 02");
    for (const JointRow& row : m_model.rows()) {
        const auto* name = model::jointDefinitions()[row.joint].name.data();
        ASSERT_TRUE(row.sent.allFinite() && row.computed.allFinite()) << name;
        EXPECT_LT((row.sent - row.computed).cwiseAbs().maxCoeff(), 2e-4) << name;
        EXPECT_LT(row.difference, 1e-4) << name;
    }
    const QModelIndex knee = m_model.index(rowNamed("Right Knee"), JointModel::kFlexion);
    EXPECT_EQ(knee.data(kSuffixRole), knee.data()) << "the computed angle";
}

TEST_F(JointModelTest, PutsTheLeftSideBelowTheRight) {
    performer::Performer performer(sending(1, {20}));
    m_stage.perform(performer, 0, 10);
    refresh();
    EXPECT_EQ(rowNamed("Left Knee"), rowNamed("Right Knee") + 1);
    for (int row = 0; row < m_model.rowCount(); ++row) {
        QString mirrored = text(row, JointModel::kName);
        const bool isPaired = mirrored.startsWith("Right") || mirrored.startsWith("Left");
        mirrored = mirrored.startsWith("Right") ? mirrored.replace("Right", "Left")
                                                : mirrored.replace("Left", "Right");
        ASSERT_EQ(m_model.mirroredRow(row).has_value(), isPaired) << mirrored.toStdString();
        EXPECT_TRUE(!isPaired || text(*m_model.mirroredRow(row), JointModel::kName) == mirrored);
    }
}

TEST_F(JointModelTest, MarksAnglesThatDisagree) {
    sendArm(30, 1);
    sendAngles({0, 0, 2}, 1);
    refresh();
    // The spine of the pose is straight, and was sent bent by 2°.
    EXPECT_EQ(text(rowNamed("L5 S1"), JointModel::kDifference), QStringLiteral("▲ 2.0"));
    sendArm(30, 2);
    sendAngles({0, 0, 0.5F}, 2);
    refresh();
    EXPECT_EQ(text(rowNamed("L5 S1"), JointModel::kDifference), "0.5");
    sendArm(40, 3);
    refresh();
    EXPECT_EQ(text(rowNamed("L5 S1"), JointModel::kDifference), "–") << "not of the same sample";
    EXPECT_EQ(text(rowNamed("L5 S1"), JointModel::kFlexion), "0.5");
}

TEST_F(JointModelTest, ShowsOneOfTheTwoIfTheOtherIsNotOnTheAir) {
    sendArm(30, 1);
    refresh();
    EXPECT_EQ(m_model.sourceText(), "computed from 02");
    const QModelIndex shoulder = m_model.index(rowNamed("Right Shoulder"), JointModel::kAbduction);
    EXPECT_EQ(shoulder.data(), "30.0");
    EXPECT_FALSE(shoulder.data(kSuffixRole).isValid());
    EXPECT_EQ(text(rowNamed("Left Shoulder"), JointModel::kAbduction), "90.0");
}

TEST_F(JointModelTest, FlagsTheGimbalLockAndKeepsWhatItMeansOut) {
    sendArm(88, 1);
    refreshAll();
    const JointRow& arm = joint("Right Shoulder");
    EXPECT_THAT(m_model.state(arm).text.toStdString(), testing::HasSubstr("gimbal lock"));
    EXPECT_EQ(m_model.state(arm).health, Health::Warning);
    EXPECT_TRUE(m_model.motion().extents().range(arm.joint, 2).isEmpty());
    sendArm(60, 2);
    refreshAll();
    EXPECT_EQ(m_model.state(joint("Right Shoulder")).text, "");
}

TEST_F(JointModelTest, BoundsTheMotionOverTheRangeOfTheFigures) {
    constexpr std::size_t kAbduction = 0;
    for (std::uint32_t sample = 1; sample <= 100; ++sample) {
        sendArm(sample <= 50 ? 10.0 + sample : 30, sample);
    }
    refreshAll();
    const auto taken = [&] {
        return m_model.motion().extents().range(joint("Right Shoulder").joint, kAbduction);
    };
    EXPECT_NEAR(taken().least * model::kDegreesPerRadian, 11, 0.01);
    EXPECT_NEAR(taken().most * model::kDegreesPerRadian, 60, 0.01);
    EXPECT_EQ(m_model.state(joint("Right Shoulder")).text, "");
    m_stage.commands.selectRange({.fixed = model::TimeRange{Stage::kStart + 600ms, Stage::kStart + 2s}});
    refreshAll();
    EXPECT_NEAR(taken().most * model::kDegreesPerRadian, 30, 0.01);
    m_stage.commands.selectRange({});
    sendArm(-80, 101);
    refreshAll();
    EXPECT_NEAR(taken().least * model::kDegreesPerRadian, -80, 0.01);
    EXPECT_EQ(m_model.state(joint("Right Shoulder")).text, "beyond");
    const auto bar = m_model.index(rowNamed("Right Shoulder"), JointModel::kAbduction)
                         .data(kBarRole)
                         .value<QList<float>>();
    ASSERT_EQ(bar.size(), 5);
    EXPECT_LT(bar[2], bar[0]) << "below the reference range";
    EXPECT_FALSE(m_model.index(rowNamed("L5 S1"), JointModel::kFlexion).data(kBarRole).isValid());
}

TEST_F(JointModelTest, BoundsWhatIsSentIfThereIsNoPose) {
    sendAngles({1, 2, 3}, 1);
    sendAngles({1, 2, 33}, 2);
    refreshAll();
    EXPECT_EQ(m_model.sourceText(), "sent");
    const auto& range = m_model.motion().extents().range(joint("Left Knee").joint, 2);
    EXPECT_NEAR(range.least * model::kDegreesPerRadian, 3, 1e-4);
    EXPECT_NEAR(range.most * model::kDegreesPerRadian, 33, 1e-4);
}

TEST_F(JointModelTest, ShowsTheJointOfTheSelectedSegmentCloselyWithTheOtherSide) {
    sendArm(30, 1);
    m_stage.now += 300ms; // the sample waits no longer for others
    refresh();
    m_stage.commands.select(selectionOf(m_stage.session, m_stage.key(), model::segment::kRightUpperArm));
    refreshAll();
    m_angles.refresh();
    EXPECT_EQ(m_model.shownRow(), rowNamed("Right Shoulder"));
    ASSERT_EQ(m_angles.rowCount(), 3);
    const auto cells = [&](int row) {
        std::vector<std::string> texts;
        for (int column = 0; column < m_angles.columnCount(); ++column) {
            texts.push_back(m_angles.index(row, column).data().toString().toStdString());
        }
        return texts;
    };
    EXPECT_THAT(cells(1), testing::ElementsAre("Abduction / adduction", "–", "30.0", "30.0 to 30.0",
                                               "−75 to 180", "90.0", "90.0 to 90.0"));
    m_stage.commands.select(selectionOf(m_stage.session, m_stage.key(), model::segment::kPelvis));
    refresh();
    EXPECT_EQ(m_model.shownRow(), rowNamed("Right Shoulder")) << "the pelvis hangs on no joint";
}

TEST_F(JointModelTest, DimsWhatIsNoLongerSent) {
    performer::Performer performer(sending(1, {2, 20}));
    m_stage.perform(performer, 0, 60);
    refresh();
    EXPECT_FALSE(m_model.isStale());
    m_stage.now += 3s;
    refresh();
    EXPECT_TRUE(m_model.isStale());
    EXPECT_TRUE(text(0, JointModel::kState).startsWith("stale"));
    EXPECT_EQ(m_model.index(0, JointModel::kFlexion).data(Qt::ForegroundRole), QVariant(theme().dim));
    m_angles.refresh();
    EXPECT_EQ(m_angles.index(0, 1).data(Qt::ForegroundRole), QVariant(theme().dim));
}

} // namespace

} // namespace posewire::gui
