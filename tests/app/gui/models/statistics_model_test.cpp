// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/statistics_model.h"

#include "app/gui/models/column.h"
#include "app/gui/models/display_filter.h"
#include "core/filter/filter.h"
#include "core/model/session/roster.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

using Figure = model::Figure;

int columnOf(model::Figure figure) {
    int column = 0;
    while (figureIn(column) != figure) {
        ++column;
    }
    return column;
}

class StatisticsModelTest : public testing::Test {
protected:
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    QModelIndex sender(int row = 0) const { return m_model.index(row, 0); }
    QModelIndex character(int row = 0) const { return m_model.index(row, 0, sender()); }
    QModelIndex stream(int row = 0) const { return m_model.index(row, 0, character()); }
    static QModelIndex cell(const QModelIndex& row, Figure column) {
        return row.siblingAtColumn(columnOf(column));
    }
    static QString text(const QModelIndex& row, Figure column) { return cell(row, column).data().toString(); }
    static double number(const QModelIndex& row, Figure column) {
        return text(row, column).remove(QChar(0x202f)).toDouble();
    }

    /// 100 samples a second for that many seconds; frame 520 never arrives.
    void performSeconds(std::uint64_t seconds) {
        performer::Performer performer(sending(1, {2}, 100.0));
        m_stage.perform(performer, 0, seconds * 100, [](std::uint64_t frame) { return frame != 520; });
        refresh();
    }

    Stage m_stage;
    StatisticsModel m_model{m_stage.session};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(StatisticsModelTest, SpeaksWordsForShapes) {
    performSeconds(10);
    EXPECT_EQ(text(stream(), Figure::LossShare), "▲ 0.10");
    EXPECT_EQ(cell(stream(), Figure::LossShare).data(Qt::AccessibleTextRole).toString(), "warning, 0.10");
    EXPECT_EQ(cell(stream(), Figure::Duplicates).data(Qt::AccessibleTextRole).toString(), "0");
}

TEST_F(StatisticsModelTest, ShowsRateSpacingAndBandwidthOfAStream) {
    for (std::uint32_t i = 0; i < 200; ++i) {
        const auto late = i % 2 == 0 ? 0ms : 1ms;
        m_stage.send(smallPose(), i, i * 10, Stage::kStart + i * 10ms + late);
    }
    refresh();
    ASSERT_EQ(m_model.rowCount(character()), 1);
    EXPECT_EQ(text(stream(), Figure::SpacingLeast), "9.00");
    EXPECT_EQ(text(stream(), Figure::SpacingMost), "11.00");
    EXPECT_NEAR(number(stream(), Figure::SpacingMean), 10.0, 0.02);
    EXPECT_NEAR(number(stream(), Figure::SpacingDeviation), 1.0, 0.02);
    EXPECT_NEAR(number(stream(), Figure::Rate), 100.0, 0.2);
    EXPECT_NEAR(number(stream(), Figure::Bandwidth), 5.6, 0.1); // 56 bytes each
    EXPECT_NEAR(number(stream(), Figure::Jitter), 1.0, 0.1);
    EXPECT_EQ(text(stream(), Figure::Datagrams), "200");
    EXPECT_EQ(text(stream(), Figure::Lost), "0");
}

TEST_F(StatisticsModelTest, RateIsThatOfNowAndZeroWhereNothingComesAnyMore) {
    performSeconds(3);
    EXPECT_NEAR(number(stream(), Figure::Rate), 100, 1);
    m_stage.now += 2s;
    refresh();
    EXPECT_EQ(number(stream(), Figure::Rate), 0);
    EXPECT_NEAR(number(stream(), Figure::RateMean), 100, 1);
}

TEST_F(StatisticsModelTest, ZeroIsQuietAndLossHasShapeColourAndText) {
    performSeconds(3);
    EXPECT_EQ(cell(stream(), Figure::Lost).data(Qt::ForegroundRole).value<QColor>(), theme().dim);
    performer::Performer performer(sending(1, {2}, 100.0));
    m_stage.perform(performer, 300, 600, [](std::uint64_t frame) { return frame != 520; });
    refresh();
    EXPECT_EQ(text(stream(), Figure::Lost), "1");
    EXPECT_EQ(text(stream(), Figure::LongestGap), "1");
    EXPECT_FALSE(cell(stream(), Figure::Lost).data(Qt::ForegroundRole).isValid()) << "said by the share";
    EXPECT_EQ(cell(stream(), Figure::LossShare).data(Qt::ForegroundRole).value<QColor>(),
              healthColour(Health::Warning));
}

TEST_F(StatisticsModelTest, NamesBesideFiguresOfAllAreOfAllWhateverTheCursor) {
    performSeconds(3);
    m_stage.sendMetadata("name:Mira\n", m_stage.now);
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 10});
    refresh();
    EXPECT_EQ(character().data().toString(), "Mira");
    m_stage.commands.selectRange({.last = 10s});
    refresh();
    EXPECT_EQ(character().data().toString(), "Character 0") << "had sent no name by then";
}

