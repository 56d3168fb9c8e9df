// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/performer/delivery.h"
#include "core/performer/noise.h"
#include "core/performer/sending.h"
#include "core/wire/codec.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace posewire::performer {

/// Loss in two states (Gilbert 1960, Elliott 1963): a good one and a bad one, drawn for each datagram.
struct GilbertElliott {
    double toBad = 0.0;        ///< p: chance to go from good to bad
    double toGood = 1.0;       ///< r: chance to come back
    double passesInGood = 1.0; ///< k: chance of a datagram to pass in the good state
    double passesInBad = 0.0;  ///< h: and in the bad one
};

struct ContentBreakSettings {
    std::string kind; ///< one of contentBreaks()
    double fromSeconds = 0.0;
};
/// Named as what the report says of them; "floor" is a convention there, "header" makes a datagram malformed.
[[nodiscard]] std::vector<std::string_view> contentBreaks();

/// A sender that fills its datagrams wrongly in one way: the headers of all that count samples, or the poses.
class ContentBreak {
public:
    /// The kind must be one of contentBreaks().
    explicit ContentBreak(ContentBreakSettings settings) : m_settings(std::move(settings)) {}

    /// Breaks what leaves at its time. What the network damaged stays as it is.
    void apply(Sending& sending);

private:
    struct Stream {
        log::Duration since{};  ///< of its first broken datagram
        wire::Datagram first{}; ///< that one, before it was
    };
    ContentBreakSettings m_settings;
    std::map<std::pair<std::uint8_t, std::uint8_t>, Stream> m_streams; ///< by character and type
};

/// What goes wrong between a sender and the network. Probabilities are per datagram; times are seconds after
/// the start.
struct FaultSettings {
    std::uint64_t seed = 1; ///< the same seed gives the same faults
    double rateHz = 240.0;  ///< of the samples, before any reduction

    double drop = 0.0;
    int burst = 1; ///< datagrams lost one after another each time
    std::optional<GilbertElliott> gilbertElliott;
    double duplicate = 0.0;
    double reorder = 0.0;
    double corrupt = 0.0;
    double truncate = 0.0;
    double delayMs = 0.0;  ///< of every datagram
    double jitterMs = 0.0; ///< at most, on top of it, evenly distributed
    bool splits = false;   ///< samples of several items go in two to four datagrams

    struct Restart {
        double atSeconds = 0.0;
        std::uint32_t firstSample = 1;
    };
    std::optional<Restart> restart; ///< the sample counter restarts
    struct Pause {
        double atSeconds = 0.0;
        double seconds = 0.0;
    };
    std::optional<Pause> pause; ///< nothing is sent; the capture and its counter run on
    struct Reduction {
        double atSeconds = 0.0;
        std::uint32_t step = 2;
    };
    std::optional<Reduction> reduction; ///< from then on every step-th sample

    std::optional<ContentBreakSettings> content; ///< what is sent is filled in wrongly

    /// What is sent was received once, with faults of its own: these stay as they are, so that nothing is
    /// delayed or given up for the sake of what a receiver counts, and no Truth can be told.
    bool isRecorded = false;
};

/// One sentence; empty if Faults can be made of the settings.
std::optional<std::string> findProblem(const FaultSettings& settings);

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
    /// Without a time the rest, after the last offer.
    void take(std::optional<log::Duration> until, std::vector<Sending>& into);

    [[nodiscard]] FaultTally tally() const;

private:
    [[nodiscard]] bool isPaused(log::Duration due) const;
    [[nodiscard]] bool isReduced(std::uint32_t sample, log::Duration due);
    void send(Sending sending);
    void damage(Sending& sending, std::uint64_t key);
    bool loses(std::uint64_t key);
    void deliver(Sending sending);
    void sendCopy(const Sending& sending, std::uint64_t key);
    [[nodiscard]] double holdMs(std::uint64_t key) const;
    [[nodiscard]] bool happens(double probability, const KeyedRandom& random, std::uint64_t key) const {
        return probability > 0.0 && random.uniform(key) < probability;
    }

    FaultSettings m_settings;
    KeyedRandom m_random;
    QuietTimes m_quiet;
    Delivery m_delivery;
    std::vector<Sending> m_ready;
    std::optional<std::uint32_t> m_reductionSample; ///< first one of the reduced rate
    std::uint32_t m_shift = 0;                      ///< off every counter, since the restart
    std::uint32_t m_epoch = 0;
    int m_leftOfBurst = 0;
    bool m_isBad = false; ///< state of the GilbertElliott model
    FaultTally m_tally;
    std::optional<ContentBreak> m_content;
};

} // namespace posewire::performer
