// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace posewire::render {

struct RenderQuality;

/// What is left out of pictures that follow one another, in the order in which it is missed least: each step
/// leaves out what those before it do.
enum class Simplification : std::uint8_t {
    None,
    LowShadows,      ///< shadows are those of the low mesh
    SmallShadows,    ///< of fewer texels
    LowBodies,       ///< bodies that are not large in the picture are of the low mesh
    HardSelfShadows, ///< one look at the light's picture, instead of six
    RawEdges,        ///< edges are not smoothed, all bodies are of the low mesh
    FewAxes,         ///< of what is selected only
    HalfRate         ///< every other picture
};
inline constexpr int kLastSimplification = static_cast<int>(Simplification::HalfRate);

/// The quality with all that a step leaves out; axes and rate are the caller's.
RenderQuality simplified(RenderQuality quality, Simplification step);

/// Finds how much has to be left out for pictures to take no longer than a budget, by how long they took: the
/// median of a few decides, so that one hiccup changes nothing. It steps up again when the pictures of the
/// step above would have time: what a step saves is measured when it is taken. Where a step up proves wrong,
/// the next waits longer, so that the picture does not flicker between two.
class QualityLadder {
public:
    /// Seconds; of a display's 60 pictures a second every other is drawn then, with room for all else.
    static constexpr double kBudget = 0.013;

    explicit QualityLadder(double budget = kBudget) : m_budget(budget) {}

    /// A picture of the present step took so long; `now` is when it was finished, on any steady clock in
    /// seconds.
    void add(double took, double now);

    [[nodiscard]] Simplification step() const { return static_cast<Simplification>(m_step); }
    [[nodiscard]] double budget() const { return m_budget; }
    /// What a picture takes now; 0 before there were enough.
    [[nodiscard]] double typical() const { return m_typical; }
    /// What a picture took before the last step down; 0 where there was none.
    [[nodiscard]] double cause() const { return m_step == 0 ? 0.0 : m_cause; }

private:
    static constexpr std::size_t kPictures = 7;
    static constexpr std::size_t kSteps = kLastSimplification + 1;

    [[nodiscard]] double median() const;
    void learn();
    void stepDown(double now);
    void stepUp(double now);
    void move(int step, double now);

    double m_budget;
    int m_step = 0;
    std::array<double, kPictures> m_took{};
    std::size_t m_count = 0; ///< since the last move
    double m_typical = 0.0;
    double m_cause = 0.0;
    double m_moved = 0.0;   ///< when
    double m_doubted = 0.0; ///< when what was learned was last believed less
    bool m_wasUp = false;
    double m_patience = 0.0;
    int m_leftStep = 0;
    double m_leftTypical = 0.0; ///< of the step that was left
    /// How many times longer a picture takes a step higher.
    std::array<double, kSteps> m_gain = [] {
        std::array<double, kSteps> gain{};
        gain.fill(1.4);
        return gain;
    }();
};

} // namespace posewire::render
