// SPDX-License-Identifier: GPL-3.0-or-later
// Ways to copy, to go to and to find packets.
#include "app/gui/models/display_filter.h"
#include "app/gui/models/packet_model.h"

#include "app/gui/models/packet_choice.h"
#include "app/gui/models/packet_search.h"
#include "core/filter/filter.h"
#include "core/model/session/accounts.h"
#include "tests/app/gui/models/stage.h"

namespace posewire::gui {
namespace {

class PacketTextTest : public testing::Test {
protected:
    PacketTextTest() {
        for (std::uint32_t sample = 0; sample < 100; ++sample) {
            m_stage.send(smallPose(), sample, sample * 10, Stage::kStart + sample * 10ms);
        }
        m_stage.sendMetadata("name:Mira Lindqvist\n", Stage::kStart + 1s);
        m_stage.follow();
        m_model.refresh();
    }
    std::uint64_t target(const QString& text) {
        return packetTarget(m_stage.session, text).value_or(UINT64_MAX);
    }

    Stage m_stage;
    PacketModel m_model{m_stage.session};
};

TEST_F(PacketTextTest, WritesBytesInEveryFormat) {
    const QString text = packetBytesText(m_stage.session, 0, ByteFormat::Text);
    EXPECT_TRUE(text.startsWith("0000  4d 58 54 50 30 32 00 00 00 00 80 01")) << text.toStdString();
    EXPECT_TRUE(text.contains("MXTP02"));
    EXPECT_EQ(text.count('\n'), 4);
    EXPECT_EQ(packetBytesText(m_stage.session, 0, ByteFormat::Raw).size(), 112);
    const QString array = packetBytesText(m_stage.session, 7, ByteFormat::CArray);
    EXPECT_TRUE(array.startsWith("const unsigned char packet7[56] = {\n    0x4d, 0x58,"))
        << array.toStdString();
    EXPECT_EQ(array.count("0x"), 56);
    const QString json = packetBytesText(m_stage.session, 100, ByteFormat::Json);
    EXPECT_TRUE(json.contains("\"type\":\"12\"") && json.contains("Mira Lindqvist")) << json.toStdString();
    EXPECT_EQ(packetBytesText(m_stage.session, 4'000, ByteFormat::Raw), "");
}

TEST_F(PacketTextTest, WritesRowsForSpreadsheets) {
    const int rows[] = {0, 100};
    const QStringList lines = packetRowsCsv(m_model, rows).split("\r\n");
    ASSERT_EQ(lines.size(), 4);
    EXPECT_TRUE(lines[0].startsWith("No.,Time s,"));
    EXPECT_TRUE(lines[1].startsWith("0,0.0000,")) << lines[1].toStdString();
    EXPECT_TRUE(lines[1].contains("\"02 Pose, quaternion\""));
    EXPECT_EQ(packetRowsText(m_model, rows).count('\n'), 2);
}

TEST_F(PacketTextTest, EveryCellMakesAFilterThatItsOwnPacketPasses) {
    for (const int column : {0, 1, 3, 4, 5, 6, 7, 8}) {
        const QString text = packetCellFilter(m_stage.session, 42, column);
        const auto compiled = filter::Filter::compile(text.toStdString());
        ASSERT_TRUE(compiled.has_value()) << text.toStdString();
        const auto packet = m_stage.session.packet(42);
        const auto datagram = wire::decode(packet->bytes);
        const auto sender = m_stage.log.senders().find(packet->sender);
        EXPECT_TRUE(compiled->matches({*packet, *m_stage.session.accounts().digests().find(42), &*datagram,
                                       sender.get(), m_stage.session.firstStamp()}))
            << text.toStdString();
    }
    EXPECT_EQ(packetCellFilter(m_stage.session, 42, PacketModel::kNote), "");
}

TEST(JoinedFilter, KeepsWhatStoodThereTogether) {
    EXPECT_EQ(joinedFilter("", "b", FilterJoin::And), "b");
    EXPECT_EQ(joinedFilter("a", "b", FilterJoin::Replace), "b");
    EXPECT_EQ(joinedFilter("a", "b", FilterJoin::And), "a && b");
    EXPECT_EQ(joinedFilter("a || c", "b", FilterJoin::And), "(a || c) && b");
    EXPECT_EQ(joinedFilter("a", "b", FilterJoin::Or), "a || b");
    EXPECT_EQ(joinedFilter("a", "b", FilterJoin::AndNot), "a && !(b)");
    EXPECT_EQ(joinedFilter("", "b", FilterJoin::AndNot), "!(b)");
}

TEST_F(PacketTextTest, GoesToNumbersDistancesAndTimes) {
    EXPECT_EQ(target("42"), 42U);
    EXPECT_EQ(target("-1"), 99U);
    m_stage.commands.selectPacket(42);
    EXPECT_EQ(target("+5"), 47U);
    EXPECT_EQ(target(" - 40 "), 2U);
    EXPECT_EQ(target("0.5 s"), 50U);
    EXPECT_EQ(target("22:13:20.250"), 25U);
    EXPECT_FALSE(packetTarget(m_stage.session, "101").has_value());
    EXPECT_FALSE(packetTarget(m_stage.session, "-43").has_value());
    EXPECT_FALSE(packetTarget(m_stage.session, "+18446744073709551615").has_value());
    EXPECT_FALSE(packetTarget(m_stage.session, "30 s").has_value());
    EXPECT_FALSE(packetTarget(m_stage.session, "noon").has_value());
    EXPECT_FALSE(packetTarget(m_stage.session, "").has_value());
}

TEST_F(PacketTextTest, TheNextProblemIsAfterTheMomentThatIsShown) {
    for (const std::uint32_t sample : {101, 102, 104, 105}) { // packets 101 to 104
        m_stage.send(smallPose(), sample, sample * 10, Stage::kStart + sample * 10ms);
    }
    m_stage.follow();
    m_model.refresh();
    const auto next = [&] {
        return nearestListed(m_stage.session, m_model, Landmark::Problem, Direction::Forward);
    };
    EXPECT_EQ(next().value_or(0), 101U) << "after sample 100, which is lost";
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 102});
    EXPECT_EQ(next().value_or(0), 103U) << "after sample 103";
}

TEST_F(PacketTextTest, ReadsTimesBetweenPackets) {
    const log::Stamp first = m_stage.session.firstStamp();
    EXPECT_EQ(timeTarget(m_stage.session, " 0.255 s"), first + 255ms);
    EXPECT_EQ(timeTarget(m_stage.session, "30 s"), first + 30s);
    EXPECT_EQ(timeTarget(m_stage.session, "22:13:20.255"), first + 255ms);
    for (const char* text : {"42", "+5", "noon", "22:61", "s", ""}) {
        EXPECT_FALSE(timeTarget(m_stage.session, text).has_value()) << text;
    }
}

TEST_F(PacketTextTest, ATimeOfDayIsOfTheDayBeforeWhereItsOwnIsStillToCome) {
    const log::Stamp first = m_stage.session.firstStamp();
    m_stage.sendMetadata("name:Mira Lindqvist\n", Stage::kStart + 3h);
    m_stage.follow();
    EXPECT_EQ(timeTarget(m_stage.session, "00:13:20"), first + 2h);
    EXPECT_EQ(timeTarget(m_stage.session, "22:13:21"), first + 1s);
    EXPECT_EQ(timeTarget(m_stage.session, "01:13:21"), first + 3h + 1s) << "after the newest packet";
}

TEST_F(PacketTextTest, FindsTextAndBytesInBothDirectionsAndAround) {
    const auto find = [&](const QString& text, bool isHexadecimal, std::uint64_t from, bool isForward) {
        return PacketSearch(m_stage.log, {*parsePattern(text, isHexadecimal), from, isForward, {}}).wait();
    };
    EXPECT_EQ(find("mira lind", false, 0, true).found->packet, 100U);
    EXPECT_FALSE(find("mira lind", false, 0, true).isWrapped);
    EXPECT_TRUE(find("mira lind", false, 100, true).isWrapped);
    EXPECT_EQ(find("MXTP02", false, 10, false).found->packet, 9U);
    EXPECT_EQ(find("MXTP02", false, 0, false).found->packet, 99U);
    EXPECT_EQ(find("4d58 54,50 0x31 32", true, 3, true).found->packet, 100U);
    EXPECT_EQ(find("Ana", false, 0, true).found, std::nullopt);
    EXPECT_FALSE(parsePattern("4d 5", true).has_value());
    EXPECT_FALSE(parsePattern("no bytes", true).has_value());
}

} // namespace
} // namespace posewire::gui
