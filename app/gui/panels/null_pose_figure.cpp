// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/null_pose_figure.h"

#include "app/gui/models/null_pose_table.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr double kSegmentRadius = 3.0;
constexpr double kPointRadius = 1.6;
constexpr double kLeastExtent = 0.2; ///< metres; less would be blown up
constexpr double kGreatestExtent = 1e7;

struct Extent {
    Eigen::Vector3d least = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d most = -least;

    void add(const Eigen::Vector3d& place) {
        if (place.allFinite() && place.cwiseAbs().maxCoeff() < kGreatestExtent) {
            least = least.cwiseMin(place);
            most = most.cwiseMax(place);
        }
    }
    [[nodiscard]] bool isEmpty() const { return !(least.x() <= most.x()); }
    [[nodiscard]] double size(int axis) const { return std::max(most[axis] - least[axis], kLeastExtent); }
    [[nodiscard]] double middle(int axis) const { return (most[axis] + least[axis]) / 2; }
};

QPen pen(const QColor& colour, double width, Qt::PenStyle style = Qt::SolidLine) {
    return {colour, width, style, Qt::RoundCap, Qt::RoundJoin};
}

} // namespace

/// Texts beside marks, none over another: the first to ask gets its place.
class NullPoseFigure::Labels {
public:
    Labels(QPainter& painter, const QRectF& room) : m_painter(painter), m_room(room) {}

    /// Kept free of labels.
    void reserve(const QRectF& rect) { m_taken.push_back(rect); }
    /// Kept free where a label has room elsewhere.
    void spare(const QRectF& rect) { m_spared.push_back(rect); }

    /// Beside the mark, away from the body's middle (pixels) where there is room.
    bool add(const QPointF& mark, const QString& text, const QColor& colour, double middle) {
        const QFontMetricsF metrics(m_painter.font());
        const QSizeF size(metrics.horizontalAdvance(text), metrics.height());
        const double away = kSegmentRadius + 3;
        double outward = away;
        double inward = -away - size.width();
        if (mark.x() < middle - 1) {
            std::swap(outward, inward);
        }
        const double above = -size.height() - away;
        const std::array places{QPointF(outward, -size.height() / 2),
                                QPointF(-size.width() / 2, above),
                                QPointF(-size.width() / 2, away),
                                QPointF(inward, -size.height() / 2),
                                QPointF(outward, above),
                                QPointF(outward, away),
                                QPointF(inward, above),
                                QPointF(inward, away)};
        for (const bool isSparing : {true, false}) {
            for (const QPointF& place : places) {
                const QRectF rect(mark + place, size);
                if (m_room.contains(rect) && !hits(m_taken, rect) && !(isSparing && hits(m_spared, rect))) {
                    m_taken.push_back(rect.adjusted(-3, 0, 3, 0));
                    m_painter.setPen(colour);
                    m_painter.drawText(rect, Qt::AlignCenter | Qt::TextDontClip, text);
                    return true;
                }
            }
        }
        return false;
    }

private:
    static bool hits(const std::vector<QRectF>& others, const QRectF& rect) {
        return std::ranges::any_of(others, [&](const QRectF& other) { return other.intersects(rect); });
    }

    QPainter& m_painter;
    QRectF m_room;
    std::vector<QRectF> m_taken;
    std::vector<QRectF> m_spared;
};

