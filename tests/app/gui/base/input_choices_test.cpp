// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/options.h"

#include <QJsonDocument>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

using Kind = InputAddress::Kind;

TEST(InputChoices, AreReadBackAsTheyWereWritten) {
    InputChoices choices;
    EXPECT_EQ(inputChoicesOf(jsonOf(choices)), choices) << "nobody has chosen";
    choices.inputs.emplace();
    EXPECT_EQ(inputChoicesOf(jsonOf(choices)), choices) << "nothing is listened to";
    choices.inputs = {{"", 9763, Kind::Udp, {"239.1.2.3"}},
                      {"::1", 9764, Kind::TcpListener},
                      {"studio", 9765, Kind::TcpConnection}};
    choices.waysOut = {{"10.0.0.9", 9763, true}, {"later", 9000, false}};
    choices.allowed = QStringList{"192.168.1.0/24", "studio"};
    EXPECT_EQ(inputChoicesOf(jsonOf(choices)), choices);
}

TEST(InputChoices, LeaveOutWhatMakesNoSense) {
    const QByteArray text = R"({"inputs": [{"protocol": "udp", "port": 0}, {"protocol": "osc", "port": 5}, 7,
        {"protocol": "tcp", "host": "", "port": 5}, {"protocol": "udp", "port": 5}],
        "from": ["10.0.0.0/99", 7, "10.0.0.5"],
        "relays": [{"host": "", "port": 5}, {"host": "a", "port": 70000}, {"host": "b", "port": 5}]})";
    const InputChoices choices = inputChoicesOf(QJsonDocument::fromJson(text).object());
    ASSERT_TRUE(choices.inputs);
    EXPECT_EQ(*choices.inputs, std::vector<InputAddress>({{"", 5}}));
    EXPECT_EQ(choices.waysOut, std::vector<WayOut>({{"b", 5}}));
    EXPECT_EQ(choices.allowed, QStringList("10.0.0.5"));
}

TEST(InputChoices, AListOfHostsThatCannotBeReadIsNotEverybody) {
    const auto allowedOf = [](const QByteArray& text) {
        return inputChoicesOf(QJsonDocument::fromJson(text).object()).allowed;
    };
    EXPECT_EQ(allowedOf(R"({"from": ["10.0.0.0/99"]})"), QStringList("10.0.0.0/99"));
    EXPECT_EQ(allowedOf(R"({"from": []})"), QStringList());
}

TEST(InputChoices, HostsToListenToAreReadInAnyForm) {
    EXPECT_EQ(parseAllowed("10.0.0.0/8; studio,\n fd00::/8 "),
              QStringList({"10.0.0.0/8", "studio", "fd00::/8"}));
    EXPECT_EQ(parseAllowed(" "), QStringList());
    EXPECT_TRUE(parseAllowed("10.0.0.0/8 10.0.0").error().contains("'10.0.0' is not a host or a net"));
    Options options;
    InputChoices choices;
    choices.allowed = QStringList("studio");
    EXPECT_EQ(allowedAtStart(options, choices), choices.allowed);
    options.allowed = QStringList("10.0.0.5");
    EXPECT_EQ(allowedAtStart(options, choices), options.allowed);
}

TEST(InputChoices, AreOpenedUnlessTheCommandLineSaysOtherwise) {
    const std::vector<InputAddress> kept{{"", 9000, Kind::TcpListener}};
    const std::vector<InputAddress> usual{InputAddress{}};
    InputChoices choices;
    EXPECT_EQ(inputsToOpen({}, choices), usual);
    choices.inputs = kept;
    EXPECT_EQ(inputsToOpen({}, choices), kept);
    Options options;
    options.udpPorts = {{"", 9800}};
    EXPECT_EQ(inputsToOpen(options, choices), options.udpPorts);
    options = {};
    options.tcpInputs = {{"studio", 1, Kind::TcpConnection}};
    EXPECT_EQ(inputsToOpen(options, choices), options.tcpInputs);
    Options probes;
    probes.stage.servers.addresses = {"nats://stage"};
    EXPECT_TRUE(inputsToOpen(probes, choices).empty()) << "probes are asked for";
    options = {};
    options.file = "take.pcapng";
    EXPECT_TRUE(inputsToOpen(options, choices).empty()) << "a file is looked at by itself";
    options.demoCharacters = 1;
    EXPECT_EQ(inputsToOpen(options, choices), usual);
}

} // namespace
} // namespace posewire::gui
