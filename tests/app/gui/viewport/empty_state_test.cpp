// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/captions.h"

#include "tests/app/gui/models/stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

ReceivingState listening() {
    ReceivingState state;
    state.addresses = {{"192.168.10.5", "eth0", true, false, false}};
    state.ports.push_back({InputAddress{}, {}});
    return state;
}

std::string textOf(const EmptyState& state) {
    return (state.title + "\n" + state.lines.join("\n")).toStdString();
}

TEST(EmptyState, SaysWhatIsWaitedForAndWhatToTypeInMvn) {
    Stage stage;
    const EmptyState state = emptyState(stage.session, listening());
    EXPECT_EQ(state.title, "Waiting for MXTP on UDP 9763");
    EXPECT_THAT(textOf(state), testing::HasSubstr("Options > Preferences > Network Streamer"));
    EXPECT_THAT(textOf(state), testing::HasSubstr("host 192.168.10.5, port 9763"));
}

TEST(EmptyState, SaysThatOthersThanThoseListenedToSend) {
    Stage stage;
    ReceivingState receiving = listening();
    receiving.refusedDatagrams = 1'200;
    EXPECT_EQ(emptyState(stage.session, receiving).level, Health::Warning);
    EXPECT_THAT(textOf(emptyState(stage.session, receiving)),
                testing::HasSubstr("1 200 datagrams came from others than those listened to"));
    receiving = listening();
    receiving.allowedProblem = "fe80::1%nope: there is no interface nope here";
    EXPECT_EQ(emptyState(stage.session, receiving).level, Health::Warning);
    EXPECT_THAT(textOf(emptyState(stage.session, receiving)), testing::HasSubstr("no interface nope here"));
}

TEST(EmptyState, SaysWhyAPortIsNotOpen) {
    Stage stage;
    ReceivingState receiving = listening();
    receiving.ports[0].problem = "UDP port 9763 is in use by mvn (process 12)";
    const EmptyState state = emptyState(stage.session, receiving);
    EXPECT_EQ(state.level, Health::Error);
    EXPECT_THAT(textOf(state), testing::HasSubstr("in use by mvn (process 12)"));
}

TEST(EmptyState, NamesTheProtocolThatIsListenedTo) {
    Stage stage;
    ReceivingState receiving = listening();
    receiving.ports[0].port.kind = InputAddress::Kind::TcpListener;
    EXPECT_THAT(textOf(emptyState(stage.session, receiving)), testing::HasSubstr("protocol TCP"));
}

TEST(EmptyState, SaysWhatIsWrongWithAPeerAndWhereThereIsMore) {
    Stage stage;
    ReceivingState receiving = listening();
    receiving.findings = {
        {words::Kind::SilentPeer, {{"address", std::string("10.0.0.5:1")}, {"lasted", std::uint64_t{7}}}}};
    const EmptyState state = emptyState(stage.session, receiving);
    EXPECT_EQ(state.level, Health::Warning);
    EXPECT_THAT(textOf(state),
                testing::HasSubstr("10.0.0.5:1 is connected by TCP and has sent nothing for 7 s. In MVN:"));
    EXPECT_THAT(textOf(state), testing::HasSubstr("Help > Connection help"));
}

TEST(EmptyState, SaysThatTheAddressThatIsListenedOnHasGone) {
    Stage stage;
    ReceivingState receiving = listening();
    receiving.findings = {
        {words::Kind::AddressGone, {{"problem", std::string("no interface has 10.9.0.1; connect it")}}}};
    const EmptyState state = emptyState(stage.session, receiving);
    EXPECT_EQ(state.level, Health::Warning);
    EXPECT_THAT(textOf(state),
                testing::HasSubstr("receives nothing: no interface has 10.9.0.1; connect it."));
}

TEST(EmptyState, ShowsTheFirstBytesOfForeignDatagrams) {
    Stage stage;
    const std::string text = "GET / HTTP/1.1";
    stage.sendBytes(std::as_bytes(std::span(text)), Stage::kStart);
    stage.follow();
    const EmptyState state = emptyState(stage.session, listening());
    EXPECT_EQ(state.level, Health::Warning);
    EXPECT_THAT(textOf(state), testing::HasSubstr("not MXTP"));
    EXPECT_THAT(textOf(state), testing::HasSubstr("47 45 54 20 2f 20 48 54   \"GET / HT\""));
    EXPECT_THAT(textOf(state), testing::HasSubstr(Stage::kAddress));
}

TEST(EmptyState, SaysThatThePoseIsMissingWhereOtherMessagesArrive) {
    Stage stage;
    stage.sendMetadata("name:Ana\n", Stage::kStart);
    stage.follow();
    const EmptyState state = emptyState(stage.session, listening());
    EXPECT_THAT(textOf(state), testing::HasSubstr("no pose"));
    EXPECT_THAT(textOf(state), testing::HasSubstr("12"));
}

TEST(EmptyState, IsEmptyOnceThereIsAPose) {
    Stage stage;
    performer::Performer performer(sending(1, {2}));
    stage.perform(performer, 0, 2);
    stage.follow();
    EXPECT_TRUE(emptyState(stage.session, listening()).title.isEmpty());
}

} // namespace
} // namespace posewire::gui
