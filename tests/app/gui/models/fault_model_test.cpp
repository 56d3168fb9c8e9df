// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/fault_model.h"

#include "app/gui/models/shown_character.h"
#include "core/filter/filter.h"
#include "core/model/session/accounts.h"
#include "core/performer/sending.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

namespace posewire::gui {
namespace {

class FaultModelTest : public testing::Test {
protected:
    /// Two characters in two types; of character 1 some samples of type 20 do not come.
    void perform(std::uint64_t from, std::uint64_t to) {
        for (std::uint64_t frame = from; frame < to; ++frame) {
            for (const wire::Datagram& datagram : m_performer.frame(frame)) {
                const bool isLost =
                    frame % 50 == 25 && datagram.header.type() == 20 && datagram.header.character == 1;
                if (!isLost) {
                    m_stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / 100));
                }
            }
        }
        refresh();
    }
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    [[nodiscard]] static QString text(const QModelIndex& row, int column) {
        return row.siblingAtColumn(column).data().toString();
    }
    [[nodiscard]] static QString share(const QModelIndex& row, int column) {
        return row.siblingAtColumn(column).data(kSuffixRole).toString();
    }

    Stage m_stage;
    performer::Performer m_performer{sending(2, {2, 20}, 100.0)};
    FaultModel m_model{m_stage.session};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(FaultModelTest, IsEmptyBeforeAnythingCame) {
    refresh();
    EXPECT_EQ(m_model.rowCount(), 0);
}

TEST_F(FaultModelTest, SaysWhoLostHowMuchAndWhoseFaultItWas) {
    perform(0, 400);
    ASSERT_EQ(m_model.rowCount(), 3);
    const QModelIndex all = m_model.index(0, 0);
    const QModelIndex second = m_model.index(2, 0);
    EXPECT_EQ(text(all, FaultModel::kName), "All characters");
    EXPECT_EQ(text(all, FaultModel::kNetwork), "8");
    EXPECT_EQ(share(all, FaultModel::kNetwork), "0.5 %");
    EXPECT_EQ(text(second, FaultModel::kNetwork), "8");
    EXPECT_EQ(text(second, FaultModel::kLost), QStringLiteral("▲ 8"));
    EXPECT_EQ(text(second, FaultModel::kThisComputer), "0");
    ASSERT_EQ(m_model.rowCount(second), 2);
    const QModelIndex stream = m_model.index(1, 0, second);
    EXPECT_EQ(text(stream, FaultModel::kName), "20 Joint angles");
    EXPECT_EQ(share(stream, FaultModel::kNetwork), "2.0 %");
    EXPECT_EQ(text(stream, FaultModel::kExpected), "400");
}

TEST_F(FaultModelTest, ZeroIsQuietAndLossHasShapeColourAndText) {
    perform(0, 200);
    const QModelIndex second = m_model.index(2, 0);
    const auto colour = [&](int column) {
        return second.siblingAtColumn(column).data(Qt::ForegroundRole).value<QColor>();
    };
    EXPECT_EQ(colour(FaultModel::kSender), theme().dim);
    EXPECT_EQ(colour(FaultModel::kLost), theme().warning);
    EXPECT_EQ(share(second, FaultModel::kSender), "");
}

TEST_F(FaultModelTest, IsOfTheRangeThatIsChosenForAllFigures) {
    perform(0, 400);
    m_stage.commands.selectRange({.last = 1s});
    refresh();
    EXPECT_EQ(text(m_model.index(0, 0), FaultModel::kNetwork), "2");
    EXPECT_EQ(spanText(m_stage.session), "last 1.0 s");
    m_stage.session.resetForTake();
    refresh();
    EXPECT_EQ(text(m_model.index(0, 0), FaultModel::kNetwork), QStringLiteral("–"))
        << "nothing is expected yet";
    EXPECT_TRUE(spanText(m_stage.session).startsWith("since reset, "));
    m_stage.commands.selectRange({});
    EXPECT_EQ(spanText(m_stage.session), "all, 4.0 s");
}

TEST_F(FaultModelTest, RowsStayWhileFiguresChange) {
    perform(0, 200);
    const QPersistentModelIndex stream(m_model.index(1, 0, m_model.index(2, 0)));
    const QSignalSpy reset(&m_model, &QAbstractItemModel::modelReset);
    const QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    perform(200, 400);
    EXPECT_EQ(reset.count(), 0);
    EXPECT_EQ(changed.count(), 1);
    ASSERT_TRUE(stream.isValid());
    EXPECT_EQ(text(stream, FaultModel::kNetwork), "8");
}

TEST_F(FaultModelTest, ACellLeadsToThePacketsThatShowTheLoss) {
    perform(0, 400);
    const PacketsBehind behind = m_model.packetsBehind(m_model.index(2, FaultModel::kNetwork));
    ASSERT_TRUE(behind.packet.has_value());
    const model::PacketDigest* digest = m_stage.session.accounts().digests().find(*behind.packet);
    EXPECT_EQ(digest->gap, 1U);
    EXPECT_EQ(digest->type, 20);
    EXPECT_EQ(digest->character, 1);
    EXPECT_EQ(behind.filter, "character == 1 && gap > 0");
    EXPECT_TRUE(isListed(m_stage.session, behind.filter, *behind.packet));
}

TEST_F(FaultModelTest, OfSeveralCausesACellNamesItsOwnPackets) {
    perform(0, 150);
    // All pause together, and nothing says why.
    perform(152, 300);
    const PacketsBehind behind = m_model.packetsBehind(m_model.index(2, FaultModel::kNetwork));
    EXPECT_TRUE(behind.filter.startsWith("number in {")) << behind.filter.toStdString();
    EXPECT_TRUE(filter::Filter::compile(behind.filter.toStdString()).has_value());
    EXPECT_TRUE(isListed(m_stage.session, behind.filter, *behind.packet));
    const PacketsBehind all = m_model.packetsBehind(m_model.index(2, FaultModel::kLost));
    EXPECT_EQ(all.filter, "character == 1 && gap > 0");
}

TEST_F(FaultModelTest, ACellOfIncompleteSamplesLeadsToWhatCameOfThem) {
    for (std::uint64_t frame = 0; frame < 100; ++frame) {
        const auto stamp = Stage::kStart + log::durationOf(static_cast<double>(frame) / 100);
        const wire::Datagram datagram = m_performer.frame(frame).front(); // type 02 of character 0
        const auto parts = performer::splitSample(*wire::encode(datagram), 2);
        ASSERT_EQ(parts.size(), 2U);
        m_stage.sendBytes(parts[0], stamp);
        if (frame % 50 != 25) {
            m_stage.sendBytes(parts[1], stamp);
        }
    }
    refresh();
    const QModelIndex all = m_model.index(0, 0);
    ASSERT_EQ(text(all, FaultModel::kLost), QStringLiteral("▲ 2"));
    const PacketsBehind behind = m_model.packetsBehind(all.siblingAtColumn(FaultModel::kLost));
    EXPECT_EQ(behind.filter, "number in {50, 149}");
    EXPECT_EQ(behind.packet, 149U);
    EXPECT_TRUE(isListed(m_stage.session, behind.filter, 50));
    m_stage.commands.selectRange({.last = 500ms});
    refresh();
    EXPECT_EQ(m_model.packetsBehind(m_model.index(0, FaultModel::kLost)).filter, "number in {149}");
}

TEST_F(FaultModelTest, CsvHasALineForEachRow) {
    perform(0, 200);
    const QStringList lines = m_model.csv().split(QStringLiteral("\r\n"));
    ASSERT_EQ(lines.size(), 9);
    EXPECT_EQ(lines[0], "Character,Name,Type,This computer,Network,Sender,Unknown,Lost,Expected");
    EXPECT_TRUE(lines[7].endsWith(",20,0,4,0,0,4,200")) << lines[7].toStdString();
}

} // namespace
} // namespace posewire::gui
