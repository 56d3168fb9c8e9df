// SPDX-License-Identifier: MIT
#include "core/model/packet_digest.h"

#include <algorithm>

namespace posewire::model {
namespace {

constexpr double kSecondsPerNs = 1e-9;
// RFC 3550 appendix A.1: a jump that is no loss.
constexpr std::uint32_t kMostBack = 100;
constexpr std::uint32_t kMostForward = 3'000;

/// Types 10 to 13 carry sample 0 and are sent again and again on purpose.
bool countsSamples(std::uint8_t type) {
    return type < 10 || type > 13;
}

} // namespace

PacketDigest PacketDigester::add(const log::Packet& packet, const wire::Datagram* datagram) {
    PacketDigest digest;
    digest.isTruncated = packet.flags.truncated;
    digest.followsDrops = packet.kernelDropsBefore != 0;
    if (datagram == nullptr) {
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
    const wire::Header& header = datagram->header;
    digest.type = header.type();
    digest.character = header.character;
    digest.hasNotices = !datagram->notices.empty();
    const log::StreamKey key{packet.source, header.character, header.type()};
    auto stream = m_streams.find(key);
    if (stream == m_streams.end()) {
        if (m_streams.size() == log::StreamIndex::kStreamLimit) {
            return digest;
        }
        stream = m_streams.try_emplace(key).first;
    }
    Recent& recent = stream->second;
    if (recent.isKnown) {
        digest.deltaS = static_cast<float>(
            std::max(0.0, static_cast<double>(packet.stampNs - recent.stampNs) * kSecondsPerNs));
    }
    recent.isKnown = true;
    recent.stampNs = packet.stampNs;
    if (countsSamples(digest.type)) {
        compare(header, recent, digest);
    }
    return digest;
}

void PacketDigester::compare(const wire::Header& header, Recent& recent, PacketDigest& digest) {
    const std::uint32_t sample = header.sampleCounter;
    const std::uint8_t index = header.datagramIndex();
    const auto kept = std::min(recent.count, Recent::kKept);
    const auto begin = recent.arrivals.begin();
    digest.isDuplicate =
        std::any_of(begin, begin + static_cast<std::ptrdiff_t>(kept), [&](const Recent::Arrival& arrival) {
            return arrival.sample == sample && arrival.datagram == index;
        });
    if (recent.count == 0) {
        recent.highest = sample;
    } else if (!digest.isDuplicate && sample != recent.highest) {
        const std::uint32_t forward = sample - recent.highest;
        const std::uint32_t back = recent.highest - sample;
        if (back <= kMostBack) {
            digest.isReordered = true;
        } else if (forward > kMostForward) {
            digest.isRestart = true;
            recent.highest = sample;
            recent.count = 0;
        } else {
            const std::uint32_t step = recent.step.value();
            digest.gap = step != 0 && forward > step ? forward / step - 1 : 0;
            recent.step.add(forward);
            recent.highest = sample;
        }
    }
    recent.arrivals[recent.count % Recent::kKept] = {sample, index};
    ++recent.count;
}

void PacketDigests::append(std::uint64_t number, const PacketDigest& digest) {
    if (m_blocks.empty()) {
        m_firstOfBlocks = m_begin = m_end = number;
    }
    while (number - m_firstOfBlocks >= m_blocks.size() * kBlock) {
        m_blocks.push_back(std::make_unique<Block>());
    }
    const std::uint64_t place = number - m_firstOfBlocks;
    Block& block = *m_blocks[place / kBlock];
    block.digests[place % kBlock] = digest;
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

const PacketDigest* PacketDigests::find(std::uint64_t number) const {
    if (number < m_begin || number >= m_end) {
        return nullptr;
    }
    const std::uint64_t place = number - m_firstOfBlocks;
    return &m_blocks[place / kBlock]->digests[place % kBlock];
}

std::optional<std::uint64_t> PacketDigests::nextProblem(std::uint64_t after) const {
    for (std::uint64_t number = std::max(after + 1, m_begin); number < m_end;) {
        const std::uint64_t place = number - m_firstOfBlocks;
        if (m_blocks[place / kBlock]->problems == 0) {
            number += kBlock - place % kBlock;
        } else if (find(number)->isProblem()) {
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
        if (m_blocks[place / kBlock]->problems == 0) {
            end -= std::min(end - m_begin, place % kBlock + 1);
        } else if (find(end - 1)->isProblem()) {
            return end - 1;
        } else {
            --end;
        }
    }
    return std::nullopt;
}

} // namespace posewire::model
