// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/model/body/pose_messages.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace posewire::feed {

/// What came of one sample of a character: messages of kPoseTypes, whole or in part.
class HeldSample {
public:
    /// A sample with more bytes in one message is no sample.
    static constexpr std::size_t kMostBytes = model::kMostMessageBytes;

    HeldSample(std::uint32_t number, log::Stamp stamp) : m_number(number), m_stamp(stamp) {}

    /// Takes a datagram of a type, by its place in kPoseTypes. Datagrams come in any order; repeats are left
    /// out.
    void add(std::size_t place, const wire::Datagram& datagram, const log::Packet& packet);

    [[nodiscard]] std::uint32_t number() const { return m_number; } ///< the sample counter
    [[nodiscard]] log::Stamp stamp() const { return m_stamp; }      ///< of the datagram that came first
    /// Whether a datagram belongs to a message that is not whole, and has not come.
    [[nodiscard]] bool lacks(std::size_t place, const wire::Header& header) const;
    /// Null unless all its datagrams came.
    [[nodiscard]] const model::Message* message(std::size_t place) const;
    [[nodiscard]] bool hasWholePose() const;

private:
    struct Joining {
        model::Message message;
        std::map<std::uint8_t, wire::Datagram> parts; ///< until all have come
        std::size_t expected = 0;                     ///< 0 before the last part has come
        std::size_t bytes = 0;
        bool isWhole = false;
    };

    std::uint32_t m_number;
    log::Stamp m_stamp;
    std::array<std::unique_ptr<Joining>, model::kPoseTypes.size()> m_messages;
};

/// Puts the samples of one character into the order of their counters, each once. Each waits, unless it is
/// the next and has a whole pose, so that what is late has its place, also from before a restart; memory does
/// not grow with the range. A counter that is far from the others is believed if the next ones agree with it:
/// what is lost in between is lost, or a new run begins. Its rules are those of model::Probation, which
/// counts, so that what is fed is what was counted.
class SampleOrder {
public:
    static constexpr std::size_t kMost = 2048; ///< samples that wait

    /// `beginsRun`: the first one, or the first after a restart.
    using Take = std::function<void(HeldSample&& sample, bool beginsRun)>;
    SampleOrder(log::Duration wait, Take take) : m_wait(wait), m_take(std::move(take)) {}

    /// Takes a datagram with its place in kPoseTypes.
    void add(std::size_t place, const wire::Datagram& datagram, const log::Packet& packet);
    /// Hands out what has waited long enough.
    void release(log::Stamp now);
    /// Hands out all that waits; what comes next has nothing to do with the counters before: another sender.
    void flush();

private:
    /// Samples between two restarts.
    struct Run {
        std::deque<HeldSample> waiting;     ///< by counter
        std::uint32_t highest = 0;          ///< counter, taken or not
        std::optional<std::uint32_t> taken; ///< the newest that has gone
        std::int32_t step = INT32_MAX;      ///< the least between two that have gone

        [[nodiscard]] HeldSample* find(std::uint32_t number);
        [[nodiscard]] bool lacks(std::uint32_t number);
        /// Null if it came too late, or one with this counter waits.
        HeldSample* insert(HeldSample sample);
    };
    struct Doubted {
        HeldSample sample;
        bool isFresh = true; ///< the run has not advanced since
    };

    [[nodiscard]] bool isNext(const Run& run) const;
    [[nodiscard]] bool isExpected(std::uint32_t number);
    [[nodiscard]] bool mayStraggle(std::uint32_t number);
    [[nodiscard]] HeldSample* findLacking(std::size_t place, const wire::Header& header);
    HeldSample& doubt(std::uint32_t number, log::Stamp stamp);
    void advance();
    [[nodiscard]] std::size_t agreeing(std::uint32_t number) const;
    void settle(std::uint32_t number);
    void believe(std::uint32_t number);
    void takeFirst();

    log::Duration m_wait;
    Take m_take;
    std::deque<Run> m_runs; ///< the newest last; those before it may still get what is late
    std::vector<Doubted> m_doubted;
};

} // namespace posewire::feed
