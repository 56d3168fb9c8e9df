// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/null_pose_reading.h"

#include <QWidget>

#include <array>
#include <vector>

namespace posewire::gui {

/// The null pose as it was sent, from the front and from its right: bones, segments by their numbers, points.
/// It names the selection and draws the bones of the message before where they were.
class NullPoseFigure final : public QWidget {
    Q_OBJECT

public:
    /// The reading must outlive the figure.
    explicit NullPoseFigure(const NullPoseReading& reading, QWidget* parent = nullptr);

    /// For when the reading or the selection has changed: a place in the list of segments and one in that of
    /// points, −1 for none.
    void mark(int segment, int point);

    [[nodiscard]] QSize sizeHint() const override {
        return {fontMetrics().height() * 20, fontMetrics().height() * 15};
    }
    [[nodiscard]] QSize minimumSizeHint() const override {
        return {fontMetrics().height() * 8, fontMetrics().height() * 6};
    }

    /// For tests and scripts.
    [[nodiscard]] QPointF placeOfSegment(int segment) const { return inFront({segment, -1}); }
    [[nodiscard]] QPointF placeOfPoint(int point) const { return inFront({-1, point}); }

signals:
    void segmentPicked(int segment);
    void pointPicked(int point);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

private:
    /// Two views, each by the axis that lies across it: y from the front, x from the right.
    struct Projection {
        double scale = 1;               ///< pixels a metre
        double floor = 0;               ///< metres
        std::array<QPointF, 2> origins; ///< by axis: where 0 of it meets the floor
        [[nodiscard]] QPointF of(const Eigen::Vector3d& place, int across) const;
    };
    /// One of both by its place in the message; −1 for the other.
    struct Item {
        int segment = -1;
        int point = -1;
        friend bool operator==(const Item&, const Item&) = default;
    };
    struct Dot {
        Item item;
        Eigen::Vector3d place; ///< metres
    };
    struct Bone {
        int segment = -1; ///< place of the segment that it begins at
        Eigen::Vector3d from;
        Eigen::Vector3d to;
    };

    [[nodiscard]] std::vector<Bone> bonesOf(const std::vector<std::optional<Eigen::Vector3d>>& places) const;
    void readPlaces();
    [[nodiscard]] Projection projection() const;
    [[nodiscard]] QPointF inFront(const Item& item) const;
    [[nodiscard]] Item itemAt(const QPointF& pointer) const;
    [[nodiscard]] QString nameOf(const Item& item) const;
    [[nodiscard]] bool isOfSelected(const Item& item) const;
    void paintFrame(QPainter& painter, const Projection& projection) const;
    void paintView(QPainter& painter, const Projection& projection, int across) const;

    const NullPoseReading& m_reading;
    std::vector<Dot> m_dots; ///< those that are known: points, then segments
    std::vector<Bone> m_bones;
    std::vector<Bone> m_before; ///< in the message before, if that was another body
    Item m_selected;            ///< the point if there is one, else the segment
    int m_segment = -1;
};

} // namespace posewire::gui
