// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/plots_view.h"

#include "app/gui/models/curve_text.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <QContextMenuEvent>
#include <QDropEvent>
#include <QKeyEvent>
#include <QMimeData>
#include <QMouseEvent>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <set>

namespace posewire::gui {

namespace {

constexpr int kClickRoom = 4;      ///< pixels; what moves less is none
constexpr int kNear = 12;          ///< pixels from a curve
constexpr double kWheelStep = 120; ///< by Qt's definition
constexpr log::Duration kShortestWindow = std::chrono::milliseconds(1);
constexpr log::Duration kFollowed = std::chrono::seconds(10);

using Seconds = std::chrono::duration<double, std::nano>;

log::Duration scaled(double factor, log::Duration duration) {
    return std::chrono::duration_cast<log::Duration>(factor * Seconds(duration));
}

/// As the axis has it.
double axisValue(double value, bool isLog) {
    return isLog ? std::log10(value) : value;
}
double fromAxis(double value, bool isLog) {
    return isLog ? std::pow(10.0, value) : value;
}

} // namespace

PlotsView::PlotsView(model::SessionView& view, Commands& commands, Playback& playback, QWidget* parent)
    : QWidget(parent), m_view(view), m_commands(commands), m_playback(playback), m_curves(view) {
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setAcceptDrops(true);
    setAccessibleName(tr("Plots"));
}

int PlotsView::gutter() const {
    return QFontMetrics(tabularFont()).horizontalAdvance(QStringLiteral("−0000.000")) +
           fontMetrics().height();
}

double PlotsView::placeOf(log::Stamp stamp) const {
    const Seconds length = std::max(log::Duration(1), m_window.to - m_window.from);
    return gutter() + (stamp - m_window.from) / length * stripWidth();
}

log::Stamp PlotsView::stampAt(double place) const {
    return m_window.from + scaled((place - gutter()) / stripWidth(), m_window.to - m_window.from);
}

double PlotsView::placeOf(std::size_t chart, double value) const {
    const Shown& shown = m_shown[chart];
    const bool isLog = m_curves.charts()[chart].isLog;
    const double least = axisValue(shown.least, isLog);
    const double share = (axisValue(value, isLog) - least) / (axisValue(shown.most, isLog) - least);
    return shown.area.bottom() - share * (shown.area.height() - 1);
}

QSize PlotsView::minimumSizeHint() const {
    int height = rulerHeight();
    for (std::size_t i = 0; i < m_curves.charts().size(); ++i) {
        height += lineHeight() * (linesOf(i) + 3);
    }
    return {gutter() + fontMetrics().averageCharWidth() * 16, std::max(height, lineHeight() * 6)};
}

int PlotsView::linesOf(std::size_t chart) const {
    const auto curves = static_cast<int>(m_curves.charts()[chart].curves.size());
    const int width = chart < m_shown.size() ? m_shown[chart].entryWidth : 0;
    const int columns = width > 0 ? std::max(1, stripWidth() / width) : 1;
    return (curves + columns - 1) / columns;
}

QRect PlotsView::entryOf(std::size_t chart, std::size_t curve) const {
    const Shown& shown = m_shown[chart];
    const int columns = std::max(1, shown.head.width() / std::max(1, shown.entryWidth));
    const int place = static_cast<int>(curve);
    return {shown.head.left() + place % columns * shown.entryWidth,
            shown.head.top() + place / columns * lineHeight(), std::min(shown.entryWidth, shown.head.width()),
            lineHeight()};
}

void PlotsView::layOut() {
    const auto& charts = m_curves.charts();
    m_shown.resize(charts.size());
    const int space = fontMetrics().height() / 2;
    int entry = 0; // of all charts, so that their legends are in line
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const double largest = std::max({std::abs(m_shown[i].least), std::abs(m_shown[i].most), 1.0});
        const double widestValue = -8 * std::pow(10.0, std::floor(std::log10(largest)));
        const QString widest = fixed(widestValue, decimalsOf(i)) + QLatin1Char(' ') + charts[i].unit();
        int names = 0;
        for (const PlotCurve& curve : charts[i].curves) {
            names = std::max(names, fontMetrics().horizontalAdvance(nameOf(curve)));
        }
        entry = std::max(entry, names + QFontMetrics(tabularFont()).horizontalAdvance(widest) + 6 * space);
    }
    int heads = 0;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        m_shown[i].entryWidth = entry;
        heads += linesOf(i) * lineHeight() + 2 * space;
    }
    const int room =
        std::max(0, height() - rulerHeight() - heads) / std::max(1, static_cast<int>(charts.size()));
    int top = 0;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        Shown& shown = m_shown[i];
        shown.head = {gutter(), top + space / 2, stripWidth(), linesOf(i) * lineHeight()};
        shown.area = {gutter(), shown.head.bottom() + 1 + space / 2, stripWidth(), room};
        top = shown.area.bottom() + 1 + space;
    }
    if (const int least = minimumSizeHint().height(); least != m_leastHeight) {
        m_leastHeight = least;
        updateGeometry();
    }
}

