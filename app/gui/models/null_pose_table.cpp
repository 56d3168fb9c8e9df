// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/null_pose_table.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kMetreDecimals = 4;
constexpr int kMillimetreDecimals = 1;
constexpr double kMillimetres = 1000.0;
/// What is below this is the wire's own rounding: 32-bit floats of metres.
constexpr double kVisibleChange = 0.00005;

QString dash() {
    return QStringLiteral("–");
}

QString millimetres(const std::optional<double>& metres) {
    return metres ? fixed(*metres * kMillimetres, kMillimetreDecimals) : dash();
}

QString vectorText(const std::optional<Eigen::Vector3d>& metres) {
    return metres ? QStringLiteral("x %1, y %2, z %3 mm")
                        .arg(signedFixed(metres->x() * kMillimetres, kMillimetreDecimals),
                             signedFixed(metres->y() * kMillimetres, kMillimetreDecimals),
                             signedFixed(metres->z() * kMillimetres, kMillimetreDecimals))
                  : QString();
}

std::optional<Eigen::Vector3d> at(const model::Distances& distances, std::size_t row) {
    return row < distances.size() ? distances[row] : std::nullopt;
}

QString matrixText(const wire::Mat3& matrix, const QString& betweenRows) {
    QString text;
    for (std::size_t i = 0; i < matrix.size(); ++i) {
        text += i == 0 ? QString() : i % 3 == 0 ? betweenRows : QStringLiteral(" ");
        text += fixed(static_cast<double>(matrix[i]), 3);
    }
    return text;
}

/// Cells of what follows from the message, not sent itself.
template <class Row>
QVariant dim(const Row&) {
    return theme().dim;
}

/// One coordinate of a vector.
template <class Row, class Read>
TableColumn<Row> coordinateColumn(const QString& title, const QString& help, int axis, Read read) {
    return {.title = title,
            .help = help,
            .isNumber = true,
            .text = [axis, read](const Row& row) { return fixed(read(row, axis), kMetreDecimals); },
            .sortKey = [axis, read](const Row& row) { return QVariant(read(row, axis)); }};
}

} // namespace

QString bitsText(std::uint32_t flags) {
    QStringList bits;
    for (int bit = 31; bit >= 0; --bit) {
        if ((flags >> bit & 1U) != 0) {
            bits += QString::number(bit);
        }
    }
    return bits.isEmpty() ? dash() : bits.join(QStringLiteral(", "));
}

QString segmentText(int wireId) {
    if (wireId < 1 || wireId > model::kBodySegmentCount) {
        return tr("Segment %1").arg(wireId);
    }
    return fromUtf8(model::bodySegments()[static_cast<std::size_t>(wireId - 1)].displayName);
}

