// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/performer/sending.h"

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace posewire::performer {

/// Moments around which what belongs to what would be open to doubt: a restart, a change of rate.
struct QuietTimes {
    std::vector<log::Duration> moments;
    log::Duration width{}; ///< before and after each

    [[nodiscard]] bool contains(log::Duration time) const;
};

/// Datagrams under way: they come out in the order of their due times. Where their order would leave it to
/// chance what a receiver has to count, it is changed by as little as makes it clear:
///
/// - a sample that comes behind a later one by 25 to 100 ms would be late or not by the whims of a scheduler;
///   it waits until it is late beyond doubt;
/// - two samples in a row from more than 100 before look like a restart; the second waits until the stream
///   has gone on, and is given up at the end of the stream.
class Delivery {
public:
    /// Where it does not make that clear, all comes out when it is due.
    Delivery(log::Duration period, QuietTimes quiet, bool makesClear = true);

    void push(Sending sending);
    /// Comes out after `count` more have been pushed or noted.
    void pushAfter(Sending sending, std::uint64_t count);
    /// One more datagram of this sender has passed at this time.
    void notePassed(log::Duration time);
    /// Whether what a stream has overtaken by a restart still comes; else it is given up, as it is to begin
    /// with.
    void keepStragglers(bool keeps) { m_keepsStragglers = keeps; }

    /// All that are due before this time (without one, all there are: the streams have ended), in order,
    /// appended. Nothing due earlier may be pushed afterwards.
    void take(std::optional<log::Duration> until, std::vector<Sending>& into);

    [[nodiscard]] std::uint64_t givenUp() const { return m_givenUp; }

private:
    struct Entry {
        Sending sending;
        std::uint64_t order = 0;
    };
    struct Counted {
        Sending sending;
        std::uint64_t left = 0;
    };
    struct Advance {
        std::uint32_t sample;
        log::Duration time;
    };
    struct Front {
        bool isNative = false; ///< false while all of it is damaged datagrams of other streams
        std::uint32_t epoch = 0;
        std::uint32_t regime = 0;
        std::uint32_t first = 0;
        std::uint32_t highest = 0;
        std::uint64_t advances = 0; ///< 0: it has not begun
        std::uint64_t advancesAtFar = 0;
        std::deque<Advance> recent{};
    };
    enum class Judgement : std::uint8_t { Deliver, Wait, GiveUp };

    [[nodiscard]] static Judgement begin(Front& front, const Sending& sending, std::uint32_t sample);
    [[nodiscard]] Judgement judge(Sending& sending, bool isAtEnd);
    [[nodiscard]] Judgement judgeNative(Sending& sending, Front& front, std::uint32_t sample,
                                        bool isAtEnd) const;
    [[nodiscard]] Judgement judgeFar(Sending& sending, Front& front, bool isAtEnd) const;
    [[nodiscard]] Judgement judgeBehind(Sending& sending, Front& front, std::uint32_t sample,
                                        bool isAtEnd) const;
    static void advance(Front& front, std::uint32_t sample, log::Duration time);

    log::Duration m_period;
    QuietTimes m_quiet;
    bool m_makesClear;
    std::vector<Entry> m_heap;
    std::vector<Counted> m_counted;
    std::map<std::pair<std::uint8_t, std::uint8_t>, Front> m_fronts;
    log::Duration m_latest{}; ///< of what has come out
    std::uint64_t m_pushed = 0;
    std::uint64_t m_givenUp = 0;
    bool m_keepsStragglers = false;
};

} // namespace posewire::performer
