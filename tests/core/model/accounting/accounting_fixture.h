// SPDX-License-Identifier: MIT
#pragma once

#include "tests/core/model/accounting/arrivals.h"

#include "core/model/accounting/stream_accounting.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <span>

namespace posewire::model {

using namespace std::chrono_literals;

constexpr log::Stamp at(log::Duration time) {
    return log::Stamp(time);
}

/// Datagrams of one stream, 4 ms apart unless said otherwise.
struct Accounting : testing::Test {
    std::span<const Verdict> send(std::uint32_t sample, std::uint8_t datagramCounter = 0x80) {
        return sendWith(sample, sample, datagramCounter);
    }
    std::span<const Verdict> sendWith(std::uint32_t content, std::uint32_t sample,
                                      std::uint8_t datagramCounter = 0x80) {
        wire::Header header;
        header.sampleCounter = sample;
        header.datagramCounter = datagramCounter;
        header.timeCode = static_cast<std::uint32_t>(stamp.time_since_epoch() / 1ms);
        const auto verdicts = addTo(stream, stamp, 760, header, content);
        stamp += 4ms;
        return verdicts;
    }
    void sendAll(std::initializer_list<std::uint32_t> samples) {
        for (const std::uint32_t sample : samples) {
            send(sample);
        }
    }
    /// Both ends are sent.
    void sendSteady(std::uint32_t first, std::uint32_t last, std::uint32_t step = 1) {
        for (std::uint32_t sample = first; sample != last + step; sample += step) {
            send(sample);
        }
    }
    StreamAccounting stream;
    log::Stamp stamp = at(1s);
};

} // namespace posewire::model
