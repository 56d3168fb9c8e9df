// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace posewire::net {

/// Finds out whether what a relay sends comes back to its own inputs, over however many other monitors and
/// from whatever port.
///
/// A datagram with the content of one that was relayed within the last kMemory, from another sender, is a
/// return. (What a sender itself sends again, on purpose or twice, is none.) Where returns are many, it may
/// be a loop, or a stream that arrives here twice. A trial tells: for a moment new datagrams are dealt out by
/// their content, one share to nobody, one share to each target alone, and whose share comes back has a loop.
/// If the share that was sent to nobody comes back as well, the stream arrives twice, and nothing is wrong.
/// Meanwhile no return is relayed, so a loop that was suspected does not grow.
///
/// Belongs to the relay's thread. Nothing is allocated after construction but in a trial.
class LoopWatch {
public:
    /// How long a datagram under way through other monitors is expected back.
    static constexpr log::Duration kMemory = std::chrono::seconds(2);
    /// Returns within a second that begin a trial; more where more than this share of what is relayed is new.
    static constexpr std::uint64_t kSuspicious = 16;

    LoopWatch() : m_slots(std::make_unique<Slot[]>(kSlots)) {}

    struct Route {
        bool isReturn = false;
        bool isWithheld = false;           ///< from all but `only`
        std::optional<std::size_t> only{}; ///< the target that alone gets it, where withheld
        [[nodiscard]] bool leadsTo(std::size_t target) const { return !isWithheld || only == target; }
    };

    /// `content` is a hash of the datagram; `targets` how many there are.
    [[nodiscard]] Route route(std::uint64_t content, log::SenderId sender, log::Moment now,
                              std::size_t targets);

    /// The targets whose datagrams came back, once a trial has shown it; empty for none so far.
    [[nodiscard]] std::vector<std::size_t> takeLoops(log::Moment now);

    [[nodiscard]] log::SenderId lastReturner() const { return m_returner; }

    /// The targets have changed: what a trial has found so far no longer holds.
    void endTrial() { m_trial.reset(); }

private:
    struct Slot {
        std::uint64_t content = 0;
        log::Moment sent{};
        log::SenderId sender{};
        std::uint32_t trial = 0; ///< in which it was dealt out; 0 for none
        bool isBack = false;     ///< from that trial
    };
    struct Share {
        std::uint64_t dealt = 0;
        std::uint64_t back = 0;
    };
    struct Trial {
        std::vector<Share> shares; ///< nobody's first
        log::Moment begun{};
        std::optional<log::Moment> dealtOut{}; ///< when there were enough of each
    };

    [[nodiscard]] Route routeOfReturn(Slot& slot, log::Moment now, std::size_t targets);
    [[nodiscard]] Route deal(Slot& slot, log::Moment now);
    [[nodiscard]] Route routeOfShare(std::uint64_t content) const;
    [[nodiscard]] std::size_t shareOf(std::uint64_t content) const;
    [[nodiscard]] std::uint64_t mostReturns(log::Moment now) const;
    void countSecond(log::Moment now);

    /// One slot for each hash; a newcomer replaces the old entry. Enough for two seconds at the design load,
    /// and at more a return that goes unseen does not matter.
    static constexpr std::size_t kSlots = std::size_t{1} << 16;
    std::unique_ptr<Slot[]> m_slots;
    log::Moment m_second{};      ///< when the present one began
    std::uint64_t m_new = 0;     ///< relayed in this second
    std::uint64_t m_returns = 0; ///< in this second
    log::SenderId m_returner{};
    log::Moment m_trusted{}; ///< until then only a flood of returns begins a trial: streams arrive twice
    std::optional<Trial> m_trial;
    std::uint32_t m_trialNumber = 0;
};

} // namespace posewire::net
