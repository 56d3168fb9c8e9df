// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/viewport_widget.h"

#include "app/gui/base/logging.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/viewport/captions.h"
#include "app/gui/viewport/overlays.h"
#include "app/gui/viewport/pane_frame.h"
#include "app/gui/viewport/picture_health.h"
#include "app/gui/viewport/pose_banner.h"
#include "app/gui/viewport/segment_card.h"
#include "app/gui/viewport/viewport_overlay.h"

#include <QApplication>
#include <QJsonArray>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <limits>
#include <utility>

namespace posewire::gui {

namespace {

constexpr double kWheelStep = 120.0;

} // namespace

ViewportWidget::ViewportWidget(model::SessionView& session, Commands& commands, QWidget* parent)
    : QWidget(parent),
      m_session(&session),
      m_commands(commands),
      m_overlay(new ViewportOverlay(this)),
      m_paneFrame(new PaneFrame(this)),
      m_banner(new PoseBanner(commands, this)),
      m_card(new SegmentCard(this, *m_banner)) {
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
    constexpr int kGlide = 12; // milliseconds: faster than displays would show it
    m_glideTimer.setSingleShot(true);
    m_glideTimer.setInterval(kGlide);
    connect(&m_glideTimer, &QTimer::timeout, this, &ViewportWidget::refresh);
    connect(&m_ownCharacters, &OwnCharacters::changed, this, [this] {
        m_look.wardrobe = m_ownCharacters.wardrobe();
        refresh();
    });
    setMouseTracking(true);
    setObjectName(QStringLiteral("viewport"));
    setAccessibleName(tr("Characters in space"));
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(240, 160);
}

ViewportWidget::~ViewportWidget() = default;

void ViewportWidget::start(Presenter* (*makeHardware)(QWidget*)) {
    if (m_presenter != nullptr) {
        return;
    }
    Presenter* hardware = makeHardware(this);
    m_isHardware = hardware != nullptr;
    qCInfo(drawingLog) << (m_isHardware ? "into the window, by graphics hardware"
                                        : "on a thread, by the processor or without the window's OpenGL");
    use(m_isHardware ? hardware : makeSoftwarePresenter(this));
}

void ViewportWidget::use(Presenter* presenter) {
    m_presenter = presenter;
    m_builder = makeBuilder();
    m_presenter->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_presenter->setGeometry(rect());
    m_presenter->lower();
    m_presenter->setVisible(true);
    connect(m_presenter, &Presenter::presented, this, &ViewportWidget::onPresented);
    connect(m_presenter, &Presenter::ready, this, &ViewportWidget::drawNext);
    connect(m_presenter, &Presenter::outgrown, this, &ViewportWidget::refresh);
    refresh();
}

/// Hardware that fails, be it at once or by a reset of its driver, leaves the processor to draw.
void ViewportWidget::leaveHardware() {
    m_hardwareFailure = m_presenter->failure();
    qCWarning(drawingLog).noquote() << "graphics hardware failed, the processor draws:" << m_hardwareFailure;
    disconnect(m_presenter, nullptr, this, nullptr);
    m_presenter->setVisible(false);
    m_presenter->deleteLater();
    m_isHardware = false;
    m_drawing.reset();
    use(makeSoftwarePresenter(this));
}

std::unique_ptr<SceneBuilder> ViewportWidget::makeBuilder() const {
    return std::make_unique<SceneBuilder>(*m_session,
                                          m_isHardware ? render::Detail::High : render::Detail::Medium);
}

void ViewportWidget::showSession(model::SessionView& session, const QString& file) {
    m_session = &session;
    m_file = file;
    m_shown.reset(); // its figures are of the other session
    m_drawing.reset();
    m_hovered.reset();
    m_followed = {};
    m_wordsStamp = {};
    if (m_builder != nullptr) {
        m_builder = makeBuilder();
    }
    updateOverlay();
    refresh();
}

void ViewportWidget::setComparison(const ComparisonState& comparison) {
    m_comparison = &comparison;
    refresh();
}

void ViewportWidget::setReceiving(const ReceivingState& receiving) {
    m_receiving = receiving;
    updateOverlay();
}

void ViewportWidget::refresh() {
    m_isOutdated = true;
    drawNext();
}

void ViewportWidget::drawNext() {
    if (!m_isOutdated || m_presenter == nullptr || !m_presenter->isReady() || !isVisible()) {
        return;
    }
    auto frame = std::make_shared<SceneFrame>();
    frame->pixelRatio = static_cast<float>(devicePixelRatioF());
    frame->width = std::max(1, qRound(width() * devicePixelRatioF()));
    frame->height = std::max(1, qRound(height() * devicePixelRatioF()));
    m_builder->setInterpolating(m_isInterpolating);
    m_builder->setComparison(m_comparison);
    // Between two moments at rest no pictures come in which the camera could glide.
    const model::Cursor& cursor = m_session->cursor();
    const bool isAtRest = cursor.mode == model::Cursor::Mode::Paused && cursor.speed == 0;
    const bool isElsewhere = isAtRest && cursor.packet != m_followedPacket;
    const double seconds =
        isElsewhere ? std::numeric_limits<double>::infinity() : log::secondsOf(m_session->now() - m_followed);
    m_followedPacket = cursor.packet;
    if (m_look.panes.isSplit()) {
        m_look.fillPanes(*m_builder, seconds, size(), *frame);
    } else {
        m_look.fill(*m_builder, seconds, *frame);
    }
    m_followed = m_session->now();
    m_drawingBuilt = m_session->now();
    m_isOutdated = false;
    if (m_builder->isUnderWay() || (isAtRest && m_look.isGliding())) {
        m_glideTimer.start();
    }
    m_drawing = frame;
    m_presenter->present(std::move(frame));
}

void ViewportWidget::onPresented() {
    if (m_isHardware && !m_presenter->failure().isEmpty()) {
        leaveHardware();
        return;
    }
    if (!std::exchange(m_hasPicture, true)) {
        qCInfo(drawingLog).noquote() << "first picture by" << m_presenter->rendererName();
    }
    if (m_drawing != nullptr) {
        m_shown = std::exchange(m_drawing, nullptr);
        m_shownBuilt = m_drawingBuilt;
    }
    updateOverlay();
    drawNext();
}

void ViewportWidget::updateOverlay() {
    const SceneFrame nothing;
    const bool hasPicture = m_shown != nullptr && failure().isEmpty();
    const SceneFrame& shown = hasPicture ? *m_shown : nothing;
    updatePanes(shown);
    updateWords();
    if (const QString problem = failure(); !problem.isEmpty()) {
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
    const bool isFollowing = m_session->cursor().mode == model::Cursor::Mode::Following;
    const bool isAsked = m_session->selection() != m_wordsSelection;
    if (isAsked || !isFollowing || now >= m_wordsStamp + kEvery || now < m_wordsStamp) {
        m_wordsStamp = now;
        m_wordsSelection = m_session->selection();
        m_banner->refresh(*m_session, m_isInterpolating);
        updateCard();
    }
}

/// Of what the pointer rests on, else of the selected segment.
void ViewportWidget::updateCard() {
    std::optional<PickedSegment> about = m_hovered;
    if (const model::Selection& selected = m_session->selection();
        !about && selected.character && selected.segment >= 0) {
        about = {*selected.character, selected.segment};
    }
    const bool isWanted = m_hasCard && about && !m_session->isHidden(about->key);
    const model::CharacterPose* pose = isWanted ? m_session->pose(about->key) : nullptr;
    const bool isThere = pose != nullptr && pose->isPresent(static_cast<std::size_t>(about->segment));
    if (isThere && m_shown != nullptr) {
        const QRect pane = m_look.panes.place(m_look.panes.active(), size());
        m_card->keepClearOf(roomOf(*m_shown, about->key, pane.size()).translated(pane.topLeft()));
    }
    m_card->setPointer(m_hovered ? std::optional(m_pointer.toPoint()) : std::nullopt);
    m_card->setFacts(isThere ? std::optional(segmentFacts({*m_session, about->key, *pose}, about->segment))
                             : std::nullopt);
}

PictureHealth ViewportWidget::pictureHealth() const {
    return m_hasPicture ? pictureHealthOf(m_presenter->load(), m_hardwareFailure) : PictureHealth{};
}

bool ViewportWidget::isSettled() const {
    constexpr log::Duration kFresh = std::chrono::milliseconds(250);
    const bool isIdle = !m_isOutdated && m_drawing == nullptr;
    // A moment that is held has to be shown itself.
    const bool isStreaming =
        !m_session->isRecording() && m_session->cursor().mode == model::Cursor::Mode::Following;
    return m_shown != nullptr && (isIdle || (isStreaming && m_session->now() - m_shownBuilt < kFresh));
}

void ViewportWidget::setAxes(AxesMode mode) {
    m_look.axes = mode;
    refresh();
    emit optionsChanged();
}

void ViewportWidget::toggle(Overlay overlay) {
    m_look.overlays.toggle(overlay);
    refresh();
    emit optionsChanged();
}

void ViewportWidget::toggleProjection() {
    m_look.panes.motion().setProjection(projection() == render::Projection::Perspective
                                            ? render::Projection::Orthographic
                                            : render::Projection::Perspective);
    refresh();
    emit optionsChanged();
}

void ViewportWidget::face(render::StandardView view) {
    m_look.panes.motion().face(view);
    m_look.panes.motion().turn(heading());
    refresh();
}

void ViewportWidget::toggleRelativeViews() {
    m_hasRelativeViews = !m_hasRelativeViews;
    emit optionsChanged();
}

void ViewportWidget::toggleInterpolation() {
    m_isInterpolating = !m_isInterpolating;
    refresh();
    emit optionsChanged();
}

void ViewportWidget::toggleScale() {
    m_look.hasScale = !m_look.hasScale;
    refresh();
    emit optionsChanged();
}

void ViewportWidget::toggleCard() {
    m_hasCard = !m_hasCard;
    updateCard();
    emit optionsChanged();
}

void ViewportWidget::showKeptView(int index) {
    if (isKept(index)) {
        gui::restore(m_look.panes.motion(), m_keptViews[static_cast<std::size_t>(index)]);
        refresh();
        emit optionsChanged();
    }
}

QJsonObject ViewportWidget::state() const {
    QJsonArray on;
    for (const OverlayEntry& entry : kOverlayTable) {
        if (m_look.overlays.has(entry.overlay)) {
            on.append(QLatin1String(entry.key));
        }
    }
    QJsonArray views;
    for (const QJsonObject& view : m_keptViews) {
        views.append(view);
    }
    return {{"panes", m_look.panes.state()},
            {"axes", static_cast<int>(m_look.axes)},
            {"overlays", on},
            {"scale", m_look.hasScale},
            {"interpolation", m_isInterpolating},
            {"segmentCard", m_hasCard},
            {"relativeViews", m_hasRelativeViews},
            {"ownCharacters", m_ownCharacters.state()},
            {"views", views}};
}

void ViewportWidget::restoreState(const QJsonObject& state) {
    gui::restore(m_look.panes.motion(), state["camera"].toObject()); // as versions wrote it that had one view
    m_look.panes.restoreState(state["panes"].toObject());
    const int axes = state["axes"].toInt(static_cast<int>(m_look.axes));
    m_look.overlays = {};
    for (const OverlayEntry& entry : kOverlayTable) {
        if (state["overlays"].toArray().contains(QLatin1String(entry.key))) {
            m_look.overlays.toggle(entry.overlay);
        }
    }
    m_look.hasScale = state["scale"].toBool(true);
    m_hasCard = state["segmentCard"].toBool(true);
    m_isInterpolating = state["interpolation"].toBool(false);
    m_hasRelativeViews = state["relativeViews"].toBool(true);
    m_ownCharacters.restoreState(state["ownCharacters"].toArray());
    for (int i = 0; i < kKeptViews; ++i) {
        m_keptViews[static_cast<std::size_t>(i)] = state["views"].toArray().at(i).toObject();
    }
    m_look.axes = static_cast<AxesMode>(std::clamp(axes, 0, static_cast<int>(AxesMode::None)));
    refresh();
    emit optionsChanged();
}

void ViewportWidget::frameAll() {
    if (m_shown != nullptr) {
        m_look.panes.motion().frame(boxesOf(*m_shown), aspect());
        refresh();
    }
}

void ViewportWidget::frameCharacter(const model::CharacterKey& key) {
    if (m_shown == nullptr) {
        return;
    }
    for (const Figure& figure : m_shown->figures) {
        if (m_session->isSame(figure.key, key) && !figure.bounds.isEmpty()) {
            m_look.panes.motion().show(paddedBounds(figure), aspect());
            refresh();
        }
    }
}

void ViewportWidget::orbitBy(int right, int up) {
    constexpr double kStep = 24; // pixels of a drag: about 10°
    m_look.panes.motion().orbit(kStep * QPointF(-right, up));
    refresh();
}

void ViewportWidget::panBy(int right, int up) {
    constexpr double kStep = 0.05; // of the height
    m_look.panes.motion().pan(kStep * height() * QPointF(-right, up), size());
    refresh();
}

void ViewportWidget::zoomBy(int steps) {
    m_look.panes.motion().zoom(steps, QRectF(rect()).center(), size());
    refresh();
}

void ViewportWidget::paintEvent(QPaintEvent* /*event*/) {
    if (m_presenter == nullptr) {
        QPainter(this).fillRect(rect(), theme().window);
    }
}

void ViewportWidget::resizeEvent(QResizeEvent* /*event*/) {
    m_overlay->setGeometry(rect());
    m_paneFrame->setGeometry(rect());
    m_banner->place(size());
    m_card->place();
    if (m_presenter != nullptr) {
        m_presenter->setGeometry(rect());
    }
    refresh();
}

void ViewportWidget::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange) {
        refresh();
    }
    QWidget::changeEvent(event);
}

void ViewportWidget::mousePressEvent(QMouseEvent* event) {
    m_pressed = m_pointer = event->position();
    m_isDragging = false;
    activate(m_look.panes.paneAt(event->position(), size()));
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
    if (isPan) {
        m_look.panes.motion().pan(movement, paneAt(m_pressed).size());
    } else if (event->buttons().testFlag(Qt::LeftButton)) {
        m_look.panes.motion().orbit(movement);
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
    activate(m_look.panes.paneAt(event->position(), size()));
    const QRect pane = paneAt(event->position());
    m_look.panes.motion().zoom(event->angleDelta().y() / kWheelStep, event->position() - pane.topLeft(),
                               pane.size());
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
