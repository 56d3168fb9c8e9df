// SPDX-License-Identifier: MIT
#include "core/export/html.h"

#include <gmock/gmock.h>

#include <limits>

namespace posewire::exporting {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Html, LetsNoTextBecomeMarkup) {
    EXPECT_EQ(escaped("<script>alert(\"1\" & '2')</script>"),
              "&lt;script&gt;alert(&quot;1&quot; &amp; &#39;2&#39;)&lt;/script&gt;");
}

TEST(Html, ShowsWhatIsNoText) {
    EXPECT_EQ(escaped("Zoë\n\x01"), "Zoë\n␁");
    EXPECT_EQ(escaped("a\xff\xc3"), "a\xef\xbf\xbd\xef\xbf\xbd");
    EXPECT_EQ(escaped(std::string_view("\0", 1)), "␀");
}

TEST(Html, GroupsDigits) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1\u202f000");
    EXPECT_EQ(grouped(1234567), "1\u202f234\u202f567");
}

TEST(Html, ShowsNoNumberWhereThereIsNone) {
    EXPECT_EQ(fixed(1.25, 1), "1.2");
    EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 1), "–");
    EXPECT_EQ(fixed(std::numeric_limits<double>::max(), 1), "–");
}

TEST(SvgPlot, LeavesGapsWhereThereAreNoValues) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const std::string svg = svgPlot({"Rate", SvgPlot::Form::Curves, 4, {{"a", 0, {1, none, 2, 3}}}, 0});
    const std::size_t path = svg.find("<path");
    EXPECT_EQ(std::count(svg.begin() + static_cast<std::ptrdiff_t>(path), svg.end(), 'M'), 2);
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgPlot, StacksBars) {
    const std::string svg =
        svgPlot({"Lost", SvgPlot::Form::StackedBars, 2, {{"network", 0, {1, 0}}, {"sender", 1, {1, 3}}}, 0});
    std::size_t bars = 0;
    for (std::size_t at = svg.find("<rect"); at != std::string::npos; at = svg.find("<rect", at + 1)) {
        ++bars;
    }
    EXPECT_EQ(bars, 3U);
}

TEST(SvgPlot, EscapesNames) {
    const std::string svg = svgPlot({"<b>", SvgPlot::Form::Curves, 1, {{"</svg><script>", 0, {1}}}, 0});
    EXPECT_THAT(svg, Not(HasSubstr("<script>")));
}

TEST(SvgPlot, StandsWithoutAnyValue) {
    EXPECT_THAT(svgPlot({"Rate", SvgPlot::Form::Curves, 0, {}, 0}), Not(HasSubstr("nan")));
    EXPECT_THAT(svgSparkline({}, 0), Not(HasSubstr("nan")));
}

} // namespace
} // namespace posewire::exporting
