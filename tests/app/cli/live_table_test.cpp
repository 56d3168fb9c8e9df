// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/table_writer.h"

#include "app/cli/monitor.h"
#include "core/model/session/session.h"
#include "core/wire/codec.h"
#include "core/wire/text.h"
#include "tests/support/hostile_text.h"

#include <gmock/gmock.h>

namespace posewire::cli {
namespace {

TEST(LiveDisplay, WritesOneTableOverTheOtherOnATerminal) {
    LiveDisplay display(true);
    EXPECT_EQ(display.show({"one", "two"}, 24, 80), "\x1b[2Kone\n\x1b[2Ktwo\n\x1b[J");
    EXPECT_EQ(display.show({"three"}, 24, 80), "\x1b[2A\x1b[2Kthree\n\x1b[J");
    EXPECT_EQ(display.show({"four"}, 24, 80), "\x1b[1A\x1b[2Kfour\n\x1b[J");
}

TEST(LiveDisplay, NeverWritesMoreThanTheTerminalHolds) {
    LiveDisplay display(true);
    const std::vector<std::string> lines(50, "äöüßéè");
    const std::string text = display.show(lines, 10, 3);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 9);
    EXPECT_EQ(text.find("ß"), std::string::npos);
    EXPECT_THAT(display.show(lines, 10, 80), testing::StartsWith("\x1b[9A"));
}

TEST(LiveDisplay, WritesBlocksElsewhere) {
    LiveDisplay display(false);
    EXPECT_EQ(display.show({"one", "two"}, 24, 80), "one\ntwo\n\n");
}

TEST(LiveTable, ShowsNamesAsTextOfALine) {
    for (const std::string& name : posewire::test::hostileNames()) {
        log::PacketLog log{{.memoryCap = std::size_t{1} << 22, .chunkSize = std::size_t{1} << 20}};
        model::Session session{log};
        wire::Datagram datagram;
        datagram.body = wire::MetaData{true, "name:" + name + "\n"};
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        log::Arrival arrival;
        arrival.stamp = log::Stamp(std::chrono::seconds(1));
        arrival.sender = log.senders().intern({"recording " + name, log::Transport::File, 0});
        log.writer().append(*wire::encode(datagram), arrival);
        log.writer().publish();
        session.follow(arrival.stamp);
        const std::vector<std::string> lines = liveTable(session, {.durationS = 1});
        const bool isText = wire::firstInvalidUtf8(name) == name.size(); // else it is malformed
        EXPECT_EQ(lines.size(), isText ? 5U : 2U) << name.substr(0, 80);
        for (const std::string& line : lines) {
            EXPECT_EQ(posewire::test::harmIn(line), "") << line;
            EXPECT_EQ(line.find('\n'), std::string::npos);
        }
    }
}

TEST(LiveTable, SaysHowManyDatagramsOfOthersWereRefused) {
    const log::PacketLog log{{.memoryCap = std::size_t{1} << 22, .chunkSize = std::size_t{1} << 20}};
    const model::Session session{log};
    exporting::MonitorFacts facts;
    EXPECT_THAT(liveTable(session, facts)[0], testing::Not(testing::HasSubstr("refused")));
    facts.refusedDatagrams = 1'234;
    EXPECT_THAT(liveTable(session, facts)[0], testing::EndsWith("   refused by --sender 1\u202f234"));
}

TEST(MonitorPlaces, AreTheUsualPortWhereNothingIsNamed) {
    const auto places = placesOf({});
    ASSERT_TRUE(places);
    ASSERT_EQ(places->udp.size(), 1U);
    EXPECT_EQ(places->udp[0].endpoint, net::Endpoint{});
    MonitorOptions tcp;
    tcp.tcpListen = {"9764"};
    EXPECT_TRUE(placesOf(tcp)->udp.empty());
}

TEST(MonitorPlaces, JoinGroupsAtThePortsThatHearAllAddresses) {
    MonitorOptions options;
    options.multicast = {"239.1.2.3"};
    EXPECT_EQ(placesOf(options)->udp, (std::vector<net::UdpInput>{{net::Endpoint{}, {"239.1.2.3"}}}));
    options.udp = {"127.0.0.1:1", "2"};
    const auto places = placesOf(options);
    ASSERT_EQ(places->udp.size(), 2U);
    EXPECT_TRUE(places->udp[0].groups.empty());
    EXPECT_EQ(places->udp[1].groups.size(), 1U);
}

} // namespace
} // namespace posewire::cli
