// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/body/null_pose.h"
#include "core/model/body/segments.h"
#include "core/wire/messages.h"
#include "core/words/fact.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::model {

enum class Severity : std::uint8_t { Note, Warning, Error };

/// One contradiction. Its sentence says what is wrong and where, its advice what follows.
struct NullPoseFinding {
    words::Fact fact;
    int segment = -1; ///< body segment to look at, −1 for none in particular

    [[nodiscard]] Severity severity() const;
};

struct NullPoseEvidence {
    NullPoseRecord record;
    const wire::ScaleInformation* scale = nullptr; ///< newest type 10, null if none was sent
    std::optional<SegmentLayout> layout;           ///< of the newest pose
    double poseSeconds = 0;                        ///< for how long poses have come
    log::Stamp now{};                              ///< stamp at the cursor
};

/// Every contradiction, gravest first.
[[nodiscard]] std::vector<NullPoseFinding> findContradictions(const NullPoseEvidence& evidence);

/// The gravest error in a null pose itself, whatever came or did not come beside it.
[[nodiscard]] std::optional<words::Fact> gravestError(const NullPoseRecord& record);

/// Poses for this long without a scale message are reported (seconds).
inline constexpr double kScaleMessageDue = 10.0;

/// A part that has not come this long after its neighbours does not come any more (seconds).
inline constexpr double kPartOverdue = 1.0;

/// Adds those of them that concern the shape of a null pose, which must be there: its size, axes and sides,
/// what changed since the message before, its points. Part of findContradictions().
void findInShape(const NullPoseRecord& record, std::vector<NullPoseFinding>& findings);
/// Adds one that lists names, if there are any.
void addListed(words::Kind kind, std::vector<words::Fact> names, int segment,
               std::vector<NullPoseFinding>& findings);

} // namespace posewire::model
