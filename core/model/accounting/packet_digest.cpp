// SPDX-License-Identifier: MIT
#include "core/model/accounting/packet_digest.h"

#include <algorithm>

namespace posewire::model {

PacketDigest digestOf(const log::Packet& packet, const wire::Datagram* datagram) {
    PacketDigest digest;
    digest.isTruncated = packet.flags.truncated;
    digest.followsDrops = packet.kernelDropsBefore != 0;
    if (datagram != nullptr) {
        digest.type = datagram->header.type();
        digest.character = datagram->header.character;
        digest.hasNotices = !datagram->notices.empty() || packet.flags.shared != 0;
        return digest;
    }
    const auto header = wire::decodeHeader(packet.bytes);
    digest.kind = packet.flags.skipped                  ? PacketKind::Skipped
                  : wire::startsWithMagic(packet.bytes) ? PacketKind::Malformed
                                                        : PacketKind::Foreign;
    if (header && digest.kind == PacketKind::Malformed) {
        digest.type = header->type();
        digest.character = header->character;
    }
    return digest;
}

void applyVerdict(const Verdict& verdict, PacketDigest& digest) {
    digest.gap = verdict.gap;
    digest.isDuplicate = verdict.isDuplicate;
    digest.isReordered = verdict.isReordered;
    digest.isRestart = verdict.isRestart;
    digest.isInDoubt = false;
}

std::span<const Verdict> addToStream(const log::Packet& packet, const wire::Header& header,
                                     StreamAccounting& accounting, PacketDigest& digest) {
    if (accounting.datagrams() != 0) {
        const double sinceS = log::secondsOf(packet.stamp - accounting.lastStamp());
        digest.deltaS = static_cast<float>(std::max(0.0, sinceS));
    }
    const bool wasInDoubt = accounting.isInDoubt();
    const auto verdicts = accounting.add(packet, header);
    if (!verdicts.empty() && verdicts.back().packet == packet.number) {
        applyVerdict(verdicts.back(), digest);
    } else {
        digest.isInDoubt = !wasInDoubt;
    }
    return verdicts;
}

PacketDigest PacketDigester::add(const log::Packet& packet, const wire::Datagram* datagram) {
    PacketDigest digest = digestOf(packet, datagram);
    m_newest = nullptr;
    if (datagram == nullptr) {
        return digest;
    }
    const wire::Header& header = datagram->header;
    const log::StreamKey key{packet.sender, header.character, header.type()};
    auto stream = m_streams.find(key);
    if (stream == m_streams.end()) {
        if (m_streams.size() == log::StreamIndex::kStreamLimit) {
            return digest;
        }
        stream = m_streams.try_emplace(key, key).first;
        stream->second.accounting.setDepth(m_depth);
        if (const auto depth = AccountingDepth::of(m_streams.size()); depth != m_depth) {
            m_depth = depth;
            for (auto& [each, other] : m_streams) {
                other.accounting.setDepth(depth);
            }
        }
    }
    const auto verdicts = addToStream(packet, header, stream->second.accounting, digest);
    stream->second.statistics.add(packet.stamp);
    stream->second.addSamples(packet.stamp, header, verdicts);
    m_newest = &stream->second;
    return digest;
}

void PacketDigests::append(std::uint64_t number, const PacketDigest& digest) {
    if (m_blocks.empty()) {
        m_firstOfBlocks = m_begin = m_end = number;
    }
    while (number - m_firstOfBlocks >= m_blocks.size() * kBlock) {
        m_blocks.push_back({m_scratch->make<Digests>()});
    }
    const std::uint64_t place = number - m_firstOfBlocks;
    Block& block = m_blocks[place / kBlock];
    (*block.digests)[place % kBlock] = digest;
    block.problems += digest.isProblem() ? 1 : 0;
    m_end = number + 1;
}

void PacketDigests::dropBefore(std::uint64_t begin) {
    m_begin = std::clamp(begin, m_begin, m_end);
    while (!m_blocks.empty() && m_begin - m_firstOfBlocks >= kBlock) {
        m_blocks.pop_front();
        m_firstOfBlocks += kBlock;
    }
}

void PacketDigests::amend(const Verdict& verdict) {
    change(verdict.packet, [&](PacketDigest& digest) { applyVerdict(verdict, digest); });
}

void PacketDigests::amendGap(std::uint64_t number, std::uint32_t gap) {
    change(number, [gap](PacketDigest& digest) { digest.gap = gap; });
}

template <class Change>
void PacketDigests::change(std::uint64_t number, Change&& change) {
    if (number < m_begin || number >= m_end) {
        return;
    }
    const std::uint64_t place = number - m_firstOfBlocks;
    Block& block = m_blocks[place / kBlock];
    if (block.digests.use_count() > 1) {
        block.digests = copyOf(*block.digests);
    }
    PacketDigest& digest = (*block.digests)[place % kBlock];
    block.problems -= digest.isProblem() ? 1 : 0;
    change(digest);
    block.problems += digest.isProblem() ? 1 : 0;
}

PacketDigests PacketDigests::excerpt(std::uint64_t from, std::uint64_t to) const {
    PacketDigests excerpt(m_scratch);
    excerpt.m_begin = std::clamp(from, m_begin, m_end);
    excerpt.m_end = std::clamp(to, excerpt.m_begin, m_end);
    if (excerpt.m_begin == excerpt.m_end) {
        return excerpt;
    }
    const std::uint64_t first = (excerpt.m_begin - m_firstOfBlocks) / kBlock;
    const std::uint64_t last = (excerpt.m_end - 1 - m_firstOfBlocks) / kBlock;
    excerpt.m_firstOfBlocks = m_firstOfBlocks + first * kBlock;
    excerpt.m_blocks.assign(m_blocks.begin() + static_cast<std::ptrdiff_t>(first),
                            m_blocks.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    const bool isComplete = m_end - m_firstOfBlocks >= (last + 1) * kBlock;
    if (!isComplete) {
        excerpt.m_blocks.back().digests = copyOf(*m_blocks.back().digests);
    }
    return excerpt;
}

std::shared_ptr<PacketDigests::Digests> PacketDigests::copyOf(const Digests& digests) const {
    std::shared_ptr<Digests> copy = m_scratch->make<Digests>();
    *copy = digests;
    return copy;
}

std::optional<std::uint64_t> PacketDigests::nextProblem(std::uint64_t after) const {
    for (std::uint64_t number = std::max(after + 1, m_begin); number < m_end;) {
        const std::uint64_t place = number - m_firstOfBlocks;
        if (m_blocks[place / kBlock].problems == 0) {
            number += kBlock - place % kBlock;
        } else if (at(number).isProblem()) {
            return number;
        } else {
            ++number;
        }
    }
    return std::nullopt;
}

std::optional<std::uint64_t> PacketDigests::previousProblem(std::uint64_t before) const {
    for (std::uint64_t end = std::min(before, m_end); end > m_begin;) {
        const std::uint64_t place = end - 1 - m_firstOfBlocks;
        if (m_blocks[place / kBlock].problems == 0) {
            end -= std::min(end - m_begin, place % kBlock + 1);
        } else if (at(end - 1).isProblem()) {
            return end - 1;
        } else {
            --end;
        }
    }
    return std::nullopt;
}

} // namespace posewire::model
