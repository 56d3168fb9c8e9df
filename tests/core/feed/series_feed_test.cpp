// SPDX-License-Identifier: MIT
#include "core/feed/series_feed.h"
#include "core/feed/signal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

namespace posewire::feed {
namespace {

using namespace std::chrono_literals;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr log::Stamp kStart{1'700'000'000s};

/// A log of datagrams that tests send, 10 ms from each other.
class SeriesFeedTest : public testing::Test {
protected:
    explicit SeriesFeedTest(log::LogLimits limits = {}) : m_log(limits) {}

    void send(wire::Body body, std::uint32_t sample, std::uint8_t character = 0) {
        wire::Datagram datagram;
        datagram.body = std::move(body);
        datagram.header.sampleCounter = sample;
        datagram.header.timeCode = 10 * sample;
        datagram.header.character = character;
        datagram.header.datagramCounter = 0x80;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        log::Arrival arrival;
        arrival.stamp = kStart + sample * 10ms;
        arrival.sender = m_sender;
        m_log.writer().append(wire::encode(datagram).value(), arrival);
        m_log.writer().publish();
    }
    /// Items 1 to 3 at heights of the sample and their number.
    static wire::PoseQuaternion pose(std::uint32_t sample) {
        wire::PoseQuaternion body;
        for (std::uint32_t id = 1; id <= 3; ++id) {
            body.segments.push_back({id, {3, 4, static_cast<float>(100 * sample + id)}, {0, 1, 0, 0}});
        }
        return body;
    }
    [[nodiscard]] log::StreamKey stream(std::uint8_t type = 2, std::uint8_t character = 0) const {
        return {m_sender, character, type};
    }
    static Signal signal(std::string_view text) { return parseSignal(text).value().signal; }
    static void readAll(SeriesFeed& feed) {
        while (feed.advance()) {
        }
    }
    /// The values of the one signal of the one source, from a feed of its own.
    std::vector<double> valuesOf(SeriesSource source) {
        SeriesFeed feed(m_log, 0, {std::move(source)});
        readAll(feed);
        std::vector<double> values;
        for (std::uint64_t row = feed.series().begin(); row != feed.series().end(); ++row) {
            values.push_back(feed.series().value(0, row));
        }
        return values;
    }

    log::PacketLog m_log;
    log::SenderId m_sender = m_log.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
};

TEST_F(SeriesFeedTest, ReadsWhatDecodingReads) {
    for (std::uint32_t sample = 0; sample < 100; ++sample) {
        send(pose(sample), sample);
        send(pose(sample + 1000), sample, 1);
        send(wire::CentreOfMass{}, sample);
    }
    SeriesFeed feed(m_log, 0,
                    {{stream(),
                      {signal("position.z of 2"), signal("norm(orientation)"), signal("position.z"),
                       signal("header.timeCode"), signal("size")}}});
    readAll(feed);
    const Series& series = feed.series();
    ASSERT_EQ(series.end(), 100U);
    for (std::uint64_t row = 0; row < 100; ++row) {
        const SeriesRow& at = series.row(row);
        EXPECT_EQ(at.packet, 3 * row);
        EXPECT_EQ(at.sample, row);
        EXPECT_EQ(at.stamp, kStart + row * 10ms);
        EXPECT_FALSE(at.followsGap);
        EXPECT_EQ(series.value(0, row), static_cast<double>(100 * row + 2));
        EXPECT_EQ(series.value(1, row), 1);
        EXPECT_EQ(series.value(2, row), static_cast<double>(100 * row + 1));
        EXPECT_EQ(series.value(3, row), static_cast<double>(10 * row) / 1000); // s
        EXPECT_EQ(series.value(4, row), 24 + 3 * 32);
    }
}

TEST_F(SeriesFeedTest, ConvertsToTheUnitOfTheFieldUnlessAskedForWhatWasSent) {
    wire::PoseEuler euler;
    euler.segments.push_back({1, {30, 40, 0}, {}});
    send(euler, 0);
    wire::AngularKinematics angular;
    angular.segments.push_back({1, {1, 0, 0, 0}, {2, 0, 0}, {}});
    send(angular, 0);
    EXPECT_EQ(valuesOf({stream(1), {signal("norm(position)")}}), std::vector{0.5});
    EXPECT_EQ(valuesOf({stream(1), {signal("norm(position)")}, SIZE_MAX, model::LengthUnit::Metre}),
              std::vector{50.0});
    EXPECT_EQ(valuesOf({stream(1), {signal("wire.position.y")}}), std::vector{40.0});
    EXPECT_NEAR(valuesOf({stream(22), {signal("angularVelocity.x")}}).at(0), 114.59, 0.01);
    EXPECT_EQ(valuesOf({stream(22), {signal("wire.angularVelocity.x")}}), std::vector{2.0});
}

TEST_F(SeriesFeedTest, FindsItemsWhereverTheyAreInTheMessage) {
    for (std::uint32_t sample = 0; sample < 9; ++sample) {
        wire::PointPositions body;
        for (std::uint32_t item = 0; item < 3; ++item) {
            const std::uint32_t id = 257 + (item + sample) % 3;
            body.points.push_back({id, {static_cast<float>(id), 0, 0}});
        }
        send(body, sample);
    }
    EXPECT_EQ(valuesOf({stream(3), {signal("wire.position.x of 258")}}), std::vector<double>(9, 258));
    EXPECT_TRUE(valuesOf({stream(3), {signal("position.x of 300")}}).empty());
}

TEST_F(SeriesFeedTest, KeepsARowOfWhatWasSentAsNoNumber) {
    wire::PoseQuaternion body = pose(1);
    body.segments[0].position[2] = std::numeric_limits<float>::quiet_NaN();
    send(body, 0);
    send(pose(1), 1);
    SeriesFeed feed(m_log, 0, {{stream(), {signal("position.z")}}});
    readAll(feed);
    ASSERT_EQ(feed.series().end(), 2U);
    EXPECT_TRUE(std::isnan(feed.series().value(0, 0)));
    const SeriesColumn all = feed.series().sum(0, 0, 2);
    EXPECT_EQ(all.count, 1U);
    EXPECT_EQ(all.mean(), 101);
}

TEST_F(SeriesFeedTest, FlagsTheRowAfterMissingSamples) {
    for (std::uint32_t sample = 0; sample < 300; ++sample) {
        if (sample < 100 || sample > 104) {
            send(pose(sample), sample);
        }
    }
    SeriesFeed feed(m_log, 0, {{stream(), {signal("position.z")}}});
    readAll(feed);
    const auto columns = feed.series().columns(0, {kStart, kStart + 3s}, 30);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        EXPECT_EQ(columns[i].hasGap, i == 10) << i;
        EXPECT_EQ(columns[i].count, i == 10 ? 5U : 10U) << i;
        EXPECT_EQ(columns[i].most, static_cast<double>(100 * (10 * i + 9) + 1)) << i;
    }
}

TEST_F(SeriesFeedTest, ReadsPacketsThatAFilterMatches) {
    for (std::uint32_t sample = 0; sample < 50; ++sample) {
        send(pose(sample), sample, sample % 2);
        send(wire::CentreOfMass{}, sample);
    }
    const auto filter = filter::Filter::compile("character == 1 && sample >= 10").value();
    const auto values = valuesOf({filter, {signal("segments.position.z")}});
    EXPECT_EQ(values.size(), 20U);
    EXPECT_EQ(values.front(), 1101);
    // Of all packets, those that have the field make rows.
    EXPECT_EQ(valuesOf({filter::Filter(), {signal("orientation.w")}}).size(), 50U);
}

TEST_F(SeriesFeedTest, LeavesOutWhatCannotBeDecoded) {
    send(pose(0), 0);
    const std::vector<std::byte> whole = [this] {
        const auto packet = log::LogReader(m_log).packet(0);
        return std::vector(packet->bytes.begin(), packet->bytes.end());
    }();
    log::Arrival arrival;
    arrival.stamp = kStart;
    arrival.sender = m_sender;
    m_log.writer().append(std::span(whole).first(60), arrival);
    m_log.writer().publish();
    const Signal size = [](field::Subject& packet) {
        EXPECT_NE(packet.candidate.datagram, nullptr);
        return static_cast<double>(packet.candidate.packet.bytes.size());
    };
    EXPECT_EQ(valuesOf({stream(), {size}}).size(), 1U);
    EXPECT_EQ(valuesOf({filter::Filter::compile("malformed").value(), {signal("size")}}), std::vector{60.0});
}

TEST_F(SeriesFeedTest, DecodesAPacketOnceForAllItsSignals) {
    send(pose(0), 7);
    const Signal change = [](field::Subject& packet) {
        return const_cast<wire::Datagram*>(packet.candidate.datagram)->header.timeCode = 4711;
    };
    const Signal read = [](field::Subject& packet) { return packet.header()->timeCode; };
    SeriesFeed feed(m_log, 0, {{stream(), {change, read}}, {filter::Filter(), {read}}});
    readAll(feed);
    EXPECT_EQ(feed.series(0).value(1, 0), 4711);
    EXPECT_EQ(feed.series(1).value(0, 0), 4711);
}

TEST_F(SeriesFeedTest, BeginsInTheMiddleAndStopsWhereItIsTold) {
    for (std::uint32_t sample = 0; sample < 50; ++sample) {
        send(pose(sample), sample);
    }
    SeriesFeed feed(m_log, 20, {{stream(), {signal("position.z")}}});
    while (feed.advance(30)) {
    }
    EXPECT_EQ(feed.position(), 30U);
    EXPECT_EQ(feed.series().end(), 10U);
    EXPECT_EQ(feed.series().row(0).packet, 20U);
    readAll(feed);
    EXPECT_EQ(feed.series().end(), 30U);
    EXPECT_EQ(feed.missed(), 0U);
}

class SmallLogTest : public SeriesFeedTest {
protected:
    SmallLogTest() : SeriesFeedTest({.memoryCap = std::size_t{1} << 20, .chunkSize = std::size_t{1} << 16}) {}
};

TEST_F(SmallLogTest, CountsWhatItMissedAndFlagsTheGap) {
    SeriesFeed feed(m_log, 0, {{stream(), {signal("position.z")}}});
    for (std::uint32_t sample = 0; sample < 100; ++sample) {
        send(pose(sample), sample);
    }
    readAll(feed);
    EXPECT_EQ(feed.missed(), 0U);
    for (std::uint32_t sample = 100; sample < 20'000; ++sample) {
        send(pose(sample), sample);
    }
    readAll(feed);
    EXPECT_GT(feed.missed(), 1000U);
    EXPECT_EQ(feed.missed() + feed.series().end(), 20'000U);
    EXPECT_TRUE(feed.series().row(100).followsGap);
    EXPECT_FALSE(feed.series().row(101).followsGap);
}

TEST_F(SeriesFeedTest, FollowsWhileAnotherThreadWrites) {
    constexpr std::uint32_t kSamples = 5000;
    std::thread writer([this] {
        for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
            send(pose(sample), sample);
        }
    });
    SeriesFeed feed(m_log, 0, {{stream(), {signal("position.z")}}});
    while (feed.series().end() != kSamples) {
        feed.advance();
    }
    writer.join();
    for (std::uint64_t row = 0; row < kSamples; ++row) {
        ASSERT_EQ(feed.series().value(0, row), static_cast<double>(static_cast<float>(100 * row + 1)));
    }
}

/// Rows at random times with gaps and values that are none.
class SeriesTest : public testing::Test {
protected:
    void append(std::size_t rows) {
        for (std::size_t i = 0; i < rows; ++i) {
            m_stamp += std::chrono::microseconds(m_random() % 5000);
            const double value = m_random() % 5 == 0 ? kNone : std::ldexp(m_random(), -20) - 2000;
            m_series.append({m_stamp, i, 0, m_random() % 100 == 0}, std::vector{value, -value});
        }
    }
    [[nodiscard]] SeriesColumn slowly(std::size_t curve, log::Stamp from, log::Stamp to) const {
        SeriesColumn column;
        for (std::uint64_t row = m_series.begin(); row != m_series.end(); ++row) {
            if (m_series.row(row).stamp < from || m_series.row(row).stamp >= to) {
                continue;
            }
            column.hasGap = column.hasGap || m_series.row(row).followsGap;
            const double value = m_series.value(curve, row);
            if (!std::isnan(value)) {
                column.least = std::min(column.least, value);
                column.most = std::max(column.most, value);
                column.sum += value;
                ++column.count;
            }
        }
        return column;
    }

