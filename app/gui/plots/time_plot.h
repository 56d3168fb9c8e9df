// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QWidget>

#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace posewire::gui {

/// Curves over the last seconds before a moment, or over a span of time: charts one below the other with one
/// time axis, which ends at 0 unless a span is set. Colours follow the theme. Where samples are missing,
/// curves break and the gap is hatched, or marked at the bottom of the first chart where it is too short for
/// that.
///
/// Make the charts and curves first, then give each its points and call replot() whenever they change.
class TimePlot final : public QWidget {
    Q_OBJECT

public:
    struct Point {
        double time;  ///< s, 0 or less where no span is set
        double value; ///< NaN breaks the curve
    };
    using Gap = std::pair<double, double>; ///< from, to (s)

    /// `name` is what screen readers call the plot.
    TimePlot(const QString& name, double secondsShown, QWidget* parent = nullptr);
    ~TimePlot() override;

    /// Adds a chart below those there are and returns its number. `share` is its part of the height, against
    /// the other charts; the value axis always spans at least `leastRange`.
    int addChart(const QString& title, int share, double leastRange);
    /// Adds a curve to a chart, in a colour of the theme, and returns its number.
    int addCurve(int chart, QColor Theme::*colour);

    void setTitle(int chart, const QString& title);
    /// Why what is shown is not how it is now: said behind the title of the first chart, and curves are dim.
    /// Empty: it is.
    void setPast(const QString& why);
    /// From when to when (s), instead of the last seconds.
    void setSpan(double from, double to);
    /// A line through all charts, where a moment is shown; nothing for none. From now on a click asks for
    /// another one.
    void setCursor(std::optional<double> time);

    /// Points in order of time.
    void setCurve(int curve, std::span<const Point> points);
    void setGaps(std::span<const Gap> gaps);
    /// Fits the value axes and paints.
    void replot();

    /// The values that the axis of a chart spans, as of the last replot().
    [[nodiscard]] std::pair<double, double> valueRange(int chart) const;

    [[nodiscard]] QSize minimumSizeHint() const override {
        return {fontMetrics().height() * 8, fontMetrics().height() * 9};
    }
    [[nodiscard]] QSize sizeHint() const override {
        return {fontMetrics().height() * 20, fontMetrics().height() * 12};
    }

signals:
    void momentPicked(double time);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    struct Parts; ///< what the plotting library draws

    void applyColours();
    void paintSoon();

    std::unique_ptr<Parts> m_parts;
};

/// "QCustomPlot 2.1.0".
[[nodiscard]] QString plottingName();

} // namespace posewire::gui
