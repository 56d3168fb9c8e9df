// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/timeline_view.h"

#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QScrollBar>
#include <QToolTip>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr int kClick = 4; ///< pixels; what moves less is none
constexpr double kPixelsOfPart = 2;

using Nanoseconds = std::chrono::duration<double, std::nano>;

} // namespace

TimelineView::TimelineView(model::SessionView& view, Commands& commands, Playback& playback, QWidget* parent)
    : QAbstractScrollArea(parent), m_view(view), m_commands(commands), m_playback(playback), m_model(view) {
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFocusPolicy(Qt::StrongFocus);
    viewport()->setMouseTracking(true);
    setAccessibleName(tr("Timeline"));
    setAccessibleDescription(
        tr("What each character sent, and when. Plus and minus zoom, 0 shows all, Page Up "
           "and Page Down move; the arrow keys step through samples. Escape takes the "
           "selected range away."));
    connect(verticalScrollBar(), &QScrollBar::valueChanged, viewport(), qOverload<>(&QWidget::update));
}

int TimelineView::namesWidth() const {
    return std::min(fontMetrics().averageCharWidth() * 24, viewport()->width() / 3);
}

double TimelineView::placeOf(log::Stamp stamp) const {
    const Nanoseconds length = std::max(log::Duration(1), m_window.to - m_window.from);
    return namesWidth() + (stamp - m_window.from) / length * stripWidth();
}

log::Stamp TimelineView::stampAt(double place) const {
    const double share = (place - namesWidth()) / stripWidth();
    return m_window.from +
           std::chrono::duration_cast<log::Duration>(share * Nanoseconds(m_window.to - m_window.from));
}

void TimelineView::refresh() {
    const auto span = m_model.span();
    const bool isLive = m_view.choices().cursor.mode == model::Cursor::Mode::Following;
    if (span && (m_isAll || m_window.to == log::Stamp())) {
        m_window = *span;
    } else if (span && m_isAtNow && isLive) {
        m_window = {span->to - (m_window.to - m_window.from), span->to};
    }
    readRows();
}

void TimelineView::readRows() {
    const auto most = static_cast<std::size_t>(std::max(1.0, stripWidth() / kPixelsOfPart));
    m_model.refresh(m_window, most);
    const int room = viewport()->height() - rulerHeight();
    verticalScrollBar()->setPageStep(room);
    verticalScrollBar()->setSingleStep(rowHeight());
    verticalScrollBar()->setRange(0,
                                  std::max(0, static_cast<int>(m_model.rows().size()) * rowHeight() - room));
    viewport()->update();
    emit windowChanged(m_isAll);
}

void TimelineView::setWindow(model::TimeRange window) {
    const auto span = m_model.span();
    if (!span) {
        return;
    }
    const log::Duration all = span->to - span->from;
    const log::Duration length = std::clamp(window.to - window.from, std::min(kShortest, all), all);
    window.from = std::clamp(window.from, span->from, span->to - length);
    window.to = window.from + length;
    m_isAll = length == all;
    m_isAtNow = window.to >= span->to;
    m_window = window;
    readRows();
}

void TimelineView::zoom(double factor, std::optional<log::Stamp> about) {
    const log::Stamp middle = about.value_or(std::clamp(m_view.cursorStamp(), m_window.from, m_window.to));
    const auto scaled = [&](log::Stamp edge) {
        return middle + std::chrono::duration_cast<log::Duration>(factor * Nanoseconds(edge - middle));
    };
    setWindow({scaled(m_window.from), scaled(m_window.to)});
}

void TimelineView::fit() {
    if (const auto span = m_model.span()) {
        setWindow(*span);
    }
}

void TimelineView::fitRange() {
    const auto range = m_view.range();
    range ? setWindow(*range) : fit();
}

std::optional<std::size_t> TimelineView::rowAt(const QPoint& place) const {
    const int down = place.y() - rulerHeight() + verticalScrollBar()->value();
    const auto row = static_cast<std::size_t>(std::max(0, down) / rowHeight());
    return place.y() >= rulerHeight() && row < m_model.rows().size() ? std::optional(row) : std::nullopt;
}

void TimelineView::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !m_model.span()) {
        return;
    }
    const QPoint place = event->position().toPoint();
    m_pressed = place;
    m_isMoved = false;
    m_anchor = stampAt(place.x());
    if (place.x() < namesWidth()) {
        if (const auto row = rowAt(place)) {
            const TimelineModel::Row& chosen = m_model.rows()[*row];
            const model::CharacterKey character = chosen.character; // its row goes
            if (!chosen.type) {
                m_model.toggle(character);
                readRows();
            }
            m_commands.select({character.sender, character, -1});
        }
    } else if (const model::Incident* incident = incidentAt(place)) {
        m_commands.showIncident(incident->number);
    } else {
        m_drag = place.y() < rulerHeight() ? Drag::Cursor : Drag::Range;
        if (m_drag == Drag::Cursor) {
            drag(place);
        }
    }
}

void TimelineView::mouseMoveEvent(QMouseEvent* event) {
    const QPoint place = event->position().toPoint();
    m_isMoved = m_isMoved || std::abs(place.x() - m_pressed.x()) >= kClick;
    if (m_drag == Drag::Cursor || (m_drag == Drag::Range && m_isMoved)) {
        drag(place);
    }
    const bool isInRows = place.x() >= namesWidth() && place.y() >= rulerHeight();
    viewport()->setCursor(isInRows ? Qt::IBeamCursor : Qt::ArrowCursor);
}

