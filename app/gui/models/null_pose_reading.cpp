// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/null_pose_reading.h"

#include "core/model/session/ingest.h"

#include "app/gui/models/shown_character.h"

namespace posewire::gui {

namespace {

template <class T>
std::optional<T> bodyOf(const model::Message* message) {
    const T* body = message == nullptr ? nullptr : std::get_if<T>(&message->datagram.body);
    return body == nullptr ? std::nullopt : std::optional<T>(*body);
}

} // namespace

NullPoseReading::Signature NullPoseReading::signatureOf(const model::NullPoseEvidence& evidence) const {
    Signature signature;
    signature.key = m_key;
    const model::NullPoseRecord& record = evidence.record;
    if (record.pose != nullptr) {
        signature.message = record.pose->message;
        signature.packet = record.pose->packet;
    }
    signature.messages = record.messages;
    signature.changed = record.changed;
    signature.segments = evidence.layout ? evidence.layout->count() : 0;
    signature.isDue = evidence.poseSeconds >= model::kScaleMessageDue;
    signature.isOverdue = record.newest != nullptr && !record.newest->isComplete() &&
                          log::secondsOf(evidence.now - record.newest->stamp) >= model::kPartOverdue;
    if (const auto* message = m_view.message(*m_key, wire::ScaleInformation::kType)) {
        signature.scalePacket = message->packet;
    }
    if (const auto* message = m_view.message(*m_key, wire::PropInformation::kType)) {
        signature.propPacket = message->packet;
    }
    return signature;
}

bool NullPoseReading::refresh() {
    m_key = shownCharacter(m_view);
    const model::NullPoseEvidence evidence =
        m_key ? m_view.nullPoseEvidence(*m_key) : model::NullPoseEvidence();
    const Signature signature = m_key ? signatureOf(evidence) : Signature();
    m_newest = evidence.record.newest == nullptr ? std::nullopt : std::optional(*evidence.record.newest);
    if (signature == m_signature) {
        return false;
    }
    m_signature = signature;
    take(evidence);
    return true;
}

void NullPoseReading::take(const model::NullPoseEvidence& evidence) {
    const model::NullPoseRecord& record = evidence.record;
    m_messages = record.messages;
    m_repetition = record.repetition;
    m_changed = record.changed;
    m_findings = model::findContradictions(evidence);
    const auto* scale = m_key ? m_view.message(*m_key, wire::ScaleInformation::kType) : nullptr;
    m_scale = bodyOf<wire::ScaleInformation>(scale);
    m_scaleStamp = scale == nullptr ? log::Stamp() : scale->stamp;
    m_props =
        bodyOf<wire::PropInformation>(m_key ? m_view.message(*m_key, wire::PropInformation::kType) : nullptr);
    m_fromBefore.clear();
    m_fromReference.clear();
    m_measures = {};
    m_places.fill(-1);
    m_pose.reset();
    if (record.pose == nullptr) {
        return;
    }
    m_pose = *record.pose;
    m_places = model::bodyPlaces(*m_pose);
    m_measures = model::measure(*m_pose);
    if (record.before != nullptr) {
        m_fromBefore = model::distancesTo(*m_pose, *record.before);
    }
    if (m_measures.height && *m_measures.height > 0) {
        m_fromReference = model::distancesToReference(*m_pose, *m_measures.height);
    }
}

int NullPoseReading::segmentAt(int place) const {
    const int body = model::bodySegmentAt(m_places, place);
    return body >= 0 ? body : place;
}

int NullPoseReading::selectedPlace() const {
    const model::Selection& selection = m_view.selection();
    if (!m_pose || selection.segment < 0 || selection.character != m_key) {
        return -1;
    }
    const int count = static_cast<int>(m_pose->segments.size());
    const int place = selection.segment < model::kBodySegmentCount
                          ? m_places[static_cast<std::size_t>(selection.segment)]
                          : selection.segment;
    return place < count ? place : -1;
}

} // namespace posewire::gui
