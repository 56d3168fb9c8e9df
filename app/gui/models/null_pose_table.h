// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "app/gui/models/null_pose_reading.h"

#include <Eigen/Core>

namespace posewire::gui {

/// A segment of type 13, and how far it is from where it was and from the reference body.
struct NullPoseSegmentRow {
    std::size_t place = 0;
    model::NullPose::Segment segment;
    std::optional<Eigen::Vector3d> fromBefore{};
    std::optional<Eigen::Vector3d> fromReference{};
};

/// A point of type 13.
struct NullPosePointRow {
    model::NullPose::Point point;
    bool hasSegment = true; ///< false where the message has no such segment
};

/// A table over one part of a reading. Rows are those of the message, so that they never jump.
template <class Row>
class NullPoseTable : public TableModel<Row> {
public:
    using Rows = std::vector<Row> (*)(const NullPoseReading& reading);
    NullPoseTable(const NullPoseReading& reading, std::vector<TableColumn<Row>> columns, Rows read)
        : TableModel<Row>(withHelpInCells(std::move(columns))), m_reading(reading), m_read(read) {}

    /// The reading has changed.
    void refresh() { this->setRows(m_read(m_reading)); }

private:
    const NullPoseReading& m_reading;
    Rows m_read;
};

/// Type 13, segments: where each is, and how far from where it was and from the reference body.
class NullPoseSegmentModel final : public NullPoseTable<NullPoseSegmentRow> {
public:
    enum Column : int { kId, kName, kX, kY, kZ, kFromBefore, kFromReference };
    explicit NullPoseSegmentModel(const NullPoseReading& reading);
};

/// Type 13, points.
class NullPosePointModel final : public NullPoseTable<NullPosePointRow> {
public:
    enum Column : int { kId, kName, kX, kY, kZ, kFlags, kBits };
    explicit NullPosePointModel(const NullPoseReading& reading);
};

/// Lengths of the body, left against right.
class NullPoseLengthModel final : public NullPoseTable<model::SegmentLength> {
public:
    enum Column : int { kName, kLeft, kRight, kDifference };
    explicit NullPoseLengthModel(const NullPoseReading& reading);

    /// The body segment that a length is of.
    [[nodiscard]] int segment(int row) const { return rows()[static_cast<std::size_t>(row)].right; }
};

/// Type 10: offset and matrix of each segment.
class NullPoseScaleModel final : public NullPoseTable<wire::SegmentScale> {
public:
    enum Column : int { kId, kName, kX, kY, kZ, kMatrix };
    explicit NullPoseScaleModel(const NullPoseReading& reading);
};

} // namespace posewire::gui
