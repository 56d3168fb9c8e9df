// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/null_pose_reading.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/session/messages.h"

namespace posewire::gui {

NullPoseReading::Signature NullPoseReading::signatureOf(const model::CharacterKey& key,
                                                        const model::NullPoseEvidence& evidence) const {
    Signature signature;
    signature.key = key;
    const model::NullPoseRecord& record = evidence.record;
    if (record.pose != nullptr) {
        signature.packet = record.pose->packet;
    }
    signature.messages = record.messages;
    signature.changed = record.changed;
    signature.segments = evidence.layout ? evidence.layout->count() : 0;
    signature.isDue = evidence.poseSeconds >= model::kScaleMessageDue;
    signature.isOverdue = record.newest != nullptr && !record.newest->isComplete() &&
                          log::secondsOf(evidence.now - record.newest->stamp) >= model::kPartOverdue;
    if (const auto* message = m_view.messages().message(key, wire::ScaleInformation::kType)) {
        signature.scalePacket = message->packet;
        signature.scaleStamp = message->stamp;
    }
    if (const auto* message = m_view.messages().message(key, wire::PropInformation::kType)) {
        signature.propPacket = message->packet;
    }
    return signature;
}

bool NullPoseReading::refresh() {
    const auto key = shownCharacter(m_view);
    const model::NullPoseEvidence evidence =
        key ? m_view.messages().nullPoseEvidence(*key) : model::NullPoseEvidence();
    const Signature signature = key ? signatureOf(*key, evidence) : Signature();
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
    m_repetition = record.repetition;
    m_findings = model::findContradictions(evidence);
    m_scale = evidence.scale == nullptr ? std::nullopt : std::optional(*evidence.scale);
    const auto* sent =
        character() ? m_view.messages().message(*character(), wire::PropInformation::kType) : nullptr;
    const auto* props = sent == nullptr ? nullptr : std::get_if<wire::PropInformation>(&sent->datagram.body);
    m_props = props == nullptr ? std::nullopt : std::optional(*props);
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
    const model::Selection& selection = m_view.choices().selection;
    if (!m_pose || selection.segment < 0 || selection.character != character()) {
        return -1;
    }
    const int count = static_cast<int>(m_pose->segments.size());
    const int place = selection.segment < model::kBodySegmentCount
                          ? m_places[static_cast<std::size_t>(selection.segment)]
                          : selection.segment;
    return place < count ? place : -1;
}

namespace {

QString age(const NullPoseReading& reading, log::Stamp stamp) {
    const double seconds = log::secondsOf(reading.view().cursorStamp() - stamp);
    return duration(std::max(seconds, 0.0));
}

/// "10:42:17 · 3.2 s": scale messages come seconds apart.
QString whenAndAge(const NullPoseReading& reading, log::Stamp stamp) {
    return timeOfDay(reading.view().wallOf(stamp)).section(QLatin1Char('.'), 0, 0) + QStringLiteral(" · ") +
           age(reading, stamp);
}

PropertyValue parts(const NullPoseReading& reading) {
    if (!reading.newest()) {
        return {dash()};
    }
    const model::NullPoseMessage& message = *reading.newest();
    const QString whole =
        message.partsExpected == 0 ? QStringLiteral("?") : QString::number(message.partsExpected);
    const double silence = log::secondsOf(reading.view().cursorStamp() - message.stamp);
    Health health = silence >= model::kPartOverdue ? Health::Error : Health::Unknown;
    if (message.isComplete()) {
        health = Health::Good;
    }
    QString text = tr("%1 of %2").arg(message.partsReceived).arg(whole);
    QStringList missing;
    for (const unsigned part : message.missingParts) {
        missing += QString::number(part + 1);
    }
    if (!missing.isEmpty()) {
        text += tr(", no %1").arg(missing.join(QStringLiteral(", ")));
    }
    return {text, health, tr("Datagrams of the newest type 13 message")};
}

PropertyValue received(const NullPoseReading& reading) {
    if (!reading.newest()) {
        return {dash()};
    }
    return {whenAndAge(reading, reading.newest()->stamp), Health::Unknown,
            tr("When its newest part came, and how long ago")};
}

PropertyValue messages(const NullPoseReading& reading) {
    QString text = grouped(reading.messages());
    if (reading.repetition() > log::Duration::zero()) {
        text += tr(" · every %1").arg(duration(log::secondsOf(reading.repetition())));
    }
    return {text, Health::Unknown, tr("Type 13 messages so far, and the median time between them")};
}

PropertyValue changed(const NullPoseReading& reading) {
    if (reading.pose() == nullptr) {
        return {dash()};
    }
    if (reading.fromBefore().empty()) {
        return {tr("never"), Health::Unknown, tr("All messages said the same")};
    }
    return {whenAndAge(reading, reading.changed()), Health::Warning,
            tr("When a message said something else than the one before, and how long ago")};
}

template <auto kList>
PropertyValue countOf(const NullPoseReading& reading) {
    return reading.pose() == nullptr ? PropertyValue{dash()}
                                     : PropertyValue{grouped((reading.pose()->*kList).size())};
}

template <std::optional<double> model::NullPoseMeasures::*kLength>
PropertyValue metres(const NullPoseReading& reading) {
    const model::NullPoseMeasures& measures = reading.measures();
    if (!(measures.*kLength)) {
        return {dash()};
    }
    const QString text = fixed(*(measures.*kLength), 3) + QStringLiteral(" m");
    if (!measures.isEstimated) {
        return {text, Health::Unknown, tr("From the points that were sent")};
    }
    return {QStringLiteral("≈ ") + text, Health::Unknown,
            tr("Estimated: without points, head, hands and soles are those of the reference body")};
}

PropertyValue scale(const NullPoseReading& reading) {
    return reading.scale() == nullptr ? PropertyValue{tr("not sent")}
                                      : PropertyValue{tr("%1 segments · %2")
                                                          .arg(reading.scale()->segments.size())
                                                          .arg(age(reading, reading.scaleStamp()))};
}

PropertyValue props(const NullPoseReading& reading) {
    if (reading.props() == nullptr) {
        return {tr("not sent")};
    }
    QStringList names;
    constexpr std::size_t kMost = 16;
    const std::vector<wire::Prop>& sent = reading.props()->props;
    for (std::size_t i = 0; i < std::min(sent.size(), kMost); ++i) {
        names += QStringLiteral("%1 %2").arg(QString::number(sent[i].id), shownText(sent[i].name));
    }
    if (sent.size() > kMost) {
        names += tr("%1 more").arg(sent.size() - kMost);
    }
    return names.isEmpty() ? PropertyValue{tr("none")} : PropertyValue{names.join(QStringLiteral(", "))};
}

} // namespace

std::vector<Property> nullPoseFacts(const NullPoseReading& reading) {
    return propertiesOf(reading, {{tr("Parts"), parts},
                                  {tr("Received"), received},
                                  {tr("Messages"), messages},
                                  {tr("Changed"), changed},
                                  {tr("Segments"), countOf<&model::NullPose::segments>},
                                  {tr("Points"), countOf<&model::NullPose::points>},
                                  {tr("Height"), metres<&model::NullPoseMeasures::height>},
                                  {tr("Arm span"), metres<&model::NullPoseMeasures::armSpan>},
                                  {tr("Type 10"), scale},
                                  {tr("Props (11)"), props}});
}

Health healthOf(model::Severity severity) {
    return severity == model::Severity::Error     ? Health::Error
           : severity == model::Severity::Warning ? Health::Warning
                                                  : Health::Unknown;
}

QString findingsText(const std::vector<model::NullPoseFinding>& findings) {
    QString text;
    for (const model::NullPoseFinding& finding : findings) {
        const Health health = healthOf(finding.severity());
        text += (health == Health::Unknown ? QStringLiteral("○") : healthSymbol(health)) + QLatin1Char(' ') +
                said(finding.fact, words::Form::Sentence) + QLatin1Char(' ') +
                said(finding.fact, words::Form::Advice) + QLatin1Char('\n');
    }
    return text;
}

} // namespace posewire::gui
