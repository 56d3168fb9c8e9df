// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

auto parse(QStringList arguments) {
    arguments.prepend(QStringLiteral("posewire"));
    return parseOptions(arguments, [] { return std::string("\nOther 1"); });
}

TEST(Options, WithoutArgumentsAskForNothing) {
    const auto options = parse({});
    ASSERT_TRUE(options);
    EXPECT_TRUE(options->udpPorts.empty());
    EXPECT_EQ(options->demoCharacters, 0);
    EXPECT_FALSE(options->theme);
    EXPECT_TRUE(options->file.isEmpty());
}

TEST(Options, TakeSeveralPortsWithAndWithoutAddress) {
    const auto options = parse({"--udp", "9763", "--udp", "127.0.0.1:9764", "--udp=[::1]:9765"});
    ASSERT_TRUE(options);
    EXPECT_THAT(options->udpPorts,
                testing::ElementsAre(InputAddress{"", 9763}, InputAddress{"127.0.0.1", 9764},
                                     InputAddress{"::1", 9765}));
}

TEST(Options, TakeTcpInputsAndMulticastGroups) {
    using Kind = InputAddress::Kind;
    const auto options = parse({"--tcp", "studio:9764", "--tcp-listen", "9763", "--tcp-listen=[::1]:9765",
                                "--multicast", "239.1.2.3", "--multicast", "ff15::7"});
    ASSERT_TRUE(options);
    EXPECT_THAT(options->tcpInputs, testing::ElementsAre(InputAddress{"", 9763, Kind::TcpListener},
                                                         InputAddress{"::1", 9765, Kind::TcpListener},
                                                         InputAddress{"studio", 9764, Kind::TcpConnection}));
    ASSERT_EQ(options->udpPorts.size(), 1U) << "a group without a port is heard at the usual one";
    EXPECT_EQ(options->udpPorts[0].port, kDefaultPort);
    EXPECT_EQ(options->udpPorts[0].groups, (QStringList{"239.1.2.3", "ff15::7"}));
}

TEST(Options, TakeHostsAndNetsToListenTo) {
    const auto options = parse({"--sender", "192.168.1.0/24", "--sender", "studio"});
    ASSERT_TRUE(options);
    EXPECT_EQ(options->allowed, QStringList({"192.168.1.0/24", "studio"}));
    EXPECT_EQ(parse({"--from", "192.168.1.0/24", "--from", "studio"})->allowed, options->allowed)
        << "the old spelling";
}

TEST(Options, InputsAreShownWithTheirTransport) {
    using Kind = InputAddress::Kind;
    EXPECT_EQ(displayText(InputAddress{"", 9763}), "UDP 9763");
    EXPECT_EQ(displayText(InputAddress{"::1", 9763}), "UDP [::1]:9763");
    EXPECT_EQ(displayText({"", 9763, Kind::TcpListener}), "TCP 9763");
    EXPECT_EQ(displayText({"studio", 9764, Kind::TcpConnection}), "TCP to studio:9764");
}

TEST(Options, TakeAPlaceForMetrics) {
    EXPECT_TRUE(parse({})->metrics.isEmpty());
    EXPECT_EQ(parse({"--metrics", "127.0.0.1:9464"})->metrics, "127.0.0.1:9464");
}

TEST(Options, SeekIsATimeInAFile) {
    EXPECT_FALSE(parse({"take.pcapng"})->seekSeconds);
    EXPECT_EQ(parse({"take.pcapng", "--seek", "2.5"})->seekSeconds, 2.5);
    EXPECT_FALSE(parse({"take.pcapng", "--seek", "soon"}));
    EXPECT_FALSE(parse({"--seek", "2.5"})) << "without a file there is nothing to seek in";
}

