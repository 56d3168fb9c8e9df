// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/null_pose_figure.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/plain_text.h"
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

std::optional<Eigen::Vector3d> at(const std::vector<std::optional<Eigen::Vector3d>>& places, int index) {
    const bool isThere = index >= 0 && index < static_cast<int>(places.size());
    return isThere ? places[static_cast<std::size_t>(index)] : std::nullopt;
}

QRectF squareAround(const QPointF& middle, double radius) {
    return QRectF(middle - QPointF(radius, radius), QSizeF(2 * radius, 2 * radius));
}

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
    void add(const QPointF& mark, const QString& text, const QColor& colour, double middle) {
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
                    return;
                }
            }
        }
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
    readPlaces();
    setAccessibleDescription(nameOf({segment, point}));
    update();
}

void NullPoseFigure::readPlaces() {
    for (Places* places : {&m_segments, &m_before, &m_points}) {
        places->clear();
    }
    const model::NullPose* pose = m_reading.pose();
    if (pose == nullptr) {
        return;
    }
    const auto known = [](bool isKnown, const Eigen::Vector3d& place) {
        return isKnown && place.allFinite() ? std::optional(place) : std::nullopt;
    };
    const model::Distances& moved = m_reading.fromBefore();
    for (std::size_t i = 0; i < pose->segments.size(); ++i) {
        const Eigen::Vector3d& place = pose->segments[i].position;
        const bool hasBefore = i < moved.size() && moved[i];
        m_segments.push_back(known(true, place));
        m_before.push_back(known(hasBefore, hasBefore ? Eigen::Vector3d(place - *moved[i]) : place));
    }
    for (const model::NullPose::Point& point : pose->points) {
        const int segment = point.segment - 1;
        const bool isBody = segment >= 0 && segment < model::kBodySegmentCount;
        const auto origin =
            at(m_segments, isBody ? m_reading.places()[static_cast<std::size_t>(segment)] : segment);
        m_points.push_back(
            known(origin.has_value(), origin.value_or(Eigen::Vector3d::Zero()) + point.position));
    }
}

QPointF NullPoseFigure::Projection::of(const Eigen::Vector3d& place, View view) const {
    const QPointF& origin = view == View::Front ? front : side;
    // From the front the body's left is at the viewer's right; from its right it looks to the right.
    const double across = view == View::Front ? place.y() : place.x();
    return {origin.x() + scale * across, origin.y() - scale * (place.z() - floor)};
}

