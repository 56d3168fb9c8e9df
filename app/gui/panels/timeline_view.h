// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/playback.h"
#include "app/gui/models/timeline_model.h"

#include <QAbstractScrollArea>

#include <optional>

namespace posewire::gui {

/// The history as a strip for each character and stream: when it sent, how much, and what was lost. Dragging
/// in the ruler moves the display through time, dragging in the rows selects a range; the wheel zooms, with
/// Shift it moves.
class TimelineView final : public QAbstractScrollArea {
    Q_OBJECT

public:
    TimelineView(model::SessionView& view, Commands& commands, Playback& playback, QWidget* parent);

    void refresh();

    [[nodiscard]] const model::TimeRange& window() const { return m_window; }
    static constexpr log::Duration kShortest = std::chrono::milliseconds(1);
    /// Makes the window this many times as long; `about` stays where it is.
    void zoom(double factor, std::optional<log::Stamp> about = {});
    /// All there is.
    void fit();
    void fitRange();
    /// Shows or hides the streams of the selected character, of the first where none is.
    void toggleStreams();
    /// As much of it as there is; at least the shortest that can be looked at.
    void setWindow(model::TimeRange window);

    /// Pixels from the left of the viewport for a stamp, and back.
    [[nodiscard]] double placeOf(log::Stamp stamp) const;
    [[nodiscard]] log::Stamp stampAt(double place) const;
    [[nodiscard]] const TimelineModel& model() const { return m_model; }
    [[nodiscard]] int rulerHeight() const { return fontMetrics().height() * 5 / 2; }
    [[nodiscard]] int rowHeight() const { return fontMetrics().height() * 3 / 2; }
    [[nodiscard]] int namesWidth() const;

signals:
    void windowChanged(bool isAll);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool viewportEvent(QEvent* event) override;

private:
    friend class TimelinePainter;

    enum class Drag { None, Cursor, Range, Window };

    void readRows();
    [[nodiscard]] int stripWidth() const { return std::max(1, viewport()->width() - namesWidth()); }
    [[nodiscard]] std::optional<std::size_t> rowAt(const QPoint& place) const;
    [[nodiscard]] const model::Incident* incidentAt(const QPoint& place) const;
    [[nodiscard]] QString helpAt(const QPoint& place);
    void drag(const QPoint& place);

    model::SessionView& m_view;
    Commands& m_commands;
    Playback& m_playback;
    TimelineModel m_model;
    model::TimeRange m_window{};
    bool m_isAll = true;   ///< the window is all there is, and grows
    bool m_isAtNow = true; ///< its end moves with what comes
    Drag m_drag = Drag::None;
    QPoint m_pressed;
    log::Stamp m_anchor{}; ///< where the drag began
    bool m_isMoved = false;
};

} // namespace posewire::gui
