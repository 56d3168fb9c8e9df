// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "app/gui/models/joint_motion.h"
#include "core/model/body/joint_ranges.h"
#include "core/model/session/session_view.h"

#include <array>
#include <optional>

namespace posewire::gui {

/// A joint at the cursor. Radians; NaN if not known.
struct JointRow {
    std::size_t joint = 0; ///< place in model::jointDefinitions()
    Eigen::Vector3d sent;
    Eigen::Vector3d computed;
    double difference; ///< of the one turn between the two

    /// As sent, else as computed.
    [[nodiscard]] const Eigen::Vector3d& shown() const { return sent.allFinite() ? sent : computed; }
};

/// The 22 joints of the shown character, left beside right: angles as sent in type 20 and as computed from
/// the pose of the same sample, and how far each went over the range that figures are of.
class JointModel : public TableModel<JointRow> {
public:
    enum Column : int { kName, kFlexion, kAbduction, kRotation, kDifference, kState };
    /// Sent and computed are no more than this apart if all is well, in degrees.
    static constexpr double kMarkedDifference = 1.0;

    explicit JointModel(model::SessionView& view);

    void refresh();

    [[nodiscard]] std::optional<model::CharacterKey> character() const { return m_key; }
    /// The row of the selected segment and the joint between it and its parent, else the one shown before.
    [[nodiscard]] int shownRow() const { return m_shownRow; }
    /// The row of the other side; nothing for the spine.
    [[nodiscard]] std::optional<int> mirroredRow(int row) const;
    [[nodiscard]] int segmentOf(int row) const;
    [[nodiscard]] const JointMotion& motion() const { return m_motion; }
    /// "sent · computed from 02"; empty without rows.
    [[nodiscard]] const QString& sourceText() const { return m_source; }
    [[nodiscard]] bool isStale() const { return !m_stale.isEmpty(); }
    [[nodiscard]] const QString& staleText() const { return m_stale; }
    [[nodiscard]] PropertyValue state(const JointRow& row) const;

private:
    [[nodiscard]] static std::vector<TableColumn<JointRow>> columns(const JointModel& joints);
    void showSegment(int segment);

    model::SessionView& m_view;
    std::optional<model::CharacterKey> m_key;
    JointMotion m_motion;
    QString m_source;
    QString m_stale;
    int m_shownRow = 0;
    int m_segment = -1; ///< that was selected when the row was chosen
};

/// One of the three angles of the shown joint, and the same of the other side.
struct AngleRow {
    const JointModel* joints = nullptr;
    std::size_t axis = 0;
};

/// The shown joint closely: sent, computed, range of motion, reference range, the other side.
class AngleModel : public TableModel<AngleRow> {
public:
    explicit AngleModel(const JointModel& joints);

    /// The joints have been refreshed.
    void refresh();

private:
    const JointModel& m_joints;
};

} // namespace posewire::gui
