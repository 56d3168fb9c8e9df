// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/sample_ledger.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace posewire::model {

/// Decides what a datagram with an unexpected sample counter means: the counter restarted, many samples are
/// lost, it came late, or it is corrupt. Only the datagrams that follow it can tell these apart, so it waits
/// here, together with them, until it is clear; at most kMost wait.
class Probation {
public:
    static constexpr std::size_t kMost = 128;
    /// RFC 3550 appendix A.1: a jump that is no loss.
    static constexpr std::int32_t kMostBack = 100;
    static constexpr std::int32_t kMostForward = 3'000;
    /// Steps ahead that are taken for loss at once; fewer if it may be from before a restart.
    static constexpr std::uint32_t kSteps = 100;
    static constexpr std::uint32_t kStepsInDoubt = 8;
    /// RFC 3550 appendix A.1 takes two successive numbers for a restart. They are enough where nothing can
    /// have come late from the new place.
    static constexpr std::size_t kAgreeing = 2;
    /// Where they may have come late, a burst of late arrivals looks the same: more must agree, closely.
    /// Networks that reorder hold back a few datagrams in a row, so eight are a choice on the safe side.
    static constexpr std::size_t kAgreeingClosely = 8;
    static constexpr std::int32_t kMostLate = 4'096;

    struct Waiting {
        SampleLedger::Datagram datagram;
        std::uint64_t packet = 0;
        std::uint32_t timeCode = 0;
        bool isRepeat = false; ///< of one that waits too
    };

    enum class Outcome : std::uint8_t { Expected, Alone, Begun, Restarted };
    struct Decision {
        std::size_t decided = 0; ///< how many of them; 0 while nothing is clear
        std::array<Outcome, kMost> outcomes{};
    };

    /// True if a counter is so near to the expected one that it is counted at once.
    [[nodiscard]] static bool isExpected(const SampleLedger& ledger, const SampleLedger::Datagram& datagram);

    [[nodiscard]] bool empty() const { return m_waiting.empty(); }
    [[nodiscard]] const std::vector<Waiting>& waiting() const { return m_waiting; }
    void add(const Waiting& waiting);
    void drop(std::size_t decided);
    [[nodiscard]] std::size_t memoryBytes() const { return m_waiting.capacity() * sizeof(Waiting); }

    /// `isEnd`: nothing follows, so what is most likely is decided.
    void decide(const SampleLedger& ledger, bool isEnd, Decision& decision) const;

private:
    /// Datagrams that agree with each other on another place than the expected one.
    struct Group {
        std::uint32_t highest = 0;
        std::uint32_t low = 0; ///< of those since the expected place last advanced
        std::uint32_t high = 0;
        std::size_t count = 0;   ///< likewise, without repeats
        std::size_t filling = 0; ///< of these, those that the expected place lacks
    };
    static constexpr std::size_t kGroups = 4;
    static constexpr std::uint8_t kExpected = 0xff;
    static constexpr std::uint8_t kNoGroup = 0xfe;
    struct Scan {
        std::array<Group, kGroups> groups{};
        std::size_t groupCount = 0;
        std::uint8_t newest = kExpected;
        std::uint32_t highest = 0;    ///< in the expected place
        std::size_t advances = 0;     ///< there, since the newest unexpected one
        std::size_t afterAdvance = 0; ///< one past the newest advance
        std::array<std::uint8_t, kMost> labels{};
    };
    void scan(const SampleLedger& ledger, Scan& scan) const;
    static void takeUnexpected(const Waiting& waiting, std::size_t near, const SampleLedger& ledger,
                               Scan& scan);
    [[nodiscard]] static bool isSettled(const Group& group, const SampleLedger& ledger, log::Stamp stamp,
                                        bool isEnd);

    std::vector<Waiting> m_waiting;
};

} // namespace posewire::model
