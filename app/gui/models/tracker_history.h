// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/time.h"
#include "core/model/session/session_view.h"

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

namespace posewire::gui {

/// What the trackers of a character did lately, at the cursor: every sample of one tracker over the last ten
/// seconds for plots, and for all trackers what their flags rest on. Bounded.
class TrackerHistory {
public:
    static constexpr log::Duration kPlot = std::chrono::seconds(10);
    static constexpr log::Duration kMedian = std::chrono::seconds(60);

    /// Full scale of the trackers' accelerometers (16 g) and gyroscopes (2000 °/s), a little below: an
    /// assumption from published data sheets, since the stream does not tell.
    static constexpr float kSaturatedAcceleration = 156.0F;   ///< m/s²
    static constexpr float kSaturatedAngularVelocity = 34.0F; ///< rad/s
    /// How far the norm of the magnetic field may be from its own median.
    static constexpr double kDisturbedShare = 0.15;

    /// Takes in what is new; begins anew where character or tracker change or the cursor went back.
    void follow(model::SessionView& view, const std::optional<model::CharacterKey>& key,
                std::uint32_t trackerId);

    struct Point {
        log::Stamp stamp{};
        wire::Vec3 freeAcceleration{};
        float magneticNorm = 0;
        bool followsGap = false; ///< samples are missing before it
    };
    [[nodiscard]] const std::deque<Point>& points() const { return m_points; }
    [[nodiscard]] log::Stamp lastStamp() const { return m_lastStamp; }

    /// Median of a tracker's magnetic field norm over the last minute read; nothing before its first second.
    [[nodiscard]] std::optional<float> magneticMedian(std::uint32_t trackerId) const;
    [[nodiscard]] bool isDisturbed(const wire::Tracker& tracker) const;
    /// Whether a component reached full scale within the last ten seconds.
    [[nodiscard]] bool isSaturated(std::uint32_t trackerId) const;

private:
    struct Norm {
        log::Stamp stamp;
        float norm;
    };
    struct Lately {
        std::deque<Norm> norms; ///< twenty a second
        float median = 0;
        bool hasMedian = false;
        std::optional<log::Stamp> saturated;
    };
    void add(const model::Message& message, std::uint32_t step);
    void addPoint(const wire::Tracker& tracker, log::Stamp stamp, bool followsGap);
    void addNorm(Lately& lately, log::Stamp stamp, float norm) const;
    void computeMedians();

    std::optional<model::CharacterKey> m_key;
    std::uint32_t m_trackerId = 0;
    log::Stamp m_lastStamp{};
    std::uint32_t m_lastSample = 0;
    std::deque<Point> m_points;
    std::map<std::uint32_t, Lately> m_trackers;
};

/// Length of a vector of the wire.
[[nodiscard]] float norm(const wire::Vec3& vector);

/// Angle of a tracker's magnetic field below the horizontal, in degrees. Which way is down comes from the
/// tracker's orientation, so that it holds in motion too.
[[nodiscard]] double dipDegrees(const wire::Tracker& tracker);

} // namespace posewire::gui
