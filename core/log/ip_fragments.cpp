// SPDX-License-Identifier: MIT
#include "core/log/ip_fragments.h"

#include <algorithm>

namespace posewire::log {
namespace {

/// No IP packet is larger.
constexpr std::uint32_t kLargest = 65535;

bool belongTogether(const IpPacket& first, const IpPacket& second) {
    return first.identity == second.identity && first.protocol == second.protocol &&
           first.sender == second.sender && first.target == second.target;
}

} // namespace

void IpFragments::add(const IpPacket& fragment, std::uint64_t fileOffset, std::optional<Stamp> stamp,
                      const Visitor& visit) {
    if (fragment.bytes.empty() || fragment.fragmentOffset + fragment.bytes.size() > kLargest) {
        return;
    }
    Pending& pending = pendingOf(fragment, visit);
    pending.stamp = stamp;
    if (fragment.fragmentOffset == 0) {
        pending.packet = fragment;
        pending.packet.bytes = {}; // they are not valid any longer than this call
    }
    if (!fragment.hasMoreFragments) {
        pending.size = fragment.fragmentOffset + static_cast<std::uint32_t>(fragment.bytes.size());
    }
    // Fragments that overlap without end are nobody's honest packet.
    if (pending.kept + fragment.bytes.size() <= std::size_t{2} * kLargest) {
        const auto [place, isNew] = pending.pieces.try_emplace(
            fragment.fragmentOffset, Piece{{fragment.bytes.begin(), fragment.bytes.end()}, fileOffset});
        pending.kept += isNew ? fragment.bytes.size() : 0;
    }
    if (isWhole(pending)) {
        give(pending, visit);
        std::erase_if(m_pending, [&](const Pending& one) { return &one == &pending; });
    }
}

void IpFragments::finish(const Visitor& visit) {
    for (const Pending& pending : m_pending) {
        give(pending, visit);
    }
    m_pending.clear();
}

IpFragments::Pending& IpFragments::pendingOf(const IpPacket& fragment, const Visitor& visit) {
    const auto found = std::ranges::find_if(
        m_pending, [&](const Pending& pending) { return belongTogether(pending.packet, fragment); });
    if (found != m_pending.end()) {
        return *found;
    }
    if (m_pending.size() == kMostPending) {
        give(m_pending.front(), visit);
        m_pending.pop_front();
    }
    Pending& added = m_pending.emplace_back();
    added.packet = fragment;
    added.packet.bytes = {};
    return added;
}

/// As far as it goes without a hole; of bytes that came twice the first count.
std::vector<std::byte> IpFragments::beginningOf(const Pending& pending) {
    std::vector<std::byte> bytes;
    for (const auto& [offset, piece] : pending.pieces) {
        if (offset > bytes.size()) {
            break;
        }
        const std::size_t known = bytes.size() - offset;
        if (known < piece.bytes.size()) {
            bytes.insert(bytes.end(), piece.bytes.begin() + static_cast<std::ptrdiff_t>(known),
                         piece.bytes.end());
        }
    }
    return bytes;
}

bool IpFragments::isWhole(const Pending& pending) {
    std::size_t reached = 0;
    for (const auto& [offset, piece] : pending.pieces) {
        if (offset > reached) {
            return false;
        }
        reached = std::max(reached, offset + piece.bytes.size());
    }
    return pending.size && reached >= *pending.size;
}

void IpFragments::give(const Pending& pending, const Visitor& visit) {
    if (pending.pieces.empty() || pending.pieces.begin()->first != 0) {
        return;
    }
    const std::vector<std::byte> bytes = beginningOf(pending);
    visit({pending.packet, bytes, pending.pieces.begin()->second.fileOffset, pending.stamp});
}

} // namespace posewire::log
