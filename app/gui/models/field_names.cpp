// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/field_text.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/joint_angles.h"

#include <cmath>

namespace posewire::gui {

namespace {

using wire::FieldNode;
using wire::RefersTo;

QString withName(const QString& id, std::string_view name) {
    return name.empty() ? id : id + QStringLiteral(" · ") + shownText(name);
}

/// The number that an item is known by; its place where it has none.
std::uint32_t idOf(const FieldDocument& document, std::int32_t item) {
    for (const std::int32_t child : document.children(item)) {
        const FieldNode& field = document.node(child);
        if (field.refersTo != RefersTo::Nothing && std::isfinite(field.number)) {
            return static_cast<std::uint32_t>(field.number);
        }
    }
    return document.node(item).index + 1;
}

/// The name that is sent with an item.
std::string_view textField(const FieldDocument& document, std::int32_t item) {
    for (const std::int32_t child : document.children(item)) {
        const FieldNode& field = document.node(child);
        if (field.kind == wire::NodeKind::Field && field.scalar == wire::Scalar::Text) {
            return field.value;
        }
    }
    return {};
}

QString pointText(const model::PointReference& point) {
    const QString id = QStringLiteral("%1.%2").arg(point.segmentId).arg(point.localId);
    const model::AnatomicalPoint* known = model::findPoint(point.segmentId - 1, point.localId);
    return known != nullptr     ? withName(id, known->name)
           : point.localId == 0 ? withName(id, model::segmentTitle({}, point.segmentId - 1))
                                : id;
}

QString jointTitle(int place) {
    const bool isKnown = place >= 0 && place < model::kJointCount;
    const auto name =
        isKnown ? model::jointDefinitions()[static_cast<std::size_t>(place)].name : std::string_view();
    return tr("Joint %1").arg(place < 0 ? tr("(unknown)") : withName(QString::number(place + 1), name));
}

QString pointTitle(const FieldDocument& document, std::int32_t item) {
    if (const auto id = document.numberOf(item, RefersTo::Point)) {
        const auto point = document.pointOf(*id);
        return point ? pointText(*point) : QString::number(*id);
    }
    const auto segment = document.numberOf(item, RefersTo::Carrier);
    const auto local = document.numberOf(item, RefersTo::LocalPoint);
    const QString id = segment && local ? QStringLiteral("%1.%2").arg(*segment).arg(*local)
                                        : tr("no. %1").arg(document.node(item).index + 1);
    return withName(id, textField(document, item));
}

} // namespace

QString itemTitle(const FieldDocument& document, std::int32_t item) {
    const FieldNode& node = document.node(item);
    const int segment = document.segmentOf(item);
    const QString id = QString::number(idOf(document, item));
    switch (node.refersTo) {
    case RefersTo::Joint:
        return jointTitle(document.placeOf(item));
    case RefersTo::Point:
        return tr("Point %1").arg(pointTitle(document, item));
    case RefersTo::Tag:
        return tr("Point %1").arg(id);
    case RefersTo::Prop:
        return tr("Prop %1").arg(withName(id, textField(document, item)));
    case RefersTo::Tracker:
        return tr("Tracker %1").arg(withName(id, model::segmentTitle({}, segment)));
    case RefersTo::Segment:
    case RefersTo::UnitySegment: {
        const std::string_view sent = textField(document, item);
        const auto known = sent.empty() ? document.segmentTitle(item) : model::segmentTitle(sent);
        return tr("Segment %1").arg(withName(id, known.empty() ? sent : known));
    }
    default:
        return tr("No. %1").arg(id);
    }
}

QString identifierText(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    const auto id = static_cast<std::uint32_t>(std::isfinite(node.number) ? node.number : 0);
    const QString plain = QString::number(id);
    const std::int32_t item = document.itemOf(index);
    if (item < 0) {
        return plain;
    }
    switch (node.refersTo) {
    case RefersTo::JointEnd:
        return pointText(*model::decodePointId(model::PointIdCoding::By256, id));
    case RefersTo::Point: {
        const auto point = document.pointOf(id);
        return point && document.node(item).refersTo != RefersTo::Tag ? pointText(*point) : plain;
    }
    case RefersTo::Carrier:
        return withName(plain, model::segmentTitle({}, static_cast<int>(id) - 1));
    case RefersTo::Segment:
    case RefersTo::UnitySegment:
    case RefersTo::Tracker:
    case RefersTo::Prop:
        return withName(plain, document.segmentTitle(item));
    default:
        return plain;
    }
}

} // namespace posewire::gui
