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

/// A sentence as it is said after a colon.
std::string clauseOf(std::string text) {
    const bool isWord = text.size() > 1 && text[1] >= 'a' && text[1] <= 'z';
    if (isWord && text[0] >= 'A' && text[0] <= 'Z') {
        text[0] = static_cast<char>(text[0] - 'A' + 'a');
    }
    text.erase(text.find_last_not_of('.') + 1);
    return text;
}

} // namespace

void Ingest::lookForContradictions() {
    if (m_observed < m_nextContradictions) {
        return;
    }
    m_nextContradictions = m_observed + kContradictions;
    for (const Sender& sender : m_senders) {
        if (sender.isPerforming()) {
            const auto found = hasEnded(sender) ? std::vector<words::Fact>() : sender.contradictions();
            m_incidents->takeContradiction(sender.id, std::nullopt, m_observed,
                                           found.empty() ? words::Fact() : found.front());
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
        const std::string error = gravestError(record);
        m_incidents->takeContradiction(
            packet.sender, character.key.character, packet.stamp,
            error.empty()
                ? words::Fact()
                : words::Fact{words::Kind::Contradiction, {{"text", error}, {"clause", clauseOf(error)}}});
    }
}

} // namespace posewire::model
