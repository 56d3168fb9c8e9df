// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/character_mark.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/readings.h"

#include <QString>

#include <array>
#include <vector>

namespace posewire::gui {

/// A quantity of a segment: w x y z, of which vectors leave w empty and plain numbers have x alone.
struct SegmentFact {
    QString name;
    std::array<QString, 4> values;
    QString unit;

    friend bool operator==(const SegmentFact&, const SegmentFact&) = default;
};

/// What is known of one segment at the moment that is shown.
struct SegmentFacts {
    CharacterMark mark;
    QString segment;
    QString character;
    QString source; ///< "Position sent, orientation solved"
    Health sourceHealth = Health::Unknown;
    std::vector<SegmentFact> facts;

    friend bool operator==(const SegmentFacts&, const SegmentFacts&) = default;
};

/// Pose, motion (types 21 and 22) and joint (type 20, else from the pose) of a segment by its position in
/// pose datagrams, in the world as it was sent: metres, seconds, radians, joints in degrees. `segment` is
/// within the pose.
[[nodiscard]] SegmentFacts segmentFacts(const PoseSubject& subject, int segment);

} // namespace posewire::gui
