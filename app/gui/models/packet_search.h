// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/packet_numbers.h"
#include "core/filter/filter.h"
#include "core/log/log_reader.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/session/session_view.h"
#include "core/wire/types.h"

#include <QString>

#include <tl/expected.hpp>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace posewire::gui {

/// What senders' positions come in, by sender and message type, as far as that is another unit than usual.
/// A copy: a thread may have one while the session follows the log.
using PositionUnits = std::map<std::pair<log::SenderId, std::uint8_t>, model::LengthUnit>;

[[nodiscard]] PositionUnits unusualPositionUnits(const model::SessionView& view);

/// Empty for the usual one.
[[nodiscard]] std::optional<model::LengthUnit> unitIn(const PositionUnits& units, log::SenderId sender,
                                                      std::uint8_t type);

/// What is looked for in the bytes of packets.
struct BytePattern {
    std::vector<std::byte> bytes;
    bool ignoresCase = false; ///< of the letters a to z
};

/// Text as its UTF-8 bytes, where small and capital letters count as the same; or bytes in hexadecimal, with
/// spaces, commas or "0x" where one likes. The error says what is wrong.
[[nodiscard]] tl::expected<BytePattern, QString> parsePattern(const QString& text, bool isHexadecimal);

/// Where a pattern begins in bytes; nothing where it does not occur.
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
        std::optional<std::uint64_t> packet; ///< nothing: nowhere
        std::size_t offset = 0;              ///< of the first byte in the packet
        std::size_t size = 0;                ///< how many bytes were looked for
        bool isWrapped = false;              ///< it was found beyond the end (or the beginning)
        std::uint64_t gone = 0;              ///< packets gone from the log before they were looked at
    };

    /// The log must outlive the search.
    PacketSearch(const log::PacketLog& log, Request request);

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
    PacketFilterRun(const model::SessionView& view, filter::Filter filter, PositionUnits units = {});

    struct Found {
        std::vector<std::uint64_t> packets;  ///< in growing order
        std::vector<std::uint64_t> problems; ///< those of them that are problems
    };
    /// What was found since the last call. Has the thread look at the packets that were digested meanwhile;
    /// where the filter compares what is judged later, at those that were judged.
    [[nodiscard]] Found take(const model::SessionView& view);

    /// Ends the search; what was found stays.
    void cancel() { m_thread.request_stop(); }
    [[nodiscard]] bool isCancelled() const { return m_thread.get_stop_token().stop_requested(); }

    /// How far it is. Up to date where `done` has come to `total`.
    struct Progress {
        std::uint64_t done = 0;  ///< packets that it is through with
        std::uint64_t total = 0; ///< packets handed to it
        std::uint64_t gone = 0;  ///< of those that are done: gone from the log before they were looked at
    };
    [[nodiscard]] Progress progress() const;

    /// Blocks until everything handed to it was looked at, or the run was cancelled.
    void wait();

private:
    [[nodiscard]] std::uint64_t endOf(const model::SessionView& view) const;
    void run(const std::stop_token& stop);
    [[nodiscard]] std::optional<model::PacketDigests::Excerpt> nextExcerpt(const std::stop_token& stop);
    void lookAt(const model::PacketDigests::Excerpt& excerpt, log::LogFollower& follower,
                const std::stop_token& stop);
    [[nodiscard]] bool isMatch(const log::Packet& packet, const model::PacketDigest& digest,
                               log::SenderFinder& senders);
    void hand(Found& found, const log::LogFollower& follower);

    const log::PacketLog& m_log;
    const filter::Filter m_filter;
    const log::Stamp m_firstStamp;
    const PositionUnits m_units;
    const std::uint64_t m_begin; ///< the first packet there was
    wire::Datagram m_datagram;   // the thread's
    mutable std::mutex m_mutex;  ///< guards all that follows but the thread
    std::condition_variable_any m_changed;
    std::uint64_t m_next;      ///< the packet to be looked at next
    std::uint64_t m_end;       ///< of those handed to it
    std::uint64_t m_ahead = 0; ///< packets from m_end on that are gone: the session was too late for them too
    std::uint64_t m_gone = 0;  ///< with those
    Found m_found;
    std::deque<model::PacketDigests::Excerpt> m_excerpts; ///< yet to be looked at
    std::jthread m_thread;                                // last: it uses the others, and is stopped first
};

} // namespace posewire::gui
