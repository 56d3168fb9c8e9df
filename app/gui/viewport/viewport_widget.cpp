// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/viewport_widget.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/captions.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <cmath>
#include <vector>

namespace posewire::gui {

/// The lines between the panes of a view, their names, and the frame around the active one.
class PaneFrame final : public QWidget {
public:
    explicit PaneFrame(QWidget* parent) : QWidget(parent) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setAttribute(Qt::WA_NoSystemBackground);
    }

    struct NamedPane {
        QRect place;
        QString name;

        bool operator==(const NamedPane&) const = default;
    };
    /// None for a view that is not split.
    void setPanes(const std::vector<NamedPane>& panes, int active) {
        if (panes != m_panes || active != m_active) {
            m_panes = panes;
            m_active = active;
            update();
        }
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
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
            const QRect words =
                fontMetrics().boundingRect(inner, Qt::AlignRight | Qt::AlignBottom, pane.name);
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
        painter.setPen(QPen(parentWidget()->hasFocus() ? theme().accent : withAlpha(theme().accent, 0.55),
                            kWidth, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
        const QRectF active(m_panes.at(static_cast<std::size_t>(m_active)).place);
        painter.drawRect(active.adjusted(kWidth / 2, kWidth / 2, -kWidth / 2, -kWidth / 2));
    }

private:
    std::vector<NamedPane> m_panes;
    int m_active = 0;
};

namespace {

constexpr double kWheelStep = 120.0;

} // namespace

ViewportWidget::ViewportWidget(model::SessionView& session, Commands& commands, QWidget* parent)
    : QWidget(parent),
      m_session(&session),
      m_commands(commands),
      m_pictures(new PictureLoop(session, m_choice->look(), this)),
      m_paneFrame(new PaneFrame(this)) {
    for (ViewportOverlay*& overlay : m_paneOverlays) {
        overlay = new ViewportOverlay(this);
        overlay->hide();
    }
    m_banner->raise(); // over the labels of all views
    m_card->raise();
    constexpr int kRest = 120; // milliseconds: a pointer that passes by asks nothing
    m_hoverTimer.setSingleShot(true);
    m_hoverTimer.setInterval(kRest);
    connect(&m_hoverTimer, &QTimer::timeout, this, [this] {
        m_hovered = pickAt(m_pointer);
        updateCard();
    });
    connect(m_pictures, &PictureLoop::presented, this, &ViewportWidget::updateOverlay);
    connect(m_choice, &ViewChoice::cameraMoved, this, &ViewportWidget::refresh);
    connect(m_choice, &ViewChoice::changed, this, [this] {
        m_pictures->setInterpolating(m_choice->isSwitchedOn(ViewSwitch::Interpolation));
        refresh();
        updatePanes();
        updateCard();
    });
    for (const QEvent::Type look : {QEvent::PaletteChange, QEvent::StyleChange}) {
        new EventWatch(this, look, [this] { refresh(); });
    }
    setMouseTracking(true);
    setObjectName(QStringLiteral("viewport"));
    setAccessibleName(tr("Characters in space"));
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(240, 160);
}

void ViewportWidget::showSession(model::SessionView& session, const QString& file) {
    m_session = &session;
    m_file = file;
    m_hovered.reset();
    m_wordsStamp = {};
    m_pictures->showSession(session);
    updateOverlay();
}

void ViewportWidget::setReceiving(const ReceivingState& receiving) {
    m_receiving = receiving;
    updateOverlay();
}

void ViewportWidget::updateOverlay() {
    if (!m_pictures->isDrawing()) { // else the next picture updates the labels
        updatePanes();
    }
    updateWords();
    if (const QString problem = m_pictures->failure(); !problem.isEmpty()) {
        m_overlay->setCard(
            {Health::Error,
             tr("No picture: OpenGL 3.3 could not be used"),
             {problem, tr("Everything else in this window works. Installing Mesa's drivers (package "
                          "libgl1-mesa-dri) usually helps.")},
             HelpTopic::NoPicture});
    } else {
        m_overlay->setCard(emptyState(*m_session, m_receiving, m_file));
    }
}

/// Words need not change as often as pictures.
void ViewportWidget::updateWords() {
    constexpr log::Duration kEvery = std::chrono::milliseconds(100);
    const log::Stamp now = m_session->now();
    const bool isFollowing = m_session->choices().cursor.mode == model::Cursor::Mode::Following;
    const bool isAsked = m_session->choices().selection != m_wordsSelection;
    if (isAsked || !isFollowing || now >= m_wordsStamp + kEvery || now < m_wordsStamp) {
        m_wordsStamp = now;
        m_wordsSelection = m_session->choices().selection;
        m_banner->refresh(*m_session, m_choice->isSwitchedOn(ViewSwitch::Interpolation));
        updateCard();
    }
}

/// The hovered segment, else the selected one.
void ViewportWidget::updateCard() {
    std::optional<PickedSegment> about = m_hovered;
    if (const model::Selection& selected = m_session->choices().selection;
        !about && selected.character && selected.segment >= 0) {
        about = {*selected.character, selected.segment};
    }
    const bool isWanted =
        m_choice->isSwitchedOn(ViewSwitch::Card) && about && !m_session->roster().isHidden(about->key);
    const model::CharacterPose* pose = isWanted ? m_session->messages().pose(about->key) : nullptr;
    const bool isThere = pose != nullptr && pose->isPresent(static_cast<std::size_t>(about->segment));
    if (isThere && m_pictures->shown() != nullptr) {
        const QRect pane = m_choice->look().panes.place();
        m_card->keepClearOf(roomOf(*m_pictures->shown(), about->key, pane.size()).translated(pane.topLeft()));
    }
    m_card->setPointer(m_hovered ? std::optional(m_pointer.toPoint()) : std::nullopt);
    m_card->setFacts(isThere ? std::optional(segmentFacts({*m_session, about->key, *pose}, about->segment))
                             : std::nullopt);
}

/// Labels are over the pane whose figures they name.
void ViewportWidget::updatePanes() {
    const bool hasPicture = m_pictures->shown() != nullptr && m_pictures->failure().isEmpty();
    static const SceneFrame kNothing;
    const SceneFrame& shown = hasPicture ? *m_pictures->shown() : kNothing;
    const ViewPanes& panes = m_choice->look().panes;
    const bool isWhole = shown.panes.empty();
    m_overlay->setLabels(isWhole ? labelsOf(shown, *m_session, size()) : std::vector<ViewportLabel>());
    m_overlay->setTexts(isWhole ? textsOf(shown, size()) : std::vector<ViewportText>());
    std::vector<PaneFrame::NamedPane> named;
    for (int pane = 0; pane < ViewPanes::kMost; ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        ViewportOverlay* overlay = m_paneOverlays.at(index);
        const bool isThere = index < shown.panes.size() && pane < panes.count();
        if (isThere) {
            const QRect place = panes.place(pane);
            named.push_back({place, panes.name(pane)});
            overlay->setGeometry(place);
            overlay->setLabels(labelsOf(shown.panes[index], *m_session, place.size()));
            overlay->setTexts(textsOf(shown.panes[index], place.size()));
        }
        overlay->setVisible(isThere);
    }
    const bool isActiveThere = panes.active() < static_cast<int>(named.size());
    m_paneFrame->setPanes(isActiveThere ? named : std::vector<PaneFrame::NamedPane>(), panes.active());
}

float ViewportWidget::heading() const {
    const auto key = shownCharacter(*m_session);
    const model::CharacterPose* pose = key ? m_session->messages().pose(*key) : nullptr;
    const bool isRelative = m_choice->isSwitchedOn(ViewSwitch::RelativeViews);
    if (!isRelative || pose == nullptr || pose->isObjects || !pose->isPresent(render::Pelvis)) {
        return 0;
    }
    const Eigen::Vector3d ahead = pose->segments[render::Pelvis].orientation * Eigen::Vector3d::UnitX();
    return static_cast<float>(std::atan2(ahead.y(), ahead.x()));
}

std::optional<PickedSegment> ViewportWidget::pickAt(const QPointF& pointer) const {
    const SceneFrame* shown = m_pictures->shown();
    const ViewPanes& panes = m_choice->look().panes;
    const auto pane = static_cast<std::size_t>(panes.paneAt(pointer));
    if (shown == nullptr || (!shown->panes.empty() && pane >= shown->panes.size())) {
        return std::nullopt;
    }
    const QRect place = panes.place(static_cast<int>(pane));
    return pickIn(shown->panes.empty() ? *shown : shown->panes[pane], pointer - place.topLeft(),
                  place.size());
}

void ViewportWidget::frameAll() {
    if (const SceneFrame* shown = m_pictures->shown()) {
        ViewPanes& panes = m_choice->look().panes;
        panes.motion().frame(boxesOf(*shown), panes.aspect());
        refresh();
    }
}

void ViewportWidget::frameCharacter(const model::CharacterKey& key) {
    const SceneFrame* shown = m_pictures->shown();
    for (std::size_t i = 0; shown != nullptr && i < shown->figures.size(); ++i) {
        const Figure& figure = shown->figures[i];
        if (m_session->roster().isSame(figure.key, key) && !figure.bounds.isEmpty()) {
            ViewPanes& panes = m_choice->look().panes;
            panes.motion().show(paddedBounds(figure), panes.aspect());
            refresh();
            return;
        }
    }
}

/// Seen until there is a picture.
void ViewportWidget::paintEvent(QPaintEvent* /*event*/) {
    QPainter(this).fillRect(rect(), theme().window);
}

void ViewportWidget::resizeEvent(QResizeEvent* /*event*/) {
    m_overlay->setGeometry(rect());
    m_paneFrame->setGeometry(rect());
    m_banner->place(size());
    m_card->place();
    refresh();
}

void ViewportWidget::mousePressEvent(QMouseEvent* event) {
    m_pressed = m_pointer = event->position();
    m_isDragging = false;
    m_choice->activate(m_choice->look().panes.paneAt(event->position()));
}

void ViewportWidget::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() == Qt::NoButton) {
        m_pointer = event->position();
        m_hoverTimer.start();
        return;
    }
    m_hoverTimer.stop();
    if (!m_isDragging &&
        (event->position() - m_pressed).manhattanLength() < QApplication::startDragDistance()) {
        return;
    }
    m_isDragging = true;
    const QPointF movement = event->position() - m_pointer;
    m_pointer = event->position();
    const bool isPan =
        event->buttons().testFlag(Qt::MiddleButton) ||
        (event->buttons().testFlag(Qt::LeftButton) && event->modifiers().testFlag(Qt::ShiftModifier));
    ViewPanes& panes = m_choice->look().panes;
    if (isPan) {
        panes.motion().pan(movement, panes.place().size());
    } else if (event->buttons().testFlag(Qt::LeftButton)) {
        panes.motion().orbit(movement);
    }
    refresh();
}

