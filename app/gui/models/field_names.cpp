// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/field_names.h"

#include "core/model/body/joint_angles.h"

#include <QCoreApplication>

#include <cmath>

namespace posewire::gui {

namespace {

using wire::FieldNode;

QString tr(const char* text) {
    return QCoreApplication::translate("FieldNames", text);
}

QString textOf(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QString withName(const QString& id, std::string_view name) {
    return name.empty() ? id : id + QStringLiteral(" · ") + textOf(name);
}

/// The number of a field of an item; nothing where it was cut off.
std::optional<std::uint32_t> numberOf(const FieldDocument& document, std::int32_t item,
                                      std::string_view name) {
    const std::int32_t field = document.child(item, name);
    if (field < 0 || !std::isfinite(document.node(field).number)) {
        return std::nullopt;
    }
    return static_cast<std::uint32_t>(document.node(field).number);
}

std::string_view textField(const FieldDocument& document, std::int32_t item) {
    const std::int32_t name = document.child(item, "name");
    return name < 0 ? std::string_view() : std::string_view(document.node(name).value);
}

/// Name of the segment that stands at a position of a pose datagram.
std::string_view nameAt(const FieldDocument& document, int position) {
    const bool isPose = document.type() != wire::NullPose::kType;
    return model::segmentName(isPose ? document.layout() : model::SegmentLayout{}, position);
}

QString pointText(const model::PointReference& point) {
    const QString id = QStringLiteral("%1.%2").arg(point.segmentId).arg(point.localId);
    const model::AnatomicalPoint* known = model::findPoint(point.segmentId - 1, point.localId);
    return known != nullptr     ? withName(id, known->name)
           : point.localId == 0 ? withName(id, model::segmentName({}, point.segmentId - 1))
                                : id;
}

QString jointTitle(std::uint32_t index) {
    const bool isKnown = index < static_cast<std::uint32_t>(model::kJointCount);
    return tr("Joint %1")
        .arg(withName(QString::number(index + 1),
                      isKnown ? model::jointDefinitions()[index].name : std::string_view()));
}

QString pointTitle(const FieldDocument& document, std::int32_t item, std::uint32_t index) {
    if (document.type() == wire::NullPose::kType) {
        const auto segment = numberOf(document, item, "segment");
        const auto point = numberOf(document, item, "point");
        const QString id = segment && point ? QStringLiteral("%1.%2").arg(*segment).arg(*point)
                                            : tr("no. %1").arg(index + 1);
        return tr("Point %1").arg(withName(id, textField(document, item)));
    }
    const auto id = numberOf(document, item, "id");
    const auto point = id ? model::decodePointId(document.coding(), *id) : std::nullopt;
    return tr("Point %1")
        .arg(point && document.type() != wire::TagPositions::kType ? pointText(*point)
                                                                   : QString::number(id.value_or(index + 1)));
}

} // namespace

QString spacedName(std::string_view name) {
    QString text;
    for (const QChar character : textOf(name)) {
        if (text.isEmpty()) {
            text += name.size() > 1 ? character.toUpper() : character;
        } else if (character.isUpper()) {
            text += QLatin1Char(' ');
            text += character.toLower();
        } else {
            text += character;
        }
    }
    return text == QStringLiteral("Id") ? QStringLiteral("ID") : text;
}

QString itemTitle(const FieldDocument& document, std::int32_t item) {
    const FieldNode& node = document.node(item);
    const std::string& list = document.node(node.parent).name;
    const int segment = document.segmentOf(item);
    const auto id = numberOf(document, item, "id").value_or(node.index + 1);
    if (list == "joints") {
        return jointTitle(node.index);
    }
    if (list == "points") {
        return pointTitle(document, item, node.index);
    }
    if (list == "props") {
        return tr("Prop %1").arg(withName(QString::number(id), textField(document, item)));
    }
    if (list == "trackers") {
        return tr("Tracker %1").arg(withName(QString::number(id), model::segmentName({}, segment)));
    }
    const std::string_view sent = textField(document, item);
    return tr("Segment %1")
        .arg(withName(QString::number(id), sent.empty() ? nameAt(document, segment) : sent));
}

QString identifierText(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    const auto id = static_cast<std::uint32_t>(std::isfinite(node.number) ? node.number : 0);
    const QString plain = QString::number(id);
    const std::int32_t item = document.itemOf(index);
    if (item < 0) {
        return plain;
    }
    const std::string& list = document.node(document.node(item).parent).name;
    if (node.name == "parent" || node.name == "child") {
        const auto point = model::decodePointId(model::PointIdCoding::By256, id);
        return point ? pointText(*point) : plain;
    }
    if (list == "points" && node.name == "id") {
        const auto point = model::decodePointId(document.coding(), id);
        return point && document.type() != wire::TagPositions::kType ? pointText(*point) : plain;
    }
    if (node.name == "point") {
        return plain;
    }
    const int segment = node.name == "segment" ? static_cast<int>(id) - 1 : document.segmentOf(item);
    return withName(plain, nameAt(document, segment));
}

} // namespace posewire::gui
