// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/connection_help.h"
#include "app/net/kernel_counters.h"
#include "tests/support/facts.h"
#include "tests/support/temporary_folder.h"

#include "core/log/packet_log.h"
#include "core/model/session/session.h"

#include <QTcpServer>
#include <QTcpSocket>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace posewire::net {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using words::Fact;
using words::Form;
using words::numberIn;
using words::partOf;
using Kind = words::Kind;

InputStatus input(InputKind kind, std::uint16_t port = 9763) {
    InputStatus status;
    status.kind = kind;
    status.endpoint.port = port;
    return status;
}

std::vector<Kind> kindsOf(const ConnectionFacts& facts) {
    std::vector<Kind> kinds;
    for (const Fact& finding : connectionHelp(facts)) {
        EXPECT_NE(say(finding, Form::Sentence), "");
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
    facts.datagrams = 100;
    facts.firewall = Firewall{"ufw", "sudo ufw allow PORT/udp"};
    EXPECT_TRUE(connectionHelp(facts).empty());
}

TEST_F(ConnectionHelpTest, TellsThatOnlyOthersThanThoseListenedToSend) {
    facts.inputs[0].refusedDatagrams = 34;
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NotListenedTo));
    EXPECT_EQ(numberIn(connectionHelp(facts)[0], "n"), 34);
    facts.silence = 100ms;
    facts.datagrams = 100;
    EXPECT_TRUE(connectionHelp(facts).empty()) << "that is what the list is for";
}

TEST_F(ConnectionHelpTest, TellsWhereAGroupCouldNotBeJoined) {
    facts.silence = 100ms;
    facts.inputs[0].problem = "239.1.1.1 could not be joined on eth1: No buffer space available";
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NotJoined));
    EXPECT_EQ(namesIn(connectionHelp(facts)[0], "problem"), std::vector{facts.inputs[0].problem});
}

TEST_F(ConnectionHelpTest, TellsThatTheAddressThatIsListenedOnHasGone) {
    facts.silence = 100ms;
    facts.inputs[0].endpoint.host = "10.9.0.1";
    facts.inputs[0].problem =
        "no interface that is up has the address 10.9.0.1 any more; connect its network";
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::AddressGone));
    EXPECT_EQ(namesIn(connectionHelp(facts)[0], "problem"), std::vector{facts.inputs[0].problem});
    facts.inputs[0].endpoint.host = "239.1.1.1";
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NotJoined));
}

TEST_F(ConnectionHelpTest, NothingArrivesTellsWhatToTypeIntoMvn) {
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives));
    const Fact finding = connectionHelp(facts)[0];
    EXPECT_THAT(say(finding, Form::Sentence), HasSubstr("UDP port 9763"));
    EXPECT_THAT(say(finding, Form::Advice), HasSubstr("Network Streamer"));
    EXPECT_EQ(say(partOf(finding, "host"), Form::Headline), "192.168.1.20 (eth0)");
    facts.addresses.push_back({"10.0.0.4", "wlan0", true, false, false});
    EXPECT_THAT(say(connectionHelp(facts)[0], Form::Advice),
                HasSubstr("host 192.168.1.20 (eth0) or 10.0.0.4 (wlan0), port 9763, protocol UDP"));
}

TEST_F(ConnectionHelpTest, WaitsBeforeItComplains) {
    facts.silence = 1s;
    EXPECT_TRUE(connectionHelp(facts).empty());
}

TEST_F(ConnectionHelpTest, OneTransportAloneMayBeTheWrongOne) {
    facts.inputs = {input(InputKind::Udp)};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::OtherTransport));
    EXPECT_EQ(namesIn(connectionHelp(facts)[1], "other"), std::vector<std::string>{"TCP"});
    facts.inputs = {input(InputKind::TcpListener)};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::OtherTransport));
    EXPECT_EQ(namesIn(connectionHelp(facts)[0], "protocol"), std::vector<std::string>{"TCP"});
}

TEST_F(ConnectionHelpTest, AFirewallIsNamedOnlyWhileNothingHasCome) {
    facts.firewall = Firewall{"ufw", "sudo ufw allow PORT/udp"};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::FirewallOn));
    EXPECT_EQ(say(connectionHelp(facts)[1], Form::Advice), "To let them in: sudo ufw allow 9763/udp");
    facts.inputs = {input(InputKind::TcpListener, 9764)};
    EXPECT_EQ(namesIn(connectionHelp(facts).back(), "command"),
              std::vector<std::string>{"sudo ufw allow 9764/tcp"});
    facts.firewall = Firewall{"nftables", ""};
    EXPECT_EQ(say(connectionHelp(facts).back(), Form::Advice),
              "Ask the administrator to accept TCP port 9764.");
    facts.datagrams = 1;
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::WentSilent));
}