/// To what is in view, with some room, unless the operator chose a range.
void PlotsView::fitValues(std::size_t chart) {
    const PlotChart& from = m_curves.charts()[chart];
    Shown& shown = m_shown[chart];
    if (from.range && (!from.isLog || from.range->first > 0)) {
        std::tie(shown.least, shown.most) = *from.range;
        return;
    }
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const auto& points : shown.points) {
        for (const PlotPoint& point : points) {
            if (!from.isLog || point.most > 0) {
                least = std::min(least, !from.isLog || point.least > 0 ? point.least : point.most);
                most = std::max(most, point.most);
            }
        }
    }
    if (least > most) {
        std::tie(least, most) = from.isLog ? std::pair(1.0, 10.0) : std::pair(0.0, 1.0);
    }
    constexpr double kAround = 0.07;
    constexpr double kLeastSpan = 1e-6; ///< of the values: noise of the last digit is no curve
    const double middle = (axisValue(least, from.isLog) + axisValue(most, from.isLog)) / 2;
    const double span = std::max(axisValue(most, from.isLog) - axisValue(least, from.isLog),
                                 std::max(kLeastSpan, std::abs(middle) * kLeastSpan));
    shown.least = fromAxis(middle - span * (0.5 + kAround), from.isLog);
    shown.most = fromAxis(middle + span * (0.5 + kAround), from.isLog);
}

void PlotsView::read() {
    const Key now{m_window, m_curves.version(), m_view.verdicts().incidents().all().size(), size()};
    if (now == m_read && !m_shown.empty()) {
        return;
    }
    m_read = now;
    const auto& charts = m_curves.charts();
    m_shown.resize(charts.size());
    for (std::size_t i = 0; i < charts.size(); ++i) {
        m_shown[i].points.clear();
        for (const PlotCurve& curve : charts[i].curves) {
            m_shown[i].points.push_back(
                m_curves.points(curve, m_window, static_cast<std::size_t>(stripWidth())));
        }
        fitValues(i);
    }
    m_curves.resume();
    layOut();
    m_picture = {};
    update();
}

void PlotsView::refresh() {
    m_curves.refresh();
    moveWindow();
    read();
    if (const log::Stamp cursor = m_view.cursorStamp(); cursor != m_cursor) {
        m_cursor = cursor;
        update();
    }
}

/// With what comes, and to the cursor if that left it.
void PlotsView::moveWindow() {
    const auto span = wholeSpan(m_view);
    if (!span) {
        return;
    }
    const log::Stamp cursor = m_view.cursorStamp();
    const bool isLive = m_view.choices().cursor.mode == model::Cursor::Mode::Following;
    const log::Duration length = m_window.to - m_window.from;
    if (m_window.to == log::Stamp()) {
        m_isAll = m_view.isRecording();
        m_window = m_isAll ? *span : model::TimeRange{span->to - kFollowed, span->to};
    } else if (m_isAll) {
        m_window = *span;
    } else if (m_isAtNow && isLive) {
        m_window = {span->to - length, span->to};
    } else if (!isLive && cursor != m_cursor && m_drag == Drag::None &&
               (cursor < m_window.from || cursor > m_window.to)) {
        setWindow({cursor - length / 2, cursor + length / 2});
    }
}

void PlotsView::setWindow(model::TimeRange window) {
    const auto span = wholeSpan(m_view);
    if (!span) {
        return;
    }
    const log::Duration all = std::max(span->to - span->from, kShortestWindow);
    const log::Duration length = std::clamp(window.to - window.from, kShortestWindow, all);
    window.from = std::clamp(window.from, std::min(span->from, span->to - length), span->to - length);
    m_isAll = length == all;
    m_window = {window.from, window.from + length};
    m_isAtNow = m_window.to >= span->to;
    read();
}

void PlotsView::zoom(double factor, std::optional<log::Stamp> about) {
    const log::Stamp middle = about.value_or(std::clamp(m_view.cursorStamp(), m_window.from, m_window.to));
    setWindow(
        {middle + scaled(factor, m_window.from - middle), middle + scaled(factor, m_window.to - middle)});
}

void PlotsView::fit() {
    if (const auto span = wholeSpan(m_view)) {
        setWindow(*span);
    }
}

