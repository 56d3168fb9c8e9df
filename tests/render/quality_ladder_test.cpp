// SPDX-License-Identifier: MIT
#include "render/quality_ladder.h"
#include "render/renderer.h"

#include <array>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace posewire::render {
namespace {

/// What a picture takes on each step, as a multiple of the last, about as measured with four characters.
constexpr std::array<double, kLastSimplification + 1> kCosts{3.4, 2.8, 2.5, 2.0, 1.6, 1.1, 1.0, 1.0};

class QualityLadderTest : public testing::Test {
protected:
    /// Draws for so long at 30 pictures a second; `load` scales all costs.
    void draw(double seconds, double load, const std::function<double(int)>& noise = {}) {
        for (const double end = m_now + seconds; m_now < end; m_now += 1.0 / 30) {
            const int before = stepNumber();
            const double cost = load * kCosts[static_cast<std::size_t>(before)];
            m_ladder.add(cost * (noise ? noise(m_picture) : 1.0), m_now);
            m_changes += stepNumber() != before ? 1 : 0;
            ++m_picture;
        }
    }
    int stepNumber() const { return static_cast<int>(m_ladder.step()); }
    double costNow(double load) const { return load * kCosts[static_cast<std::size_t>(stepNumber())]; }

    QualityLadder m_ladder;
    double m_now = 100.0;
    int m_changes = 0;
    int m_picture = 0;
};

constexpr double kBudget = QualityLadder::kBudget;

TEST_F(QualityLadderTest, LeavesNothingOutWherePicturesAreFast) {
    draw(60, kBudget / 4);
    EXPECT_EQ(m_ladder.step(), Simplification::None);
    EXPECT_EQ(m_ladder.cause(), 0.0);
}

TEST_F(QualityLadderTest, StepsDownUntilPicturesKeepTheBudgetAndNoFarther) {
    const double load = 0.6 * kBudget; // 0.96 of the budget at kCosts 1.6
    draw(3, load);
    EXPECT_EQ(m_ladder.step(), Simplification::HardSelfShadows);
    EXPECT_LE(costNow(load), kBudget);
    EXPECT_GT(m_ladder.cause(), kBudget) << "why it is on that step";
}

TEST_F(QualityLadderTest, GetsThereWithinTwoSeconds) {
    draw(2, 5 * kBudget);
    EXPECT_EQ(m_ladder.step(), Simplification::HalfRate);
}

TEST_F(QualityLadderTest, LeavesPicturesOutOnlyWhereTheyAreFarTooSlow) {
    draw(30, 1.7 * kBudget);
    EXPECT_EQ(m_ladder.step(), Simplification::FewAxes) << "slower than wanted, at the full rate";
    draw(30, 2.2 * kBudget);
    EXPECT_EQ(m_ladder.step(), Simplification::HalfRate);
    draw(60, 1.2 * kBudget);
    EXPECT_EQ(m_ladder.step(), Simplification::FewAxes);
}

TEST_F(QualityLadderTest, StepsUpAgainWhenThereIsTime) {
    draw(3, 0.6 * kBudget);
    draw(15, 0.1 * kBudget);
    EXPECT_EQ(m_ladder.step(), Simplification::None);
}

TEST_F(QualityLadderTest, IgnoresASingleSlowPicture) {
    draw(60, 0.25 * kBudget, [](int picture) { return picture % 40 == 39 ? 30.0 : 1.0; });
    EXPECT_EQ(m_ladder.step(), Simplification::None);
    EXPECT_EQ(m_changes, 0);
}

TEST_F(QualityLadderTest, DoesNotFlickerBetweenTwoStepsWhateverTheLoad) {
    // Somewhere among these loads one step is just too slow and the next has plenty of room.
    for (double load = 0.3; load < 1.1; load += 0.01) {
        m_ladder = QualityLadder();
        draw(10, load * kBudget);
        m_changes = 0;
        draw(600, load * kBudget, [](int picture) { return 0.9 + 0.2 * ((picture * 7919) % 100) / 100.0; });
        EXPECT_LE(m_changes, 10) << load << ", in ten minutes";
    }
}

TEST_F(QualityLadderTest, WaitsLongerAfterEachTryThatFailed) {
    // What is above always looks cheap and never is.
    draw(3, 0.6 * kBudget);
    m_changes = 0;
    for (int i = 0; i < 6000; ++i) {
        draw(0.1, (stepNumber() > 3 ? 0.3 : 0.9) * kBudget);
    }
    EXPECT_LE(m_changes, 50) << "in ten minutes";
    EXPECT_GE(m_changes, 2) << "it gives up on no step";
}

TEST_F(QualityLadderTest, IgnoresTimesThatAreNone) {
    for (int i = 0; i < 100; ++i) {
        m_ladder.add(-1.0, m_now);
        m_ladder.add(std::numeric_limits<double>::quiet_NaN(), m_now);
    }
    EXPECT_EQ(m_ladder.step(), Simplification::None);
    EXPECT_EQ(m_ladder.typical(), 0.0);
}

TEST(Simplified, LeavesOutMoreWithEachStep) {
    const RenderQuality base = interactiveQuality("llvmpipe");
    EXPECT_EQ(simplified(base, Simplification::None), base);
    EXPECT_TRUE(simplified(base, Simplification::LowShadows).lowShadows);
    EXPECT_EQ(simplified(base, Simplification::LowShadows).shadowMapSize, base.shadowMapSize);
    const RenderQuality small = simplified(base, Simplification::SmallShadows);
    EXPECT_EQ(small.shadowMapSize, 512);
    EXPECT_EQ(small.floorShadowSize, 256);
    EXPECT_FALSE(small.hardSelfShadow);
    EXPECT_GT(simplified(base, Simplification::LowBodies).lowBodiesBelow, base.lowBodiesBelow);
    EXPECT_TRUE(simplified(base, Simplification::HardSelfShadows).edgeSmoothing);
    EXPECT_FALSE(simplified(base, Simplification::RawEdges).edgeSmoothing);
}

} // namespace
} // namespace posewire::render