Fact foreignFrom(const std::string& address, std::uint64_t count, Kind looks = Kind::Nothing) {
    return {Kind::ForeignDatagrams,
            {{"n", count}, {"address", address}, {"value", std::string("2f  /")}, {"looks", Fact{looks}}}};
}

TEST_F(ConnectionHelpTest, ForeignDatagramsAreTold) {
    facts.silence = 0s;
    facts.foreign = {foreignFrom("10.0.0.9:4000", 17, Kind::LooksLikeXtlp)};
    EXPECT_EQ(connectionHelp(facts), facts.foreign);
    EXPECT_EQ(say(connectionHelp(facts)[0], Form::Advice), say(Fact{Kind::LooksLikeXtlp}, Form::Advice));
    facts.foreign = {foreignFrom("10.0.0.9:4000", 1)};
    EXPECT_THAT(say(connectionHelp(facts)[0], Form::Sentence),
                HasSubstr("1 datagram from 10.0.0.9:4000 is not MXTP; it"));
    EXPECT_THAT(say(connectionHelp(facts)[0], Form::Advice), HasSubstr("Another program sends"));
}

TEST_F(ConnectionHelpTest, ForeignSendersOfOneHostAreOneFinding) {
    facts.silence = 0s;
    facts.foreign = {foreignFrom("10.0.0.9:4000", 17, Kind::LooksLikeOsc),
                     foreignFrom("10.0.0.9:4001", 3, Kind::LooksLikeOsc),
                     foreignFrom("10.0.0.9:4002", 1, Kind::LooksLikeOsc),
                     foreignFrom("10.0.0.10:4000", 2, Kind::LooksLikeOsc), foreignFrom("10.0.0.9:5000", 4)};
    ASSERT_THAT(kindsOf(facts), Each(Kind::ForeignDatagrams));
    const auto findings = connectionHelp(facts);
    ASSERT_EQ(findings.size(), 3U);
    EXPECT_THAT(say(findings[0], Form::Sentence),
                HasSubstr("21 datagrams from 10.0.0.9 (3 ports) are not MXTP"));
    EXPECT_EQ(numberIn(findings[1], "n"), 2);
    EXPECT_EQ(numberIn(findings[1], "ports"), std::nullopt);
    EXPECT_EQ(numberIn(findings[2], "n"), 4);
}

TEST_F(ConnectionHelpTest, APortInUseKeepsItsWordsAndItsAdvice) {
    facts.inputs.clear();
    facts.failed = {{InputKind::Udp,
                     {"", 9763},
                     {NetError::Kind::PortInUse, "UDP port 9763 is in use by mvn (process 42); close that "
                                                 "program or choose another port"}}};
    const Fact expected{Kind::CannotOpen, {{"problem", facts.failed[0].error.text}}};
    EXPECT_THAT(connectionHelp(facts), ElementsAre(expected));
    facts.failed.clear();
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NoInput));
}

TEST_F(ConnectionHelpTest, TcpPeersThatSayNothingOrNonsenseAreTold) {
    facts.datagrams = 1;
    facts.silence = 0s;
    facts.inputs[1].peers = {{"10.0.0.7:50000", log::Stamp(90s), 0, 0, 0},
                             {"10.0.0.8:50000", log::Stamp(90s), 0, 500, 500},
                             {"10.0.0.9:50000", log::Stamp(90s), 5, 500, 0},
                             {"10.0.0.10:50000", log::Stamp(99s), 0, 0, 0}};
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::SilentPeer, Kind::GarbledPeer));
    EXPECT_EQ(numberIn(connectionHelp(facts)[0], "lasted"), 10);
    EXPECT_EQ(numberIn(connectionHelp(facts)[1], "n"), 500);
}

TEST_F(ConnectionHelpTest, ASenderThatCannotBeReachedIsTold) {
    facts.inputs = {input(InputKind::TcpConnection)};
    facts.inputs[0].state = InputState::Retrying;
    facts.inputs[0].text = "studio:9763 cannot be reached: Connection refused; trying again in 1 s";
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NotReachable));
    EXPECT_THAT(say(connectionHelp(facts)[0], Form::Advice), HasSubstr("MVN itself does not listen"));
}

