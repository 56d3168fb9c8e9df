// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/null_pose_figure.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"

#include <Eigen/Geometry>

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

QPen pen(const QColor& colour, double width, Qt::PenStyle style = Qt::SolidLine) {
    return {colour, width, style, Qt::RoundCap, Qt::RoundJoin};
}

} // namespace

NullPoseFigure::NullPoseFigure(const NullPoseReading& reading, QWidget* parent)
    : QWidget(parent), m_reading(reading) {
    setAccessibleName(tr("Null pose from the front and from the right"));
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void NullPoseFigure::mark(int segment, int point) {
    m_segment = segment;
    m_selected = {point < 0 ? segment : -1, point};
    readPlaces();
    setAccessibleDescription(nameOf(m_selected));
    update();
}

std::vector<NullPoseFigure::Bone>
NullPoseFigure::bonesOf(const std::vector<std::optional<Eigen::Vector3d>>& places) const {
    std::vector<Bone> bones;
    const auto placeOf = [this](int segment) {
        return segment < 0 ? -1 : m_reading.places()[static_cast<std::size_t>(segment)];
    };
    for (const model::Segment& segment : model::bodySegments()) {
        const int begin = placeOf(segment.parent);
        const int end = placeOf(segment.id - 1);
        const int count = static_cast<int>(places.size());
        const bool isThere = begin >= 0 && end >= 0 && begin < count && end < count;
        const auto from = isThere ? places[static_cast<std::size_t>(begin)] : std::nullopt;
        const auto to = isThere ? places[static_cast<std::size_t>(end)] : std::nullopt;
        if (from && to) {
            bones.push_back({begin, *from, *to});
        }
    }
    return bones;
}

void NullPoseFigure::readPlaces() {
    m_dots.clear();
    m_bones.clear();
    m_before.clear();
    const model::NullPose* pose = m_reading.pose();
    if (pose == nullptr) {
        return;
    }
    const model::Distances& moved = m_reading.fromBefore();
    std::vector<std::optional<Eigen::Vector3d>> now(pose->segments.size());
    std::vector<std::optional<Eigen::Vector3d>> before(pose->segments.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (const Eigen::Vector3d& place = pose->segments[i].position; place.allFinite()) {
            now[i] = place;
            before[i] = i < moved.size() && moved[i] ? std::optional<Eigen::Vector3d>(place - *moved[i])
                                                     : std::nullopt;
        }
    }
    for (std::size_t i = 0; i < pose->points.size(); ++i) {
        const model::NullPose::Point& point = pose->points[i];
        const auto segment = static_cast<std::size_t>(point.segment - 1);
        const std::size_t place = segment < m_reading.places().size()
                                      ? static_cast<std::size_t>(m_reading.places()[segment])
                                      : segment;
        if (place < now.size() && now[place] && point.position.allFinite()) {
            m_dots.push_back({{-1, static_cast<int>(i)}, *now[place] + point.position});
        }
    }
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (now[i]) {
            m_dots.push_back({{static_cast<int>(i), -1}, *now[i]});
        }
    }
    m_bones = bonesOf(now);
    m_before = bonesOf(before);
}

QPointF NullPoseFigure::Projection::of(const Eigen::Vector3d& place, int across) const {
    const QPointF& origin = origins.at(static_cast<std::size_t>(across));
    // From the front the body's left is at the viewer's right; from its right it looks to the right.
    return {origin.x() + scale * place[across], origin.y() - scale * (place.z() - floor)};
}

