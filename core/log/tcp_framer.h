// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace posewire::log {

/// Cuts a byte stream (TCP, a file of raw datagrams) into datagrams. MXTP has no framing of its own:
/// datagrams follow each other without a length before them, older senders leave out the payload size, and
/// the four letters may occur inside float data.
///
/// The same bytes give the same pieces however they are sliced. Every byte ends up in exactly one piece. A
/// datagram that decodes cleanly comes out as soon as its last byte is there; a doubtful one waits for what
/// follows it.
class TcpFramer {
public:
    enum class Kind : std::uint8_t {
        Datagram, ///< begins with a header; whether it is sound, only decoding shows
        Skipped,  ///< belongs to no datagram; a long run comes in pieces of kLongestSkip
    };
    struct Piece {
        std::uint64_t offset;             ///< of the first byte in the stream
        std::span<const std::byte> bytes; ///< valid during the call
        Kind kind;
    };
    using Visitor = std::function<void(const Piece&)>;

    /// Besides a copy of what is not decided yet, at most this much, the framer keeps nothing.
    static constexpr std::size_t kMostKept = (std::size_t{64} << 10) + 24;
    static constexpr std::size_t kLongestSkip = std::size_t{64} << 10;

    TcpFramer();

    void push(std::span<const std::byte> bytes, const Visitor& visit);

    /// The stream has ended: what is left comes out, a datagram that was cut off as a datagram. Afterwards
    /// the framer is ready for another stream.
    void finish(const Visitor& visit);

    [[nodiscard]] std::uint64_t skippedBytes() const { return m_skippedBytes; }
    [[nodiscard]] std::size_t kept() const { return m_kept.size(); }

private:
    struct Window;

    std::size_t parse(std::span<const std::byte> bytes, bool isAtEnd, const Visitor& visit);
    bool step(Window& window);
    bool stepDatagram(Window& window, std::size_t size);
    bool stepUnknownSize(Window& window);
    bool stepCutOff(Window& window);
    void skipTo(Window& window, std::size_t position);
    bool deliver(Window& window, std::size_t size);
    void pass(Window& window, std::size_t end, Kind kind);
    bool await(const Window& window, std::size_t size);
    bool isTrusted(std::span<const std::byte> datagram);

    std::vector<std::byte> m_kept;
    std::size_t m_ruledOut = 0; ///< this many bytes from the front are known to begin no datagram
    std::size_t m_need = 0;     ///< nothing can be decided before this many are there
    std::uint64_t m_offset = 0; ///< in the stream, of the first byte not yet given out
    std::uint64_t m_skippedBytes = 0;
    bool m_isInStep = true; ///< what was before was a datagram, or nothing
    wire::Datagram m_scratch;
};

} // namespace posewire::log
