// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/null_pose_reading.h"
#include "app/gui/models/null_pose_table.h"
#include "app/gui/theme/theme.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>

namespace posewire::gui {

namespace {

class NullPoseModelTest : public testing::Test {
protected:
    NullPoseModelTest() {
        for (QAbstractItemModel* table : tables) {
            m_testers.push_back(std::make_unique<QAbstractItemModelTester>(
                table, QAbstractItemModelTester::FailureReportingMode::Fatal));
        }
    }
    /// The scale message of a performer; `change` may spoil its parts.
    void sendNullPose(log::Stamp stamp, const std::function<void(wire::NullPose&)>& change = {}) {
        performer::Performer performer(sending(1, {13}));
        for (wire::Datagram datagram : performer.frame(0)) {
            if (change) {
                change(std::get<wire::NullPose>(datagram.body));
                wire::completeHeader(datagram, wire::HeaderEra::Counted);
            }
            stage.send(datagram, stamp);
        }
    }
    bool refresh() {
        stage.follow();
        const bool isNew = reading.refresh();
        segments.refresh();
        points.refresh();
        lengths.refresh();
        scale.refresh();
        return isNew;
    }
    static QString text(const QAbstractItemModel& table, int row, int column) {
        return table.index(row, column).data().toString();
    }
    QString fact(const QString& label) {
        for (const Property& property : facts) {
            if (property.label == label) {
                return property.read().display();
            }
        }
        return QStringLiteral("no such fact");
    }