NullPoseFigure::Projection NullPoseFigure::projection() const {
    Extent extent;
    for (const Places* places : {&m_segments, &m_before, &m_points}) {
        for (const auto& place : *places) {
            if (place) {
                extent.add(*place);
            }
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
        paintBones(painter, shown, view);
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

/// Calls `draw` with the ends of each bone that is known and the place of the segment that it begins at, to
/// which it belongs.
template <class Draw>
void NullPoseFigure::forEachBone(const Places& segments, Draw draw) const {
    const model::BodyPlaces& places = m_reading.places();
    for (const model::Segment& segment : model::bodySegments()) {
        const int begin = segment.parent < 0 ? -1 : places[static_cast<std::size_t>(segment.parent)];
        const auto from = at(segments, begin);
        const auto to = at(segments, places[static_cast<std::size_t>(segment.id - 1)]);
        if (from && to) {
            draw(*from, *to, begin);
        }
    }
}

/// Labels keep off bones: off their middles, since only bones along an axis fill their rectangle.
void NullPoseFigure::reserveBones(const Projection& projection, Labels& labels) const {
    constexpr int kSteps = 12;
    forEachBone(m_segments, [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, int) {
        for (const View view : {View::Front, View::Side}) {
            for (int step = 0; step < kSteps; ++step) {
                const double share = (step + 0.5) / kSteps;
                labels.reserve(squareAround(projection.of(from + share * (to - from), view), 2.5));
            }
        }
    });
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

void NullPoseFigure::paintBones(QPainter& painter, const Projection& projection, View view) const {
    painter.setPen(pen(theme().warning, 1, Qt::DashLine));
    forEachBone(m_before, [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, int) {
        painter.drawLine(projection.of(from, view), projection.of(to, view));
    });
    forEachBone(m_segments, [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, int begin) {
        painter.setPen(begin == m_segment ? pen(theme().accent, 3) : pen(theme().dim, 2));
        painter.drawLine(projection.of(from, view), projection.of(to, view));
    });
}

bool NullPoseFigure::isOfSelected(std::size_t point) const {
    return m_segment >= 0 && m_reading.pose()->points[point].segment == m_reading.segmentAt(m_segment) + 1;
}

void NullPoseFigure::paintMarks(QPainter& painter, const Projection& projection, View view) const {
    const QColor faint = withAlpha(theme().dim, 0.55);
    painter.setPen(Qt::NoPen);
    for (std::size_t i = 0; i < m_points.size(); ++i) {
        if (m_points[i]) {
            const bool isSelected = static_cast<int>(i) == m_point;
            painter.setBrush(isOfSelected(i) || isSelected ? theme().accent : faint);
            double radius = isOfSelected(i) ? kPointRadius + 0.6 : kPointRadius;
            radius = isSelected ? kSegmentRadius + 1.5 : radius;
            painter.drawEllipse(projection.of(*m_points[i], view), radius, radius);
        }
    }
    for (std::size_t i = 0; i < m_segments.size(); ++i) {
        if (m_segments[i]) {
            const bool isOwn = static_cast<int>(i) == m_segment;
            const bool isSelected = isOwn && m_point < 0;
            painter.setPen(pen(isSelected ? theme().accent : theme().panel, 1));
            painter.setBrush(isOwn ? theme().accent : theme().text);
            const double radius = isSelected ? kSegmentRadius + 2 : kSegmentRadius;
            painter.drawEllipse(projection.of(*m_segments[i], view), radius, radius);
        }
    }
    painter.setPen(Qt::NoPen);
}

void NullPoseFigure::paintLabels(QPainter& painter, const Projection& projection, View view,
                                 Labels& labels) const {
    for (const auto& place : m_segments) {
        if (place) {
            labels.reserve(squareAround(projection.of(*place, view), kSegmentRadius));
        }
    }
    for (const auto& place : m_points) {
        if (place) {
            labels.spare(squareAround(projection.of(*place, view), kPointRadius));
        }
    }
    const double middle = (view == View::Front ? projection.front : projection.side).x();
    const QFont plain = painter.font();
    QFont bold = plain;
    bold.setBold(true);
    painter.setFont(bold);
    if (const auto point = at(m_points, m_point)) {
        labels.add(projection.of(*point, view), nameOf({-1, m_point}), theme().accent, middle);
    } else if (const auto segment = at(m_segments, m_segment)) {
        labels.add(projection.of(*segment, view), nameOf({m_segment, -1}), theme().accent, middle);
    }
    painter.setFont(plain);
    if (view == View::Side) {
        return;
    }
    for (std::size_t i = 0; i < m_points.size(); ++i) {
        if (m_points[i] && static_cast<int>(i) != m_point && isOfSelected(i)) {
            labels.add(projection.of(*m_points[i], view), shown(m_reading.pose()->points[i].name),
                       theme().text, middle);
        }
    }
    for (int i = 0; i < static_cast<int>(m_segments.size()); ++i) {
        if (const auto place = i == m_segment ? std::nullopt : at(m_segments, i)) {
            labels.add(projection.of(*place, view), QString::number(i + 1), theme().dim, middle);
        }
    }
}

NullPoseFigure::Hit NullPoseFigure::hitAt(const QPointF& pointer) const {
    const Projection shown = projection();
    Hit hit;
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
    for (int i = 0; i < static_cast<int>(m_segments.size()); ++i) {
        consider(at(m_segments, i), {i, -1});
    }
    for (int i = 0; i < static_cast<int>(m_points.size()); ++i) {
        consider(at(m_points, i), {-1, i});
    }
    return hit;
}

QString NullPoseFigure::nameOf(const Hit& hit) const {
    if (hit.point >= 0 && hit.point < static_cast<int>(m_points.size())) {
        const auto& point = m_reading.pose()->points[static_cast<std::size_t>(hit.point)];
        return QStringLiteral("%1.%2 %3").arg(point.segment).arg(point.id).arg(shown(point.name));
    }
    if (hit.segment >= 0 && hit.segment < static_cast<int>(m_segments.size())) {
        const auto& segment = m_reading.pose()->segments[static_cast<std::size_t>(hit.segment)];
        return QStringLiteral("%1 %2").arg(QString::number(hit.segment + 1), fromUtf8(segment.title()));
    }
    return {};
}

QPointF NullPoseFigure::inFront(const Places& places, int index) const {
    return projection().of(at(places, index).value_or(Eigen::Vector3d::Zero()), View::Front);
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
    const int count = static_cast<int>(m_segments.size());
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
        QToolTip::showText(help->globalPos(), toolTipText(nameOf(hitAt(help->pos()))), this);
        return true;
    }
    return QWidget::event(event);
}

} // namespace posewire::gui