NullPoseFigure::Projection NullPoseFigure::projection() const {
    Eigen::AlignedBox3d box;
    const auto add = [&box](const Eigen::Vector3d& place) {
        if (place.allFinite() && place.cwiseAbs().maxCoeff() < kGreatestExtent) {
            box.extend(place);
        }
    };
    for (const Dot& dot : m_dots) {
        add(dot.place);
    }
    for (const Bone& bone : m_before) {
        add(bone.from);
        add(bone.to);
    }
    if (box.isEmpty()) {
        box.extend(Eigen::Vector3d::Zero().eval());
    }
    const Eigen::Vector3d size = box.sizes().cwiseMax(kLeastExtent);
    const double line = fontMetrics().height();
    const double gap = 1.5 * line;
    const QRectF room = QRectF(rect()).adjusted(line, line, -line, -1.6 * line);
    Projection projection;
    projection.floor = box.min().z();
    projection.scale =
        std::max(1e-9, std::min((room.width() - gap) / (size.x() + size.y()), room.height() / size.z()));
    const double width = (size.x() + size.y()) * projection.scale + gap;
    const double left = room.center().x() - width / 2;
    const double bottom = room.center().y() + size.z() * projection.scale / 2;
    projection.origins = {
        QPointF(left + width - projection.scale * (size.x() / 2 + box.center().x()), bottom),
        QPointF(left + projection.scale * (size.y() / 2 - box.center().y()), bottom)};
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
    for (const int across : {1, 0}) {
        paintView(painter, shown, across);
    }
    if (hasFocus()) {
        painter.setPen(pen(theme().accent, 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
    }
}

/// The floor, and from which side each view looks.
void NullPoseFigure::paintFrame(QPainter& painter, const Projection& projection) const {
    const double line = fontMetrics().height();
    const auto& [side, front] = projection.origins;
    const double floor = front.y() + 0.5;
    painter.setPen(pen(theme().line, 1));
    painter.drawLine(QPointF(line / 2, floor), QPointF(width() - line / 2, floor));
    painter.setPen(theme().dim);
    const auto caption = [&](double middle, const QString& text) {
        const double wide = fontMetrics().horizontalAdvance(text) + 4.0;
        const double left = std::clamp(middle - wide / 2, 2.0, std::max(2.0, width() - wide - 2.0));
        painter.drawText(QRectF(left, floor + 2, wide, line * 1.3), Qt::AlignCenter, text);
    };
    const QString whole = tr("right  ←  front  →  left");
    const bool hasRoom = side.x() - front.x() > fontMetrics().horizontalAdvance(whole) / 2 + 2 * line;
    caption(front.x(), hasRoom ? whole : tr("front"));
    caption(side.x(), tr("side"));
}

bool NullPoseFigure::isOfSelected(const Item& item) const {
    return m_segment >= 0 &&
           (item.point < 0 ? item.segment == m_segment
                           : m_reading.pose()->points[static_cast<std::size_t>(item.point)].segment ==
                                 m_reading.segmentAt(m_segment) + 1);
}

void NullPoseFigure::paintView(QPainter& painter, const Projection& projection, int across) const {
    painter.setPen(pen(theme().warning, 1, Qt::DashLine));
    for (const Bone& bone : m_before) {
        painter.drawLine(projection.of(bone.from, across), projection.of(bone.to, across));
    }
    for (const Bone& bone : m_bones) {
        painter.setPen(bone.segment == m_segment ? pen(theme().accent, 3) : pen(theme().dim, 2));
        painter.drawLine(projection.of(bone.from, across), projection.of(bone.to, across));
    }
    for (const Dot& dot : m_dots) {
        const bool isPoint = dot.item.point >= 0;
        const bool isSelected = dot.item == m_selected;
        const QColor plain = isPoint ? withAlpha(theme().dim, 0.55) : theme().text;
        painter.setPen(isPoint ? QPen(Qt::NoPen) : pen(isSelected ? theme().accent : theme().panel, 1));
        painter.setBrush(isSelected || isOfSelected(dot.item) ? theme().accent : plain);
        const double radius = (isPoint ? kPointRadius : kSegmentRadius) + (isSelected ? 2 : 0);
        painter.drawEllipse(projection.of(dot.place, across), radius, radius);
    }
    if (const auto dot = std::ranges::find(m_dots, m_selected, &Dot::item); dot != m_dots.end()) {
        const QString name = nameOf(m_selected);
        const QPointF at = projection.of(dot->place, across) + QPointF(0, -1.4 * fontMetrics().height());
        QRectF plate(at, QSizeF(fontMetrics().horizontalAdvance(name) + 8, fontMetrics().height()));
        plate.moveLeft(
            std::clamp(plate.left() - plate.width() / 2, 2.0, std::max(2.0, width() - plate.width() - 2)));
        plate.moveTop(std::max(plate.top(), 2.0));
        painter.fillRect(plate, withAlpha(theme().panel, 0.85));
        painter.setPen(theme().accent);
        painter.drawText(plate, Qt::AlignCenter | Qt::TextDontClip, name);
    }
}

NullPoseFigure::Item NullPoseFigure::itemAt(const QPointF& pointer) const {
    const Projection shown = projection();
    Item item;
    double nearest = fontMetrics().height() * 0.7;
    for (const Dot& dot : m_dots) {
        for (const int across : {0, 1}) {
            const QPointF away = shown.of(dot.place, across) - pointer;
            // A joint's point lies on its segment's origin: there the segment is meant.
            const double distance = std::hypot(away.x(), away.y()) + (dot.item.point >= 0 ? 0.75 : 0.0);
            if (distance < nearest) {
                nearest = distance;
                item = dot.item;
            }
        }
    }
    return item;
}

QString NullPoseFigure::nameOf(const Item& item) const {
    const model::NullPose* pose = m_reading.pose();
    if (pose != nullptr && item.point >= 0 && item.point < static_cast<int>(pose->points.size())) {
        const auto& point = pose->points[static_cast<std::size_t>(item.point)];
        return QStringLiteral("%1.%2 %3").arg(point.segment).arg(point.id).arg(shown(point.name));
    }
    if (pose != nullptr && item.segment >= 0 && item.segment < static_cast<int>(pose->segments.size())) {
        const auto& segment = pose->segments[static_cast<std::size_t>(item.segment)];
        return QStringLiteral("%1 %2").arg(QString::number(item.segment + 1), fromUtf8(segment.title()));
    }
    return {};
}

QPointF NullPoseFigure::inFront(const Item& item) const {
    const auto dot = std::ranges::find(m_dots, item, &Dot::item);
    return dot == m_dots.end() ? QPointF() : projection().of(dot->place, 1);
}

void NullPoseFigure::mousePressEvent(QMouseEvent* event) {
    const Item item = itemAt(event->position());
    if (item.segment >= 0) {
        emit segmentPicked(item.segment);
    } else if (item.point >= 0) {
        emit pointPicked(item.point);
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
        QToolTip::showText(help->globalPos(), toolTipText(nameOf(itemAt(help->pos()))), this);
        return true;
    }
    return QWidget::event(event);
}

} // namespace posewire::gui
