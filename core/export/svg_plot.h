// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace posewire::exporting {

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

/// Only the curve, in the height of a line. `top`: the value at its upper edge, 0 for its own greatest.
[[nodiscard]] std::string svgSparkline(const std::vector<double>& values, std::size_t colour, double top = 0);

} // namespace posewire::exporting
