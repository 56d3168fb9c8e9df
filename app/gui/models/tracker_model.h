// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "core/log/time.h"
#include "core/model/message.h"
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
    /// assumption from published data sheets, since the stream does not say.
    static constexpr float kSaturatedAcceleration = 156.0F;   ///< m/s²
    static constexpr float kSaturatedAngularVelocity = 34.0F; ///< rad/s
    /// The norm of the magnetic field may be this far from its own median.
    static constexpr double kDisturbedShare = 0.15;

    /// Takes in what is new; starts over where character or tracker change or the cursor went back.
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
    /// Within the last ten seconds.
    [[nodiscard]] bool isSaturated(std::uint32_t trackerId) const;

private:
    struct Norm {
        log::Stamp stamp;
        float norm;
    };
    struct Lately {
        std::deque<Norm> norms; ///< twenty a second
        std::optional<float> median;
        std::optional<log::Stamp> saturated;
    };
    void add(const model::Message& message, std::uint32_t step);
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

/// The trackers of the shown character in wire order, as of the newest type 23 at the cursor.
class TrackerModel : public TableModel<wire::Tracker> {
public:
    enum Column : int { kName, kFree, kAcceleration, kGyro, kMagnetic, kState };

    explicit TrackerModel(model::SessionView& view);

    void refresh();

    /// The tracker to be looked at closely: that of the selected segment, else the first. Null if there is
    /// no tracker.
    [[nodiscard]] const wire::Tracker* shown() const;
    [[nodiscard]] int shownRow() const { return m_shownRow; }
    [[nodiscard]] const wire::Tracker& tracker(int row) const {
        return rows()[static_cast<std::size_t>(row)];
    }
    [[nodiscard]] std::optional<model::CharacterKey> character() const { return m_key; }
    [[nodiscard]] const TrackerHistory& history() const { return m_history; }
    /// False in the form of type 23 that has neither acceleration nor angular velocity.
    [[nodiscard]] bool hasInertialData() const { return m_hasInertialData; }
    /// Nothing has come of it for a while: what is shown is not how it is now.
    [[nodiscard]] bool isStale() const { return !m_stale.isEmpty(); }
    /// "stale 3.2 s"; empty while it is not.
    [[nodiscard]] const QString& staleText() const { return m_stale; }
    /// Good and without text if all is well.
    [[nodiscard]] PropertyValue state(const wire::Tracker& tracker) const;

private:
    model::SessionView& m_view;
    std::optional<model::CharacterKey> m_key;
    bool m_hasInertialData = true;
    QString m_stale;
    int m_shownRow = -1;
    TrackerHistory m_history;
};

/// "Right Hand" for 11: trackers have the ID of the segment that they are on.
[[nodiscard]] QString trackerName(std::uint32_t id);

/// Every quantity of the shown tracker with its unit.
[[nodiscard]] std::vector<Property> trackerFacts(const TrackerModel& trackers);

} // namespace posewire::gui