TEST_F(StatisticsModelTest, FiguresAreOfTheRangeThatIsChosen) {
    performSeconds(20);
    EXPECT_EQ(text(stream(), Figure::Lost), "1");
    const log::Stamp start = Stage::kStart;
    m_stage.commands.selectRange({0s, model::TimeRange{start + 10s, start + 15s}});
    refresh();
    EXPECT_EQ(text(stream(), Figure::Lost), "0");
    EXPECT_EQ(text(stream(), Figure::Samples), "500");
    EXPECT_EQ(text(stream(), Figure::Rate), "100.0");
    EXPECT_EQ(text(stream(), Figure::Bursts), "0");
    EXPECT_EQ(text(sender(), Figure::Samples), "500");
    m_stage.commands.selectRange({10s, std::nullopt});
    refresh();
    EXPECT_NEAR(number(stream(), Figure::Samples), 1000, 11);
    m_stage.commands.selectRange({});
    refresh();
    EXPECT_EQ(text(stream(), Figure::Lost), "1");
}

TEST_F(StatisticsModelTest, SaysWhoseLossItWasAlsoInARange) {
    performer::Performer performer(sending(1, {2, 21}, 100.0));
    for (std::uint64_t frame = 0; frame < 2000; ++frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            if (frame != 520 || datagram.header.type() != 2) { // the other stream proves that it was sent
                m_stage.send(datagram, Stage::kStart + std::chrono::milliseconds(10 * frame));
            }
        }
    }
    refresh();
    EXPECT_EQ(text(stream(), Figure::LostOnNetwork), "1");
    m_stage.commands.selectRange({0s, model::TimeRange{Stage::kStart + 4s, Stage::kStart + 6s}});
    refresh();
    EXPECT_EQ(text(stream(), Figure::LostOnNetwork), "1");
    EXPECT_EQ(text(stream(), Figure::LostUnknown), "0");
    EXPECT_EQ(text(character(), Figure::LostOnNetwork), "1");
    m_stage.commands.selectRange({0s, model::TimeRange{Stage::kStart + 6s, Stage::kStart + 9s}});
    refresh();
    EXPECT_EQ(text(stream(), Figure::LostOnNetwork), "0");
}

TEST_F(StatisticsModelTest, SumsOfCharacterAndSenderAddUpAndLeaveOutWhatMakesNoSense) {
    performer::Performer performer(sending(2, {2, 20, 12}, 100.0));
    m_stage.perform(performer, 0, 300, [](std::uint64_t frame) { return frame != 120; });
    refresh();
    EXPECT_EQ(m_model.rowCount(sender()), 2);
    EXPECT_EQ(text(character(), Figure::Lost), "2");
    EXPECT_EQ(text(sender(), Figure::Lost), "4");
    EXPECT_EQ(text(sender(), Figure::Rate), "");
    EXPECT_EQ(text(sender(), Figure::Skew), "");
    QString datagrams = text(sender(), Figure::Datagrams);
    EXPECT_EQ(datagrams.remove(QChar(0x202f)).toULongLong(),
              m_stage.session.roster().senders().front().datagrams);
}

TEST_F(StatisticsModelTest, MessagesWithoutSamplesHaveNoFiguresOfSamples) {
    m_stage.sendMetadata("name: Ana\n", Stage::kStart);
    refresh();
    EXPECT_EQ(text(stream(), Figure::Lost), "");
    EXPECT_EQ(text(stream(), Figure::Datagrams), "1");
    EXPECT_EQ(text(stream(), Figure::Incomplete), "0");
}

TEST_F(StatisticsModelTest, CurveSpansTwoMinutesAndIsMarkedWhereSamplesWereLost) {
    performSeconds(20);
    const auto rates = stream().siblingAtColumn(kCurveColumn).data(kSeriesRole).value<QList<float>>();
    const auto marks = stream().siblingAtColumn(kCurveColumn).data(kMarksRole).value<QList<float>>();
    ASSERT_EQ(rates.size(), StatisticsModel::kCurvePoints);
    ASSERT_EQ(marks.size(), StatisticsModel::kCurvePoints);
    EXPECT_TRUE(std::isnan(rates.first()));
    EXPECT_FLOAT_EQ(rates[rates.size() - 4], 100.0F);
    EXPECT_EQ(std::ranges::count_if(marks, [](float mark) { return mark > 0; }), 1);
}

TEST_F(StatisticsModelTest, AnnouncesAtMostOneInsertionAndOneChangeEachTime) {
    performer::Performer performer(sending(4));
    m_stage.perform(performer, 0, 24);
    for (int i = 0; i < 6; ++i) {
        QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
        QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
        refresh();
        EXPECT_LE(inserted.count(), 1);
        EXPECT_EQ(changed.count(), 1);
    }
    EXPECT_EQ(m_model.rowCount(sender()), 4);
    EXPECT_EQ(m_model.rowCount(character()),
              static_cast<int>(performer::typesOf(performer::Revision::N).size()));
}

