// SPDX-License-Identifier: MIT
#include "core/export/html.h"

#include "core/model/foreign_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace posewire::exporting {
namespace {

constexpr double kWidth = 720;
constexpr double kHeight = 170;
constexpr double kLeft = 56;
constexpr double kRight = 712;
constexpr double kTop = 10;
constexpr double kBottom = 146;

std::string number(double value) {
    return fixed(value, 1);
}

/// 1, 2 or 5 times a power of ten, at least `least`.
double roundStep(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least * 0.999999) {
            return factor * power;
        }
    }
    return 10 * power;
}

std::string label(double value, double step) {
    const int places = step >= 1 ? 0 : std::min(6, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    return fixed(value, places);
}

std::string line(double x1, double y1, double x2, double y2) {
    return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
           number(y2) + "\"/>";
}

std::string text(double x, double y, std::string_view anchor, const std::string& words) {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + std::string(anchor) +
           "\">" + escaped(words) + "</text>";
}

std::string colourClass(std::size_t colour) {
    return "c" + std::to_string(colour % 8);
}

double greatest(const SvgPlot& plot) {
    double top = plot.leastTop;
    std::vector<double> stack;
    for (const SvgPlot::Series& series : plot.series) {
        stack.resize(std::max(stack.size(), series.values.size()));
        for (std::size_t i = 0; i < series.values.size(); ++i) {
            const double value = series.values[i];
            if (std::isfinite(value)) {
                stack[i] += value;
                top = std::max(top, plot.form == SvgPlot::Form::StackedBars ? stack[i] : value);
            }
        }
    }
    return top > 0 ? top : 1;
}

struct Scale {
    double top = 1;
    double step = 1;
    [[nodiscard]] double y(double value) const { return kBottom - (kBottom - kTop) * value / top; }
};

/// From 0 to a round number in two to five steps.
Scale scaleFor(double greatest) {
    const double step = roundStep(greatest / 4);
    return {std::ceil(greatest / step - 1e-9) * step, step};
}

/// Whole steps in a length, one more where only rounding hides it.
int stepsIn(double length, double step) {
    constexpr double kMost = 50;
    return static_cast<int>(std::clamp(length * 1.0001 / step, 0.0, kMost));
}

std::string axes(const Scale& scale, double durationS) {
    std::string svg = "<g class=\"grid\">";
    std::string labels;
    for (int i = 0; i <= stepsIn(scale.top, scale.step); ++i) {
        const double value = i * scale.step;
        svg += line(kLeft, scale.y(value), kRight, scale.y(value));
        labels += text(kLeft - 6, scale.y(value) + 4, "end", label(value, scale.step));
    }
    const double step = durationS > 0 ? roundStep(durationS / 8) : 1;
    const int steps = stepsIn(durationS, step);
    for (int i = 0; i <= steps; ++i) {
        const double time = i * step;
        const double x = durationS > 0 ? kLeft + (kRight - kLeft) * time / durationS : kLeft;
        svg += line(x, kBottom, x, kBottom + 4);
        const bool isLast = i == steps;
        labels += text(x, kBottom + 18, isLast && x > kRight - 24 ? "end" : "middle",
                       label(time, step) + (isLast ? " s" : ""));
    }
    return svg + "</g>" + labels;
}

double placeOf(std::size_t step, std::size_t count) {
    return kLeft + (kRight - kLeft) * static_cast<double>(step) /
                       static_cast<double>(std::max<std::size_t>(count, 1));
}

/// A line through the values that are there; `at` gives the place or places of one.
template <class At>
std::string curve(const std::vector<double>& values, std::size_t colour, At at) {
    std::string path;
    bool isPenDown = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool isThere = std::isfinite(values[i]);
        path += isThere ? (isPenDown ? "L" : "M") + at(i) : "";
        isPenDown = isThere;
    }
    return "<path class=\"curve " + colourClass(colour) + "\" d=\"" + path + "\"/>";
}