    static constexpr std::size_t kKept = 40'000;
    std::mt19937 m_random{3};
    log::Stamp m_stamp = kStart;
    std::shared_ptr<log::Scratch> m_scratch = std::make_shared<log::Scratch>();
    Series m_series{2, kKept, m_scratch};
};

TEST_F(SeriesTest, AddsUpAsOneByOne) {
    append(30'000);
    const auto all = m_stamp - kStart;
    for (int run = 0; run < 60; ++run) {
        const log::Stamp from = kStart - 1s + log::Duration(static_cast<std::int64_t>(m_random()) * 20);
        const log::Stamp to = run % 7 == 0 ? from : from + all / static_cast<int>(1 + m_random() % 1000);
        const std::size_t pixels = 1 + m_random() % 9;
        const auto columns = m_series.columns(run % 2, {from, to}, pixels);
        ASSERT_EQ(columns.size(), pixels);
        log::Stamp begin = from;
        for (std::size_t i = 0; i < pixels; ++i) {
            const double share = static_cast<double>(i + 1) / static_cast<double>(pixels);
            const log::Stamp end =
                i + 1 == pixels ? to : from + log::durationOf(share * log::secondsOf(to - from));
            const SeriesColumn expected = slowly(run % 2, begin, end);
            EXPECT_EQ(columns[i].count, expected.count);
            EXPECT_EQ(columns[i].hasGap, expected.hasGap);
            EXPECT_EQ(columns[i].least, expected.least);
            EXPECT_EQ(columns[i].most, expected.most);
            EXPECT_NEAR(columns[i].sum, expected.sum, 1e-6 * (1 + std::abs(expected.sum)));
            begin = end;
        }
    }
}

TEST_F(SeriesTest, NeverGoesBackInTime) {
    m_series.append({kStart + 1s}, std::vector{1.0, 1.0});
    m_series.append({kStart}, std::vector{2.0, 2.0});
    EXPECT_EQ(m_series.row(1).stamp, kStart + 1s);
    EXPECT_EQ(m_series.rowFrom(kStart + 1s), 0U);
    EXPECT_EQ(m_series.rowFrom(kStart + 2s), 2U);
}

TEST_F(SeriesTest, KeepsTheNewestInBoundedMemory) {
    append(kKept + 10'000);
    const std::uint64_t full = m_scratch->figures().heapBytes;
    append(10 * kKept);
    EXPECT_LE(m_scratch->figures().heapBytes, full + full / 8);
    EXPECT_GE(m_series.end() - m_series.begin(), kKept);
    EXPECT_LT(m_series.end() - m_series.begin(), kKept + 10'000);
    EXPECT_EQ(m_series.end(), 11 * kKept + 10'000);
    EXPECT_EQ(m_series.sum(0, m_series.begin(), m_series.end()).count, slowly(0, kStart, m_stamp + 1s).count);
}

} // namespace
} // namespace posewire::feed
