// SPDX-License-Identifier: MIT
#include "core/export/sheets.h"
#include "core/model/session/session.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace posewire::exporting {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class EventSheetTest : public testing::Test {
protected:
    EventSheetTest() {
        gap.number = 7;
        gap.kind = model::IncidentKind::Loss;
        gap.sender = log.senders().intern({"192.168.10.21:52011", log::Transport::Udp, 9763});
        gap.parts.push_back({gap.sender, 1, 2});
        gap.parts.push_back({gap.sender, 3, 21});
        gap.firstStamp = log::stampOf(1'700'000'000'000'000'001);
        gap.lastStamp = log::stampOf(1'700'000'003'500'000'000);
        gap.firstPacket = 10;
        gap.lastPacket = 12;
        gap.count = 2;
        gap.samples = 3;
        gap.cause = model::LossCause::Network;
        gap.detail = {words::Kind::Text, {{"text", std::string("Other streams \"brought\" it, \xff")}}};
        down.kind = model::IncidentKind::Outage;
        down.value = 2;
        down.lastStamp = log::Stamp(std::chrono::seconds(2));
        down.isCurrent = false;
    }

    log::PacketLog log{{.memoryCap = std::size_t{1} << 22, .chunkSize = std::size_t{1} << 20}};
    model::Session session{log};
    model::Incident gap;
    model::Incident down;
};

TEST_F(EventSheetTest, WritesATableWithQuotesWhereTheyAreNeeded) {
    const std::vector<const model::Incident*> events{&gap, &down};
    const std::string csv = eventsCsv({session, events});
    EXPECT_THAT(csv, StartsWith("number,severity,group,event,source,characters,types,from,to,"));
    EXPECT_THAT(csv, HasSubstr("\r\n7,warning,loss,loss,a retired sender,1 3,02 "
                               "21,1700000000.000000001,1700000003.500000000,10,12,"
                               "2,3,network,yes,\"3 samples lost in 2 gaps, cause: network. "
                               "Other streams \"\"brought\"\" it, "));
    EXPECT_THAT(csv, HasSubstr("\r\n0,error,source,outage,a retired sender,,,0.000000000,"));
    EXPECT_THAT(csv, EndsWith("No data for 2.00 s.\r\n"));
}

TEST_F(EventSheetTest, WritesStampsOfAnyYear) {
    gap.firstStamp = log::Stamp::min();
    gap.lastStamp = log::stampOf(-1'500'000'000);
    down.firstStamp = log::stampOf(1);
    down.lastStamp = log::Stamp::max();
    const std::vector<const model::Incident*> events{&gap, &down};
    const std::string csv = eventsCsv({session, events});
    EXPECT_THAT(csv, HasSubstr(",-9223372036.854775808,-1.500000000,"));
    EXPECT_THAT(csv, HasSubstr(",0.000000001,9223372036.854775807,"));
}

TEST_F(EventSheetTest, WritesObjectsThatCanBeRead) {
    const std::vector<const model::Incident*> events{&gap, &down};
    const auto json = nlohmann::json::parse(eventsJson({session, events}));
    ASSERT_EQ(json.size(), 2U);
    EXPECT_EQ(json[0]["event"], "loss");
    EXPECT_EQ(json[0]["types"], nlohmann::json::parse(R"(["02","21"])"));
    EXPECT_EQ(json[0]["cause"], "network");
    EXPECT_EQ(json[0]["fromNs"], 1'700'000'000'000'000'001);
    EXPECT_EQ(json[0]["samples"], 3);
    EXPECT_EQ(json[0]["current"], true);
    EXPECT_EQ(json[1]["characters"].size(), 0U);
    EXPECT_FALSE(json[1].contains("cause"));
    EXPECT_EQ(json[1]["current"], false);
}

TEST_F(EventSheetTest, WritesNothingButTitlesWithoutEvents) {
    EXPECT_EQ(nlohmann::json::parse(eventsJson({session, {}})).size(), 0U);
    EXPECT_THAT(eventsCsv({session, {}}), EndsWith("current,text\r\n"));
}

} // namespace
} // namespace posewire::exporting
