// SPDX-License-Identifier: MIT
#include "core/feed/series_feed.h"
#include "core/feed/signal.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

// Does a view of 12 hours cost what a view of a minute costs? 1000 columns over 10 million values against
// 1000 over 10 thousand. And what does it cost to read 24 signals of a pose, against decoding it once?
//   series_bench [--brief] [--check]
namespace {

using namespace posewire;

constexpr double kColumnsLimit = 12;
constexpr double kReadingLimit = 8;
constexpr std::size_t kPixels = 1000;
constexpr log::Stamp kStart{std::chrono::hours(1)};
constexpr log::Duration kStep = std::chrono::microseconds(4167);

double secondsOf(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Seconds of a view of the newest rows, the best of some.
double viewed(const feed::Series& series, std::size_t rows) {
    const log::Stamp end = kStart + static_cast<std::int64_t>(series.end()) * kStep;
    double best = 1e9;
    for (int run = 0; run < 20; ++run) {
        std::uint64_t count = 0;
        const double seconds = secondsOf([&] {
            for (const auto& column :
                 series.columns(0, {end - static_cast<std::int64_t>(rows) * kStep, end}, kPixels)) {
                count += column.count;
            }
        });
        best = count == rows ? std::min(best, seconds) : best;
    }
    return best;
}

double columnsRatio(std::size_t rows) {
    feed::Series series(1, SIZE_MAX, std::make_shared<log::Scratch>());
    for (std::size_t row = 0; row < rows; ++row) {
        const double value = std::sin(static_cast<double>(row) * 1e-4);
        series.append({kStart + static_cast<std::int64_t>(row) * kStep, row}, {&value, 1});
    }
    return viewed(series, rows) / viewed(series, 10'000);
}

double readingRatio(std::size_t packets) {
    wire::Datagram datagram;
    wire::PoseQuaternion pose;
    std::vector<feed::Signal> curves;
    for (std::uint32_t id = 1; id <= 23; ++id) {
        pose.segments.push_back({id, {0, 0, static_cast<float>(id)}, {1, 0, 0, 0}});
        curves.push_back(feed::parseSignal("position.z of " + std::to_string(id)).value().signal);
    }
    curves.push_back(feed::parseSignal("norm(orientation)").value().signal);
    datagram.body = pose;
    log::PacketLog log;
    const log::SenderId sender = log.senders().intern({"127.0.0.1:4000", log::Transport::Udp, 9763});
    for (std::size_t i = 0; i < packets; ++i) {
        datagram.header.sampleCounter = static_cast<std::uint32_t>(i);
        datagram.header.datagramCounter = 0x80;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        log::Arrival arrival;
        arrival.stamp = kStart + static_cast<std::int64_t>(i) * kStep;
        arrival.sender = sender;
        log.writer().append(*wire::encode(datagram), arrival);
    }
    log.writer().publish();
    const double decoding = secondsOf([&] {
        log::LogFollower follower(log);
        while (const auto packet = follower.next()) {
            static_cast<void>(wire::decodeInto(packet->bytes, datagram));
        }
    });
    feed::SeriesFeed feed(log, 0, {{log::StreamKey{sender, 0, 2}, std::move(curves)}});
    const double reading = secondsOf([&] {
        while (feed.advance()) {
        }
    });
    std::printf("# %zu of %zu packets read, %.2f us each\n", static_cast<std::size_t>(feed.series().end()),
                packets, reading * 1e6 / static_cast<double>(packets));
    return feed.series().end() == packets ? reading / decoding : 1e9;
}

} // namespace

int main(int argumentCount, char** arguments) {
    bool isBrief = false;
    bool isChecked = false;
    for (int i = 1; i < argumentCount; ++i) {
        isBrief = isBrief || std::string_view(arguments[i]) == "--brief";
        isChecked = isChecked || std::string_view(arguments[i]) == "--check";
    }
    const double columns = columnsRatio(isBrief ? 1'000'000 : 10'000'000);
    const double reading = readingRatio(isBrief ? 10'000 : 200'000);
    std::printf("series_columns_ratio %.1f %.1f\n", columns, kColumnsLimit);
    std::printf("series_reading_ratio %.1f %.1f\n", reading, kReadingLimit);
    return isChecked && (columns > kColumnsLimit || reading > kReadingLimit) ? 1 : 0;
}
