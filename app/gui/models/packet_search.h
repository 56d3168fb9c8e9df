// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/packet_log.h"
#include "core/wire/types.h"

#include <QString>

#include <tl/expected.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace posewire::gui {

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
        std::vector<std::uint64_t> among{}; ///< in growing order; empty for all packets
    };
    struct Result {
        std::optional<std::uint64_t> packet; ///< nothing: nowhere
        std::size_t offset = 0;              ///< of the first byte in the packet
        bool isWrapped = false;              ///< it was found beyond the end (or the beginning)
    };

    /// The log must outlive the search.
    PacketSearch(const log::PacketLog& log, Request request);
    ~PacketSearch();
    PacketSearch(const PacketSearch&) = delete;
    PacketSearch& operator=(const PacketSearch&) = delete;

    /// Nothing while it is still looking.
    [[nodiscard]] std::optional<Result> result() const;
    /// Blocks until it is done.
    [[nodiscard]] Result wait();

private:
    void run();

    const log::PacketLog& m_log;
    const Request m_request;
    std::atomic<bool> m_isCancelled = false;
    std::atomic<bool> m_isDone = false;
    Result m_result; ///< the thread's until m_isDone
    std::thread m_thread;
};

} // namespace posewire::gui
