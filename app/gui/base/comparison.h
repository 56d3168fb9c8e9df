// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/comparison/alignment.h"
#include "core/export/comparison/pose_comparison.h"

#include <QString>
#include <QStringList>

#include <memory>
#include <optional>

namespace posewire::gui {

struct ComparisonChoice {
    std::optional<exporting::AlignBy> by{}; ///< nothing: by what both have in common
    double offset = 0;                      ///< as exporting::Alignment
    model::DifferenceFrame frame = model::DifferenceFrame::World;
    /// Counts while its first character is the one that is shown; nothing: by name, ID, or order.
    std::optional<exporting::CharacterPair> pair{};
    bool isBeside = false; ///< the second body stands at the side of the first one in the viewport

    friend bool operator==(const ComparisonChoice&, const ComparisonChoice&) = default;
};

struct ComparisonState {
    bool isOpen = false;
    QString name;                         ///< of the second recording's file
    model::SessionView* second = nullptr; ///< at the same moment as what is shown; null without any of it
    ComparisonChoice choice;              ///< of the operator, also while nothing is compared
    std::optional<exporting::CharacterPair> pair;
    std::optional<exporting::Alignment> alignment; ///< in force; nothing before it is known
    double step = 1;                               ///< of its offset, for one sample
    std::optional<model::PoseDifference> atCursor; ///< nothing if there is no partner
    /// Differences over the range of the figures; null before they are worked out.
    std::shared_ptr<const exporting::MotionComparison> range;
    bool isWorking = false;
    double share = 0;       ///< of that work, from 0 to 1
    bool isStopped = false; ///< by the operator
    QString problem;        ///< why nothing is compared, and what to do
    QStringList notes;      ///< what else the operator must know
};

} // namespace posewire::gui
