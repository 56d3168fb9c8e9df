// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/null_pose_reading.h"

#include <QWidget>

#include <vector>

namespace posewire::gui {

/// The null pose as it was sent, from the front and from its right: bones, segments, points. What is selected
/// is named; what moved since the message before is drawn where it was.
class NullPoseFigure final : public QWidget {
    Q_OBJECT

public:
    /// The reading must outlive the figure.
    explicit NullPoseFigure(const NullPoseReading& reading, QWidget* parent = nullptr);

    /// The reading has changed, or what is selected: a place in the list of segments and one in that of
    /// points, −1 for none.
    void mark(int segment, int point);

    [[nodiscard]] QSize sizeHint() const override {
        return {fontMetrics().height() * 20, fontMetrics().height() * 15};
    }
    [[nodiscard]] QSize minimumSizeHint() const override {
        return {fontMetrics().height() * 8, fontMetrics().height() * 6};
    }

    /// Where a segment is on the widget, in the view from the front; for tests and scripts.
    [[nodiscard]] QPointF placeOfSegment(int segment) const { return inFront(m_segments, segment); }
    [[nodiscard]] QPointF placeOfPoint(int point) const { return inFront(m_points, point); }

signals:
    void segmentPicked(int segment);
    void pointPicked(int point);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

private:
    enum class View { Front, Side };
    struct Projection {
        double scale = 1; ///< pixels a metre
        QPointF front;    ///< where y = 0 meets the floor
        QPointF side;     ///< where x = 0 meets the floor
        double floor = 0; ///< metres
        [[nodiscard]] QPointF of(const Eigen::Vector3d& place, View view) const;
    };
    struct Hit {
        int segment = -1;
        int point = -1;
    };
    class Labels;
    using Places = std::vector<std::optional<Eigen::Vector3d>>; ///< metres; nothing where unknown

    void readPlaces();
    [[nodiscard]] Projection projection() const;
    [[nodiscard]] QPointF inFront(const Places& places, int index) const;
    [[nodiscard]] Hit hitAt(const QPointF& pointer) const;
    [[nodiscard]] QString nameOf(const Hit& hit) const;
    [[nodiscard]] bool isOfSelected(std::size_t point) const;
    template <class Draw>
    void forEachBone(const Places& segments, Draw draw) const;
    void paintBones(QPainter& painter, const Projection& projection, View view) const;
    void paintMarks(QPainter& painter, const Projection& projection, View view) const;
    void paintLabels(QPainter& painter, const Projection& projection, View view, Labels& labels) const;
    void reserveBones(const Projection& projection, Labels& labels) const;
    void paintFrame(QPainter& painter, const Projection& projection) const;

    const NullPoseReading& m_reading;
    Places m_segments; ///< in the order of the message, as are the others
    Places m_before;   ///< of segments, in the message before
    Places m_points;
    int m_segment = -1;
    int m_point = -1;
};

} // namespace posewire::gui
