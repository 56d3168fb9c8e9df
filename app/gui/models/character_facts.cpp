// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/character_facts.h"

#include "app/gui/models/text.h"

#include <QCoreApplication>

namespace posewire::gui {

namespace {

using Key = model::CharacterKey;

QString tr(const char* text) {
    return QCoreApplication::translate("CharacterFacts", text);
}

QString withEvidence(const QString& conclusion, const std::string& evidence) {
    return evidence.empty() ? conclusion
                            : conclusion + QStringLiteral(" · ") + QString::fromStdString(evidence);
}

PropertyValue revision(model::SessionView& view, const Key& key) {
    const model::Source* source = view.find(key.source);
    if (source == nullptr) {
        return {};
    }
    const model::Detection& found = source->detector.result();
    const auto name = model::revisionName(found.revision);
    return {withEvidence(QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())),
                         found.revisionEvidence),
            Health::Unknown, tr("Revision of the specification that this sender follows · the evidence")};
}

PropertyValue units(model::SessionView& view, const Key& key) {
    const model::Source* source = view.find(key.source);
    if (source == nullptr || source->detector.result().unitEvidence.empty()) {
        return {tr("not known before a pose arrives")};
    }
    const model::Detection& found = source->detector.result();
    const bool isMetres = found.positionUnit == model::LengthUnit::Metre;
    return {withEvidence(isMetres ? tr("metres") : tr("centimetres"), found.unitEvidence), Health::Unknown,
            tr("Unit of positions in types 02, 21 and 24, judged by what a person can be · the evidence")};
}

PropertyValue address(model::SessionView& view, const Key& key) {
    const model::Source* source = view.find(key.source);
    return source == nullptr ? PropertyValue{} : PropertyValue{QString::fromStdString(source->info.address)};
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
    const QString text = tr("%1/%2 parts · %3 segments · %4 points")
                             .arg(pose->partsReceived)
                             .arg(expected)
                             .arg(pose->segments.size())
                             .arg(pose->points.size());
    return {text, pose->isComplete() ? Health::Good : Health::Warning,
            tr("Datagrams of the scale message (type 13) received of those sent; last at %1")
                .arg(timeOfDay(pose->stampNs))};
}

} // namespace

std::vector<Property> characterFacts(model::SessionView& view, const std::optional<Key>& key) {
    const auto row = [&view, &key](const QString& label,
                                   PropertyValue (*read)(model::SessionView&, const Key&)) {
        return Property{label, [&view, &key, read] { return key ? read(view, *key) : PropertyValue{}; }};
    };
    return {row(tr("Revision"), revision), row(tr("Units"), units), row(tr("Source"), address),
            row(tr("Segments"), segments), row(tr("Null pose"), nullPose)};
}

} // namespace posewire::gui
