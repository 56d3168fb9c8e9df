// SPDX-License-Identifier: GPL-3.0-or-later
// The viewport in several views.
#include "app/gui/models/shown_character.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/pane_frame.h"
#include "app/gui/viewport/viewport_overlay.h"
#include "app/gui/viewport/viewport_widget.h"

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

PaneFrame::PaneFrame(QWidget* parent) : QWidget(parent) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
}

void PaneFrame::setPanes(const std::vector<NamedPane>& panes, int active) {
    if (panes != m_panes || active != m_active) {
        m_panes = panes;
        m_active = active;
        update();
    }
}

void PaneFrame::paintEvent(QPaintEvent* /*event*/) {
    if (m_panes.empty()) {
        return;
    }
    QPainter painter(this);
    QRegion between(rect());
    for (const NamedPane& pane : m_panes) {
        between -= pane.place;
    }
    for (const QRect& part : between) {
        painter.fillRect(part, theme().line);
    }
    constexpr int kMargin = 8;
    for (const NamedPane& pane : m_panes) {
        const QRect inner = pane.place.adjusted(kMargin, kMargin, -kMargin, -kMargin);
        const QRect words = fontMetrics().boundingRect(inner, Qt::AlignRight | Qt::AlignBottom, pane.name);
        painter.setPen(Qt::NoPen);
        painter.setBrush(withAlpha(theme().panel, 0.7));
        painter.setRenderHint(QPainter::Antialiasing);
        painter.drawRoundedRect(words.adjusted(-6, -2, 6, 2), 4, 4);
        painter.setRenderHint(QPainter::Antialiasing, false);
        painter.setPen(theme().dim);
        painter.setBrush(Qt::NoBrush);
        painter.drawText(words, Qt::AlignCenter, pane.name);
    }
    constexpr qreal kWidth = 2;
    painter.setPen(QPen(parentWidget()->hasFocus() ? theme().accent : withAlpha(theme().accent, 0.55), kWidth,
                        Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
    const QRectF active(m_panes.at(static_cast<std::size_t>(m_active)).place);
    painter.drawRect(active.adjusted(kWidth / 2, kWidth / 2, -kWidth / 2, -kWidth / 2));
}

void ViewportWidget::split(int count) {
    m_look.panes.split(count, heading());
    refresh();
    updatePanes(m_shown == nullptr ? SceneFrame() : *m_shown);
    emit optionsChanged();
}

void ViewportWidget::activateNext() {
    activate((m_look.panes.active() + 1) % m_look.panes.count());
}

void ViewportWidget::activate(int pane) {
    if (pane == m_look.panes.active()) {
        return;
    }
    m_look.panes.activate(pane);
    updatePanes(m_shown == nullptr ? SceneFrame() : *m_shown);
    emit optionsChanged();
}

float ViewportWidget::heading() const {
    const auto key = shownCharacter(*m_session);
    const model::CharacterPose* pose = key ? m_session->pose(*key) : nullptr;
    if (!m_hasRelativeViews || pose == nullptr || pose->isObjects || !pose->isPresent(render::Pelvis)) {
        return 0;
    }
    const Eigen::Vector3d ahead = pose->segments[render::Pelvis].orientation * Eigen::Vector3d::UnitX();
    return static_cast<float>(std::atan2(ahead.y(), ahead.x()));
}

QRect ViewportWidget::paneAt(const QPointF& pointer) const {
    return m_look.panes.place(m_look.panes.paneAt(pointer, size()), size());
}

float ViewportWidget::aspect() const {
    const QSize pane = m_look.panes.place(m_look.panes.active(), size()).size();
    return static_cast<float>(std::max(1, pane.width())) / static_cast<float>(std::max(1, pane.height()));
}

/// Labels are over the pane whose figures they name.
void ViewportWidget::updatePanes(const SceneFrame& shown) {
    const bool isWhole = shown.panes.empty();
    m_overlay->setLabels(isWhole ? labelsOf(shown, *m_session, size()) : std::vector<ViewportLabel>());
    m_overlay->setTexts(isWhole ? textsOf(shown, size()) : std::vector<ViewportText>());
    std::vector<PaneFrame::NamedPane> panes;
    for (int pane = 0; pane < ViewPanes::kMost; ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        ViewportOverlay* overlay = m_paneOverlays[index];
        const bool isThere = index < shown.panes.size() && pane < m_look.panes.count();
        if (isThere) {
            const QRect place = m_look.panes.place(pane, size());
            panes.push_back({place, m_look.panes.name(pane)});
            overlay->setGeometry(place);
            overlay->setLabels(labelsOf(shown.panes[index], *m_session, place.size()));
            overlay->setTexts(textsOf(shown.panes[index], place.size()));
        }
        overlay->setVisible(isThere);
    }
    const bool isActiveThere = m_look.panes.active() < static_cast<int>(panes.size());
    m_paneFrame->setPanes(isActiveThere ? panes : std::vector<PaneFrame::NamedPane>(), m_look.panes.active());
}

std::optional<PickedSegment> ViewportWidget::pickAt(const QPointF& pointer) const {
    if (m_shown == nullptr) {
        return std::nullopt;
    }
    const auto pane = static_cast<std::size_t>(m_look.panes.paneAt(pointer, size()));
    const QRect place = paneAt(pointer);
    const bool isWhole = m_shown->panes.empty();
    if (!isWhole && pane >= m_shown->panes.size()) {
        return std::nullopt;
    }
    return pickIn(isWhole ? *m_shown : m_shown->panes[pane], pointer - place.topLeft(), place.size());
}

} // namespace posewire::gui
