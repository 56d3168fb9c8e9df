// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_model.h"

#include "app/gui/models/roles.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include <cmath>

namespace posewire::gui {

namespace {

class StatisticsModelTest : public testing::Test {
protected:
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    QString text(int row, int column) const { return m_model.index(row, column).data().toString(); }

    Stage m_stage;
    StatisticsModel m_model{m_stage.session};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(StatisticsModelTest, ShowsRateSpacingAndBandwidthOfAStream) {
    for (std::uint32_t i = 0; i < 200; ++i) {
        const std::int64_t late = i % 2 == 0 ? 0 : Stage::kMillisecond;
        m_stage.send(smallPose(), i, i * 10, Stage::kStart + i * 10 * Stage::kMillisecond + late);
    }
    refresh();
    ASSERT_EQ(m_model.rowCount(), 1);
    EXPECT_EQ(m_model.index(0, 0).data(kSuffixRole).toString(), "02");
    EXPECT_EQ(text(0, StatisticsModel::kLeast), "9.00");
    EXPECT_EQ(text(0, StatisticsModel::kMost), "11.00");
    EXPECT_NEAR(text(0, StatisticsModel::kMean).toDouble(), 10.0, 0.02);
    EXPECT_NEAR(text(0, StatisticsModel::kDeviation).toDouble(), 1.0, 0.02);
    EXPECT_NEAR(text(0, StatisticsModel::kRate).toDouble(), 100.0, 0.2);
    EXPECT_NEAR(text(0, StatisticsModel::kBandwidth).toDouble(), 5.6, 0.1); // 56 bytes each
    EXPECT_EQ(text(0, StatisticsModel::kDatagrams), "200");
    EXPECT_EQ(text(0, StatisticsModel::kLost), "0");
}

TEST_F(StatisticsModelTest, CountsLostSamplesExactly) {
    performer::Performer performer(sending(1, {2}, 100.0));
    m_stage.perform(performer, 0, 300, [](std::uint64_t frame) { return frame < 120 || frame > 122; });
    refresh();
    EXPECT_EQ(text(0, StatisticsModel::kLost), QStringLiteral("▲ 3"));
}

TEST_F(StatisticsModelTest, DrawsTheRateSecondBySecondAndBreaksWhereNobodyLooked) {
    performer::Performer performer(sending(1, {2}, 50.0));
    const auto look = [&](std::uint64_t second) {
        m_stage.perform(performer, second * 50, second * 50 + 50);
        m_stage.now = Stage::kStart + static_cast<std::int64_t>(second + 1) * Stage::kSecond;
        refresh();
    };
    for (std::uint64_t second = 0; second < 4; ++second) {
        look(second);
    }
    m_stage.now += 3 * Stage::kSecond;
    refresh();
    const auto series = m_model.index(0, StatisticsModel::kTrend).data(kSeriesRole).value<QList<float>>();
    ASSERT_EQ(series.size(), 6);
    EXPECT_FLOAT_EQ(series[0], 50.0F);
    EXPECT_FLOAT_EQ(series[2], 50.0F);
    EXPECT_TRUE(std::isnan(series[3]));
    EXPECT_TRUE(std::isnan(series[5]));
}

TEST_F(StatisticsModelTest, KeepsTwoMinutesAndNoMore) {
    m_stage.send(smallPose(), 1, 1, Stage::kStart);
    refresh();
    for (int i = 0; i < 300; ++i) {
        m_stage.now += Stage::kSecond;
        refresh();
    }
    const auto series = m_model.index(0, StatisticsModel::kTrend).data(kSeriesRole).value<QList<float>>();
    EXPECT_EQ(series.size(), StatisticsModel::kTrendSeconds);
}

TEST_F(StatisticsModelTest, AnnouncesOneInsertionAndOneChange) {
    QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    performer::Performer performer(sending(4));
    m_stage.perform(performer, 0, 24);
    refresh();
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(changed.count(), 1);
    EXPECT_EQ(m_model.rowCount(), 4 * static_cast<int>(performer::typesOf(performer::Revision::N).size()));
}

TEST(ReceiverFacts, TellsWhatThisComputerDropped) {
    Stage stage;
    PropertyModel facts(receiverFacts(stage.session));
    QAbstractItemModelTester tester(&facts, QAbstractItemModelTester::FailureReportingMode::Fatal);
    EXPECT_EQ(facts.index(2, 0).data().toString(), "Dropped here");
    EXPECT_EQ(facts.index(2, 1).data().toString(), QStringLiteral("● 0"));
    log::Arrival arrival;
    arrival.stampNs = Stage::kStart;
    arrival.source = stage.source();
    arrival.kernelDropsBefore = 17;
    wire::Datagram datagram;
    datagram.body = smallPose();
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    stage.log.writer().append(*wire::encode(datagram), arrival);
    stage.log.writer().publish();
    stage.follow();
    EXPECT_EQ(facts.index(2, 1).data().toString(), QStringLiteral("■ 17"));
}

} // namespace

} // namespace posewire::gui