void TimelineView::drag(const QPoint& place) {
    const auto span = m_model.span();
    const log::Stamp moment = std::clamp(stampAt(place.x()), span->from, span->to);
    if (m_drag == Drag::Cursor) {
        m_playback.showMoment(moment, m_isMoved);
    } else {
        const auto [from, to] = std::minmax(m_anchor, moment);
        m_commands.selectRange({log::Duration::zero(), model::TimeRange{from, to + log::Duration(1)}});
    }
    viewport()->update();
}

void TimelineView::mouseReleaseEvent(QMouseEvent* event) {
    if (m_drag == Drag::Range && !m_isMoved) { // a click shows that moment
        m_playback.showMoment(stampAt(event->position().x()));
        viewport()->update();
    }
    m_drag = Drag::None;
}

void TimelineView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->position().x() >= namesWidth()) {
        fitRange();
    }
}

void TimelineView::wheelEvent(QWheelEvent* event) {
    const QPoint turned = event->angleDelta();
    const bool isSideways =
        event->modifiers().testFlag(Qt::ShiftModifier) || std::abs(turned.x()) > std::abs(turned.y());
    if (event->position().x() < namesWidth() && !isSideways) {
        QAbstractScrollArea::wheelEvent(event);
        return;
    }
    constexpr double kStep = 120; // of a wheel, by Qt's definition
    if (isSideways) {
        const double by = (turned.x() != 0 ? turned.x() : turned.y()) / kStep / 10;
        const auto moved =
            std::chrono::duration_cast<log::Duration>(-by * Nanoseconds(m_window.to - m_window.from));
        setWindow({m_window.from + moved, m_window.to + moved});
    } else {
        zoom(std::pow(0.8, turned.y() / kStep), stampAt(event->position().x()));
    }
    event->accept();
}

void TimelineView::keyPressEvent(QKeyEvent* event) {
    const log::Duration page = (m_window.to - m_window.from) / 2;
    switch (event->key()) {
    case Qt::Key_Plus:
        zoom(0.5);
        break;
    case Qt::Key_Minus:
        zoom(2);
        break;
    case Qt::Key_0:
        fit();
        break;
    case Qt::Key_PageUp:
        setWindow({m_window.from - page, m_window.to - page});
        break;
    case Qt::Key_PageDown:
        setWindow({m_window.from + page, m_window.to + page});
        break;
    case Qt::Key_Return:
    case Qt::Key_Enter:
        toggleStreams();
        break;
    case Qt::Key_Escape:
        m_commands.selectRange({});
        viewport()->update();
        break;
    default:
        QAbstractScrollArea::keyPressEvent(event);
    }
}

void TimelineView::toggleStreams() {
    const auto isWanted = [this](const TimelineModel::Row& row) {
        return !row.type && m_view.roster().isSelected(row.character);
    };
    const auto chosen = std::ranges::find_if(m_model.rows(), isWanted);
    if (!m_model.rows().empty()) {
        m_model.toggle((chosen != m_model.rows().end() ? *chosen : m_model.rows().front()).character);
        readRows();
    }
}

const model::Incident* TimelineView::incidentAt(const QPoint& place) const {
    const int lane = fontMetrics().height();
    const bool isInLane =
        place.x() >= namesWidth() && place.y() >= rulerHeight() - lane && place.y() < rulerHeight();
    const model::Incident* nearest = nullptr;
    double least = lane / 2.0;
    for (const model::Incident& incident : m_view.verdicts().incidents().all()) {
        const double distance = std::abs(placeOf(incident.firstStamp) - place.x());
        // Of those in one place the worst lies on top.
        const bool isOver = nearest != nullptr && std::abs(distance - least) < 1;
        const bool isNearer = isOver ? incident.severity() >= nearest->severity() : distance <= least;
        if (isInLane && isNearer) {
            least = distance;
            nearest = &incident;
        }
    }
    return nearest;
}

QString TimelineView::helpAt(const QPoint& place) {
    if (const model::Incident* incident = incidentAt(place)) {
        return tr("%1: %2").arg(timeOfDay(m_view.wallOf(incident->firstStamp)),
                                said(incident->fact(), words::Form::Sentence));
    }
    const auto row = rowAt(place);
    const model::RangeParts& parts = m_model.parts();
    if (!row || place.x() < namesWidth() || parts.count == 0) {
        return place.y() < rulerHeight() ? tr("Drag to move the display through time.") : QString();
    }
    const auto part = static_cast<std::size_t>(
        std::max(log::Duration::zero(), stampAt(place.x()) - parts.first) / parts.width);
    if (part >= parts.count) {
        return {};
    }
    const TimelineModel::Row& shown = m_model.shown(*row);
    const model::RangePart& counted = shown.parts[part];
    return tr("%1, %2: %3 datagrams/s, %4 samples lost\nClick to look at that moment, drag to select a "
              "range.")
        .arg(shown.name, timeOfDay(m_view.wallOf(parts.beginOf(part))),
             fixed(counted.datagrams / log::secondsOf(parts.width), 0), grouped(counted.lost));
}

bool TimelineView::viewportEvent(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), toolTipText(helpAt(help->pos())), this);
        return true;
    }
    const bool isDone = QAbstractScrollArea::viewportEvent(event);
    if (event->type() == QEvent::Resize) {
        readRows();
    }
    return isDone;
}

} // namespace posewire::gui