namespace {

using SegmentRow = NullPoseSegmentRow;
using PointRow = NullPosePointRow;
using Length = model::SegmentLength;
using Scale = wire::SegmentScale;

std::vector<SegmentRow> segmentRows(const NullPoseReading& reading) {
    std::vector<SegmentRow> rows;
    for (std::size_t i = 0; reading.pose() != nullptr && i < reading.pose()->segments.size(); ++i) {
        rows.push_back(
            {i, reading.pose()->segments[i], at(reading.fromBefore(), i), at(reading.fromReference(), i)});
    }
    return rows;
}

std::vector<PointRow> pointRows(const NullPoseReading& reading) {
    std::vector<PointRow> rows;
    if (const model::NullPose* pose = reading.pose()) {
        for (const model::NullPose::Point& point : pose->points) {
            const auto segment = static_cast<std::size_t>(std::max(point.segment, 0));
            rows.push_back({point, segment >= 1 && segment <= pose->segments.size()});
        }
    }
    return rows;
}

std::vector<Scale> scaleRows(const NullPoseReading& reading) {
    return reading.scale() == nullptr ? std::vector<Scale>() : reading.scale()->segments;
}

TableColumn<SegmentRow> positionColumn(const QString& title, const QString& help, int axis) {
    return coordinateColumn<SegmentRow>(
        title, help, axis, [](const SegmentRow& row, int place) { return row.segment.position[place]; });
}

TableColumn<SegmentRow> distanceColumn(const QString& title, const QString& help,
                                       std::optional<Eigen::Vector3d> SegmentRow::*distance, bool isChange) {
    return {.title = title,
            .help = help,
            .isNumber = true,
            .text =
                [distance](const SegmentRow& row) {
                    return millimetres(row.*distance ? std::optional((row.*distance)->norm()) : std::nullopt);
                },
            .colour =
                [distance, isChange](const SegmentRow& row) {
                    const bool hasMoved = row.*distance && !((row.*distance)->norm() < kVisibleChange);
                    return QVariant(isChange && hasMoved ? theme().warning : theme().dim);
                },
            .toolTip = [distance](const SegmentRow& row) { return vectorText(row.*distance); }};
}

std::vector<TableColumn<SegmentRow>> segmentColumns() {
    return {
        {.title = tr("ID"),
         .help = tr("Place in the message, from 1: type 13 sends no IDs"),
         .isNumber = true,
         .text = [](const SegmentRow& row) { return QString::number(row.place + 1); },
         .colour = dim<SegmentRow>},
        {.title = tr("Segment"),
         .help = tr("Name as sent"),
         .text = [](const SegmentRow& row) { return QString::fromStdString(row.segment.name); }},
        positionColumn(tr("x m"), tr("Origin of the segment: x forward, Z-up"), 0),
        positionColumn(tr("y m"), tr("Origin of the segment: y to the left, Z-up"), 1),
        positionColumn(tr("z m"), tr("Origin of the segment: height over the balls of the feet"), 2),
        distanceColumn(
            tr("Δ last mm"),
            tr("How far the segment moved since the newest message that said something else, as sent"),
            &SegmentRow::fromBefore, true),
        distanceColumn(tr("Δ ref mm"),
                       tr("How far the segment is from that of the reference body of the same height, which "
                          "stands on the same balls of the feet with its pelvis above them"),
                       &SegmentRow::fromReference, false),
    };
}

/// Names and what else is sent of a point are red where its segment is missing.
TableColumn<PointRow> pointColumn(TableColumn<PointRow> column, bool isDim) {
    column.colour = [isDim](const PointRow& row) {
        return !row.hasSegment ? QVariant(theme().error) : isDim ? QVariant(theme().dim) : QVariant();
    };
    return column;
}

std::vector<TableColumn<PointRow>> pointColumns() {
    const auto whose = [](const PointRow& row) {
        return tr("Point %1 of %2").arg(row.point.id).arg(segmentText(row.point.segment));
    };
    const auto position = [](const PointRow& row, int axis) { return row.point.position[axis]; };
    const QString origin = tr("From the segment's origin, Z-up");
    return {
        pointColumn({.title = tr("ID"),
                     .help = tr("Segment and point within it"),
                     .isNumber = true,
                     .text =
                         [](const PointRow& row) {
                             return QStringLiteral("%1.%2").arg(row.point.segment).arg(row.point.id);
                         },
                     .toolTip = whose},
                    true),
        pointColumn({.title = tr("Point"),
                     .help = tr("Name as sent; joints begin with j"),
                     .text = [](const PointRow& row) { return QString::fromStdString(row.point.name); },
                     .toolTip = whose},
                    false),
        pointColumn(coordinateColumn<PointRow>(tr("x m"), origin, 0, position), false),
        pointColumn(coordinateColumn<PointRow>(tr("y m"), origin, 1, position), false),
        pointColumn(coordinateColumn<PointRow>(tr("z m"), origin, 2, position), false),
        pointColumn(
            {.title = tr("Flags"),
             .help = tr("\"Characteristics\" of the point, 32 bits. The specification does not say what "
                        "they mean."),
             .isNumber = true,
             .text =
                 [](const PointRow& row) {
                     return QStringLiteral("0x%1").arg(row.point.flags, 8, 16, QLatin1Char('0'));
                 }},
            true),
        pointColumn({.title = tr("Bits"),
                     .help = tr("Bits of the flags that are set, 0 being the lowest; their meaning is not "
                                "published"),
                     .isNumber = true,
                     .text = [](const PointRow& row) { return bitsText(row.point.flags); }},
                    true),
    };
}

QString differenceText(const Length& length) {
    if (length.left < 0) {
        return tr("trunk");
    }
    return length.difference()
               ? (length.isAsymmetric() ? healthSymbol(Health::Warning) + QLatin1Char(' ') : QString()) +
                     signedFixed(*length.difference() * kMillimetres, kMillimetreDecimals)
               : dash();
}

std::vector<TableColumn<Length>> lengthColumns() {
    const QString extent = tr("From the segment's origin to the next one's, or to its end point");
    return {
        {.title = tr("Length"), .text = [](const Length& length) { return fromUtf8(length.name); }},
        {.title = tr("Left mm"),
         .help = extent,
         .isNumber = true,
         .text =
             [](const Length& length) {
                 return millimetres(length.left >= 0 ? length.leftMetres : length.rightMetres);
             }},
        {.title = tr("Right mm"),
         .help = extent,
         .isNumber = true,
         .text =
             [](const Length& length) {
                 return length.left >= 0 ? millimetres(length.rightMetres) : QString();
             }},
        {.title = tr("L − R mm"),
         .help = tr("Left minus right; marked from 5 mm, since bodies that MVN measured are symmetric"),
         .isNumber = true,
         .text = differenceText,
         .colour =
             [](const Length& length) {
                 return QVariant(length.isAsymmetric() ? theme().warning : theme().dim);
             }},
    };
}

std::vector<TableColumn<Scale>> scaleColumns() {
    const auto offset = [](const Scale& segment, int axis) {
        return static_cast<double>(segment.offset[static_cast<std::size_t>(axis)]);
    };
    const QString help = tr("Offset from the default position; the specification names no unit");
    return {
        {.title = tr("ID"),
         .isNumber = true,
         .text = [](const Scale& segment) { return QString::number(segment.id); },
         .colour = dim<Scale>},
        {.title = tr("Segment"),
         .text = [](const Scale& segment) { return segmentText(static_cast<int>(segment.id)); }},
        coordinateColumn<Scale>(tr("x"), help, 0, offset),
        coordinateColumn<Scale>(tr("y"), help, 1, offset),
        coordinateColumn<Scale>(tr("z"), help, 2, offset),
        {.title = tr("Matrix"),
         .help = tr("Rotation and scale relative to the default, row by row as sent"),
         .text = [](const Scale& segment) { return matrixText(segment.matrix, QStringLiteral(" ; ")); },
         .toolTip = [](const Scale& segment) { return matrixText(segment.matrix, QStringLiteral("\n")); }},
    };
}

} // namespace

NullPoseSegmentModel::NullPoseSegmentModel(const NullPoseReading& reading, QObject* parent)
    : NullPoseTable(reading, segmentColumns(), segmentRows, parent) {}

NullPosePointModel::NullPosePointModel(const NullPoseReading& reading, QObject* parent)
    : NullPoseTable(reading, pointColumns(), pointRows, parent) {}

NullPoseLengthModel::NullPoseLengthModel(const NullPoseReading& reading, QObject* parent)
    : NullPoseTable(
          reading, lengthColumns(), [](const NullPoseReading& shown) { return shown.measures().lengths; },
          parent) {}

NullPoseScaleModel::NullPoseScaleModel(const NullPoseReading& reading, QObject* parent)
    : NullPoseTable(reading, scaleColumns(), scaleRows, parent) {}

} // namespace posewire::gui
