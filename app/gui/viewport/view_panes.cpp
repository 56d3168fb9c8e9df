// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/view_panes.h"

#include "app/gui/theme/words.h"

#include <QJsonArray>
#include <QRect>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

/// Logical pixels between two panes.
constexpr int kGap = 2;

constexpr std::array kUsualViews{render::StandardView::ThreeQuarter, render::StandardView::Front,
                                 render::StandardView::Left, render::StandardView::Top};

} // namespace

void ViewPanes::split(int count, float heading) {
    m_count = count >= kMost ? kMost : std::clamp(count, 1, 2);
    for (int pane = 1; pane < m_count; ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        if (std::exchange(m_wasShown[index], true)) {
            continue;
        }
        CameraMotion& motion = m_motions[index];
        motion.face(kUsualViews[index]);
        motion.turn(heading);
        motion.setProjection(render::Projection::Orthographic);
    }
    activate(m_active);
}

void ViewPanes::activate(int pane) {
    m_active = std::clamp(pane, 0, m_count - 1);
}

QRect ViewPanes::place(int pane) const {
    if (m_count == 1) {
        return {{}, m_view};
    }
    const int width = std::max(1, (m_view.width() - kGap) / 2);
    const int height = m_count == 2 ? m_view.height() : std::max(1, (m_view.height() - kGap) / 2);
    return {(pane % 2) * (m_view.width() - width), (pane / 2) * (m_view.height() - height), width, height};
}

float ViewPanes::aspect() const {
    return static_cast<float>(std::max(1, place().width())) /
           static_cast<float>(std::max(1, place().height()));
}

int ViewPanes::paneAt(const QPointF& point) const {
    for (int pane = 0; pane < m_count; ++pane) {
        if (place(pane).contains(point.toPoint())) {
            return pane;
        }
    }
    return m_active;
}

QString ViewPanes::name(int pane) const {
    const CameraMotion& motion = m_motions[static_cast<std::size_t>(pane)];
    const bool isFlat = motion.camera().projection == render::Projection::Orthographic;
    const QString otherwise = isFlat ? tr("Orthographic") : tr("Perspective");
    if (!motion.standardView()) {
        return otherwise;
    }
    switch (*motion.standardView()) {
    case render::StandardView::Front:
        return tr("Front");
    case render::StandardView::Back:
        return tr("Back");
    case render::StandardView::Left:
        return tr("Left side");
    case render::StandardView::Right:
        return tr("Right side");
    case render::StandardView::Top:
        return tr("Top");
    case render::StandardView::ThreeQuarter:
        break;
    }
    return otherwise;
}

QJsonObject ViewPanes::state() const {
    QJsonArray cameras;
    for (int pane = 0; pane < kMost; ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        cameras.append(m_wasShown[index] ? stateOf(m_motions[index]) : QJsonObject());
    }
    return {{"count", m_count}, {"active", m_active}, {"cameras", cameras}};
}

void ViewPanes::restoreState(const QJsonObject& state) {
    const QJsonArray cameras = state["cameras"].toArray();
    for (int pane = 0; pane < kMost; ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        const QJsonObject camera = cameras.at(pane).toObject();
        if (!camera.isEmpty()) {
            m_wasShown[index] = true;
            restore(m_motions[index], camera);
        }
    }
    split(state["count"].toInt(m_count), 0);
    activate(state["active"].toInt(m_active));
}

} // namespace posewire::gui
