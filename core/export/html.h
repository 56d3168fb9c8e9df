// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/text.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// What HTML is put together from: texts, numbers, tables and plots. Texts are escaped here and nowhere else:
/// whatever came over the wire ends up as text.
namespace posewire::exporting {

/// Safe in text and in quoted attributes: of our own words, also where they quote what a sender wrote. What
/// is a ForeignText has html(), which is clipped.
[[nodiscard]] std::string escaped(std::string_view text);

using model::grouped;
/// With `places` digits after the point; a dash where it is not finite.
[[nodiscard]] std::string fixed(double number, int places);

/// A table whose cells are HTML already; the first row heads it.
class HtmlTable {
public:
    struct Column {
        std::string title;       ///< plain text
        bool isNumber = false;   ///< set to the right, digits of equal width
        std::string explanation; ///< plain text, shown by the title
    };

    explicit HtmlTable(std::vector<Column> columns) : m_columns(std::move(columns)) {}

    void add(const std::vector<std::string>& cells);
    [[nodiscard]] bool isEmpty() const { return m_rows.empty(); }
    [[nodiscard]] std::string html() const;

private:
    std::vector<Column> m_columns;
    std::string m_rows;
};

/// A picture over time of equal steps, as SVG inside HTML. Colours come from the style sheet: the classes c0
/// to c7 for curves and bars.
struct SvgPlot {
    struct Series {
        std::string name;           ///< plain text
        std::size_t colour = 0;     ///< 0 to 7
        std::vector<double> values; ///< one a step; NaN where there is none
    };
    enum class Form { Curves, StackedBars };

    std::string title; ///< plain text, with the unit
    Form form = Form::Curves;
    double durationS = 0; ///< of all steps
    std::vector<Series> series;
    double leastTop = 0; ///< the axis reaches at least up to this
};

/// With axes, legend and a text for who cannot see it.
[[nodiscard]] std::string svgPlot(const SvgPlot& plot);

/// Only the curve, in the height of a line; its greatest value is at the upper edge.
[[nodiscard]] std::string svgSparkline(const std::vector<double>& values, std::size_t colour);

} // namespace posewire::exporting
