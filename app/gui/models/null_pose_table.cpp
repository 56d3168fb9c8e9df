// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/null_pose_table.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"

#include <array>

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

QString distanceText(const model::Distances& distances, std::size_t row) {
    const auto distance = at(distances, row);
    return millimetres(distance ? std::optional(distance->norm()) : std::nullopt);
}

QString matrixText(const wire::Mat3& matrix, const QString& betweenRows) {
    QString text;
    for (std::size_t i = 0; i < matrix.size(); ++i) {
        text += i == 0 ? QString() : i % 3 == 0 ? betweenRows : QStringLiteral(" ");
        text += fixed(static_cast<double>(matrix[i]), 3);
    }
    return text;
}

QString coordinate(const Eigen::Vector3d& position, int axis) {
    return fixed(position[axis], kMetreDecimals);
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
        return NullPoseTable::tr("Segment %1").arg(wireId);
    }
    const std::string_view name = model::bodySegments()[static_cast<std::size_t>(wireId - 1)].displayName;
    return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

void NullPoseTable::refresh() {
    const int rows = static_cast<int>(count());
    if (rows > m_rows) {
        beginInsertRows({}, m_rows, rows - 1);
        m_rows = rows;
        endInsertRows();
    } else if (rows < m_rows) {
        beginRemoveRows({}, rows, m_rows - 1);
        m_rows = rows;
        endRemoveRows();
    }
    if (m_rows > 0) {
        emit dataChanged(index(0, 0), index(m_rows - 1, columnCount() - 1));
    }
}

int NullPoseTable::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : m_rows;
}

int NullPoseTable::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(m_columns.size());
}

QVariant NullPoseTable::data(const QModelIndex& index, int role) const {
    const auto row = static_cast<std::size_t>(index.row());
    if (!checkIndex(index, CheckIndexOption::IndexIsValid) || row >= count()) {
        return {};
    }
    switch (role) {
    case Qt::DisplayRole:
        return text(row, index.column());
    case Qt::TextAlignmentRole:
        return m_columns[static_cast<std::size_t>(index.column())].isNumber ? numberAlignment() : QVariant();
    default:
        return look(row, index.column(), role);
    }
}

QVariant NullPoseTable::look(std::size_t /*row*/, int /*column*/, int /*role*/) const {
    return {};
}

QVariant NullPoseTable::headerData(int section, Qt::Orientation orientation, int role) const {
    return orientation == Qt::Horizontal ? columnHeader(m_columns, m_context, section, role) : QVariant();
}

namespace {

constexpr const char* kSegments = "posewire::gui::NullPoseSegmentModel";
constexpr std::array<ColumnText, NullPoseSegmentModel::kColumnCount> kSegmentColumns{{
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "ID"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel",
                       "Place in the message, from 1: type 13 sends no IDs")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "Segment"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "Name as sent"), false},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "x m"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "Origin of the segment: x forward, Z-up")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "y m"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "Origin of the segment: y to the left, Z-up")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "z m"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel",
                       "Origin of the segment: height over the balls of the feet")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "Δ last mm"),
     QT_TRANSLATE_NOOP(
         "posewire::gui::NullPoseSegmentModel",
         "How far the segment moved since the newest message that said something else, as sent")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseSegmentModel", "Δ ref mm"),
     QT_TRANSLATE_NOOP(
         "posewire::gui::NullPoseSegmentModel",
         "How far the segment is from that of the reference body of the same height, which stands "
         "on the same balls of the feet with its pelvis above them")},
}};

constexpr const char* kPoints = "posewire::gui::NullPosePointModel";
constexpr std::array<ColumnText, NullPosePointModel::kColumnCount> kPointColumns{{
    {QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "ID"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "Segment and point within it")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "Point"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "Name as sent; joints begin with j"), false},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "x m"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "From the segment's origin, Z-up")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "y m"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "From the segment's origin, Z-up")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "z m"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "From the segment's origin, Z-up")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "Flags"),
     QT_TRANSLATE_NOOP(
         "posewire::gui::NullPosePointModel",
         "\"Characteristics\" of the point, 32 bits. The specification does not say what they mean.")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel", "Bits"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPosePointModel",
                       "Bits of the flags that are set, 0 being the lowest; their meaning is not published")},
}};

