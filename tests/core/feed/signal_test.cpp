// SPDX-License-Identifier: MIT
#include "core/feed/signal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace posewire::feed {
namespace {

using namespace std::chrono_literals;
using Values = std::vector<std::optional<double>>;

constexpr std::uint32_t kHz = 100;
constexpr double kDegree = std::numbers::pi / 180;

/// Feeds signals with datagrams that are written here byte by byte, so that numbers are known before the
/// program reads them.
class SignalTest : public testing::Test {
protected:
    struct Sent {
        std::uint8_t type = 2;
        std::uint32_t sample = 0;
        std::vector<std::vector<float>> items{}; ///< without their ids, which count from 1
        std::uint8_t character = 0;
        std::optional<std::uint32_t> timeCode{}; ///< ms; else that of kHz
        std::optional<log::Duration> at{};       ///< likewise
        std::vector<std::uint32_t> ids{};
        std::uint8_t datagram = 0x80;
    };

    static void put(std::vector<std::byte>& bytes, std::uint32_t value, std::size_t size) {
        for (std::size_t i = size; i-- > 0;) {
            bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
        }
    }

    static std::vector<std::byte> bytesOf(const Sent& sent) {
        std::vector<std::byte> payload;
        for (std::size_t i = 0; i < sent.items.size(); ++i) {
            put(payload, i < sent.ids.size() ? sent.ids[i] : static_cast<std::uint32_t>(i + 1), 4);
            for (const float number : sent.items[i]) {
                std::uint32_t word = 0;
                std::memcpy(&word, &number, sizeof word);
                put(payload, word, 4);
            }
        }
        std::vector<std::byte> bytes;
        for (const char letter :
             {'M', 'X', 'T', 'P', char('0' + sent.type / 10), char('0' + sent.type % 10)}) {
            bytes.push_back(static_cast<std::byte>(letter));
        }
        put(bytes, sent.sample, 4);
        put(bytes, sent.datagram, 1);
        put(bytes, static_cast<std::uint32_t>(sent.items.size()), 1);
        put(bytes, sent.timeCode.value_or(sent.sample * 1000 / kHz), 4);
        put(bytes, sent.character, 1);
        put(bytes, sent.type == 1 || sent.type == 2 ? static_cast<std::uint32_t>(sent.items.size()) : 0, 1);
        put(bytes, 0, 4);
        put(bytes, static_cast<std::uint32_t>(payload.size()), 2);
        bytes.insert(bytes.end(), payload.begin(), payload.end());
        return bytes;
    }

    /// The value with each packet.
    static Values read(std::string_view text, const std::vector<Sent>& packets) {
        auto expression = parseSignal(text);
        if (!expression) {
            ADD_FAILURE() << text << ": " << expression.error().offset << ": " << expression.error().text;
            return {};
        }
        model::PacketDigester digester;
        Values values;
        wire::Datagram datagram;
        for (const Sent& sent : packets) {
            const auto bytes = bytesOf(sent);
            log::Packet packet;
            packet.number = values.size();
            packet.bytes = bytes;
            packet.stamp = log::Stamp(sent.at.value_or(sent.sample * (1000ms / kHz)));
            const auto decoded = wire::decodeInto(bytes, datagram);
            EXPECT_TRUE(decoded) << wire::errorText(decoded.error());
            const model::PacketDigest digest = digester.add(packet, &datagram);
            field::Candidate candidate{packet, digest, &datagram, nullptr, {}};
            candidate.stream = digester.stream();
            field::Subject subject(candidate);
            values.push_back(expression->signal(subject));
        }
        return values;
    }

