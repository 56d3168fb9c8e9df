// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/body/null_pose.h"
#include "core/model/body/segments.h"
#include "core/wire/messages.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace posewire::model {

enum class Severity : std::uint8_t { Note, Warning, Error };

enum class NullPoseFault : std::uint8_t {
    NeverSent,
    NotFinite,
    MissingPart,
    TooLarge,
    EarlierPartMissing,
    SegmentCount,
    NameTwice,
    NameOrder,
    UnknownName,
    Unit,
    Stature,
    AxisUp,
    Mirrored,
    BelowFloor,
    AboveFloor,
    Asymmetric,
    LengthChanged,
    PointWithoutSegment,
    PointTwice,
    PointName,
    PointAgainstSegment,
    ScaleAgainstNullPose,
};

/// One contradiction, in words.
struct NullPoseFinding {
    NullPoseFault fault = NullPoseFault::NeverSent;
    Severity severity = Severity::Note;
    int segment = -1;    ///< body segment to look at, −1 for none in particular
    std::string what;    ///< what is wrong and where
    std::string meaning; ///< what follows for whoever uses the data
};

/// What the scale messages of a character are judged by.
struct NullPoseEvidence {
    NullPoseRecord record;
    const wire::ScaleInformation* scale = nullptr; ///< newest type 10, null where none was sent
    std::optional<SegmentLayout> layout;           ///< of the newest pose
    double poseSeconds = 0;                        ///< for how long poses have come
    log::Stamp now{};                              ///< stamp at the cursor
};

/// Every contradiction, gravest first.
[[nodiscard]] std::vector<NullPoseFinding> findContradictions(const NullPoseEvidence& evidence);

/// The gravest error in a null pose itself, whatever came or did not come beside it; empty where there is
/// none.
[[nodiscard]] std::string gravestError(const NullPoseRecord& record);

/// "2 errors, 1 warning"; empty where there are neither.
[[nodiscard]] std::string findingsSummary(const std::vector<NullPoseFinding>& findings);

/// Poses for this long without a scale message are reported (seconds).
inline constexpr double kScaleMessageDue = 10.0;

/// A part that has not come this long after its neighbours does not come any more (seconds).
inline constexpr double kPartOverdue = 1.0;

/// Adds those of them that concern the shape of a null pose, which must be there: its size, axes and sides,
/// what changed since the message before, its points. Part of findContradictions().
void findInShape(const NullPoseRecord& record, std::vector<NullPoseFinding>& findings);

} // namespace posewire::model
