// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/filter/filter.h"
#include "core/log/log_reader.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/session/session_view.h"
#include "core/wire/types.h"

#include <QString>

#include <tl/expected.hpp>

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace posewire::gui {

class PacketModel;

/// Numbers of packets, by size: about a bit for each packet between the first and the last, however many of
/// them are in. A place is found in logarithmic time.
class PacketNumbers {
public:
    /// Numbers grow.
    void append(std::uint64_t number);
    void append(const std::vector<std::uint64_t>& numbers) {
        for (const std::uint64_t number : numbers) {
            append(number);
        }
    }
    void dropBefore(std::uint64_t number);
    void clear() { *this = {}; }

    [[nodiscard]] std::size_t size() const { return m_end - m_dropped; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    /// The number at a place, which is below size().
    [[nodiscard]] std::uint64_t operator[](std::size_t place) const;
    [[nodiscard]] std::size_t placeOf(std::uint64_t number) const;

private:
    static constexpr std::size_t kWords = 64;
    static constexpr std::size_t kNumbers = kWords * 64; ///< of a block
    struct Block {
        std::uint64_t before = 0; ///< how many are in the blocks before it, those that were dropped included
        std::array<std::uint64_t, kWords> bits{};
    };

    std::deque<Block> m_blocks;
    std::uint64_t m_first = 0;   ///< the number of the first bit
    std::uint64_t m_end = 0;     ///< how many there ever were
    std::uint64_t m_dropped = 0; ///< of them
};

/// Asks a filter about packets. Belongs to one thread, which may be another than the session's.
class PacketMatcher {
public:
    /// The log of the session must outlive it.
    PacketMatcher(const model::SessionView& view, filter::Filter filter);

    [[nodiscard]] bool matches(const log::Packet& packet, const model::PacketDigest& digest);
    [[nodiscard]] const filter::Filter& filter() const { return m_filter; }
    /// Whether positions of a sender that it compares have come in another unit since.
    [[nodiscard]] bool isOutdated(const model::SessionView& view) const { return m_units != unitsOf(view); }

private:
    /// What positions come in, by sender and type, as far as that is another unit than usual.
    using Units = std::map<std::pair<log::SenderId, std::uint8_t>, model::LengthUnit>;
    [[nodiscard]] Units unitsOf(const model::SessionView& view) const;

    const log::PacketLog& m_log;
    filter::Filter m_filter;
    log::Stamp m_firstStamp;
    Units m_units;
    log::SenderFinder m_senders;
    wire::Datagram m_datagram;
};

struct BytePattern {
    std::vector<std::byte> bytes;
    bool ignoresCase = false; ///< of the letters a to z
};

/// Text as its UTF-8 bytes, where small and capital letters count as the same; or bytes in hexadecimal, with
/// spaces, commas or "0x" where one likes. The error says what is wrong.
[[nodiscard]] tl::expected<BytePattern, QString> parsePattern(const QString& text, bool isHexadecimal);

/// Nothing if the pattern does not occur.
[[nodiscard]] std::optional<std::size_t> findPattern(const BytePattern& pattern, wire::Bytes bytes);

/// Looks for a pattern in the packets of a log, on a thread of its own, from a packet on in one direction and
/// once around.
class PacketSearch {
public:
    struct Request {
        BytePattern pattern;
        std::uint64_t from = 0; ///< the packet after (or before) which it begins
        bool isForward = true;
        PacketNumbers among{}; ///< empty for all packets
    };
    struct Result {
        std::optional<model::FoundBytes> found;
        bool isWrapped = false; ///< it was found beyond the end (or the beginning)
        std::uint64_t gone = 0; ///< packets gone from the log before they were looked at
    };

    /// The log must outlive the search.
    PacketSearch(const log::PacketLog& log, Request request)
        : m_log(log),
          m_request(std::move(request)),
          m_thread([this](const std::stop_token& stop) { run(stop); }) {}

    /// Nothing while it is still looking.
    [[nodiscard]] std::optional<Result> result() const;
    /// Blocks until it is done.
    [[nodiscard]] Result wait();

private:
    void run(const std::stop_token& stop);

    const log::PacketLog& m_log;
    const Request m_request;
    std::atomic<bool> m_isDone = false;
    Result m_result;       ///< the thread's until m_isDone
    std::jthread m_thread; // last: it uses the others, and is stopped first
};

/// Finds the packets of a log that a filter lets through: a thread of its own reads those that the session
/// has followed, and then whatever is handed to it, until the run is destroyed, which stops it at once. What
/// is known about a packet beyond its bytes is the session's own digest, so that list and filter agree.
class PacketFilterRun {
public:
    /// The log of the session must outlive the run.
    PacketFilterRun(const model::SessionView& view, filter::Filter filter);

    /// What was found since the last call, in growing order. Has the thread look at the packets that were
    /// digested meanwhile; where the filter compares what is judged later, at those that were judged.
    [[nodiscard]] std::vector<std::uint64_t> take(const model::SessionView& view);

    /// Ends the search; what was found stays.
    void cancel() { m_thread.request_stop(); }
    [[nodiscard]] bool isCancelled() const { return m_thread.get_stop_token().stop_requested(); }

    /// Up to date if `done` has come to `total`.
    struct Progress {
        std::uint64_t done = 0;  ///< packets that it is through with
        std::uint64_t total = 0; ///< packets handed to it
        std::uint64_t gone = 0;  ///< of those that are done: gone from the log before they were looked at
    };
    [[nodiscard]] Progress progress() const;

    /// Blocks until everything handed to it was looked at, or the run was cancelled.
    void wait();

    [[nodiscard]] const PacketMatcher& matcher() const { return m_matcher; }

private:
    void run(const std::stop_token& stop);
    [[nodiscard]] std::optional<model::PacketDigests::Excerpt> nextExcerpt(const std::stop_token& stop);
    void lookAt(const model::PacketDigests::Excerpt& excerpt, log::LogFollower& follower,
                const std::stop_token& stop);
    void hand(std::vector<std::uint64_t>& found, const log::LogFollower& follower);

    const log::PacketLog& m_log;
    PacketMatcher m_matcher;     ///< the thread's, but for what never changes
    const std::uint64_t m_begin; ///< the first packet there was
    mutable std::mutex m_mutex;  ///< guards all that follows but the thread
    std::condition_variable_any m_changed;
    std::uint64_t m_next;      ///< the packet to be looked at next
    std::uint64_t m_end;       ///< of those handed to it
    std::uint64_t m_ahead = 0; ///< packets from m_end on that are gone: the session was too late for them too
    std::uint64_t m_gone = 0;  ///< with those
    std::vector<std::uint64_t> m_found;
    std::deque<model::PacketDigests::Excerpt> m_excerpts; ///< yet to be looked at
    std::jthread m_thread;                                // last: it uses the others, and is stopped first
};

/// Keeps a list of packets to those that the session's display filter lets through. It holds to a selected
/// range as well, until a packet beyond that is selected.
class ListFilter {
public:
    ListFilter(model::SessionView& view, PacketModel& list) : m_view(view), m_list(list) {}

    /// Takes over the session's filter, which any dock may have set, and lists what was found meanwhile.
    /// True if the filter is another one.
    bool follow();
    /// Ends the search; what was found stays.
    void cancel();

    [[nodiscard]] const QString& text() const { return m_wanted.text; }
    [[nodiscard]] bool hasRange() const { return m_wanted.range.has_value(); }
    /// Null if all packets are listed.
    [[nodiscard]] PacketFilterRun* run() const { return m_run.get(); }
    /// How far it has come through the packets that were there when it was set, from 0 to 1; empty once it is
    /// through.
    [[nodiscard]] std::optional<double> progress() const;
    /// What follow() found last was there when the filter was set.
    [[nodiscard]] bool isCatchingUp() const { return m_isCatchingUp; }
    /// Packets that left the log before they were looked at.
    [[nodiscard]] std::uint64_t missed() const { return m_missed; }

private:
    struct Wanted {
        QString text;
        std::optional<model::TimeRange> range;
        log::Stamp firstStamp{}; ///< from which times count: that of the first packet, once there is one
        friend bool operator==(const Wanted&, const Wanted&) = default;
    };
    void followRange();
    void start();

    model::SessionView& m_view;
    PacketModel& m_list;
    std::unique_ptr<PacketFilterRun> m_run;
    Wanted m_wanted;
    std::optional<model::TimeRange> m_chosenRange; ///< as it was last taken from the session
    std::optional<model::TimeRange> m_range;       ///< that the list holds to
    std::optional<std::uint64_t> m_selected;       ///< packet, when the range was last followed
    std::uint64_t m_done = 0;                      ///< packets that the run was through with, when last asked
    std::uint64_t m_backlog = 0;                   ///< packets that were there when the filter was set
    std::uint64_t m_missed = 0;
    bool m_isCatchingUp = false;
};

} // namespace posewire::gui
