// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/tcp_framer.h"
#include "core/log/time.h"
#include "core/performer/sending.h"
#include "core/wire/codec.h"

#include <bitset>
#include <compare>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

namespace posewire::performer {

/// What a receiver that misses nothing has to count about one stream: one type of one character of one
/// sender. Types 10 to 13 have datagrams, duplicates and incomplete alone.
struct SentFigures {
    std::uint64_t datagrams = 0;
    std::uint64_t samples = 0;
    std::uint64_t lost = 0;
    std::uint64_t duplicates = 0;
    std::uint64_t reordered = 0;
    std::uint64_t late = 0;
    std::uint64_t incomplete = 0;
    std::uint64_t restarts = 0;
    std::uint32_t step = 0;
    std::uint32_t firstSample = 0;
    std::uint32_t lastSample = 0;

    friend bool operator==(const SentFigures&, const SentFigures&) = default;
};

/// Behind a later sample by more than this, a sample is late: the waiting time of the display.
inline constexpr log::Duration kLate = std::chrono::milliseconds(50);

/// Records the datagrams of one stream as they leave, with what the sender knows about each: what it
/// was meant to be, where restarts and changes of rate are. Nothing is inferred, so nothing of the receiver's
/// accounting is needed. Keeps 24 bytes a sample.
class StreamTruth {
public:
    /// A datagram that can be decoded, with the header that it has now.
    void add(const wire::Header& header, const Sending& sending);

    [[nodiscard]] SentFigures figures() const;

private:
    /// The datagrams of a sample, or of a message outside sample accounting.
    struct Parts {
        std::bitset<128> arrived;
        int last = -1; ///< index of the one with the last flag; -1 where that has not come

        [[nodiscard]] bool isTouched() const { return arrived.any(); }
        [[nodiscard]] bool isComplete() const;
        /// False where it is there already.
        bool add(const wire::Header& header);
    };
    /// Samples with one spacing between two restarts.
    struct Run {
        std::uint32_t epoch = 0;
        std::uint32_t regime = 0;
        std::uint32_t step = 1;
        std::uint64_t restarts = 0; ///< before it
        std::int64_t first = 0;     ///< counters without wrap-around
        std::int64_t last = 0;
        std::int64_t base = 0; ///< of samples.front()
        std::deque<Parts> samples{};
        std::vector<std::pair<std::int64_t, log::Duration>> advances{}; ///< counter, time

        [[nodiscard]] std::int64_t place(std::uint32_t sample) const;
        Parts& at(std::int64_t position);
    };

    void addMessage(const wire::Header& header, const Sending& sending);
    /// Null where the counter is damaged so that it can belong to nothing.
    Run* runOf(const wire::Header& header, const Origin& origin);
    Run& beginRun(const wire::Header& header, const Origin& origin);
    void addTo(Run& run, const wire::Header& header, log::Duration time);

    SentFigures m_figures; ///< those that are counted as they come
    std::vector<Run> m_runs;
    Parts m_message;             ///< the newest one of types 10 to 13
    log::Duration m_messageAt{}; ///< when it began
    std::vector<std::pair<log::Duration, std::vector<std::byte>>> m_messageParts; ///< time, bytes
};

/// What a receiver that misses nothing has to count about one sender.
struct SenderFigures {
    std::uint64_t datagrams = 0; ///< that can be decoded
    std::uint64_t bytes = 0;     ///< of these and of malformed ones
    std::uint64_t malformed = 0; ///< begin with MXTP and cannot be decoded
    std::uint64_t foreign = 0;   ///< do not begin with MXTP

    friend bool operator==(const SenderFigures&, const SenderFigures&) = default;
};

/// Records everything that one socket really sends, in the order of sending. The codec decides
/// whether damaged bytes are still a datagram, and which.
class Truth {
public:
    struct StreamKey {
        std::uint8_t character = 0;
        std::uint8_t type = 0;
        friend auto operator<=>(const StreamKey&, const StreamKey&) = default;
    };

    void add(const Sending& sending);

    [[nodiscard]] const SenderFigures& sender() const { return m_sender; }
    [[nodiscard]] const std::map<StreamKey, StreamTruth>& streams() const { return m_streams; }

private:
    SenderFigures m_sender;
    std::map<StreamKey, StreamTruth> m_streams;
    wire::Datagram m_scratch;
};

/// The same as Truth for a byte stream such as TCP, in which a damaged datagram can take the next with it:
/// the framer finds where datagrams begin and end.
class StreamedTruth {
public:
    void add(const Sending& sending);
    /// The stream has ended.
    void finish();

    [[nodiscard]] const Truth& truth() const { return m_truth; }
    [[nodiscard]] std::uint64_t skippedBytes() const { return m_framer.skippedBytes(); }

private:
    struct Sent {
        std::uint64_t end = 0; ///< bytes of the stream up to the end of it
        log::Duration due{};
        Origin origin;
    };
    void take(const log::TcpFramer::Piece& piece);

    log::TcpFramer m_framer;
    Truth m_truth;
    std::deque<Sent> m_sent; ///< of which not everything has come out yet
    std::uint64_t m_size = 0;
};

} // namespace posewire::performer