void PlotsView::fitRange() {
    const auto range = m_view.range();
    range ? setWindow(*range) : fit();
}

void PlotsView::follow() {
    m_playback.goLive();
    const log::Duration length = m_isAll ? kFollowed : m_window.to - m_window.from;
    setWindow({m_view.now() - length, m_view.now()});
}

int PlotsView::decimalsOf(std::size_t chart) const {
    constexpr int kDigits = 4;
    const double span = m_shown[chart].most - m_shown[chart].least;
    const double decade = span > 0 ? std::floor(std::log10(span)) : 0;
    return std::clamp(kDigits - 1 - static_cast<int>(decade), 0, 9);
}

QString PlotsView::valueText(std::size_t chart, const PlotCurve& curve, log::Stamp stamp) {
    const auto value = m_curves.valueAt(curve, stamp);
    const QString unit = QString::fromStdString(curve.expression.unit);
    return !value           ? dash()
           : unit.isEmpty() ? fixed(value->value, decimalsOf(chart))
                            : fixed(value->value, decimalsOf(chart)) + QChar(0x202F) + unit;
}

QString PlotsView::nameOf(const PlotCurve& curve) const {
    std::set<std::optional<int>> characters;
    for (const PlotChart& chart : m_curves.charts()) {
        for (const PlotCurve& other : chart.curves) {
            characters.insert(other.character);
        }
    }
    return characters.size() > 1 && curve.key ? tr("%1: %2").arg(nameApart(m_view, *curve.key), curve.text())
                                              : curve.text();
}

log::Stamp PlotsView::legendStamp() const {
    return m_pointer && m_drag == Drag::None ? stampAt(m_pointer->x()) : m_view.cursorStamp();
}

std::optional<std::size_t> PlotsView::chartAt(const QPoint& place) const {
    const auto found = std::ranges::find_if(m_shown, [&](const Shown& shown) {
        return place.y() >= shown.head.top() && place.y() <= shown.area.bottom();
    });
    return found == m_shown.end() ? std::nullopt
                                  : std::optional(static_cast<std::size_t>(found - m_shown.begin()));
}

std::optional<PlotsView::Spot> PlotsView::spotAt(const QPoint& place) {
    const auto chart = chartAt(place);
    if (!chart) {
        return std::nullopt;
    }
    Spot spot{*chart};
    double nearest = kNear;
    const auto& curves = m_curves.charts()[*chart].curves;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const auto value = m_curves.valueAt(curves[i], stampAt(place.x()));
        const double distance = value ? std::abs(placeOf(*chart, value->value) - place.y()) : kNear;
        if (entryOf(*chart, i).contains(place)) {
            return Spot{*chart, i};
        }
        if (m_shown[*chart].area.contains(place) && distance < nearest) {
            nearest = distance;
            spot.curve = i;
        }
    }
    m_curves.resume();
    return spot;
}

bool PlotsView::showPacket(const PlotCurve& curve, log::Stamp stamp) {
    const auto value = m_curves.valueAt(curve, stamp);
    return value && showPackets(m_view, m_commands, {.filter = {}, .packet = value->row.packet},
                                PacketLook::InContext);
}

void PlotsView::zoomValues(std::size_t chart, double factor, double about) {
    const bool isLog = m_curves.charts()[chart].isLog;
    const Shown& shown = m_shown[chart];
    const double middle = axisValue(about, isLog);
    const auto moved = [&](double edge) {
        return fromAxis(middle + factor * (axisValue(edge, isLog) - middle), isLog);
    };
    if (moved(shown.least) < moved(shown.most)) {
        m_curves.setRange(chart, std::pair(moved(shown.least), moved(shown.most)));
        read();
    }
}

void PlotsView::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || m_shown.empty()) {
        return;
    }
    m_pressed = event->position().toPoint();
    m_pressedChart = chartAt(m_pressed);
    m_windowBefore = m_window;
    const bool isValues = m_pressed.x() < gutter();
    if (m_pressedChart) {
        m_valuesBefore = {m_shown[*m_pressedChart].least, m_shown[*m_pressedChart].most};
    }
    m_drag = !isValues        ? (event->modifiers().testFlag(Qt::ShiftModifier) ? Drag::Range : Drag::Press)
             : m_pressedChart ? Drag::Values
                              : Drag::None;
}

