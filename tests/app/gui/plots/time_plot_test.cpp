// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/plots/time_plot.h"

#include <QImage>
#include <QTest>

#include <gtest/gtest.h>
#include <qcustomplot.h>

#include <array>
#include <limits>

namespace posewire::gui {
namespace {

class TimePlotTest : public testing::Test {
protected:
    TimePlotTest() {
        m_plot.resize(400, 300);
        m_plot.show();
    }
    QImage painted() {
        m_plot.replot();
        QTest::qWait(1);
        return m_plot.grab().toImage();
    }
    /// As of the last replot().
    [[nodiscard]] const QCPAxisRect& axes(int chart) const {
        return *m_plot.findChild<QCustomPlot*>()->axisRect(chart);
    }
    [[nodiscard]] int valueLabels(int chart) const {
        const QCPAxis* values = axes(chart).axis(QCPAxis::atLeft);
        return values->tickLabels() ? static_cast<int>(values->tickVector().size()) : 0;
    }
    static int pixelsOf(const QImage& image, const QColor& colour) {
        int count = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                count += image.pixelColor(x, y) == colour ? 1 : 0;
            }
        }
        return count;
    }

    TimePlot m_plot{"Plot", 10.0};
    int m_upper = m_plot.addChart("Upper", 2, 1.0);
    int m_lower = m_plot.addChart("Lower", 1, 0.5);
    int m_curve = m_plot.addCurve(m_upper, &Theme::axisX);
    int m_other = m_plot.addCurve(m_lower, &Theme::plotFourth);
};

TEST_F(TimePlotTest, FitsEachChartToItsOwnCurvesWithRoomAround) {
    m_plot.setCurve(m_curve, std::array<TimePlot::Point, 2>{{{-5, -4}, {-1, 6}}});
    m_plot.setCurve(m_other, std::array<TimePlot::Point, 2>{{{-5, 2}, {-1, 2}}});
    m_plot.replot();
    const auto [lower, upper] = m_plot.valueRange(m_upper);
    EXPECT_LT(lower, -4);
    EXPECT_GT(upper, 6);
    EXPECT_DOUBLE_EQ(lower + upper, 2) << "as much room below as above";
    const auto [flatLower, flatUpper] = m_plot.valueRange(m_lower);
    EXPECT_GE(flatUpper - flatLower, 0.5) << "a constant needs a range as well";
    EXPECT_DOUBLE_EQ(flatLower + flatUpper, 4);
}

TEST_F(TimePlotTest, LabelsOfValuesNeverTouchInLowCharts) {
    m_plot.setCurve(m_curve, std::array<TimePlot::Point, 2>{{{-5, -4}, {-1, 6}}});
    for (const int height : {40, 60, 80, 110, 150, 300}) {
        m_plot.resize(300, height);
        m_plot.replot();
        QTest::qWait(1);
        m_plot.replot();
        for (const int chart : {m_upper, m_lower}) {
            const int labels = valueLabels(chart);
            EXPECT_TRUE(labels <= 1 || labels * m_plot.fontMetrics().height() <= axes(chart).height())
                << height << " pixels: " << labels << " labels in " << axes(chart).height();
        }
    }
    EXPECT_GE(valueLabels(m_upper), 2) << "where there is room";
}

TEST_F(TimePlotTest, BreaksCurvesAtNoNumberAndDrawsThemInTheirColour) {
    m_plot.setCurve(m_curve, std::array<TimePlot::Point, 2>{{{-10, 0}, {0, 0}}});
    const int whole = pixelsOf(painted(), theme().axisX);
    EXPECT_GT(whole, 100);
    const double none = std::numeric_limits<double>::quiet_NaN();
    m_plot.setCurve(m_curve,
                    std::array<TimePlot::Point, 5>{{{-10, 0}, {-8, 0}, {-5, none}, {-2, 0}, {0, 0}}});
    EXPECT_NEAR(pixelsOf(painted(), theme().axisX), whole * 0.4, whole * 0.1);
}

TEST_F(TimePlotTest, HatchesWideGapsAndMarksShortOnes) {
    EXPECT_EQ(pixelsOf(painted(), theme().warning), 0);
    m_plot.setGaps(std::array<TimePlot::Gap, 1>{{{-4.0, -2.0}}});
    const int hatched = pixelsOf(painted(), theme().warning);
    EXPECT_GT(hatched, 100);
    m_plot.setGaps(std::array<TimePlot::Gap, 1>{{{-4.0, -3.99}}});
    const int marked = pixelsOf(painted(), theme().warning);
    EXPECT_GT(marked, 0);
    EXPECT_LT(marked, hatched / 2);
    m_plot.setGaps({});
    EXPECT_EQ(pixelsOf(painted(), theme().warning), 0);
}

TEST_F(TimePlotTest, FollowsTheTheme) {
    m_plot.setCurve(m_curve, std::array<TimePlot::Point, 2>{{{-10, 0}, {0, 0}}});
    applyTheme(*qApp, ThemeChoice::Light);
    EXPECT_GT(pixelsOf(painted(), theme().axisX), 100);
    EXPECT_GT(pixelsOf(painted(), theme().panel), 10'000);
    applyTheme(*qApp, ThemeChoice::Dark);
}

TEST_F(TimePlotTest, AClickAsksForTheMomentThatItIsAt) {
    m_plot.setSpan(0, 20);
    m_plot.setCursor(5.0);
    EXPECT_GT(pixelsOf(painted(), theme().text), 100) << "a line through both charts";
    m_plot.setCursor(std::nullopt);
    EXPECT_LT(pixelsOf(painted(), theme().text), 100);
    std::vector<double> picked;
    QObject::connect(&m_plot, &TimePlot::momentPicked, &m_plot, [&](double time) { picked.push_back(time); });
    QWidget* inner = m_plot.findChildren<QWidget*>().front();
    QTest::mouseClick(inner, Qt::LeftButton, {}, QPoint(inner->width() - 20, 100));
    QTest::mouseClick(inner, Qt::LeftButton, {}, QPoint(inner->width() / 2, 100));
    ASSERT_EQ(picked.size(), 2U);
    EXPECT_GT(picked[0], 18);
    EXPECT_GT(picked[1], 7);
    EXPECT_LT(picked[1], 13);
}

} // namespace
} // namespace posewire::gui