TEST(Options, DemoHasTwoCharactersUnlessTold) {
    EXPECT_EQ(parse({"--demo"})->demoCharacters, 2);
    EXPECT_EQ(parse({"--demo=5"})->demoCharacters, 5);
    EXPECT_EQ(parse({"--demo", "5", "--udp", "9000"})->demoCharacters, 5);
    // What else follows "--demo" is a file.
    const auto options = parse({"--demo", "take.bin"});
    ASSERT_TRUE(options);
    EXPECT_EQ(options->file, "take.bin");
}

TEST(Options, ReadEverythingElse) {
    const auto options =
        parse({"take.bin",  "--layout", "check",        "--reset-layout",  "--settings", "s.json",
               "--theme",   "light",    "--screenshot", "p.png",           "--force",    "--after",
               "1.5",       "--size",   "1600x1000",    "--language",      "en",         "--startup-time",
               "--verbose", "--mode",   "0600",         "--forget-history"});
    ASSERT_TRUE(options);
    EXPECT_TRUE(options->forgetsHistory);
    EXPECT_FALSE(parse({"--mode", "world"}));
    EXPECT_EQ(options->file, "take.bin");
    EXPECT_EQ(options->layout, "check");
    EXPECT_TRUE(options->resetsLayout);
    EXPECT_EQ(options->settingsFile, "s.json");
    EXPECT_EQ(options->theme, ThemeChoice::Light);
    EXPECT_EQ(options->language, "en");
    EXPECT_EQ(options->screenshotFile, "p.png");
    EXPECT_TRUE(options->replaces);
    EXPECT_DOUBLE_EQ(options->screenshotAfterSeconds, 1.5);
    EXPECT_EQ(options->size, QSize(1600, 1000));
    EXPECT_TRUE(options->printsStartupTime);
    EXPECT_TRUE(options->isVerbose);
}

class WrongOption : public testing::TestWithParam<QStringList> {};

TEST_P(WrongOption, EndsWithStatusTwoAndSaysWhich) {
    const auto options = parse(GetParam());
    ASSERT_FALSE(options);
    EXPECT_EQ(options.error().status, 2);
    EXPECT_TRUE(options.error().text.starts_with("posewire: ")) << options.error().text;
}

INSTANTIATE_TEST_SUITE_P(All, WrongOption,
                         testing::Values(QStringList{"--nonsense"}, QStringList{"--udp", "0"},
                                         QStringList{"--udp", "65536"}, QStringList{"--udp", "host:"},
                                         QStringList{"--udp"}, QStringList{"--demo=0"},
                                         QStringList{"--demo=x"}, QStringList{"--size", "12"},
                                         QStringList{"--size", "0x5"}, QStringList{"--after", "soon"},
                                         QStringList{"--theme", "pink"}, QStringList{"--language", "tlh"},
                                         QStringList{"--layout", ""}, QStringList{"--sender", "10.0.0.0/33"},
                                         QStringList{"a.bin", "b.bin"}));

TEST(Options, TheLastOneCountsOfWhatIsGivenTwice) {
    EXPECT_EQ(parse({"--theme", "dark", "--theme", "light"})->theme, ThemeChoice::Light);
    EXPECT_EQ(parse({"--size", "10x10", "--size", "20x20"})->size, QSize(20, 20));
}

TEST(Options, HelpAndVersionEndWithStatusZero) {
    EXPECT_EQ(parse({"--help"}).error().status, 0);
    EXPECT_THAT(parse({"--help"}).error().text, testing::HasSubstr("--screenshot"));
    const usage::EarlyExit version = parse({"--version"}).error();
    EXPECT_EQ(version.status, 0);
    EXPECT_THAT(version.text, testing::StartsWith("posewire ")) << "scripts read the first line";
    EXPECT_THAT(version.text, testing::HasSubstr(std::string("\nQt ") + qVersion() + "\nOther 1\n"));
    EXPECT_THAT(parse({"--help"}).error().text, testing::Not(testing::HasSubstr("Other")));
}

} // namespace
} // namespace posewire::gui