TEST_F(ConnectionHelpTest, NamesOnlyAddressesAtWhichItListens) {
    facts.addresses = {{"10.43.0.2", "vb", true, false, false},
                       {"10.43.1.2", "vd", true, false, false},
                       {"fe80::1%vb", "vb", false, false, true}};
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives));
    EXPECT_EQ(namesIn(connectionHelp(facts)[0], "host"),
              std::vector<std::string>{"10.43.0.2 (vb) or 10.43.1.2 (vd)"});
    facts.inputs = {input(InputKind::Udp)};
    facts.inputs[0].endpoint.host = "10.43.1.2";
    ASSERT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::ListensOnly, Kind::OtherTransport));
    const Fact only = connectionHelp(facts)[1];
    EXPECT_EQ(namesIn(connectionHelp(facts)[0], "host"), std::vector<std::string>{"10.43.1.2 (vd)"});
    EXPECT_EQ(namesIn(only, "host"), std::vector<std::string>{"10.43.1.2 (vd)"});
    EXPECT_EQ(namesIn(only, "others"), std::vector<std::string>{"10.43.0.2 (vb)"});
    facts.inputs.push_back(input(InputKind::Udp));
    facts.inputs[1].endpoint.host = "10.43.0.2";
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::OtherTransport));
}

TEST_F(ConnectionHelpTest, TellsOfWhatGoesElsewhere) {
    facts.inputs = {input(InputKind::Udp)};
    facts.kernel = {.noPort = 9, .refusedTcp = 2};
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::OtherTransport));
    facts.kernel = {.noPort = 300, .refusedTcp = 3};
    EXPECT_THAT(kindsOf(facts),
                ElementsAre(Kind::NothingArrives, Kind::NoListener, Kind::TcpRefused, Kind::OtherTransport));
    EXPECT_EQ(numberIn(connectionHelp(facts)[1], "n"), 300);
    facts.silence = 1'000s; // as much as any network has
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives, Kind::TcpRefused, Kind::OtherTransport));
    facts.inputs.push_back(input(InputKind::TcpListener));
    EXPECT_THAT(kindsOf(facts), ElementsAre(Kind::NothingArrives));
}

TEST(ConnectionWatch, NamesWhoConnectsByTcpToAPortOfUdp) {
    QTcpServer any;
    ASSERT_TRUE(any.listen(QHostAddress::LocalHost));
    const std::uint16_t port = any.serverPort();
    any.close();
    const log::PacketLog log;
    model::Session session(log);
    ConnectionWatch watch;
    log::Stamp now(100s);
    const auto look = [&](std::uint64_t refused, InputKind kind = InputKind::Udp) {
        now += 3s;
        std::vector<Kind> kinds;
        for (const Fact& one : watch.look(session, {input(kind, port)}, {}, {.refusedTcp = refused}, now)) {
            kinds.push_back(one.kind);
        }
        return kinds;
    };
    const auto connects = [port] {
        QTcpSocket sender;
        sender.connectToHost(QHostAddress(QHostAddress::LocalHost), port);
        return sender.waitForConnected(1000);
    };
    look(0);
    look(2);
    EXPECT_FALSE(connects()) << "too few were refused to open it";
    EXPECT_THAT(look(5), Contains(Kind::TcpRefused));
    EXPECT_TRUE(connects());
    EXPECT_THAT(look(5), Contains(Kind::TcpKnocked));
    EXPECT_FALSE(connects()) << "one is enough";
    EXPECT_THAT(look(5, InputKind::TcpListener), Not(Contains(Kind::TcpKnocked)));
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

TEST_F(FirewallTest, CountersOfTheKernelAreReadBesideIt) {
    EXPECT_FALSE(readKernelCounters(root.string()));
    write("proc/net/snmp", "Ip: Forwarding ReasmReqds ReasmOKs ReasmFails\nIp: 1 40 5 30\n"
                           "Tcp: MaxConn OutRsts\nTcp: -1 7\nUdp: InDatagrams NoPorts\nUdp: 9 11\n");
    EXPECT_EQ(*readKernelCounters(root.string()), (log::KernelCounters{40, 5, 30, 11, 7}));
    write("proc/net/snmp6", "Ip6ReasmReqds   \t2\nIp6ReasmOKs 1\nUdp6NoPorts  100\n");
    EXPECT_EQ(*readKernelCounters(root.string()), (log::KernelCounters{42, 6, 30, 111, 7}));
}

} // namespace
} // namespace posewire::net