    /// Of segment `i` in a sample: anything smooth.
    static std::vector<float> segment(std::uint32_t sample, std::uint32_t i) {
        const double t = sample * 0.05;
        const double turn = 0.5 * (t + i);
        return {static_cast<float>(std::sin(t + i)),
                static_cast<float>(0.2 * t),
                static_cast<float>(1 + 0.1 * i * t),
                static_cast<float>(std::cos(turn / 2)),
                0,
                0,
                static_cast<float>(std::sin(turn / 2))};
    }
    static std::vector<Sent> poses(std::uint32_t from, std::uint32_t to) {
        std::vector<Sent> all;
        for (std::uint32_t sample = from; sample < to; ++sample) {
            all.push_back({2, sample, {segment(sample, 0), segment(sample, 1), segment(sample, 2)}});
        }
        return all;
    }
};

TEST_F(SignalTest, ComputesWhatTheBytesSay) {
    const auto packets = poses(0, 200);
    const auto distance = read("distance(position of Pelvis, position of L3)", packets);
    const auto angle = read("angle(orientation of Pelvis, orientation of 2)", packets);
    const auto between = read("angle(position of L5, position of L3)", packets);
    const auto speed = read("speed(position of L5)", packets);
    const auto turning = read("speed(orientation of L5)", packets);
    const auto mixed = read("(position.z of L3 - position.z of Pelvis) / 2 * -3 + 10 cm", packets);
    const auto norm = read("norm(2 * position of L3 - position of L3)", packets);
    EXPECT_FALSE(speed[0]);
    for (std::uint32_t sample = 0; sample < 200; ++sample) {
        const auto a = segment(sample, 0);
        const auto b = segment(sample, 1);
        const auto c = segment(sample, 2);
        const auto far = [](const auto& from, const auto& to) {
            return std::hypot(1.0 * to[0] - from[0], 1.0 * to[1] - from[1], 1.0 * to[2] - from[2]);
        };
        EXPECT_DOUBLE_EQ(*distance[sample], far(a, c));
        EXPECT_NEAR(*angle[sample], 0.5 / kDegree, 1e-4); // the turns differ by half a radian
        const double dot = 1.0 * b[0] * c[0] + 1.0 * b[1] * c[1] + 1.0 * b[2] * c[2];
        const double lengths = std::hypot(b[0], b[1], b[2]) * std::hypot(c[0], c[1], c[2]);
        EXPECT_NEAR(*between[sample], std::acos(std::min(1.0, dot / lengths)) / kDegree, 1e-3);
        EXPECT_NEAR(*mixed[sample], (1.0 * c[2] - a[2]) / 2 * -3 + 0.1, 1e-12);
        EXPECT_NEAR(*norm[sample], std::hypot(1.0 * c[0], 1.0 * c[1], 1.0 * c[2]), 1e-12);
        if (sample > 0) {
            const auto before = segment(sample - 1, 1);
            EXPECT_NEAR(*speed[sample], far(before, b) * kHz, 1e-9) << sample;
            EXPECT_NEAR(*turning[sample], 0.025 / kDegree * kHz, 1e-2) << sample;
        }
    }
}

TEST_F(SignalTest, TakesTheSendersTimeAtItsRateAndNotInWholeMilliseconds) {
    std::vector<Sent> packets;
    for (std::uint32_t sample = 0; sample < 480; ++sample) { // 240 Hz: 4, 4, 4, 4, 4, 5 ms …
        packets.push_back(
            {2, sample, {{0, 0, static_cast<float>(sample), 1, 0, 0, 0}}, 0, sample * 1000 / 240});
    }
    const auto values = read("derivative(position.z)", packets);
    EXPECT_EQ(*values[1], 250); // 4 ms, before the rate is known
    for (std::size_t sample = 130; sample < 480; ++sample) {
        EXPECT_DOUBLE_EQ(*values[sample], 240);
    }
}

TEST_F(SignalTest, HasNoDerivativeAcrossAGapOrARestart) {
    auto packets = poses(0, 120);
    packets.erase(packets.begin() + 100); // sample 100 is lost
    const auto restarted = poses(0, 30);
    for (Sent sent : restarted) {
        sent.at = 2s + sent.sample * 10ms;
        packets.push_back(sent);
    }
    const auto speed = read("speed(position of L5)", packets);
    const auto change = read("derivative(speed(position of L5))", packets);
    ASSERT_EQ(speed.size(), 149U);
    for (std::size_t i = 0; i < 119; ++i) {
        EXPECT_EQ(speed[i].has_value(), i != 0 && i != 100) << i;
        EXPECT_EQ(change[i].has_value(), i > 1 && i != 100 && i != 101) << i;
    }
    EXPECT_FALSE(speed[119]);
    EXPECT_TRUE(speed[148]);
    for (const auto& value : speed) {
        EXPECT_LT(value.value_or(0), 6); // no leap is taken for a motion
    }
}

TEST_F(SignalTest, LeavesLateSamplesOutOfDerivatives) {
    auto packets = poses(0, 120);
    std::swap(packets[100], packets[101]);
    const auto height = read("position.z of L3", packets);
    const auto speed = read("speed(position of L3)", packets);
    EXPECT_EQ(*height[100], segment(101, 2)[2]);
    EXPECT_EQ(*height[101], segment(100, 2)[2]); // late, but a value all the same
    EXPECT_FALSE(speed[100]);
    EXPECT_FALSE(speed[101]);
    EXPECT_TRUE(speed[102]);
}

TEST_F(SignalTest, TurnsTheShortWayRound) {
    std::vector<Sent> packets;
    for (std::uint32_t sample = 0; sample < 100; ++sample) {
        constexpr std::size_t kKnee = 15; // the place of jRightKnee
        Sent joints{20, sample, {}};
        for (std::size_t place = 0; place < 22; ++place) {
            const double degrees = place == kKnee ? std::remainder(5.0 * sample, 360) : 0;
            joints.items.push_back({0, 0, 0, static_cast<float>(degrees)}); // the first is the child's id
        }
        packets.push_back(joints);
    }
    const auto values = read("derivative(20.rotation.z of RightKnee)", packets);
    for (std::size_t i = 1; i < values.size(); ++i) {
        EXPECT_NEAR(values[i].value_or(0), 5.0 * kHz, 1e-2) << i;
    }
}

TEST_F(SignalTest, PutsMessagesOfOneSampleTogetherInOneFrame) {
    std::vector<Sent> packets;
    for (std::uint32_t sample = 0; sample < 20; ++sample) {
        const auto height = static_cast<float>(sample);
        // The same place: metres with Z up, and centimetres with Y up.
        const Sent pose{2, sample, {{1, 2, height, 1, 0, 0, 0}}};
        Sent points{3, sample, {{200, 100 * height, 103}}};
        points.ids = {257 + 12};
        const bool isPoseFirst = sample % 2 == 0;
        packets.push_back(isPoseFirst ? pose : points);
        if (sample != 7) {
            packets.push_back(isPoseFirst ? points : pose);
        }
    }
    const auto values = read("distance(2.position of Pelvis, 3.position of pSacrum)", packets);
    std::size_t count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        count += values[i] ? 1 : 0;
        EXPECT_NEAR(values[i].value_or(0.03), 0.03, 1e-6);
    }
    EXPECT_EQ(count, 19U); // sample 7 lacks its pose
}