NullPoseFigure::NullPoseFigure(const NullPoseReading& reading, QWidget* parent)
    : QWidget(parent), m_reading(reading) {
    setAccessibleName(tr("Null pose from the front and from the right"));
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void NullPoseFigure::mark(int segment, int point) {
    m_segment = segment;
    m_point = point;
    setAccessibleDescription(nameOf({segment, point}));
    update();
}

QSize NullPoseFigure::sizeHint() const {
    return {fontMetrics().height() * 20, fontMetrics().height() * 15};
}

QSize NullPoseFigure::minimumSizeHint() const {
    return {fontMetrics().height() * 8, fontMetrics().height() * 6};
}

std::optional<Eigen::Vector3d> NullPoseFigure::segmentAt(int place) const {
    const model::NullPose* pose = m_reading.pose();
    if (pose == nullptr || place < 0 || place >= static_cast<int>(pose->segments.size())) {
        return std::nullopt;
    }
    const Eigen::Vector3d& position = pose->segments[static_cast<std::size_t>(place)].position;
    return position.allFinite() ? std::optional(position) : std::nullopt;
}

std::optional<Eigen::Vector3d> NullPoseFigure::segmentBefore(int place) const {
    const auto now = segmentAt(place);
    const auto& distances = m_reading.fromBefore();
    const auto index = static_cast<std::size_t>(place);
    return now && index < distances.size() && distances[index]
               ? std::optional<Eigen::Vector3d>(*now - *distances[index])
               : std::nullopt;
}

std::optional<Eigen::Vector3d> NullPoseFigure::pointAt(int index) const {
    const model::NullPose* pose = m_reading.pose();
    if (pose == nullptr || index < 0 || index >= static_cast<int>(pose->points.size())) {
        return std::nullopt;
    }
    const model::NullPose::Point& point = pose->points[static_cast<std::size_t>(index)];
    const bool isBody = point.segment >= 1 && point.segment <= model::kBodySegmentCount;
    const auto origin = segmentAt(isBody ? m_reading.places()[static_cast<std::size_t>(point.segment - 1)]
                                         : point.segment - 1);
    return origin && point.position.allFinite() ? std::optional<Eigen::Vector3d>(*origin + point.position)
                                                : std::nullopt;
}

QPointF NullPoseFigure::Projection::of(const Eigen::Vector3d& place, View view) const {
    const QPointF& origin = view == View::Front ? front : side;
    // From the front the body's left is at the viewer's right; from its right it looks to the right.
    const double across = view == View::Front ? place.y() : place.x();
    return {origin.x() + scale * across, origin.y() - scale * (place.z() - floor)};
}

NullPoseFigure::Projection NullPoseFigure::projection() const {
    Extent extent;
    const model::NullPose* pose = m_reading.pose();
    for (int i = 0; pose != nullptr && i < static_cast<int>(pose->segments.size()); ++i) {
        extent.add(segmentAt(i).value_or(pose->segments[static_cast<std::size_t>(i)].position));
        extent.add(segmentBefore(i).value_or(extent.isEmpty() ? Eigen::Vector3d::Zero() : extent.least));
    }
    for (int i = 0; pose != nullptr && i < static_cast<int>(pose->points.size()); ++i) {
        if (const auto place = pointAt(i)) {
            extent.add(*place);
        }
    }
    if (extent.isEmpty()) {
        extent.add(Eigen::Vector3d::Zero());
    }
    const double line = fontMetrics().height();
    const double gap = 1.5 * line;
    const QRectF room = QRectF(rect()).adjusted(line, line, -line, -1.6 * line);
    Projection projection;
    const double across = extent.size(1) + extent.size(0);
    projection.scale =
        std::max(1e-9, std::min((room.width() - gap) / across, room.height() / extent.size(2)));
    projection.floor = extent.least.z();
    const double width = across * projection.scale + gap;
    const double left = room.center().x() - width / 2;
    const double bottom = room.center().y() + extent.size(2) * projection.scale / 2;
    projection.front = {left + projection.scale * (extent.size(1) / 2 - extent.middle(1)), bottom};
    projection.side = {left + width - projection.scale * (extent.size(0) / 2 + extent.middle(0)), bottom};
    return projection;
}

void NullPoseFigure::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().panel);
    if (m_reading.pose() == nullptr) {
        return;
    }
    painter.setRenderHint(QPainter::Antialiasing);
    const Projection shown = projection();
    paintFrame(painter, shown);
    for (const View view : {View::Front, View::Side}) {
        if (m_reading.hasChanged()) {
            paintBones(painter, shown, view, true);
        }
        paintBones(painter, shown, view, false);
        paintMarks(painter, shown, view);
    }
    QFont small = tabularFont();
    small.setPixelSize(QFontInfo(font()).pixelSize() * 7 / 8);
    painter.setFont(small);
    Labels labels(painter, QRectF(0, 0, width(), shown.front.y())); // captions are below the floor
    reserveBones(shown, labels);
    paintLabels(painter, shown, View::Front, labels);
    paintLabels(painter, shown, View::Side, labels);
    if (hasFocus()) {
        painter.setPen(pen(theme().accent, 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
    }
}

/// Labels keep off bones: off their middles, since only bones along an axis fill their rectangle.
void NullPoseFigure::reserveBones(const Projection& projection, Labels& labels) const {
    constexpr int kSteps = 12;
    const model::BodyPlaces& places = m_reading.places();
    for (const model::Segment& segment : model::bodySegments()) {
        const auto to = segmentAt(places[static_cast<std::size_t>(segment.id - 1)]);
        const auto from =
            segment.parent < 0 ? std::nullopt : segmentAt(places[static_cast<std::size_t>(segment.parent)]);
        for (const View view : {View::Front, View::Side}) {
            for (int step = 0; to && from && step < kSteps; ++step) {
                const double share = (step + 0.5) / kSteps;
                const QPointF middle = projection.of(*from + share * (*to - *from), view);
                labels.reserve(QRectF(middle - QPointF(2.5, 2.5), QSizeF(5, 5)));
            }
        }
    }
}

/// The floor, and from where one looks.
void NullPoseFigure::paintFrame(QPainter& painter, const Projection& projection) const {
    const double line = fontMetrics().height();
    const double floor = projection.front.y() + 0.5;
    painter.setPen(pen(theme().line, 1));
    painter.drawLine(QPointF(line / 2, floor), QPointF(width() - line / 2, floor));
    painter.setPen(theme().dim);
    const QRectF below(0, floor + 2, 0, line * 1.3);
    const auto caption = [&](double middle, const QString& text) {
        const double wide = fontMetrics().horizontalAdvance(text) + 4.0;
        const double left = std::clamp(middle - wide / 2, 2.0, std::max(2.0, width() - wide - 2.0));
        painter.drawText(QRectF(left, below.top(), wide, below.height()), Qt::AlignCenter, text);
    };
    const QString front = tr("right  ←  front  →  left");
    const bool hasRoom =
        projection.side.x() - projection.front.x() > fontMetrics().horizontalAdvance(front) / 2 + 2 * line;
    caption(projection.front.x(), hasRoom ? front : tr("front"));
    caption(projection.side.x(), tr("side"));
}

void NullPoseFigure::paintBones(QPainter& painter, const Projection& projection, View view,
                                bool isBefore) const {
    const model::BodyPlaces& places = m_reading.places();
    for (const model::Segment& segment : model::bodySegments()) {
        if (segment.parent < 0) {
            continue;
        }
        const int place = places[static_cast<std::size_t>(segment.id - 1)];
        const int parentPlace = places[static_cast<std::size_t>(segment.parent)];
        const auto to = isBefore ? segmentBefore(place) : segmentAt(place);
        const auto from = isBefore ? segmentBefore(parentPlace) : segmentAt(parentPlace);
        if (!to || !from) {
            continue;
        }
        // A bone belongs to the segment that it begins at.
        const bool isSelected = !isBefore && parentPlace == m_segment;
        painter.setPen(isBefore     ? pen(theme().warning, 1, Qt::DashLine)
                       : isSelected ? pen(theme().accent, 3)
                                    : pen(theme().dim, 2));
        painter.drawLine(projection.of(*from, view), projection.of(*to, view));
    }
}

void NullPoseFigure::paintMarks(QPainter& painter, const Projection& projection, View view) const {
    const model::NullPose& pose = *m_reading.pose();
    const int selectedId = m_segment < 0 ? -1 : m_reading.segmentAt(m_segment) + 1;
    QColor faint = theme().dim;
    faint.setAlphaF(0.55F);
    painter.setPen(Qt::NoPen);
    for (int i = 0; i < static_cast<int>(pose.points.size()); ++i) {
        if (const auto place = pointAt(i)) {
            const bool isOfSelected = pose.points[static_cast<std::size_t>(i)].segment == selectedId;
            painter.setBrush(isOfSelected || i == m_point ? theme().accent : faint);
            const double radius = i == m_point   ? kSegmentRadius + 1.5
                                  : isOfSelected ? kPointRadius + 0.6
                                                 : kPointRadius;
            painter.drawEllipse(projection.of(*place, view), radius, radius);
        }
    }
    for (int i = 0; i < static_cast<int>(pose.segments.size()); ++i) {
        if (const auto place = segmentAt(i)) {
            const bool isSelected = i == m_segment && m_point < 0;
            painter.setPen(pen(isSelected ? theme().accent : theme().panel, 1));
            painter.setBrush(i == m_segment ? theme().accent : theme().text);
            const double radius = isSelected ? kSegmentRadius + 2 : kSegmentRadius;
            painter.drawEllipse(projection.of(*place, view), radius, radius);
            painter.setPen(Qt::NoPen);
        }
    }
}

void NullPoseFigure::paintLabels(QPainter& painter, const Projection& projection, View view,
                                 Labels& labels) const {
    const model::NullPose& pose = *m_reading.pose();
    const auto point = pointAt(m_point);
    const auto segment = segmentAt(m_segment);
    for (int i = 0; i < static_cast<int>(pose.segments.size()); ++i) {
        if (const auto place = segmentAt(i)) {
            const double side = 2 * kSegmentRadius;
            labels.reserve(
                QRectF(projection.of(*place, view) - QPointF(side / 2, side / 2), QSizeF(side, side)));
        }
    }
    for (int i = 0; i < static_cast<int>(pose.points.size()); ++i) {
        if (const auto place = pointAt(i)) {
            const double side = 2 * kPointRadius;
            labels.spare(
                QRectF(projection.of(*place, view) - QPointF(side / 2, side / 2), QSizeF(side, side)));
        }
    }
    const double middle = (view == View::Front ? projection.front : projection.side).x();
    const QFont plain = painter.font();
    QFont bold = plain;
    bold.setBold(true);
    painter.setFont(bold);
    if (point) {
        labels.add(projection.of(*point, view), nameOf({-1, m_point}), theme().accent, middle);
    } else if (segment) {
        labels.add(projection.of(*segment, view), nameOf({m_segment, -1}), theme().accent, middle);
    }
    painter.setFont(plain);
    if (view == View::Side) {
        return;
    }
    const int selectedId = m_segment < 0 ? -1 : m_reading.segmentAt(m_segment) + 1;
    for (int i = 0; i < static_cast<int>(pose.points.size()); ++i) {
        const auto place = pointAt(i);
        if (place && i != m_point && pose.points[static_cast<std::size_t>(i)].segment == selectedId) {
            labels.add(projection.of(*place, view),
                       QString::fromStdString(pose.points[static_cast<std::size_t>(i)].name), theme().text,
                       middle);
        }
    }
    for (int i = 0; i < static_cast<int>(pose.segments.size()); ++i) {
        const auto place = i == m_segment ? std::nullopt : segmentAt(i);
        if (place) {
            labels.add(projection.of(*place, view), QString::number(i + 1), theme().dim, middle);
        }
    }
}

NullPoseFigure::Hit NullPoseFigure::hitAt(const QPointF& pointer) const {
    const model::NullPose* pose = m_reading.pose();
    Hit hit;
    if (pose == nullptr) {
        return hit;
    }
    const Projection shown = projection();
    double nearest = fontMetrics().height() * 0.7;
    const auto consider = [&](const std::optional<Eigen::Vector3d>& place, Hit candidate) {
        for (const View view : {View::Front, View::Side}) {
            const QPointF away = place ? shown.of(*place, view) - pointer : QPointF(1e9, 0);
            // A joint's point lies on its segment's origin: there the segment is meant.
            const double distance = std::hypot(away.x(), away.y()) + (candidate.point >= 0 ? 0.75 : 0.0);
            if (distance < nearest) {
                nearest = distance;
                hit = candidate;
            }
        }
    };
    for (int i = 0; i < static_cast<int>(pose->segments.size()); ++i) {
        consider(segmentAt(i), {i, -1});
    }
    for (int i = 0; i < static_cast<int>(pose->points.size()); ++i) {
        consider(pointAt(i), {-1, i});
    }
    return hit;
}

QString NullPoseFigure::nameOf(const Hit& hit) const {
    const model::NullPose* pose = m_reading.pose();
    if (pose != nullptr && hit.point >= 0 && hit.point < static_cast<int>(pose->points.size())) {
        const model::NullPose::Point& point = pose->points[static_cast<std::size_t>(hit.point)];
        return QStringLiteral("%1.%2 %3")
            .arg(point.segment)
            .arg(point.id)
            .arg(QString::fromStdString(point.name));
    }
    if (pose != nullptr && hit.segment >= 0 && hit.segment < static_cast<int>(pose->segments.size())) {
        const std::string& name = pose->segments[static_cast<std::size_t>(hit.segment)].name;
        return QStringLiteral("%1 %2").arg(hit.segment + 1).arg(QString::fromStdString(name));
    }
    return {};
}

QPointF NullPoseFigure::placeOfSegment(int segment) const {
    return projection().of(segmentAt(segment).value_or(Eigen::Vector3d::Zero()), View::Front);
}

QPointF NullPoseFigure::placeOfPoint(int point) const {
    return projection().of(pointAt(point).value_or(Eigen::Vector3d::Zero()), View::Front);
}

void NullPoseFigure::mousePressEvent(QMouseEvent* event) {
    const Hit hit = hitAt(event->position());
    if (hit.segment >= 0) {
        emit segmentPicked(hit.segment);
    } else if (hit.point >= 0) {
        emit pointPicked(hit.point);
    }
}

void NullPoseFigure::keyPressEvent(QKeyEvent* event) {
    const int count = m_reading.pose() == nullptr ? 0 : static_cast<int>(m_reading.pose()->segments.size());
    const bool isNext = event->key() == Qt::Key_Right || event->key() == Qt::Key_Down;
    const bool isPrevious = event->key() == Qt::Key_Left || event->key() == Qt::Key_Up;
    if (count == 0 || (!isNext && !isPrevious)) {
        QWidget::keyPressEvent(event);
        return;
    }
    emit segmentPicked(isNext ? std::min(m_segment + 1, count - 1) : std::max(m_segment - 1, 0));
}

bool NullPoseFigure::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), nameOf(hitAt(help->pos())), this);
        return true;
    }
    return QWidget::event(event);
}

} // namespace posewire::gui
