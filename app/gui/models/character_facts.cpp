// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/character_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose.h"

namespace posewire::gui {

namespace {

using Key = model::CharacterKey;

QString withEvidence(const QString& conclusion, const std::string& evidence) {
    return evidence.empty() ? conclusion
                            : conclusion + QStringLiteral(" · ") + QString::fromStdString(evidence);
}

QString unitText(model::LengthUnit unit) {
    return unit == model::LengthUnit::Metre ? tr("metres") : tr("centimetres");
}

PropertyValue revision(model::SessionView& view, const Key& key) {
    const model::Sender* sender = view.find(key.sender);
    if (sender == nullptr) {
        return {};
    }
    const model::Detection& found = sender->detector.result();
    const QString detected =
        withEvidence(fromUtf8(model::revisionName(found.revision)), found.revisionEvidence);
    const QString toolTip = tr("Revision of the specification that this sender follows · the evidence");
    if (!sender->overrides.revision) {
        return {detected, Health::Unknown, toolTip};
    }
    return {tr("%1 · as you said").arg(fromUtf8(model::revisionName(sender->revision()))), Health::Unknown,
            toolTip + QLatin1Char('\n') + tr("Detected: %1").arg(detected)};
}

PropertyValue units(model::SessionView& view, const Key& key) {
    const model::Sender* sender = view.find(key.sender);
    if (sender == nullptr) {
        return {};
    }
    const model::Detection& found = sender->detector.result();
    const QString detected = found.unitEvidence.empty()
                                 ? tr("not known before type 02")
                                 : withEvidence(unitText(found.positionUnit), found.unitEvidence);
    const QString toolTip =
        tr("Unit of positions in types 02, 21 and 24, judged by what a person can be · the evidence");
    if (!sender->overrides.positionUnit) {
        return {detected, Health::Unknown, toolTip};
    }
    return {tr("%1 · as you said").arg(unitText(sender->positionUnit())), Health::Unknown,
            toolTip + QLatin1Char('\n') + tr("Detected: %1").arg(detected)};
}

PropertyValue address(model::SessionView& view, const Key& key) {
    const model::Sender* sender = view.find(key.sender);
    return sender == nullptr ? PropertyValue{} : PropertyValue{QString::fromStdString(sender->info.address)};
}

PropertyValue segments(model::SessionView& view, const Key& key) {
    const model::CharacterPose* pose = view.pose(key);
    if (pose == nullptr) {
        return {tr("no pose yet")};
    }
    const model::SegmentLayout& layout = pose->layout;
    return {tr("%1 body · %2 props · %3 fingers").arg(layout.body).arg(layout.props).arg(layout.fingers),
            Health::Unknown, tr("Items of a pose datagram, from the header's counts or their number")};
}

PropertyValue nullPose(model::SessionView& view, const Key& key) {
    const model::NullPose* pose = view.nullPose(key);
    if (pose == nullptr || pose->segments.empty()) {
        return {tr("not received · reference body"), Health::Unknown,
                tr("Type 13 has not arrived: proportions of a reference body are used.")};
    }
    const QString expected =
        pose->partsExpected == 0 ? QStringLiteral("?") : QString::number(pose->partsExpected);
    const QString text =
        tr("%1/%2 parts · %3 points").arg(pose->partsReceived).arg(expected).arg(pose->points.size());
    return {
        text, pose->isComplete() ? Health::Good : Health::Warning,
        tr("Datagrams of the scale message (type 13) received of those sent, with %1 segments; last at %2")
            .arg(pose->segments.size())
            .arg(timeOfDay(pose->stamp))};
}

} // namespace

std::vector<Property> characterFacts(model::SessionView& view, const std::optional<Key>& key) {
    const auto row = [&view, &key](const QString& label,
                                   PropertyValue (*read)(model::SessionView&, const Key&)) {
        return Property{label, [&view, &key, read] { return key ? read(view, *key) : PropertyValue{}; }};
    };
    return {row(tr("Revision"), revision), row(tr("Units"), units), row(tr("Sender"), address),
            row(tr("Segments"), segments), row(tr("Null pose"), nullPose)};
}

} // namespace posewire::gui
