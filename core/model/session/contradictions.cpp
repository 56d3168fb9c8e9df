// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_findings.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/session/ingest.h"

#include <optional>
#include <utility>
#include <vector>

/// What senders say that contradicts itself.
namespace posewire::model {
namespace {

/// Whether senders contradict themselves is looked at this often.
constexpr log::Duration kContradictions = std::chrono::milliseconds(500);

} // namespace

void Ingest::lookForContradictions() {
    if (m_observed < m_nextContradictions) {
        return;
    }
    m_nextContradictions = m_observed + kContradictions;
    for (const Sender& sender : m_senders) {
        if (sender.isPerforming()) {
            const auto found = hasEnded(sender) ? std::vector<Contradiction>() : sender.contradictions();
            m_incidents->takeContradiction(sender.id, std::nullopt, m_observed,
                                           found.empty() ? "" : found.front().text);
        }
    }
}

void Ingest::setOverride(log::SenderId sender, const SenderOverride& overrides) {
    if (Sender* known = m_senders.find(sender)) {
        known->overrides = overrides;
        m_nextContradictions = {};
        lookForContradictions();
    }
}

/// Once for each that differs, as soon as it is whole.
void Ingest::lookAtNullPose(const NullPoseRecord& record, Character& character, const log::Packet& packet) {
    const bool isWhole = record.pose != nullptr && record.pose->isComplete();
    if (isWhole && record.changed != std::exchange(character.judgedNullPose, record.changed)) {
        m_incidents->takeContradiction(packet.sender, character.key.character, packet.stamp,
                                       gravestError(record));
    }
}

} // namespace posewire::model