constexpr const char* kLengths = "posewire::gui::NullPoseLengthModel";
constexpr std::array<ColumnText, NullPoseLengthModel::kColumnCount> kLengthColumns{{
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseLengthModel", "Length"), "", false},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseLengthModel", "Left mm"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseLengthModel",
                       "From the segment's origin to the next one's, or to its end point")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseLengthModel", "Right mm"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseLengthModel",
                       "From the segment's origin to the next one's, or to its end point")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseLengthModel", "L − R mm"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseLengthModel",
                       "Left minus right; marked from 5 mm, since bodies that MVN measured are symmetric")},
}};

constexpr const char* kScales = "posewire::gui::NullPoseScaleModel";
constexpr std::array<ColumnText, NullPoseScaleModel::kColumnCount> kScaleColumns{{
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel", "ID"), ""},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel", "Segment"), "", false},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel", "x"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel",
                       "Offset from the default position; the specification names no unit")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel", "y"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel",
                       "Offset from the default position; the specification names no unit")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel", "z"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel",
                       "Offset from the default position; the specification names no unit")},
    {QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel", "Matrix"),
     QT_TRANSLATE_NOOP("posewire::gui::NullPoseScaleModel",
                       "Rotation and scale relative to the default, row by row as sent"),
     false},
}};

} // namespace

NullPoseSegmentModel::NullPoseSegmentModel(const NullPoseReading& reading, QObject* parent)
    : NullPoseTable(reading, kSegmentColumns, kSegments, parent) {}

std::size_t NullPoseSegmentModel::count() const {
    return reading().pose() == nullptr ? 0 : reading().pose()->segments.size();
}

QString NullPoseSegmentModel::text(std::size_t row, int column) const {
    const model::NullPose::Segment& segment = reading().pose()->segments[row];
    switch (column) {
    case kId:
        return QString::number(row + 1);
    case kName:
        return QString::fromStdString(segment.name);
    case kFromBefore:
        return distanceText(reading().fromBefore(), row);
    case kFromReference:
        return distanceText(reading().fromReference(), row);
    default:
        return coordinate(segment.position, column - kX);
    }
}

QVariant NullPoseSegmentModel::look(std::size_t row, int column, int role) const {
    const model::Distances& distances =
        column == kFromBefore ? reading().fromBefore() : reading().fromReference();
    const auto distance = column >= kFromBefore ? at(distances, row) : std::nullopt;
    const bool hasMoved = distance && !(distance->norm() < kVisibleChange);
    if (role == Qt::ToolTipRole) {
        return distance ? QVariant(vectorText(distance)) : headerData(column, Qt::Horizontal, role);
    }
    if (role == Qt::ForegroundRole) {
        if (column == kFromBefore && hasMoved) {
            return theme().warning;
        }
        return column == kId || column >= kFromBefore ? QVariant(theme().dim) : QVariant();
    }
    return {};
}

NullPosePointModel::NullPosePointModel(const NullPoseReading& reading, QObject* parent)
    : NullPoseTable(reading, kPointColumns, kPoints, parent) {}

std::size_t NullPosePointModel::count() const {
    return reading().pose() == nullptr ? 0 : reading().pose()->points.size();
}

QString NullPosePointModel::text(std::size_t row, int column) const {
    const model::NullPose::Point& point = reading().pose()->points[row];
    switch (column) {
    case kId:
        return QStringLiteral("%1.%2").arg(point.segment).arg(point.id);
    case kName:
        return QString::fromStdString(point.name);
    case kFlags:
        return QStringLiteral("0x%1").arg(point.flags, 8, 16, QLatin1Char('0'));
    case kBits:
        return bitsText(point.flags);
    default:
        return coordinate(point.position, column - kX);
    }
}