TEST_F(SignalTest, PutsDatagramsOfOneSampleTogether) {
    std::vector<Sent> packets;
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        packets.push_back({2, sample, {segment(sample, 0)}});
        packets.back().datagram = 0;
        packets.push_back({2, sample, {segment(sample, 1)}});
        packets.back().datagram = 0x81;
        packets.back().ids = {2};
    }
    packets.push_back(packets.back()); // twice
    const auto values = read("position.x of L5 - position.x of Pelvis", packets);
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        EXPECT_FALSE(values[2 * sample]);
        EXPECT_DOUBLE_EQ(*values[2 * sample + 1], 1.0 * segment(sample, 1)[0] - segment(sample, 0)[0]);
    }
    EXPECT_FALSE(values.back());
}

TEST_F(SignalTest, TellsCharactersApart) {
    std::vector<Sent> packets;
    for (std::uint32_t sample = 0; sample < 100; ++sample) {
        for (std::uint8_t character = 0; character < 2; ++character) {
            const float place = static_cast<float>(sample) * (character == 0 ? 0.01F : 0.02F);
            packets.push_back({2, sample, {{place, 0, 0, 1, 0, 0, 0}}, character});
        }
    }
    const auto speed = read("speed(position)", packets);
    const auto second = read("speed(position) where character == 1", packets);
    for (std::size_t i = 2; i < packets.size(); ++i) {
        EXPECT_NEAR(*speed[i], i % 2 == 0 ? 1 : 2, 1e-3);
        EXPECT_EQ(second[i].has_value(), i % 2 == 1);
    }
}

TEST_F(SignalTest, StaysWithOneOfTheTypesThatHaveAField) {
    std::vector<Sent> packets;
    for (std::uint32_t sample = 0; sample < 20; ++sample) {
        packets.push_back({2, sample, {{0, 0, 1, 1, 0, 0, 0}}});
        packets.push_back({1, sample, {{0, 0, 200, 0, 0, 0}}});
        if (sample % 3 == 0 && sample > 0) {
            std::swap(packets[2 * sample], packets[2 * sample + 1]);
        }
    }
    for (const auto& value : read("position.z of Pelvis", packets)) {
        EXPECT_EQ(value.value_or(1), 1);
    }
    EXPECT_EQ(read("1.position.z of Pelvis", packets)[1], 2);
}

TEST_F(SignalTest, ReadsTheFiguresOfTheAccounting) {
    std::vector<Sent> packets;
    for (std::uint32_t sample = 0; sample < 6000; ++sample) {
        if (sample % 20 == 19) { // each 20th is lost
            continue;
        }
        packets.push_back({2, sample, {segment(sample, 0)}});
        // The sender's clock is 100 ppm faster, and some samples are late by 2 ms.
        packets.back().at = sample * 9'999'000ns + (sample % 7 == 3 ? 2ms : 0ms);
    }
    EXPECT_NEAR(*read("2.rate", packets).back(), 95, 1);
    EXPECT_NEAR(*read("2.loss", packets).back(), 5, 0.2);
    EXPECT_NEAR(*read("2.skew", packets).back(), 100, 5);
    const auto jitter = read("2.jitter", packets);
    EXPECT_GT(*jitter.back(), 0.0001);
    EXPECT_LT(*jitter.back(), 0.002);
    const auto delay = read("2.delay", packets);
    const Sent& last = packets.back();
    EXPECT_NEAR(*delay.back(), log::secondsOf(*last.at) - last.sample * 0.01, 1e-6);
    EXPECT_EQ(read("3.rate", packets), Values(packets.size()));
}

} // namespace
} // namespace posewire::feed
