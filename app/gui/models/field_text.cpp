// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/field_text.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/joint_angles.h"
#include "core/model/body/spaces.h"
#include "core/wire/type_table.h"

#include <cmath>

namespace posewire::gui {

namespace {

using wire::FieldNode;
using wire::NodeKind;
using wire::RefersTo;
using wire::Unit;

/// The wire's vector in the frame above the wire, without a change of unit.
Eigen::Vector3d zUpOf(const FieldDocument& document, const Eigen::Vector3d& sent) {
    const wire::TypeInfo* info = wire::findType(document.type());
    const wire::Frame frame = info != nullptr ? info->frame : wire::Frame::None;
    return document.isYUp || frame == wire::Frame::YUp ? model::zUpFromYUp(sent)
           : frame == wire::Frame::Unity               ? model::zUpFromUnity(sent)
                                                       : sent;
}

struct Scale {
    double factor = 1;
    const char* symbol = "";
    int decimals = 3;
};

/// From the wire's unit to the one that is shown.
Scale scaleOf(const FieldDocument& document, const FieldNode& node) {
    switch (node.unit) {
    case Unit::Metres:
    case Unit::Centimetres:
        // Null poses come in metres whatever the sender's poses come in.
        return {model::metresPer(wire::isSampled(document.type()) ? document.unit : model::LengthUnit::Metre),
                "m", 4};
    case Unit::Degrees:
        return {1, "°", 2};
    case Unit::RadiansPerSecond:
        return {model::kDegreesPerRadian, "°/s", 2};
    case Unit::RadiansPerSecondSquared:
        return {model::kDegreesPerRadian, "°/s²", 1};
    case Unit::MetresPerSecond:
        return {1, "m/s", 3};
    case Unit::MetresPerSecondSquared:
        return {1, "m/s²", 3};
    case Unit::ArbitraryUnits:
        return {1, "a.u.", 4};
    default:
        return {1, "", 4};
    }
}

QString withUnit(const QString& value, const char* symbol) {
    const QString unit = QString::fromUtf8(symbol);
    return unit.isEmpty()                ? value
           : unit == QStringLiteral("°") ? value + unit
                                         : value + QLatin1Char(' ') + unit;
}

bool isLength(Unit unit) {
    return unit == Unit::Metres || unit == Unit::Centimetres;
}

/// Wire components in their order; fewer where they are not there.
std::vector<double> components(const FieldDocument& document, std::int32_t node) {
    std::vector<double> values;
    for (const std::int32_t part : document.children(node)) {
        values.push_back(document.node(part).number);
    }
    return values;
}

QString vectorText(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    const Scale scale = scaleOf(document, node);
    std::vector<double> values = components(document, index);
    if (values.size() == 3 && isLength(node.unit)) {
        const Eigen::Vector3d zUp = zUpOf(document, {values[0], values[1], values[2]});
        values.assign({zUp.x(), zUp.y(), zUp.z()});
    }
    QString text;
    for (const double value : values) {
        text += (text.isEmpty() ? QString() : QStringLiteral("  ")) +
                fixed(value * scale.factor, std::min(scale.decimals, 3));
    }
    return withUnit(text, scale.symbol);
}

/// A component of a position of another frame says which axis it becomes.
QString componentText(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    const FieldNode& vector = document.node(node.parent);
    const Scale scale = scaleOf(document, vector);
    const QString plain = withUnit(fixed(node.number * scale.factor, scale.decimals), scale.symbol);
    if (!isLength(vector.unit) || vector.components != 3) {
        return plain;
    }
    const auto siblings = document.children(node.parent);
    const auto place = std::find(siblings.begin(), siblings.end(), index) - siblings.begin();
    const Eigen::Vector3d zUp = zUpOf(document, Eigen::Vector3d::Unit(static_cast<int>(place)));
    Eigen::Index axis = 0;
    zUp.cwiseAbs().maxCoeff(&axis);
    if (axis == place && zUp[axis] > 0) {
        return plain;
    }
    return QStringLiteral("%1 = %2")
        .arg(QLatin1Char("xyz"[axis]))
        .arg(withUnit(fixed(node.number * scale.factor * zUp[axis], scale.decimals), scale.symbol));
}

QString datagramCounterText(std::uint8_t counter) {
    const QString index = tr("part %1").arg((counter & 0x7f) + 1);
    return (counter & 0x80) != 0 ? tr("%1, the last").arg(index) : tr("%1, more follow").arg(index);
}

QString flagsText(double number) {
    const QStringList bits = setBits(static_cast<std::uint32_t>(number));
    return bits.isEmpty() ? tr("no bit set") : tr("bits %1").arg(bits.join(QLatin1Char(' ')));
}

QString headerText(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    if (node.refersTo == RefersTo::Character) {
        return tr("character %1").arg(node.number);
    }
    if (node.unit == Unit::ByteCount && node.number == 0) {
        return tr("not sent");
    }
    if (node.kind == NodeKind::Part) {
        return node.unit == Unit::Identifier ? typeTitle(document.type()) : QString();
    }
    if (node.kind == NodeKind::Field && !document.children(index).empty()) {
        return node.scalar == wire::Scalar::Characters ? documentTitle(document)
                                                       : datagramCounterText(document.header.datagramCounter);
    }
    return {};
}

/// "freeAcceleration" as "Free acceleration".
QString spacedName(std::string_view name) {
    QString text;
    for (const QChar character : fromUtf8(name)) {
        const bool beginsWord = character.isUpper() && !text.isEmpty();
        text += beginsWord ? QLatin1Char(' ') + QString(character.toLower()) : QString(character);
    }
    if (text.size() > 1) {
        text[0] = text[0].toUpper();
    }
    return text == QStringLiteral("Id") ? QStringLiteral("ID") : text;
}

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
        if (field.kind == NodeKind::Field && field.scalar == wire::Scalar::Text) {
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

QString documentTitle(const FieldDocument& document) {
    if (document.kind == model::PacketKind::Skipped) {
        return tr("Skipped bytes");
    }
    if (document.hasHeader) {
        return typeTitle(document.type());
    }
    return document.kind == model::PacketKind::Foreign ? tr("Foreign datagram") : tr("Malformed datagram");
}

QStringList documentLines(const FieldDocument& document) {
    const QString size =
        tr("%1 bytes", nullptr, static_cast<int>(document.bytes.size())).arg(grouped(document.bytes.size()));
    if (!document.hasHeader) {
        return {size};
    }
    const wire::Header& header = document.header;
    QStringList lines{
        tr("%1 · sample %2 · %3")
            .arg(size, grouped(header.sampleCounter), datagramCounterText(header.datagramCounter))};
    if (const wire::TypeInfo* type = wire::findType(document.type())) {
        const QString frame =
            document.isYUp ? tr("as sent: Y-up; shown: Z-up") : translatedText(wire::frameName(type->frame));
        QStringList about{frame, translatedText(type->remark)};
        about.removeAll(QString());
        lines += about.join(QStringLiteral(" · "));
        lines += tr("Revisions %1 · § %2").arg(fromUtf8(type->revisions), fromUtf8(type->section));
        lines.removeAll(QString());
    }
    return lines;
}

QString fieldTitle(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    switch (node.kind) {
    case NodeKind::Item:
        return itemTitle(document, index);
    case NodeKind::Unread:
        return document.kind == model::PacketKind::Datagram ? tr("Bytes without a field")
               : document.hasHeader                         ? tr("Unread")
                                                            : tr("Bytes");
    case NodeKind::Part:
        return document.node(node.parent).unit == Unit::TagLines ? shownText(node.name)
                                                                 : spacedName(node.name);
    default:
        return spacedName(node.name);
    }
}

QString wireValue(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    if (node.kind == NodeKind::Cut && document.tree.cutError.code == wire::ErrorCode::BadLength) {
        return QString::number(static_cast<std::int32_t>(document.tree.cutError.need));
    }
    if (node.kind == NodeKind::Cut && document.tree.cutError.code == wire::ErrorCode::CountTooLarge) {
        return QString::number(document.tree.cutError.need);
    }
    const Unit unit = node.kind == NodeKind::Part && node.unit == Unit::None && node.parent >= 0
                          ? document.node(node.parent).unit
                          : node.unit;
    const QString symbol = fromUtf8(wire::unitSymbol(unit));
    const QString value = shownText(node.value);
    return value.isEmpty() || symbol.isEmpty() || node.kind == NodeKind::Unread
               ? value
               : value + QLatin1Char(' ') + symbol;
}

QString convertedValue(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    switch (node.kind) {
    case NodeKind::Group:
        return document.isInHeader(index) ? tr("%n bytes", nullptr, static_cast<int>(node.length))
                                          : tr("%1 × · %2 bytes").arg(node.index).arg(grouped(node.length));
    case NodeKind::Item:
        return tr("%n bytes", nullptr, static_cast<int>(node.length));
    case NodeKind::Cut:
        return document.tree.cutError.code == wire::ErrorCode::FieldTruncated
                   ? tr("%1 of %2 bytes").arg(document.tree.cutError.have).arg(document.tree.cutError.need)
                   : tr("past the end");
    case NodeKind::Unread:
        return tr("%1 bytes", nullptr, static_cast<int>(node.length)).arg(grouped(node.length));
    default:
        break;
    }
    if (node.components != 0) {
        return vectorText(document, index);
    }
    if (node.kind == NodeKind::Part && document.node(node.parent).components != 0) {
        return componentText(document, index);
    }
    if (const QString text = document.isInHeader(index) ? headerText(document, index) : QString();
        !text.isEmpty()) {
        return text;
    }
    switch (node.unit) {
    case Unit::Identifier:
        return identifierText(document, index);
    case Unit::Milliseconds:
        return milliClock(static_cast<std::int64_t>(node.number));
    case Unit::Flags:
        return flagsText(node.number);
    case Unit::Count:
        return grouped(static_cast<std::uint64_t>(node.number));
    default:
        return wireValue(document, index);
    }
}

QString fieldMeaning(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    if (node.text.empty() && node.parent >= 0 && node.kind == NodeKind::Part) {
        return fieldMeaning(document, node.parent);
    }
    if (node.kind == NodeKind::Unread && !document.hasHeader) {
        return tr("no datagram of this protocol");
    }
    return translatedText(node.text);
}

QString fieldSection(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    return node.section.empty() ? QString() : QStringLiteral("§ ") + fromUtf8(node.section);
}

QString fieldPlace(const FieldDocument& document, std::int32_t index) {
    const FieldNode& node = document.node(index);
    const bool isNumber = node.scalar != wire::Scalar::Text && node.scalar != wire::Scalar::Characters;
    const QString scalar = fromUtf8(wire::scalarName(node.scalar));
    const QString kind = !isNumber              ? tr("%n bytes", nullptr, static_cast<int>(node.length))
                         : node.components != 0 ? tr("%1 × %2").arg(node.components).arg(scalar)
                                                : scalar;
    return node.length == 1 ? tr("%1 at byte %2").arg(kind).arg(node.offset)
                            : tr("%1 at bytes %2–%3")
                                  .arg(kind)
                                  .arg(node.offset)
                                  .arg(node.offset + std::max(node.length, 1U) - 1);
}

QString difference(const FieldDocument& document, std::int32_t index, const FieldDocument& other,
                   std::int32_t otherIndex) {
    const FieldNode& a = document.node(index);
    const FieldNode& b = other.node(otherIndex);
    if (a.value == b.value && a.kind == b.kind) {
        return {};
    }
    const auto u = components(document, index);
    const auto v = components(other, otherIndex);
    if (a.components == 3 && b.components == 3) {
        const Scale scale = scaleOf(document, a);
        const double distance = std::hypot(u[0] - v[0], u[1] - v[1], u[2] - v[2]) * scale.factor;
        return isLength(a.unit) ? QStringLiteral("%1 mm").arg(fixed(distance * 1000, 2))
                                : withUnit(fixed(distance, scale.decimals), scale.symbol);
    }
    if (a.components == 4 && b.components == 4) {
        const double dot = std::abs(u[0] * v[0] + u[1] * v[1] + u[2] * v[2] + u[3] * v[3]);
        return fixed(2 * std::acos(std::min(1.0, dot)) * model::kDegreesPerRadian, 3) + QStringLiteral("°");
    }
    if (!std::isfinite(a.number) || !std::isfinite(b.number) || a.unit == Unit::Identifier ||
        a.unit == Unit::Flags) {
        return tr("differs");
    }
    const bool isPart = a.kind == NodeKind::Part && document.node(a.parent).components != 0;
    const Scale scale = scaleOf(document, isPart ? document.node(a.parent) : a);
    const double delta = (a.number - b.number) * scale.factor;
    return isPart                         ? withUnit(signedFixed(delta, scale.decimals), scale.symbol)
           : a.unit == Unit::Milliseconds ? clockDifference(delta)
                                          : signedFixed(delta, 0);
}

QString itemTitle(const FieldDocument& document, std::int32_t item) {
    const FieldNode& node = document.node(item);
    const int segment = document.segmentOf(item);
    const QString id = QString::number(idOf(document, item));
    if (document.isTag(item)) {
        return tr("Tag %1").arg(id);
    }
    switch (node.refersTo) {
    case RefersTo::Joint:
        return jointTitle(document.placeOf(item));
    case RefersTo::Point:
        return tr("Point %1").arg(pointTitle(document, item));
    case RefersTo::Tag:
        return tr("Tag %1").arg(id);
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
