// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/replay.h"
#include "tests/app/net/net_fixture.h"

#include <QTcpServer>
#include <QTcpSocket>

#include <gtest/gtest.h>

namespace posewire::net {
namespace {

using namespace std::chrono_literals;

class ReplayTest : public ::testing::Test {
protected:
    static constexpr std::size_t kPackets = 40;

    void SetUp() override {
        for (std::size_t i = 0; i < kPackets; ++i) {
            append(i, log::Stamp(100s) + static_cast<std::int64_t>(i) * 4ms);
        }
    }
    void append(std::size_t number, log::Stamp stamp, log::PacketFlags flags = {}) {
        log::Arrival arrival;
        arrival.stamp = stamp;
        arrival.sender = log.senders().intern({"10.0.0.5:50000", log::Transport::Udp, 9763});
        arrival.flags = flags;
        log.writer().append(numbered(50 + number, number), arrival);
        log.writer().publish();
    }
    [[nodiscard]] ReplayChoice all() const { return {.target = consumer.target(), .end = kPackets}; }
    [[nodiscard]] std::vector<log::Stamp> received(std::size_t from) const {
        std::vector<log::Stamp> stamps;
        log::LogReader reader(consumer.log);
        for (std::uint64_t number = 0; number < reader.end(); ++number) {
            const auto packet = reader.packet(number);
            EXPECT_TRUE(equal(packet->bytes, numbered(packet->bytes.size(), packet->bytes.size() - 50)));
            EXPECT_EQ(packet->bytes.size(), 50 + from + number % kPackets);
            stamps.push_back(packet->stamp);
        }
        return stamps;
    }

    log::PacketLog log;
    log::SystemClock clock;
    Receiving consumer;
};

TEST_F(ReplayTest, SendsTheSameBytesAsFarApartAsTheyCame) {
    const Replay replay(log, clock, all());
    ASSERT_TRUE(eventually([&] { return consumer.packets() == kPackets; }));
    ASSERT_TRUE(eventually([&] { return replay.figures().isOver; }));
    const std::vector<log::Stamp> stamps = received(0);
    // A late packet is no earlier than its time; on a busy machine it may be later.
    EXPECT_GE(stamps.back() - stamps.front(), 39 * 4ms - 10ms);
    const ReplayFigures figures = replay.figures();
    EXPECT_EQ(figures.sent, kPackets);
    EXPECT_EQ(figures.position, kPackets);
    EXPECT_EQ(figures.rounds, 1U);
    EXPECT_EQ(figures.problem, "");
}

TEST_F(ReplayTest, SpeedAndRangeAreThoseThatWereChosen) {
    ReplayChoice choice = all();
    choice.begin = 10;
    choice.end = 30;
    choice.speed = 0.5;
    const Replay replay(log, clock, choice);
    ASSERT_TRUE(eventually([&] { return replay.figures().isOver && consumer.packets() == 20; }));
    const std::vector<log::Stamp> stamps = received(10);
    EXPECT_GE(stamps.back() - stamps.front(), 19 * 8ms - 10ms);
}

TEST_F(ReplayTest, RoundsFollowEachOtherWithoutAGap) {
    ReplayChoice choice = all();
    choice.speed = 8;
    choice.isLooping = true;
    const Replay replay(log, clock, choice);
    ASSERT_TRUE(eventually([&] { return consumer.packets() >= 4 * kPackets; }));
    EXPECT_FALSE(replay.figures().isOver);
    EXPECT_GE(replay.figures().rounds, 3U);
    const std::vector<log::Stamp> stamps = received(0);
    EXPECT_GE(stamps[4 * kPackets - 1] - stamps.front(), 4 * kPackets * 500us - 10ms);
}

TEST_F(ReplayTest, EndsAtOnceAlsoWhileItWaits) {
    append(kPackets, log::Stamp(10'000s));
    const auto begin = std::chrono::steady_clock::now();
    {
        ReplayChoice choice = all();
        choice.begin = kPackets - 1;
        choice.end = kPackets + 1;
        const Replay replay(log, clock, choice);
        ASSERT_TRUE(eventually([&] { return replay.figures().sent == 1; }));
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
}

TEST_F(ReplayTest, LeavesOutWhatIsNoDatagramAndCountsWhatIsGone) {
    append(kPackets, log::Stamp(101s), {.skipped = true});
    ReplayChoice choice = all();
    choice.begin = kPackets - 2;
    choice.end = kPackets + 5;
    const Replay replay(log, clock, choice);
    ASSERT_TRUE(eventually([&] { return replay.figures().isOver; }));
    EXPECT_EQ(replay.figures().sent, 2U);
    EXPECT_EQ(replay.figures().missing, 4U);
}

TEST_F(ReplayTest, ConnectsAsMvnDoesOverTcp) {
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost));
    ReplayChoice choice = all();
    choice.target = {{"127.0.0.1", server.serverPort()}, SendTarget::Transport::Tcp};
    choice.speed = 16;
    const Replay replay(log, clock, choice);
    ASSERT_TRUE(server.waitForNewConnection(5'000));
    QTcpSocket* socket = server.nextPendingConnection();
    QByteArray bytes;
    std::vector<std::byte> expected;
    for (std::size_t i = 0; i < kPackets; ++i) {
        const auto packet = numbered(50 + i, i);
        expected.insert(expected.end(), packet.begin(), packet.end());
    }
    while (bytes.size() < static_cast<qsizetype>(expected.size()) && socket->waitForReadyRead(5'000)) {
        bytes += socket->readAll();
    }
    EXPECT_TRUE(equal(std::as_bytes(std::span(bytes)), expected));
}

TEST_F(ReplayTest, SaysWhyItCannotConnect) {
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost));
    const std::uint16_t port = server.serverPort();
    server.close();
    ReplayChoice choice = all();
    choice.target = {{"127.0.0.1", port}, SendTarget::Transport::Tcp};
    const Replay replay(log, clock, choice);
    ASSERT_TRUE(eventually([&] { return replay.figures().isOver; }));
    EXPECT_NE(replay.figures().problem.find("127.0.0.1:" + std::to_string(port)), std::string::npos)
        << replay.figures().problem;
    EXPECT_EQ(replay.figures().sent, 0U);
}

} // namespace
} // namespace posewire::net
