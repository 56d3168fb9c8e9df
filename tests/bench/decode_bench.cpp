// SPDX-License-Identifier: MIT
#include "core/wire/byte_order.h"
#include "core/wire/codec.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string_view>
#include <vector>

// What does it cost to turn a pose datagram of 23 segments (760 bytes) into values, with every check, against
// nothing but swapping the bytes of the same 190 words? Both in turn, in one run; medians.
//   decode_bench [--brief] [--check]
namespace {

using namespace posewire;

constexpr std::size_t kDatagramSize = 760;
constexpr std::size_t kWords = kDatagramSize / 4;
constexpr double kLimit = 2.0;

/// So that the compiler must have the values at hand and may assume nothing about them.
template <class T>
void keep(T& value) {
    asm volatile("" : : "r"(&value) : "memory");
}

__attribute__((noinline)) void swapWords(const std::byte* from, std::uint32_t* to) {
    for (std::size_t i = 0; i < kWords; ++i) {
        to[i] = wire::load32(from + 4 * i);
    }
}

/// A few different datagrams, small enough for the first cache.
std::vector<std::vector<std::byte>> datagrams() {
    std::vector<std::vector<std::byte>> all;
    for (std::uint32_t n = 0; n < 16; ++n) {
        wire::PoseQuaternion pose;
        for (std::uint32_t id = 1; id <= 23; ++id) {
            const auto place = static_cast<float>(id) * 0.1F;
            pose.segments.push_back(
                {id, {static_cast<float>(n) * 0.001F, place, 1.0F}, {0.5F, 0.5F, -0.5F, 0.5F}});
        }
        wire::Datagram datagram;
        datagram.header.sampleCounter = n;
        datagram.header.bodySegments = 23;
        datagram.body = std::move(pose);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        all.push_back(*wire::encode(datagram));
    }
    return all;
}

/// Nanoseconds a datagram.
template <class Work>
double timed(std::size_t rounds, const std::vector<std::vector<std::byte>>& all, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t round = 0; round < rounds; ++round) {
        work(all[round % all.size()]);
    }
    const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
    return elapsed.count() / static_cast<double>(rounds);
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

} // namespace

int main(int argumentCount, char** arguments) {
    const std::vector<std::string_view> options(arguments + 1, arguments + argumentCount);
    const auto isGiven = [&](std::string_view name) {
        return std::find(options.begin(), options.end(), name) != options.end();
    };
    const std::size_t rounds = isGiven("--brief") ? 500 : 10'000;
    const auto all = datagrams();
    std::vector<double> decoding;
    std::vector<double> swapping;
    std::vector<double> ratios;
    wire::Datagram into;
    std::vector<std::uint32_t> words(kWords);
    bool isRight = all.front().size() == kDatagramSize;
    for (int run = 0; run < 301; ++run) {
        swapping.push_back(timed(rounds, all, [&](const std::vector<std::byte>& bytes) {
            swapWords(bytes.data(), words.data());
            keep(*words.data());
        }));
        decoding.push_back(timed(rounds, all, [&](const std::vector<std::byte>& bytes) {
            isRight = isRight && wire::decodeInto(bytes, into) && into.notices.empty();
            keep(into);
        }));
        ratios.push_back(decoding.back() / swapping.back());
    }
    const double ratio = median(ratios);
    std::printf("# decode %.1f ns, byte swap %.1f ns for 760 bytes (medians of %zu runs)\n", median(decoding),
                median(swapping), ratios.size());
    std::printf("decode %.2f %.1f\n", ratio, kLimit);
    return isRight && (!isGiven("--check") || ratio <= kLimit) ? 0 : 1;
}
