// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/connection_help.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace posewire::net {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Kind = Finding::Kind;

std::vector<std::byte> bytesOf(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

InputStatus input(InputKind kind, std::uint16_t port = 9763) {
    InputStatus status;
    status.kind = kind;
    status.endpoint.port = port;
    return status;
}

std::vector<Kind> kindsOf(const ConnectionFacts& facts) {
    std::vector<Kind> kinds;
    for (const Finding& finding : connectionHelp(facts)) {
        EXPECT_FALSE(finding.text.empty());
        EXPECT_FALSE(finding.remedy.empty()) << finding.text;
        kinds.push_back(finding.kind);
    }
    return kinds;
}

class ConnectionHelpTest : public ::testing::Test {
protected:
    ConnectionHelpTest() {
        facts.inputs = {input(InputKind::Udp), input(InputKind::TcpListener)};
        facts.addresses = {{"192.168.1.20", "eth0", true, false, false}};
        facts.now = log::Stamp(100s);
        facts.silence = 5s;
    }
    ConnectionFacts facts;
};

TEST_F(ConnectionHelpTest, SaysNothingWhereAllIsWell) {
    facts.silence = 100ms;
    facts.mxtpDatagrams = 100;
    facts.firewall = Firewall{"ufw", "sudo ufw allow PORT/udp"};
    EXPECT_TRUE(connectionHelp(facts).empty());
}

TEST_F(ConnectionHelpTest, TellsThatOnlyOthersThanThoseListenedToSend) {
    facts.inputs[0].refusedDatagrams = 34;
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NotListenedTo));
    EXPECT_THAT(connectionHelp(facts)[0].text,
                HasSubstr("34 datagrams have arrived from hosts that are not"));
    facts.silence = 100ms;
    facts.mxtpDatagrams = 100;
    EXPECT_TRUE(connectionHelp(facts).empty()) << "that is what the list is for";
}

TEST_F(ConnectionHelpTest, TellsWhereAGroupCouldNotBeJoined) {
    facts.silence = 100ms;
    facts.inputs[0].problem = "239.1.1.1 could not be joined on eth1: No buffer space available";
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NotJoined));
    EXPECT_EQ(connectionHelp(facts)[0].text, facts.inputs[0].problem);
}

TEST_F(ConnectionHelpTest, TellsThatTheAddressThatIsListenedOnHasGone) {
    facts.silence = 100ms;
    facts.inputs[0].endpoint.host = "10.9.0.1";
    facts.inputs[0].problem =
        "no interface that is up has the address 10.9.0.1 any more; connect its network";
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::AddressGone));
    EXPECT_EQ(connectionHelp(facts)[0].text, "no interface that is up has the address 10.9.0.1 any more");
    EXPECT_EQ(connectionHelp(facts)[0].remedy, "connect its network");
    facts.inputs[0].endpoint.host = "239.1.1.1";
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NotJoined));
}

TEST_F(ConnectionHelpTest, NothingArrivesTellsWhatToTypeIntoMvn) {
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives));
    const Finding finding = connectionHelp(facts)[0];
    EXPECT_THAT(finding.text, HasSubstr("UDP port 9763"));
    EXPECT_THAT(finding.remedy, HasSubstr("Network Streamer"));
    EXPECT_THAT(finding.remedy, HasSubstr("host 192.168.1.20 (eth0), port 9763, protocol UDP"));
}

TEST_F(ConnectionHelpTest, WaitsBeforeItComplains) {
    facts.silence = 1s;
    EXPECT_TRUE(connectionHelp(facts).empty());
}

TEST_F(ConnectionHelpTest, OneTransportAloneMayBeTheWrongOne) {
    facts.inputs = {input(InputKind::Udp)};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::OtherTransport));
    EXPECT_THAT(connectionHelp(facts)[1].text, HasSubstr("uses TCP would go unnoticed"));
    facts.inputs = {input(InputKind::TcpListener)};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::OtherTransport));
    EXPECT_THAT(connectionHelp(facts)[0].remedy, HasSubstr("protocol TCP"));
}

