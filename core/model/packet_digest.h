// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/stream_index.h"
#include "core/model/sample_step.h"
#include "core/wire/codec.h"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <unordered_map>

namespace posewire::model {

enum class PacketKind : std::uint8_t {
    Datagram,  ///< decoded
    Malformed, ///< begins with MXTP and cannot be decoded
    Foreign,   ///< does not begin with MXTP
    Skipped,   ///< bytes of a byte stream that belong to no datagram
};

/// What can be told about a packet without its bytes at hand: enough to list it, to colour it and to find
/// problems among millions. How it relates to the packets of its stream before it was known when it came.
struct PacketDigest {
    float deltaS = -1;     ///< seconds since the packet before it in its stream, -1 for the first of a stream
    std::uint32_t gap = 0; ///< samples that are missing just before it, counted in the stream's own step
    PacketKind kind = PacketKind::Datagram;
    std::uint8_t type = 0; ///< of a Datagram or where the header of a Malformed one could be read, else 0
    std::uint8_t character = 0;    ///< likewise
    bool isDuplicate : 1 = false;  ///< the same sample and datagram counter came before
    bool isReordered : 1 = false;  ///< its sample counter is below the highest one seen (RFC 4737 §3)
    bool isRestart : 1 = false;    ///< the sender's counter has begun anew
    bool hasNotices : 1 = false;   ///< odd but readable
    bool isTruncated : 1 = false;  ///< longer than what could be received
    bool followsDrops : 1 = false; ///< this computer dropped datagrams of its socket just before it

    /// Whether an operator who looks for trouble wants to stop here.
    [[nodiscard]] bool isProblem() const {
        return kind != PacketKind::Datagram || gap != 0 || isDuplicate || isReordered || isRestart ||
               hasNotices || isTruncated || followsDrops;
    }
};
static_assert(sizeof(PacketDigest) == 12, "one is kept for every packet of the log");

/// Makes digests of packets in the order of the log. Deterministic: whoever walks over the same packets from
/// the same beginning gets the same digests. Memory is bounded: of streams beyond StreamIndex::kStreamLimit
/// nothing is compared.
class PacketDigester {
public:
    /// `datagram` is what the packet was decoded to, null where that failed.
    PacketDigest add(const log::Packet& packet, const wire::Datagram* datagram);

private:
    /// The newest datagrams of one stream.
    struct Recent {
        static constexpr std::size_t kKept = 64;
        struct Arrival {
            std::uint32_t sample;
            std::uint8_t datagram;
        };
        std::array<Arrival, kKept> arrivals{};
        std::size_t count = 0;     ///< since the counter last began
        std::uint32_t highest = 0; ///< sample counter
        std::int64_t stampNs = 0;
        bool isKnown = false;
        SampleStep step;
    };
    struct Hash {
        std::size_t operator()(const log::StreamKey& key) const {
            return (static_cast<std::size_t>(key.source) << 16 | std::size_t{key.character} << 8 | key.type) *
                   0x9e3779b97f4a7c15U;
        }
    };
    static void compare(const wire::Header& header, Recent& recent, PacketDigest& digest);

    std::unordered_map<log::StreamKey, Recent, Hash> m_streams;
};

/// The digests of the packets that a log holds. Belongs to one thread.
class PacketDigests {
public:
    /// Numbers grow; those that are left out have an empty digest.
    void append(std::uint64_t number, const PacketDigest& digest);
    void dropBefore(std::uint64_t begin);

    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    [[nodiscard]] std::uint64_t end() const { return m_end; }

    /// Null outside [begin, end).
    [[nodiscard]] const PacketDigest* find(std::uint64_t number) const;

    /// The nearest problem after or before a packet; nothing where there is none.
    [[nodiscard]] std::optional<std::uint64_t> nextProblem(std::uint64_t after) const;
    [[nodiscard]] std::optional<std::uint64_t> previousProblem(std::uint64_t before) const;

private:
    static constexpr std::size_t kBlock = 4096;
    struct Block {
        std::array<PacketDigest, kBlock> digests;
        std::size_t problems = 0; ///< a block without one is passed over
    };

    std::deque<std::unique_ptr<Block>> m_blocks;
    std::uint64_t m_firstOfBlocks = 0; ///< number of the first digest of the first block
    std::uint64_t m_begin = 0;
    std::uint64_t m_end = 0;
};

} // namespace posewire::model
