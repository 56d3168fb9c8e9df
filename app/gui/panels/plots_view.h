// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/playback.h"
#include "app/gui/models/plot_curves.h"

#include <QPixmap>
#include <QWidget>

#include <optional>

namespace posewire::gui {

/// Charts of curves one below the other over one time axis, with the session's cursor, range and incidents. A
/// click shows that moment; dragging moves the charts through time, with Shift it selects a range; the wheel
/// zooms. Left of a chart both act on its values.
class PlotsView final : public QWidget {
    Q_OBJECT

public:
    PlotsView(model::SessionView& view, Commands& commands, Playback& playback, QWidget* parent);

    /// Takes in what came; paints only what changed.
    void refresh();
    [[nodiscard]] PlotCurves& curves() { return m_curves; }

    [[nodiscard]] const model::TimeRange& window() const { return m_window; }
    /// As much of it as there is.
    void setWindow(model::TimeRange window);
    /// Makes the window this many times as long; `about` stays where it is.
    void zoom(double factor, std::optional<log::Stamp> about = {});
    void fit();
    void fitRange();
    /// The end moves with what comes.
    void follow();

    struct Shown {
        QRect head;         ///< with the legend
        QRect area;         ///< within the axes
        int entryWidth = 0; ///< of the legend
        double least = 0;   ///< of the value axis
        double most = 1;
        std::vector<std::vector<PlotPoint>> points; ///< of each curve
    };
    /// The charts as they were read last.
    [[nodiscard]] const std::vector<Shown>& shown() const { return m_shown; }
    [[nodiscard]] double placeOf(log::Stamp stamp) const;
    [[nodiscard]] log::Stamp stampAt(double place) const;
    /// Pixels from the top for a value.
    [[nodiscard]] double placeOf(std::size_t chart, double value) const;
    /// In the legend.
    [[nodiscard]] QRect entryOf(std::size_t chart, std::size_t curve) const;

    struct Spot {
        std::size_t chart = 0;
        std::optional<std::size_t> curve{}; ///< in the legend, or next to the pointer
    };
    [[nodiscard]] std::optional<Spot> spotAt(const QPoint& place);
    /// Returns a curve's value at a moment, such as "0.963 m"; "–" in gaps.
    [[nodiscard]] QString valueText(std::size_t chart, const PlotCurve& curve, log::Stamp stamp);
    /// The name in the legend: with whose it is, if the charts are of several characters.
    [[nodiscard]] QString nameOf(const PlotCurve& curve) const;
    /// The packet of the curve's value at a moment, in the list; false if the log has dropped it.
    bool showPacket(const PlotCurve& curve, log::Stamp stamp);

    /// All of it, as on the screen, without the pointer.
    void paint(QPainter& painter);

    [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }
    [[nodiscard]] QSize minimumSizeHint() const override;

signals:
    void menuRequested(const QPoint& place, const QPoint& onScreen);
    void dropped(const QStringList& curves, std::optional<std::size_t> chart);

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    friend class PlotsPainter;
    enum class Drag { None, Press, Time, Range, Values };

    /// Points and axes of all charts, if anything changed.
    void read();
    void layOut();
    void fitValues(std::size_t chart);
    void zoomValues(std::size_t chart, double factor, double about);
    void moveWindow();
    [[nodiscard]] int gutter() const;
    [[nodiscard]] int rulerHeight() const { return fontMetrics().height() * 3 / 2; }
    [[nodiscard]] int lineHeight() const { return fontMetrics().height() * 5 / 4; }
    [[nodiscard]] int linesOf(std::size_t chart) const;
    [[nodiscard]] int stripWidth() const {
        return std::max(1, width() - gutter() - fontMetrics().height() / 2);
    }
    [[nodiscard]] int decimalsOf(std::size_t chart) const;
    [[nodiscard]] std::optional<std::size_t> chartAt(const QPoint& place) const;
    /// The moment of the pointer, or of the cursor.
    [[nodiscard]] log::Stamp legendStamp() const;

    model::SessionView& m_view;
    Commands& m_commands;
    Playback& m_playback;
    PlotCurves m_curves;
    std::vector<Shown> m_shown;
    model::TimeRange m_window{};
    bool m_isAll = true;   ///< the window is all there is, and grows
    bool m_isAtNow = true; ///< its end moves with what comes
    log::Stamp m_cursor{}; ///< where it was at the newest refresh
    struct Key {
        model::TimeRange window{};
        std::uint64_t version = 0;
        std::size_t incidents = 0;
        QSize size;
        bool operator==(const Key&) const = default;
    };
    Key m_read;
    int m_leastHeight = 0; ///< as the layout knows it
    QPixmap m_picture;     ///< all but cursor, values and pointer; null: to be painted
    Drag m_drag = Drag::None;
    QPoint m_pressed;
    model::TimeRange m_windowBefore{};
    std::optional<std::size_t> m_pressedChart; ///< its values are dragged
    std::pair<double, double> m_valuesBefore{};
    std::optional<QPoint> m_pointer; ///< over the charts
};

} // namespace posewire::gui
