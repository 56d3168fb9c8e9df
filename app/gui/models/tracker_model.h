// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "app/gui/models/tracker_history.h"

namespace posewire::gui {

/// The trackers of the shown character in wire order, as of the newest type 23 at the cursor.
class TrackerModel : public TableModel<wire::Tracker> {
public:
    enum Column : int { kName, kFree, kAcceleration, kGyro, kMagnetic, kState, kColumnCount };

    explicit TrackerModel(model::SessionView& view, QObject* parent = nullptr);

    void refresh();

    /// The tracker to be looked at closely: that of the selected segment, else the first. Null where there is
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
    /// What is wrong with a tracker; good and without text where nothing is.
    [[nodiscard]] PropertyValue state(const wire::Tracker& tracker) const;

private:
    model::SessionView& m_view;
    std::optional<model::CharacterKey> m_key;
    bool m_hasInertialData = true;
    int m_shownRow = -1;
    TrackerHistory m_history;
};

/// "Right Hand" for 11: trackers have the ID of the segment that they are on.
[[nodiscard]] QString trackerName(std::uint32_t id);

/// Every quantity of the shown tracker with its unit.
[[nodiscard]] std::vector<Property> trackerFacts(const TrackerModel& trackers);

} // namespace posewire::gui