    Stage stage;
    NullPoseReading reading{stage.session};
    NullPoseSegmentModel segments{reading};
    NullPosePointModel points{reading};
    NullPoseLengthModel lengths{reading};
    NullPoseScaleModel scale{reading};
    std::vector<Property> facts = nullPoseFacts(reading);
    std::vector<QAbstractItemModel*> tables{&segments, &points, &lengths, &scale};

private:
    std::vector<std::unique_ptr<QAbstractItemModelTester>> m_testers;
};

TEST_F(NullPoseModelTest, IsEmptyBeforeAnythingCame) {
    EXPECT_FALSE(refresh());
    EXPECT_TRUE(reading.isEmpty());
    for (const QAbstractItemModel* table : tables) {
        EXPECT_EQ(table->rowCount(), 0);
    }
    EXPECT_EQ(fact("Height"), QStringLiteral("–"));
}

TEST_F(NullPoseModelTest, ShowsSegmentsPointsAndSizeAsSent) {
    sendNullPose(Stage::kStart);
    EXPECT_TRUE(refresh());
    EXPECT_FALSE(refresh());
    ASSERT_EQ(segments.rowCount(), 23);
    EXPECT_EQ(points.rowCount(), 127);
    EXPECT_EQ(text(segments, 8, NullPoseSegmentModel::kName), "Right Upper Arm");
    const double height = reading.pose()->segments[6].position.z();
    EXPECT_EQ(text(segments, 6, NullPoseSegmentModel::kZ), QString::number(height, 'f', 4));
    EXPECT_EQ(text(segments, 6, NullPoseSegmentModel::kFromBefore), QStringLiteral("–"));
    EXPECT_EQ(text(points, 12, NullPosePointModel::kName), "pSacrum");
    EXPECT_EQ(text(points, 12, NullPosePointModel::kId), "1.13");
    EXPECT_TRUE(reading.findings().empty());
    EXPECT_EQ(fact("Parts"), QStringLiteral("● 6 of 6"));
    EXPECT_EQ(fact("Changed"), "never");
    EXPECT_TRUE(fact("Height").endsWith(" m"));
}

TEST_F(NullPoseModelTest, ShowsFlagsInHexadecimalAndAsBits) {
    sendNullPose(Stage::kStart, [](wire::NullPose& part) {
        if (!part.points.empty()) {
            part.points[0].flags = 0x80000005U;
        }
    });
    refresh();
    EXPECT_EQ(text(points, 0, NullPosePointModel::kFlags), "0x80000005");
    EXPECT_EQ(text(points, 0, NullPosePointModel::kBits), "31, 2, 0");
    EXPECT_EQ(text(points, 1, NullPosePointModel::kBits), QStringLiteral("–"));
}

TEST_F(NullPoseModelTest, TellsHowFarSegmentsMovedSinceTheMessageBefore) {
    sendNullPose(Stage::kStart);
    sendNullPose(Stage::kStart + 5s, [](wire::NullPose& part) {
        if (!part.segments.empty()) {
            part.segments[14].position[1] += 0.03F;
        }
    });
    refresh();
    EXPECT_EQ(text(segments, 14, NullPoseSegmentModel::kFromBefore), "30.0");
    EXPECT_EQ(segments.index(14, NullPoseSegmentModel::kFromBefore).data(Qt::ForegroundRole).value<QColor>(),
              theme().warning);
    EXPECT_EQ(text(segments, 13, NullPoseSegmentModel::kFromBefore), "0.0");
    EXPECT_TRUE(segments.index(14, NullPoseSegmentModel::kFromBefore)
                    .data(Qt::ToolTipRole)
                    .toString()
                    .contains(QStringLiteral("y +30.0")));
    EXPECT_TRUE(fact("Changed").startsWith(healthSymbol(Health::Warning)));
    EXPECT_TRUE(fact("Messages").startsWith("2"));
}

TEST_F(NullPoseModelTest, MarksLengthsThatDifferBetweenLeftAndRight) {
    sendNullPose(Stage::kStart, [](wire::NullPose& part) {
        if (!part.segments.empty()) {
            part.segments[14].position[1] += 0.01F;
        }
    });
    refresh();
    ASSERT_EQ(lengths.rowCount(), 15);
    EXPECT_EQ(text(lengths, 2, NullPoseLengthModel::kName), "Forearm");
    EXPECT_EQ(text(lengths, 2, NullPoseLengthModel::kDifference), healthSymbol(Health::Warning) + " +10.0");
    EXPECT_EQ(text(lengths, 1, NullPoseLengthModel::kDifference), "0.0");
    EXPECT_EQ(text(lengths, 9, NullPoseLengthModel::kDifference), "trunk");
}

TEST_F(NullPoseModelTest, SaysWhichPartsAreMissing) {
    performer::Performer performer(sending(1, {13}));
    for (const wire::Datagram& datagram : performer.frame(0)) {
        if (datagram.header.datagramIndex() != 2) {
            stage.send(datagram, Stage::kStart);
        }
    }
    refresh();
    EXPECT_EQ(fact("Parts"), "5 of 6, no 3");
    EXPECT_TRUE(reading.findings().empty());
    stage.now += 2s;
    EXPECT_TRUE(refresh());
    EXPECT_EQ(fact("Parts"), healthSymbol(Health::Error) + " 5 of 6, no 3");
    ASSERT_FALSE(reading.findings().empty());
    EXPECT_TRUE(findingsText(reading.findings()).contains("Part 3 of 6"));
}

TEST_F(NullPoseModelTest, ShowsTypes10And11OfOldSenders) {
    performer::PerformerSettings settings = sending(1);
    settings.revision = performer::Revision::E;
    settings.types = {10, 11, 12};
    settings.props = 2;
    performer::Performer performer(settings);
    for (const wire::Datagram& datagram : performer.frame(0)) {
        stage.send(datagram, Stage::kStart);
    }
    refresh();
    EXPECT_EQ(reading.pose(), nullptr);
    EXPECT_FALSE(reading.isEmpty());
    ASSERT_EQ(scale.rowCount(), 23);
    EXPECT_EQ(text(scale, 8, NullPoseScaleModel::kName), "Right Upper Arm");
    EXPECT_TRUE(text(scale, 0, NullPoseScaleModel::kMatrix).contains(" ; "));
    EXPECT_TRUE(fact("Props (11)").startsWith("25 "));
    EXPECT_EQ(segments.rowCount(), 0);
}

TEST_F(NullPoseModelTest, FollowsTheSelectedSegmentByName) {
    sendNullPose(Stage::kStart, [](wire::NullPose& part) {
        if (!part.segments.empty()) {
            std::swap(part.segments[9], part.segments[10]);
        }
    });
    stage.follow();
    stage.session.setSelection({stage.sender(), stage.key(), 10, {}});
    refresh();
    EXPECT_EQ(reading.selectedPlace(), 9);
    EXPECT_EQ(reading.segmentAt(9), 10);
    stage.session.setSelection({stage.sender(), stage.key(), 40, {}});
    EXPECT_EQ(reading.selectedPlace(), -1);
}

TEST_F(NullPoseModelTest, RowsGrowAndShrinkWithTheMessage) {
    sendNullPose(Stage::kStart);
    refresh();
    sendNullPose(Stage::kStart + 5s, [](wire::NullPose& part) {
        if (!part.segments.empty()) {
            part.segments.resize(20);
        }
        part.points.resize(std::min<std::size_t>(part.points.size(), 3));
    });
    refresh();
    EXPECT_EQ(segments.rowCount(), 20);
    EXPECT_EQ(points.rowCount(), 15);
}

} // namespace

} // namespace posewire::gui