void PlotsView::mouseMoveEvent(QMouseEvent* event) {
    const QPoint place = event->position().toPoint();
    const QPoint by = place - m_pressed;
    m_pointer = place.x() >= gutter() ? std::optional(place) : std::nullopt;
    if (m_drag == Drag::Press && std::abs(by.x()) >= kClickRoom) {
        m_drag = Drag::Time;
    }
    if (m_drag == Drag::Time) {
        const log::Duration moved =
            scaled(-static_cast<double>(by.x()) / stripWidth(), m_windowBefore.to - m_windowBefore.from);
        setWindow({m_windowBefore.from + moved, m_windowBefore.to + moved});
    } else if (m_drag == Drag::Range && std::abs(by.x()) >= kClickRoom) {
        const auto [from, to] = std::minmax(stampAt(m_pressed.x()), stampAt(place.x()));
        m_commands.selectRange({log::Duration::zero(), model::TimeRange{from, to + log::Duration(1)}});
    } else if (m_drag == Drag::Values && std::abs(by.y()) >= kClickRoom) {
        const bool isLog = m_curves.charts()[*m_pressedChart].isLog;
        const double least = axisValue(m_valuesBefore.first, isLog);
        const double most = axisValue(m_valuesBefore.second, isLog);
        const double moved = by.y() * (most - least) / std::max(1, m_shown[*m_pressedChart].area.height());
        m_curves.setRange(*m_pressedChart,
                          std::pair(fromAxis(least + moved, isLog), fromAxis(most + moved, isLog)));
        read();
    }
    setCursor(m_drag == Drag::Time ? Qt::ClosedHandCursor : Qt::ArrowCursor);
    update();
}

void PlotsView::mouseReleaseEvent(QMouseEvent* event) {
    const auto span = wholeSpan(m_view);
    const double place = event->position().x();
    if (m_drag == Drag::Press && span && chartAt(m_pressed)) {
        m_playback.showMoment(std::clamp(stampAt(place), span->from, span->to));
    }
    m_drag = Drag::None;
    unsetCursor();
    update();
}

void PlotsView::mouseDoubleClickEvent(QMouseEvent* event) {
    const QPoint place = event->position().toPoint();
    const auto spot = spotAt(place);
    if (spot && place.x() < gutter()) {
        m_curves.setRange(spot->chart, std::nullopt);
        read();
    } else if (spot && spot->curve) {
        const bool isLegend = m_shown[spot->chart].head.contains(place);
        showPacket(m_curves.charts()[spot->chart].curves[*spot->curve],
                   isLegend ? m_view.cursorStamp() : stampAt(place.x()));
    }
}

void PlotsView::wheelEvent(QWheelEvent* event) {
    const QPoint turned = event->angleDelta();
    const QPoint place = event->position().toPoint();
    const bool isSideways =
        event->modifiers().testFlag(Qt::ShiftModifier) || std::abs(turned.x()) > std::abs(turned.y());
    const double factor = std::pow(0.8, turned.y() / kWheelStep);
    const auto chart = chartAt(place);
    if (isSideways) {
        const double by = (turned.x() != 0 ? turned.x() : turned.y()) / kWheelStep / 10;
        const log::Duration moved = scaled(-by, m_window.to - m_window.from);
        setWindow({m_window.from + moved, m_window.to + moved});
    } else if (place.x() >= gutter()) {
        zoom(factor, stampAt(place.x()));
    } else if (chart) {
        const bool isLog = m_curves.charts()[*chart].isLog;
        const QRect area = m_shown[*chart].area;
        const double least = axisValue(m_shown[*chart].least, isLog);
        const double share = (area.bottom() - place.y()) / std::max(1.0, area.height() - 1.0);
        const double about = least + share * (axisValue(m_shown[*chart].most, isLog) - least);
        zoomValues(*chart, factor, fromAxis(about, isLog));
    }
    event->accept();
}

void PlotsView::keyPressEvent(QKeyEvent* event) {
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
    default:
        QWidget::keyPressEvent(event);
    }
}

/// Handles the events that have no function of their own.
bool PlotsView::event(QEvent* event) {
    if (event->type() == QEvent::Leave) {
        m_pointer.reset();
        update();
    } else if (event->type() == QEvent::ContextMenu) {
        const auto* menu = static_cast<QContextMenuEvent*>(event);
        emit menuRequested(menu->pos(), menu->globalPos());
        return true;
    } else if (event->type() == QEvent::DragEnter || event->type() == QEvent::Drop) {
        auto* drop = static_cast<QDropEvent*>(event);
        if (const QStringList curves = draggedCurves(*drop->mimeData()); !curves.isEmpty()) {
            drop->acceptProposedAction();
            if (event->type() == QEvent::Drop) {
                emit dropped(curves, chartAt(drop->position().toPoint()));
            }
            return true;
        }
    } else if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange ||
               event->type() == QEvent::Resize) {
        m_read = {};
        m_shown.clear();
        read();
    }
    return QWidget::event(event);
}

} // namespace posewire::gui