TEST_F(ConnectionHelpTest, AFirewallIsNamedOnlyWhileNothingHasCome) {
    facts.firewall = Firewall{"ufw", "sudo ufw allow PORT/udp"};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::FirewallOn));
    EXPECT_EQ(connectionHelp(facts)[1].remedy, "sudo ufw allow 9763/udp");
    facts.inputs = {input(InputKind::TcpListener, 9764)};
    EXPECT_EQ(connectionHelp(facts).back().remedy, "sudo ufw allow 9764/tcp");
    facts.mxtpDatagrams = 1;
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::WentSilent));
}

TEST_F(ConnectionHelpTest, ForeignDatagramsAreShownAndGuessedAt) {
    facts.silence = 0s;
    facts.foreign = {{"10.0.0.9:4000", 17, bytesOf(std::string_view("/body/hip\0\0\0,fff", 16))}};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NotMxtp));
    const Finding finding = connectionHelp(facts)[0];
    EXPECT_THAT(finding.text, HasSubstr("17 datagrams from 10.0.0.9:4000"));
    EXPECT_THAT(finding.text, HasSubstr("2f 62 6f 64"));
    EXPECT_THAT(finding.text, HasSubstr("looks like OSC"));
    facts.foreign[0].count = 1'234'567;
    EXPECT_THAT(connectionHelp(facts)[0].text, HasSubstr("1\u202f234\u202f567 datagrams from"));
    facts.foreign[0].count = 1;
    EXPECT_THAT(connectionHelp(facts)[0].text, HasSubstr("1 datagram from 10.0.0.9:4000 is not MXTP; it"));
    facts.foreign[0].firstBytes = bytesOf("\x91\x92\x93\x94");
    EXPECT_EQ(connectionHelp(facts)[0].text.find("looks like"), std::string::npos);
}

TEST_F(ConnectionHelpTest, ForeignSendersOfOneHostAreOneFinding) {
    facts.silence = 0s;
    const auto osc = bytesOf(std::string_view("/body/hip\0\0\0,fff", 16));
    facts.foreign = {{"10.0.0.9:4000", 17, osc},
                     {"10.0.0.9:4001", 3, osc},
                     {"10.0.0.9:4002", 1, osc},
                     {"10.0.0.10:4000", 2, osc},
                     {"10.0.0.9:5000", 4, bytesOf("\x91\x92\x93\x94")}};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NotMxtp, Kind::NotMxtp, Kind::NotMxtp));
    const auto findings = connectionHelp(facts);
    EXPECT_THAT(findings[0].text, HasSubstr("21 datagrams from 10.0.0.9 (3 ports) are not MXTP"));
    EXPECT_THAT(findings[1].text, HasSubstr("2 datagrams from 10.0.0.10:4000"));
    EXPECT_THAT(findings[2].text, HasSubstr("4 datagrams from 10.0.0.9:5000"));
}

TEST_F(ConnectionHelpTest, APortInUseKeepsItsWordsAndItsAdvice) {
    facts.inputs.clear();
    facts.failed = {{InputKind::Udp,
                     {"", 9763},
                     {NetError::Kind::PortInUse, "UDP port 9763 is in use by mvn (process 42); close that "
                                                 "program or choose another port"}}};
    const Finding expected{Kind::CannotOpen, "UDP port 9763 is in use by mvn (process 42)",
                           "close that program or choose another port"};
    EXPECT_THAT(connectionHelp(facts), ElementsAre(expected));
    facts.failed.clear();
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NoInput));
}

TEST_F(ConnectionHelpTest, TcpPeersThatSayNothingOrNonsenseAreTold) {
    facts.mxtpDatagrams = 1;
    facts.silence = 0s;
    facts.inputs[1].peers = {{"10.0.0.7:50000", log::Stamp(90s), 0, 0, 0},
                             {"10.0.0.8:50000", log::Stamp(90s), 0, 500, 500},
                             {"10.0.0.9:50000", log::Stamp(90s), 5, 500, 0},
                             {"10.0.0.10:50000", log::Stamp(99s), 0, 0, 0}};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::SilentPeer, Kind::GarbledPeer));
    EXPECT_THAT(connectionHelp(facts)[0].text, HasSubstr("10.0.0.7:50000 is connected by TCP and has sent "
                                                         "nothing for 10 s"));
    EXPECT_THAT(connectionHelp(facts)[1].text, HasSubstr("none of its 500 bytes"));
}

