// SPDX-License-Identifier: MIT
#include "core/feed/joint_feed.h"

#include "core/wire/header.h"

#include <algorithm>

namespace posewire::feed {
namespace {

constexpr int kParts = 64;

PoseSource withoutEnd(PoseSource source) {
    source.endPacket = UINT64_MAX;
    return source;
}

} // namespace

JointFeed::JointFeed(PoseSource source, bool isSent, log::Duration window)
    : m_source(std::move(source)),
      m_isSent(isSent),
      m_part(window / kParts),
      m_poses(withoutEnd(m_source), PoseContent::Segments, model::kSentTogether),
      m_follower(*m_source.log, m_source.firstPacket) {
    m_poses.update(m_source);
}

void JointFeed::update(PoseSource newest) {
    m_source = std::move(newest);
    m_poses.update(m_source);
}

bool JointFeed::advance(log::Stamp now) {
    return m_isSent
               ? readSent()
               : m_poses.advance(
                     [this](const PoseSample& sample) {
                         const auto& body = m_poses.characterOf(sample).bodyAt(sample.pose.packet);
                         add(sample.pose.stamp, model::anglesOf(sample.pose, model::stanceOf(body.places)));
                     },
                     now);
}

bool JointFeed::readSent() {
    constexpr int kPacketsAtOnce = 2048;
    m_follower.refresh();
    for (int count = 0; count < kPacketsAtOnce; ++count) {
        const auto packet = m_follower.next(m_source.endPacket);
        if (!packet) {
            return count != 0;
        }
        const auto header = wire::decodeHeader(packet->bytes);
        if (packet->flags.skipped || !header || header->type() != wire::JointAngles::kType) {
            continue;
        }
        const bool isIts =
            std::ranges::any_of(m_source.characters.front().parts, [&](const PoseCharacter::Part& part) {
                return part.key == model::CharacterKey{packet->sender, header->character};
            });
        if (isIts && wire::decodeInto(packet->bytes, m_datagram)) {
            add(packet->stamp, model::anglesOf(std::get<wire::JointAngles>(m_datagram.body)));
        }
    }
    return true;
}

void JointFeed::add(log::Stamp stamp, const model::BodyAngles& angles) {
    const bool isDivided = m_part > log::Duration::zero();
    if (m_parts.empty() || (isDivided && stamp - m_parts.back().first >= m_part)) {
        m_parts.emplace_back(stamp, model::JointExtents());
    }
    m_parts.back().second.add(angles);
    while (isDivided && stamp - m_parts.front().first > kParts * m_part) {
        m_parts.pop_front();
    }
}

model::JointExtents JointFeed::extents() const {
    model::JointExtents all;
    for (const auto& [begin, part] : m_parts) {
        all.add(part);
    }
    return all;
}

} // namespace posewire::feed
