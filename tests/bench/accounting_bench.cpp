// SPDX-License-Identifier: MIT
#include "tests/core/model/accounting/arrivals.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

// What does it cost to account for one datagram, against nothing but copying 760 bytes? Steady streams, and
// streams that lose a tenth and bring some late. Both in turn, in one run; medians.
//   accounting_bench [--brief] [--check]
namespace {

using namespace posewire;

constexpr double kLimit = 10.0; // times the copy
constexpr std::size_t kStreams = 40;

double nsPer(std::chrono::steady_clock::time_point start, std::size_t count) {
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
           static_cast<double>(count);
}

double copying(std::size_t count) {
    std::array<std::byte, 64 * 1024> from{};
    std::array<std::byte, 1024> into{};
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(into.data(), from.data() + i % 64 * 760, 760);
        asm volatile("" : : "r"(into.data()) : "memory");
    }
    return nsPer(start, count);
}

double accounting(std::size_t count, bool isLossy) {
    std::vector<std::unique_ptr<model::StreamAccounting>> streams;
    for (std::size_t i = 0; i < kStreams; ++i) {
        streams.push_back(std::make_unique<model::StreamAccounting>());
    }
    wire::Header header;
    std::uint32_t random = 1;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < count; ++i) {
        random = random * 1'664'525 + 1'013'904'223;
        header.sampleCounter = static_cast<std::uint32_t>(i / kStreams);
        header.timeCode = header.sampleCounter * 4;
        if (isLossy && random < UINT32_MAX / 10) {
            if (random % 2 == 0) {
                continue;
            }
            header.sampleCounter -= std::min(header.sampleCounter, 5U);
        }
        model::addTo(*streams[i % kStreams], log::Stamp(header.sampleCounter * std::chrono::milliseconds(4)),
                     760, header);
    }
    return nsPer(start, count);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

} // namespace

int main(int argumentCount, char** arguments) {
    const std::vector<std::string_view> options(arguments + 1, arguments + argumentCount);
    const auto isGiven = [&](std::string_view name) {
        return std::find(options.begin(), options.end(), name) != options.end();
    };
    const std::size_t count = isGiven("--brief") ? 40'000 : 1'000'000;
    std::vector<double> copies;
    std::vector<double> steady;
    std::vector<double> lossy;
    for (int round = 0; round < (isGiven("--brief") ? 3 : 9); ++round) {
        copies.push_back(copying(count));
        steady.push_back(accounting(count, false));
        lossy.push_back(accounting(count, true));
    }
    std::printf("# copy of 760 bytes %.1f ns, accounting %.1f ns, with loss and reordering %.1f ns\n",
                median(copies), median(steady), median(lossy));
    const double ratio = median(steady) / median(copies);
    std::printf("accounting %.2f %.1f\n", ratio, kLimit);
    std::printf("accounting_lossy %.2f %.1f\n", median(lossy) / median(copies), 2 * kLimit);
    return isGiven("--check") && ratio > kLimit ? 1 : 0;
}
