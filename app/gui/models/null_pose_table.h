// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/columns.h"
#include "app/gui/models/null_pose_reading.h"

#include <QAbstractTableModel>

namespace posewire::gui {

/// A table over one part of a reading. Rows are those of the message, so that they never jump.
class NullPoseTable : public QAbstractTableModel {
    Q_OBJECT

public:
    /// `context` is that of the columns' texts.
    NullPoseTable(const NullPoseReading& reading, std::span<const ColumnText> columns, const char* context,
                  QObject* parent = nullptr)
        : QAbstractTableModel(parent), m_reading(reading), m_columns(columns), m_context(context) {}

    /// The reading has changed.
    void refresh();

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

protected:
    [[nodiscard]] const NullPoseReading& reading() const { return m_reading; }
    [[nodiscard]] virtual std::size_t count() const = 0;
    [[nodiscard]] virtual QString text(std::size_t row, int column) const = 0;
    /// Roles other than text and alignment.
    [[nodiscard]] virtual QVariant look(std::size_t row, int column, int role) const;

private:
    const NullPoseReading& m_reading;
    std::span<const ColumnText> m_columns;
    const char* m_context;
    int m_rows = 0;
};

/// Type 13, segments: where each is, and how far from where it was and from the reference body.
class NullPoseSegmentModel final : public NullPoseTable {
    Q_OBJECT

public:
    enum Column : int { kId, kName, kX, kY, kZ, kFromBefore, kFromReference, kColumnCount };
    explicit NullPoseSegmentModel(const NullPoseReading& reading, QObject* parent = nullptr);

protected:
    [[nodiscard]] std::size_t count() const override;
    [[nodiscard]] QString text(std::size_t row, int column) const override;
    [[nodiscard]] QVariant look(std::size_t row, int column, int role) const override;
};

/// Type 13, points.
class NullPosePointModel final : public NullPoseTable {
    Q_OBJECT

public:
    enum Column : int { kId, kName, kX, kY, kZ, kFlags, kBits, kColumnCount };
    explicit NullPosePointModel(const NullPoseReading& reading, QObject* parent = nullptr);

protected:
    [[nodiscard]] std::size_t count() const override;
    [[nodiscard]] QString text(std::size_t row, int column) const override;
    [[nodiscard]] QVariant look(std::size_t row, int column, int role) const override;
};

/// Lengths of the body, left against right.
class NullPoseLengthModel final : public NullPoseTable {
    Q_OBJECT

public:
    enum Column : int { kName, kLeft, kRight, kDifference, kColumnCount };
    explicit NullPoseLengthModel(const NullPoseReading& reading, QObject* parent = nullptr);

    /// The body segment that a length is of.
    [[nodiscard]] int segment(int row) const;

protected:
    [[nodiscard]] std::size_t count() const override;
    [[nodiscard]] QString text(std::size_t row, int column) const override;
    [[nodiscard]] QVariant look(std::size_t row, int column, int role) const override;
};

/// Type 10: offset and matrix of each segment.
class NullPoseScaleModel final : public NullPoseTable {
    Q_OBJECT

public:
    enum Column : int { kId, kName, kX, kY, kZ, kMatrix, kColumnCount };
    explicit NullPoseScaleModel(const NullPoseReading& reading, QObject* parent = nullptr);

protected:
    [[nodiscard]] std::size_t count() const override;
    [[nodiscard]] QString text(std::size_t row, int column) const override;
    [[nodiscard]] QVariant look(std::size_t row, int column, int role) const override;
};

/// "31, 2, 0": the bits that are set, highest first; "–" for none.
[[nodiscard]] QString bitsText(std::uint32_t flags);

/// "Right Upper Arm" for 9; "Segment 30" where it is none of the body.
[[nodiscard]] QString segmentText(int wireId);

} // namespace posewire::gui
