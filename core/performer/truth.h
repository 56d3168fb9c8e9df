// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/stream_truth.h"
#include "core/wire/codec.h"

#include <compare>
#include <cstdint>
#include <map>

namespace posewire::performer {

/// What a receiver that misses nothing has to count about one sender.
struct SenderFigures {
    std::uint64_t datagrams = 0; ///< that can be decoded
    std::uint64_t bytes = 0;     ///< of these and of malformed ones
    std::uint64_t malformed = 0; ///< begin with MXTP and cannot be decoded
    std::uint64_t foreign = 0;   ///< do not begin with MXTP

    friend bool operator==(const SenderFigures&, const SenderFigures&) = default;
};

/// Keeps book of everything that one socket really sends, in the order of sending. The codec decides
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

} // namespace posewire::performer