TEST_F(StatisticsModelTest, StreamsStandByTheirTypeWheneverTheyCome) {
    const auto types = [this] {
        QStringList titles;
        for (int row = 0; row < m_model.rowCount(character()); ++row) {
            titles += stream(row).data().toString().left(2);
        }
        return titles.join(QLatin1Char(' '));
    };
    const auto perform = [this](std::vector<std::uint8_t> sent, std::uint64_t from) {
        performer::Performer performer(sending(1, std::move(sent)));
        m_stage.perform(performer, from, from + 24);
        refresh();
        refresh();
    };
    perform({20, 23}, 0);
    EXPECT_EQ(types(), "20 23");
    perform({24, 2, 21}, 24);
    EXPECT_EQ(types(), "02 20 21 23 24");
}

TEST_F(StatisticsModelTest, EveryColumnHasATitleAndSaysWhatItIs) {
    for (int column = 0; column < m_model.columnCount(); ++column) {
        EXPECT_NE(m_model.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString(), "");
        EXPECT_GT(m_model.headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString().size(), 20);
    }
}

TEST_F(StatisticsModelTest, ACellIsAFilterThatThePacketListUnderstands) {
    performSeconds(6);
    const auto filter = [&](const QModelIndex& row, Figure column) {
        return statisticsFilter(m_stage.session, m_model, cell(row, column));
    };
    EXPECT_EQ(filter(stream(), Figure::Lost), "type == 02 && character == 0 && gap > 0");
    EXPECT_EQ(filter(stream(), Figure::Duplicates), "type == 02 && character == 0 && duplicate");
    EXPECT_EQ(filter(character(), Figure::Restarts), "character == 0 && restart");
    EXPECT_EQ(filter(sender(), Figure::Malformed), "source == \"192.168.10.21:52011\" && malformed");
    m_stage.sendBytes({}, m_stage.now, "192.168.10.22:52011");
    m_stage.commands.selectRange({0s, model::TimeRange{Stage::kStart + 1s, Stage::kStart + 2s}});
    refresh();
    EXPECT_EQ(filter(stream(), Figure::Reordered),
              "type == 02 && character == 0 && source == \"192.168.10.21:52011\" && reordered && "
              "time >= 1.000 && time < 2.000");
    EXPECT_EQ(rangeFilter(m_stage.session, {Stage::kStart + 1'000'600us, Stage::kStart + 2'000'001us}),
              "time >= 1.0006 && time < 2.000001")
        << "what is listed is what is counted";
    for (int column = 0; column < kStatisticsColumns; ++column) {
        const QString text = statisticsFilter(m_stage.session, m_model, stream().siblingAtColumn(column));
        EXPECT_TRUE(filter::Filter::compile(text.toStdString()).has_value()) << text.toStdString();
    }
}

TEST_F(StatisticsModelTest, CsvHasALineForEachStreamAndNumbersThatProgramsRead) {
    performer::Performer performer(sending(2, {2, 20}, 100.0));
    m_stage.perform(performer, 0, 1200);
    refresh();
    const QStringList lines = m_model.csv().split(QStringLiteral("\r\n"));
    ASSERT_EQ(lines.size(), 6);
    EXPECT_TRUE(lines[0].startsWith("Sender,Character,Name,Type,Hz,"));
    EXPECT_TRUE(lines[1].startsWith("192.168.10.21:52011,0,"));
    EXPECT_EQ(lines[1].count(QLatin1Char(',')), lines[0].count(QLatin1Char(',')));
    EXPECT_FALSE(m_model.csv().contains(QChar(0x202f)));
    EXPECT_TRUE(lines[1].contains(",1200,"));
}

TEST_F(StatisticsModelTest, CsvHasTheNumbersThemselvesNotWhatTheTableShows) {
    for (std::uint32_t i = 0; i < 3000; ++i) { // a sender's clock that loses 2 ms a second
        m_stage.send(smallPose(), i, i * 10 - i / 5, Stage::kStart + i * 10ms);
    }
    refresh();
    const QStringList lines = m_model.csv().split(QStringLiteral("\r\n"));
    const auto inCsv = [&](Figure column) { // the name and the curve are not in it, four others are
        return lines[1].split(QLatin1Char(','))[columnOf(column) + (columnOf(column) < kCurveColumn ? 3 : 2)];
    };
    EXPECT_EQ(inCsv(Figure::Datagrams), "3000");
    EXPECT_EQ(inCsv(Figure::Datagrams).toDouble(), m_model.figures(stream())[Figure::Datagrams]);
    EXPECT_LT(inCsv(Figure::Skew).toDouble(), -1000);
    EXPECT_NEAR(inCsv(Figure::Skew).toDouble(), m_model.figures(stream())[Figure::Skew], 0.06);
    EXPECT_TRUE(text(stream(), Figure::Skew).startsWith(QChar(0x2212)));
}

} // namespace

} // namespace posewire::gui