std::string bars(const SvgPlot& plot, const Scale& scale) {
    std::string svg;
    std::vector<double> below;
    for (const SvgPlot::Series& series : plot.series) {
        below.resize(std::max(below.size(), series.values.size()));
        for (std::size_t i = 0; i < series.values.size(); ++i) {
            if (!std::isfinite(series.values[i]) || series.values[i] <= 0) {
                continue;
            }
            const double left = placeOf(i, series.values.size());
            const double width = std::max(placeOf(i + 1, series.values.size()) - left, 1.5);
            const double top = scale.y(below[i] + series.values[i]);
            svg += "<rect class=\"bar " + colourClass(series.colour) + "\" x=\"" + number(left) + "\" y=\"" +
                   number(top) + "\" width=\"" + number(width) + "\" height=\"" +
                   number(std::max(scale.y(below[i]) - top, 0.5)) + "\"/>";
            below[i] += series.values[i];
        }
    }
    return svg;
}

std::string legend(const SvgPlot& plot) {
    std::string html;
    for (const SvgPlot::Series& series : plot.series) {
        html += "<span class=\"key\"><i class=\"" + colourClass(series.colour) + "\"></i>" +
                escaped(series.name) + "</span>";
    }
    return html;
}

} // namespace

std::string escaped(std::string_view text) {
    return model::htmlText(model::visibleText(text));
}

std::string fixed(double number, int places) {
    if (!std::isfinite(number)) {
        return "–";
    }
    std::array<char, 64> digits{};
    const auto [end, error] =
        std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, places);
    return error == std::errc() ? std::string(digits.data(), end) : "–";
}

void HtmlTable::add(const std::vector<std::string>& cells) {
    m_rows += "<tr>";
    for (std::size_t i = 0; i < cells.size() && i < m_columns.size(); ++i) {
        m_rows += m_columns[i].isNumber ? "<td class=\"n\">" : "<td>";
        m_rows += cells[i] + "</td>";
    }
    m_rows += "</tr>\n";
}

std::string HtmlTable::html() const {
    std::string text = "<div class=\"scroll\"><table>\n<thead><tr>";
    for (const Column& column : m_columns) {
        text += column.isNumber ? "<th scope=\"col\" class=\"n\"" : "<th scope=\"col\"";
        text += column.explanation.empty() ? ">" : " title=\"" + escaped(column.explanation) + "\">";
        text += escaped(column.title) + "</th>";
    }
    return text + "</tr></thead>\n<tbody>\n" + m_rows + "</tbody>\n</table></div>\n";
}

std::string svgPlot(const SvgPlot& plot) {
    const Scale scale = scaleFor(greatest(plot));
    std::string svg = "<figure><figcaption><b>" + escaped(plot.title) + "</b>" + legend(plot) +
                      "</figcaption>\n<svg viewBox=\"0 0 " + fixed(kWidth, 0) + ' ' + fixed(kHeight, 0) +
                      "\" role=\"img\" aria-label=\"" + escaped(plot.title) + "\">";
    svg += axes(scale, plot.durationS);
    if (plot.form == SvgPlot::Form::StackedBars) {
        svg += bars(plot, scale);
    } else {
        for (const SvgPlot::Series& series : plot.series) {
            // Each value stands for its whole step.
            svg += curve(series.values, series.colour, [&](std::size_t i) {
                const std::string y = ' ' + number(scale.y(series.values[i]));
                const std::size_t count = series.values.size();
                return number(placeOf(i, count)) + y + 'L' + number(placeOf(i + 1, count)) + y;
            });
        }
    }
    return svg + "</svg></figure>\n";
}

std::string svgSparkline(const std::vector<double>& values, std::size_t colour) {
    constexpr double width = 90;
    constexpr double height = 18;
    double most = 0;
    for (const double value : values) {
        most = std::isfinite(value) ? std::max(most, value) : most;
    }
    const double perValue = most > 0 ? (height - 2) / most : 0;
    const auto at = [&](std::size_t i) {
        const double x =
            values.size() > 1 ? width * static_cast<double>(i) / static_cast<double>(values.size() - 1) : 0;
        return number(x) + ' ' + number(height - 1 - values[i] * perValue);
    };
    return "<svg class=\"spark\" viewBox=\"0 0 90 18\" aria-hidden=\"true\">" + curve(values, colour, at) +
           "</svg>";
}

} // namespace posewire::exporting
