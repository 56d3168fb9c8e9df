// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/chunk_history.h"
#include "core/log/packet.h"
#include "core/log/scratch.h"
#include "core/log/stream_index.h"
#include "core/model/accounting/stream.h"
#include "core/wire/codec.h"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>

namespace posewire::model {

enum class PacketKind : std::uint8_t {
    Datagram,  ///< decoded
    Malformed, ///< begins with MXTP and cannot be decoded
    Foreign,   ///< does not begin with MXTP
    Skipped,   ///< bytes of a byte stream that belong to no datagram
};

/// What is known about a packet without its bytes at hand: enough to list it, to colour it and to find
/// problems among millions. How it relates to the packets of its stream before it is the verdict of the
/// stream's accounting: known when it came, or a few packets later where its sample counter was unexpected.
struct PacketDigest {
    float deltaS = -1;     ///< seconds since the packet before it in its stream, -1 for the first of a stream
    std::uint32_t gap = 0; ///< samples that are missing just before it, in the stream's own step
    PacketKind kind = PacketKind::Datagram;
    std::uint8_t type = 0; ///< of a Datagram or where the header of a Malformed one could be read, else 0
    std::uint8_t character = 0;    ///< likewise
    bool isDuplicate : 1 = false;  ///< the same sample and datagram counter came before
    bool isReordered : 1 = false;  ///< its sample counter is below the highest one seen (RFC 4737 §3)
    bool isRestart : 1 = false;    ///< the sender's counter restarted
    bool isInDoubt : 1 = false;    ///< its sample counter jumped: what comes next shows whether it restarted
    bool hasNotices : 1 = false;   ///< odd but readable
    bool isTruncated : 1 = false;  ///< longer than what could be received
    bool followsDrops : 1 = false; ///< this computer dropped datagrams of its socket just before it

    /// True if an operator who looks for trouble wants to stop here.
    [[nodiscard]] bool isProblem() const {
        return kind != PacketKind::Datagram || gap != 0 || isDuplicate || isReordered || isRestart ||
               isInDoubt || hasNotices || isTruncated || followsDrops;
    }
};
static_assert(sizeof(PacketDigest) == 12, "one is kept for every packet of the log");
static_assert(sizeof(log::StreamEntry) + sizeof(PacketDigest) + 2 <= log::kBesidePacket,
              "the cap of the log is for what is kept of its packets");

/// `datagram` is null if it could not be decoded.
[[nodiscard]] PacketDigest digestOf(const log::Packet& packet, const wire::Datagram* datagram);

/// Copies what a digest has of its verdict.
void applyVerdict(const Verdict& verdict, PacketDigest& digest);

/// Adds the packet of a digest to the accounting of its stream and copies the verdict, if there is one yet.
/// One that must wait for a verdict is in doubt where the doubt began with it; the verdicts on those before
/// it are among those returned.
std::span<const Verdict> addToStream(const log::Packet& packet, const wire::Header& header,
                                     StreamAccounting& accounting, PacketDigest& digest);

/// Makes digests of packets in the order of the log, without a session. Deterministic: whoever walks over the
/// same packets from the same beginning gets the same digests. Memory is bounded as that of a session: of
/// streams beyond StreamIndex::kStreamLimit nothing is compared.
class PacketDigester {
public:
    PacketDigest add(const log::Packet& packet, const wire::Datagram* datagram);

    /// That of the newest packet, which is counted; null if it has none.
    [[nodiscard]] const Stream* stream() const { return m_newest; }

private:
    std::unordered_map<log::StreamKey, Stream> m_streams;
    const Stream* m_newest = nullptr;
    AccountingDepth m_depth;
};

/// The digests of the packets that a log holds. Belongs to one thread.
class PacketDigests {
public:
    /// Digests as they were; for one other thread to read while more are appended.
    using Excerpt = PacketDigests;

    explicit PacketDigests(std::shared_ptr<log::Scratch> scratch = std::make_shared<log::Scratch>())
        : m_scratch(std::move(scratch)) {}

    /// Numbers grow; those that are left out have an empty digest.
    void append(std::uint64_t number, const PacketDigest& digest);
    void dropBefore(std::uint64_t begin);
    /// Corrects a digest by a verdict that took its time. Excerpts that were given out stay as they are.
    void amend(const Verdict& verdict);
    /// Likewise by what its gap lacks now that late arrivals and the step of the stream are known.
    void amendGap(std::uint64_t number, std::uint32_t gap);

    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    [[nodiscard]] std::uint64_t end() const { return m_end; }

    [[nodiscard]] std::size_t memoryBytes() const { return m_blocks.size() * sizeof(Digests); }

    /// The number must lie within.
    [[nodiscard]] const PacketDigest& at(std::uint64_t number) const {
        const std::uint64_t place = number - m_firstOfBlocks;
        return (*m_blocks[place / kBlock].digests)[place % kBlock];
    }
    /// Null outside [begin, end).
    [[nodiscard]] const PacketDigest* find(std::uint64_t number) const {
        return number < m_begin || number >= m_end ? nullptr : &at(number);
    }

    /// The nearest problem after or before a packet; empty if there is none.
    [[nodiscard]] std::optional<std::uint64_t> nextProblem(std::uint64_t after) const;
    [[nodiscard]] std::optional<std::uint64_t> previousProblem(std::uint64_t before) const;

    /// From a packet up to another; whole blocks are shared, at most one is copied.
    [[nodiscard]] Excerpt excerpt(std::uint64_t from, std::uint64_t to) const;

private:
    static constexpr std::size_t kBlock = 4096;
    using Digests = std::array<PacketDigest, kBlock>;
    struct Block {
        std::shared_ptr<Digests> digests;
        std::size_t problems = 0; ///< a block without one is passed over
    };

    template <class Change>
    void change(std::uint64_t number, Change&& change);
    [[nodiscard]] std::shared_ptr<Digests> copyOf(const Digests& digests) const;

    std::shared_ptr<log::Scratch> m_scratch;
    std::deque<Block> m_blocks;        ///< all but the last are complete
    std::uint64_t m_firstOfBlocks = 0; ///< number of the first digest of the first block
    std::uint64_t m_begin = 0;
    std::uint64_t m_end = 0;
};

} // namespace posewire::model
