// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/performer/corruption.h"
#include "core/performer/delivery.h"
#include "core/performer/fault_settings.h"
#include "core/performer/loss_pattern.h"
#include "core/performer/noise.h"
#include "core/performer/sending.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::performer {

/// What was done to the datagrams of one sender.
struct FaultTally {
    std::uint64_t offered = 0;    ///< after division into parts
    std::uint64_t dropped = 0;    ///< never sent
    std::uint64_t duplicated = 0; ///< sent once more
    std::uint64_t reordered = 0;  ///< held back on purpose
    std::uint64_t corrupted = 0;
    std::uint64_t truncated = 0;
    std::uint64_t withheld = 0; ///< by a pause or a reduced rate
};

/// The sender and the network between a performance and a receiver, at fault: takes datagrams with the times
/// at which a good sender would send them, gives datagrams with the times at which these leave. Without a
/// clock: the same seed and datagrams give the same faults. All kinds in any combination.
///
/// Faults keep clear of what would leave the right count to chance (see Delivery, CorruptionBounds), and of
/// the moments of a restart and a change of rate.
class Faults {
public:
    /// The settings must be without a problem.
    explicit Faults(const FaultSettings& settings);

    /// In order of their times, after the start.
    void offer(std::vector<std::byte> datagram, log::Duration due);

    /// All that leave before this time, in order, appended; later offers are due at that time or after it.
    void takeUntil(log::Duration until, std::vector<Sending>& into);
    /// The rest, after the last offer.
    void takeRest(std::vector<Sending>& into);

    [[nodiscard]] FaultTally tally() const;

private:
    [[nodiscard]] bool isPaused(log::Duration due) const;
    [[nodiscard]] bool isReduced(std::uint32_t sample, log::Duration due);
    void restartAt(log::Duration due, Sending& sending);
    void send(Sending sending);
    void damage(Sending& sending, std::uint64_t key);
    void deliver(Sending sending, std::uint64_t key);
    void sendCopy(const Sending& sending, std::uint64_t key);
    [[nodiscard]] double holdMs(std::uint64_t key) const;
    [[nodiscard]] bool happens(double probability, const KeyedRandom& random, std::uint64_t key) const {
        return probability > 0.0 && random.uniform(key) < probability;
    }

    FaultSettings m_settings;
    KeyedRandom m_random;
    QuietTimes m_quiet;
    LossPattern m_loss;
    Delivery m_delivery;
    std::vector<Sending> m_ready;
    std::optional<std::uint32_t> m_reductionSample; ///< first one of the reduced rate
    std::uint32_t m_shift = 0;                      ///< off every counter, since the restart
    std::uint32_t m_epoch = 0;
    std::uint64_t m_datagrams = 0;
    FaultTally m_tally;
};

} // namespace posewire::performer