TEST_F(ConnectionHelpTest, ASenderThatCannotBeReachedIsTold) {
    facts.inputs = {input(InputKind::TcpConnection)};
    facts.inputs[0].state = InputState::Retrying;
    facts.inputs[0].text = "studio:9763 cannot be reached: Connection refused; trying again in 1 s";
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NotReachable));
    EXPECT_THAT(connectionHelp(facts)[0].remedy, HasSubstr("MVN itself does not listen"));
}

TEST(ForeignProtocol, KnowsWhatUsuallyComesToThesePorts) {
    const auto guess = [](std::string_view text) { return protocolThatBegins(bytesOf(text)); };
    using namespace std::string_view_literals;
    EXPECT_EQ(guess("#bundle\0"sv), "OSC");
    EXPECT_THAT(guess("\x07\x00\x40\x02\x01\x00\x00\x00"sv), HasSubstr("NatNet"));
    EXPECT_THAT(guess("\x10\x00\x00\x00\x02\x00\x48\x00Subject"sv), HasSubstr("Vicon"));
    EXPECT_THAT(guess("\x00\x00\x00\x40\x00\x00\x00\x03"sv), HasSubstr("Qualisys"));
    EXPECT_THAT(guess("{\"type\":1}"), HasSubstr("JSON"));
    EXPECT_THAT(guess("GET / HTTP/1.1"), HasSubstr("HTTP"));
    EXPECT_THAT(guess("\x00\x00\x02\xf8MXTP02"sv), HasSubstr("MXTP behind 4 other bytes"));
    EXPECT_EQ(guess("\xff\xfe\xfd"), "");
    EXPECT_EQ(guess(""), "");
}

TEST(Reachable, PutsTheBestFirstAndLeavesLoopbackOutUnlessAlone) {
    const LocalAddress loop{"127.0.0.1", "lo", true, true, false};
    const LocalAddress ipv6{"2001:db8::1", "eth0", false, false, false};
    const LocalAddress linkLocal{"fe80::1%eth0", "eth0", false, false, true};
    const LocalAddress ipv4{"192.168.1.20", "eth0", true, false, false};
    EXPECT_THAT(reachable({loop, linkLocal, ipv6, ipv4}), ElementsAre(ipv4, ipv6, linkLocal));
    EXPECT_THAT(reachable({loop}), ElementsAre(loop));
    EXPECT_TRUE(reachable({}).empty());
}

TEST(LocalAddresses, KnowTheLoopback) {
    const auto addresses = localAddresses();
    EXPECT_TRUE(std::ranges::any_of(addresses, [](const LocalAddress& a) { return a.isLoopback; }));
}

class FirewallTest : public ::testing::Test {
protected:
    ~FirewallTest() override { std::filesystem::remove_all(root); }
    void write(const std::string& path, const std::string& text) const {
        std::filesystem::create_directories((root / path).parent_path());
        std::ofstream(root / path) << text;
    }
    std::filesystem::path root = posewire::test::newTemporaryFolder("firewall");
};

TEST_F(FirewallTest, IsSeenOnlyWhereItIsSwitchedOn) {
    EXPECT_FALSE(findFirewall(root.string()));
    write("etc/ufw/ufw.conf", "# settings\nENABLED=no\n");
    EXPECT_FALSE(findFirewall(root.string()));
    write("proc/net/ip_tables_names", "nat\nfilter\n");
    EXPECT_EQ(findFirewall(root.string())->name, "iptables");
    write("etc/systemd/system/sysinit.target.wants/nftables.service", "");
    EXPECT_EQ(findFirewall(root.string())->name, "nftables");
    write("run/firewalld.pid", "7");
    EXPECT_EQ(findFirewall(root.string())->name, "firewalld");
    write("etc/ufw/ufw.conf", "# settings\nENABLED=yes\n");
    EXPECT_EQ(findFirewall(root.string())->name, "ufw");
}

} // namespace
} // namespace posewire::net
