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

QString millimetres(const std::optional<double>& metres) {
    return metres ? fixed(*metres * kMillimetres, kMillimetreDecimals) : dash();
}

QString placeText(const std::optional<Eigen::Vector3d>& metres) {
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

/// One coordinate of a vector.
template <class Row, class Read>
TableColumn<Row> coordinateColumn(const QString& title, const QString& help, int axis, Read read) {
    return TableColumn<Row>::numbers(
               title, help, [axis, read](const Row& row) { return fixed(read(row, axis), kMetreDecimals); })
        .in({QStringLiteral("−9.9999")});
}

/// "31, 2, 0": the bits that are set, highest first; "–" for none.
QString bitsText(std::uint32_t flags) {
    QStringList bits = setBits(flags);
    std::ranges::reverse(bits);
    return bits.isEmpty() ? dash() : bits.join(QStringLiteral(", "));
}

/// "Right Upper Arm" for 9; "Segment 30" where it is none of the body.
QString segmentText(int wireId) {
    if (wireId < 1 || wireId > model::kBodySegmentCount) {
        return tr("Segment %1").arg(wireId);
    }
    return fromUtf8(model::bodySegments()[static_cast<std::size_t>(wireId - 1)].displayName);
}

using SegmentRow = NullPoseSegmentRow;
using PointRow = NullPosePointRow;
using Length = model::SegmentLength;
using SegmentScale = wire::SegmentScale;

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

TableColumn<SegmentRow> positionColumn(const QString& title, const QString& help, int axis) {
    return coordinateColumn<SegmentRow>(
        title, help, axis, [](const SegmentRow& row, int place) { return row.segment.position[place]; });
}

TableColumn<SegmentRow> distanceColumn(const QString& title, const QString& help,
                                       std::optional<Eigen::Vector3d> SegmentRow::*distance, int order,
                                       bool isChange) {
    const auto text = [distance](const SegmentRow& row) {
        return millimetres(row.*distance ? std::optional((row.*distance)->norm()) : std::nullopt);
    };
    const auto colour = [distance, isChange](const SegmentRow& row) {
        const bool hasMoved = row.*distance && !((row.*distance)->norm() < kVisibleChange);
        return QVariant(isChange && hasMoved ? theme().warning : theme().dim);
    };
    return TableColumn<SegmentRow>::numbers(title, help, text)
        .in({.usual = QStringLiteral("999.9"), .order = order})
        .withColour(colour)
        .withToolTip([distance](const SegmentRow& row) { return placeText(row.*distance); });
}

std::vector<TableColumn<SegmentRow>> segmentColumns() {
    using Column = TableColumn<SegmentRow>;
    return {
        Column::numbers(tr("ID"), tr("Place in the message, from 1: type 13 sends no IDs"),
                        [](const auto& row) { return QString::number(row.place + 1); })
            .in({.usual = QStringLiteral("99"), .order = 3})
            .dimmed(),
        Column::words(tr("Segment"), tr("Name in the specification; as sent where it has none such"),
                      [](const auto& row) { return fromUtf8(row.segment.title()); })
            .in({.usual = QStringLiteral("Right Upper Arm"), .isOpen = true}),
        positionColumn(tr("x m"), tr("Origin of the segment: x forward, Z-up"), 0),
        positionColumn(tr("y m"), tr("Origin of the segment: y to the left, Z-up"), 1),
        positionColumn(tr("z m"), tr("Origin of the segment: height over the balls of the feet"), 2),
        distanceColumn(
            tr("Δ last mm"),
            tr("How far the segment moved since the newest message that said something else, as sent"),
            &SegmentRow::fromBefore, 2, true),
        distanceColumn(tr("Δ ref mm"),
                       tr("How far the segment is from that of the reference body of the same height, which "
                          "stands on the same balls of the feet with its pelvis above them"),
                       &SegmentRow::fromReference, 1, false),
    };
}

/// Names and what else is sent of a point are red where its segment is missing.
QVariant pointColour(const PointRow& row) {
    return row.hasSegment ? QVariant() : QVariant(theme().error);
}

QVariant valueColour(const PointRow& row) {
    return row.hasSegment ? theme().dim : theme().error;
}

std::vector<TableColumn<PointRow>> pointColumns() {
    using Column = TableColumn<PointRow>;
    const auto id = [](const PointRow& row) {
        return QStringLiteral("%1.%2").arg(row.point.segment).arg(row.point.id);
    };
    const auto whose = [](const PointRow& row) {
        return tr("Point %1 of %2").arg(row.point.id).arg(segmentText(row.point.segment));
    };
    const auto coordinate = [](const QString& title, int axis) {
        return coordinateColumn<PointRow>(title, tr("From the segment's origin, Z-up"), axis,
                                          [](const PointRow& row, int at) { return row.point.position[at]; })
            .withColour(pointColour);
    };
    return {
        Column::numbers(tr("ID"), tr("Segment and point within it"), id)
            .in({.usual = QStringLiteral("99.99"), .order = 3})
            .withColour(valueColour)
            .withToolTip(whose),
        Column::words(tr("Point"), tr("Name as sent; joints begin with j"),
                      [](const auto& row) { return shown(row.point.name); })
            .in({.usual = QStringLiteral("jRightUpperArm"), .isOpen = true})
            .withColour(pointColour)
            .withToolTip(whose),
        coordinate(tr("x m"), 0),
        coordinate(tr("y m"), 1),
        coordinate(tr("z m"), 2),
        Column::numbers(tr("Flags"),
                        tr("\"Characteristics\" of the point, 32 bits. The specification does not say what "
                           "they mean."),
                        [](const PointRow& row) {
                            return QStringLiteral("0x%1").arg(row.point.flags, 8, 16, QLatin1Char('0'));
                        })
            .in({.usual = QStringLiteral("0x00000000"), .order = 2})
            .withColour(valueColour),
        Column::numbers(tr("Bits"),
                        tr("Bits of the flags that are set, 0 being the lowest; their meaning is not "
                           "published"),
                        [](const PointRow& row) { return bitsText(row.point.flags); })
            .in({.usual = QStringLiteral("31, 30"), .order = 1})
            .withColour(valueColour),
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
    using Column = TableColumn<Length>;
    const QString extent = tr("From the segment's origin to the next one's, or to its end point");
    return {
        Column::words(tr("Length"), {}, [](const auto& length) { return translatedText(length.name); })
            .in({.usual = QStringLiteral("12345678"), .isOpen = true}),
        Column::numbers(tr("Left mm"), extent,
                        [](const auto& length) {
                            return millimetres(length.left >= 0 ? length.leftMetres : length.rightMetres);
                        })
            .in({QStringLiteral("9999.9")}),
        Column::numbers(
            tr("Right mm"), extent,
            [](const auto& length) { return length.left >= 0 ? millimetres(length.rightMetres) : QString(); })
            .in({QStringLiteral("9999.9")}),
        Column::numbers(
            tr("L − R mm"),
            tr("Left minus right; marked from 5 mm, since bodies that MVN measured are symmetric"),
            differenceText)
            .in({QStringLiteral("▲ −999.9")})
            .withColour([](const Length& length) {
                return QVariant(length.isAsymmetric() ? theme().warning : theme().dim);
            }),
    };
}

std::vector<TableColumn<SegmentScale>> scaleColumns() {
    using Column = TableColumn<SegmentScale>;
    const auto offset = [](const SegmentScale& segment, int axis) {
        return static_cast<double>(segment.offset[static_cast<std::size_t>(axis)]);
    };
    const auto matrix = [](const QString& betweenRows) {
        return [betweenRows](const SegmentScale& segment) { return matrixText(segment.matrix, betweenRows); };
    };
    const QString help = tr("Offset from the default position; the specification names no unit");
    return {
        Column::numbers(tr("ID"), {}, [](const auto& segment) { return QString::number(segment.id); })
            .in({QStringLiteral("99")})
            .dimmed(),
        Column::words(tr("Segment"), {},
                      [](const auto& segment) { return segmentText(static_cast<int>(segment.id)); })
            .in({QStringLiteral("Right Upper Arm")}),
        coordinateColumn<SegmentScale>(tr("x"), help, 0, offset),
        coordinateColumn<SegmentScale>(tr("y"), help, 1, offset),
        coordinateColumn<SegmentScale>(tr("z"), help, 2, offset),
        Column::words(tr("Matrix"), tr("Rotation and scale relative to the default, row by row as sent"),
                      matrix(QStringLiteral(" ; ")))
            .in({.usual = QStringLiteral("12345678"), .isOpen = true})
            .withToolTip(matrix(QStringLiteral("\n"))),
    };
}

} // namespace

NullPoseSegmentModel::NullPoseSegmentModel(const NullPoseReading& reading)
    : NullPoseTable(reading, segmentColumns(), segmentRows) {}

NullPosePointModel::NullPosePointModel(const NullPoseReading& reading)
    : NullPoseTable(reading, pointColumns(), pointRows) {}

NullPoseLengthModel::NullPoseLengthModel(const NullPoseReading& reading)
    : NullPoseTable(reading, lengthColumns(),
                    [](const NullPoseReading& shown) { return shown.measures().lengths; }) {}

NullPoseScaleModel::NullPoseScaleModel(const NullPoseReading& reading)
    : NullPoseTable(reading, scaleColumns(), [](const NullPoseReading& shown) {
          return shown.scale() == nullptr ? std::vector<SegmentScale>() : shown.scale()->segments;
      }) {}

} // namespace posewire::gui