QVariant NullPosePointModel::look(std::size_t row, int column, int role) const {
    const model::NullPose::Point& point = reading().pose()->points[row];
    const bool hasSegment =
        point.segment >= 1 && static_cast<std::size_t>(point.segment) <= reading().pose()->segments.size();
    if (role == Qt::ForegroundRole) {
        if (!hasSegment) {
            return theme().error;
        }
        return column == kId || column >= kFlags ? QVariant(theme().dim) : QVariant();
    }
    if (role == Qt::ToolTipRole) {
        return column <= kName ? QVariant(tr("Point %1 of %2").arg(point.id).arg(segmentText(point.segment)))
                               : headerData(column, Qt::Horizontal, role);
    }
    return {};
}

NullPoseLengthModel::NullPoseLengthModel(const NullPoseReading& reading, QObject* parent)
    : NullPoseTable(reading, kLengthColumns, kLengths, parent) {}

std::size_t NullPoseLengthModel::count() const {
    return reading().measures().lengths.size();
}

int NullPoseLengthModel::segment(int row) const {
    const model::SegmentLength& length = reading().measures().lengths[static_cast<std::size_t>(row)];
    return length.right;
}

QString NullPoseLengthModel::text(std::size_t row, int column) const {
    const model::SegmentLength& length = reading().measures().lengths[row];
    const bool hasSides = length.left >= 0;
    switch (column) {
    case kName:
        return QString::fromUtf8(length.name.data(), static_cast<qsizetype>(length.name.size()));
    case kLeft:
        return millimetres(hasSides ? length.leftMetres : length.rightMetres);
    case kRight:
        return hasSides ? millimetres(length.rightMetres) : QString();
    default:
        if (!hasSides) {
            return tr("trunk");
        }
        return length.difference()
                   ? (length.isAsymmetric() ? healthSymbol(Health::Warning) + QLatin1Char(' ') : QString()) +
                         signedFixed(*length.difference() * kMillimetres, kMillimetreDecimals)
                   : dash();
    }
}

QVariant NullPoseLengthModel::look(std::size_t row, int column, int role) const {
    const model::SegmentLength& length = reading().measures().lengths[row];
    if (role == Qt::ForegroundRole && column == kDifference) {
        return length.isAsymmetric() ? theme().warning : theme().dim;
    }
    return role == Qt::ToolTipRole ? headerData(column, Qt::Horizontal, role) : QVariant();
}

NullPoseScaleModel::NullPoseScaleModel(const NullPoseReading& reading, QObject* parent)
    : NullPoseTable(reading, kScaleColumns, kScales, parent) {}

std::size_t NullPoseScaleModel::count() const {
    return reading().scale() == nullptr ? 0 : reading().scale()->segments.size();
}

QString NullPoseScaleModel::text(std::size_t row, int column) const {
    const wire::SegmentScale& segment = reading().scale()->segments[row];
    switch (column) {
    case kId:
        return QString::number(segment.id);
    case kName:
        return segmentText(static_cast<int>(segment.id));
    case kMatrix:
        return matrixText(segment.matrix, QStringLiteral(" ; "));
    default:
        return fixed(static_cast<double>(segment.offset[static_cast<std::size_t>(column - kX)]),
                     kMetreDecimals);
    }
}

QVariant NullPoseScaleModel::look(std::size_t row, int column, int role) const {
    if (role == Qt::ToolTipRole && column == kMatrix) {
        return matrixText(reading().scale()->segments[row].matrix, QStringLiteral("\n"));
    }
    if (role == Qt::ForegroundRole) {
        return column == kId ? QVariant(theme().dim) : QVariant();
    }
    return role == Qt::ToolTipRole ? headerData(column, Qt::Horizontal, role) : QVariant();
}

} // namespace posewire::gui