void ViewportWidget::mouseReleaseEvent(QMouseEvent* event) {
    if (m_isDragging || event->button() != Qt::LeftButton) {
        return;
    }
    m_hovered = pickAt(event->position()); // who walks may be elsewhere than when the pointer came to rest
    m_commands.select(m_hovered ? model::Selection{m_hovered->key.sender, m_hovered->key, m_hovered->segment}
                                : model::Selection());
    updateCard();
}

void ViewportWidget::mouseDoubleClickEvent(QMouseEvent* event) {
    if (const auto pick = pickAt(event->position())) {
        frameCharacter(pick->key);
    }
}

void ViewportWidget::wheelEvent(QWheelEvent* event) {
    m_choice->activate(m_choice->look().panes.paneAt(event->position()));
    ViewPanes& panes = m_choice->look().panes;
    const QPointF pointer = event->position() - panes.place().topLeft();
    panes.motion().zoom(event->angleDelta().y() / kWheelStep, pointer, panes.place().size());
    event->accept();
    m_pointer = event->position();
    m_hoverTimer.start();
    refresh();
}

void ViewportWidget::leaveEvent(QEvent* event) {
    m_hoverTimer.stop();
    m_hovered.reset();
    updateCard();
    QWidget::leaveEvent(event);
}

} // namespace posewire::gui
