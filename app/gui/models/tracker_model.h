// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "app/gui/models/tracker_history.h"

#include <QAbstractTableModel>

#include <vector>

namespace posewire::gui {

/// The trackers of the shown character in wire order, as of the newest type 23 at the cursor.
class TrackerModel : public QAbstractTableModel {
    Q_OBJECT

public:
    enum Column : int { kName, kFree, kAcceleration, kGyro, kMagnetic, kState, kColumnCount };

    explicit TrackerModel(model::SessionView& view, QObject* parent = nullptr);

    void refresh();

    /// The tracker to be looked at closely: that of the selected segment, else the first. Null where there is
    /// no tracker.
    [[nodiscard]] const wire::Tracker* shown() const;
    [[nodiscard]] int shownRow() const;
    [[nodiscard]] const wire::Tracker& tracker(int row) const;
    [[nodiscard]] std::optional<model::CharacterKey> character() const { return m_key; }
    [[nodiscard]] const TrackerHistory& history() const { return m_history; }
    /// False in the form of type 23 that has neither acceleration nor angular velocity.
    [[nodiscard]] bool hasInertialData() const { return m_hasInertialData; }
    /// What is wrong with a tracker; good and without text where nothing is.
    [[nodiscard]] PropertyValue state(const wire::Tracker& tracker) const;

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    void fitRows(std::size_t count);
    [[nodiscard]] QString text(const wire::Tracker& tracker, int column) const;

    model::SessionView& m_view;
    std::optional<model::CharacterKey> m_key;
    std::vector<wire::Tracker> m_trackers;
    bool m_hasInertialData = true;
    int m_shownRow = -1;
    TrackerHistory m_history;
};

/// "Right Hand" for 11: trackers have the ID of the segment that they are on.
[[nodiscard]] QString trackerName(std::uint32_t id);

/// Every quantity of the shown tracker with its unit.
[[nodiscard]] std::vector<Property> trackerFacts(const TrackerModel& trackers);

} // namespace posewire::gui
