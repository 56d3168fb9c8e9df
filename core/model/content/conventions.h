// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/reference_body.h"
#include "core/model/body/spaces.h"
#include "core/words/fact.h"

#include <array>
#include <cstddef>
#include <span>

namespace posewire::model {

/// Finds out in which convention positions and orientations are meant, by the only sentence that holds in all
/// of them: a joint is where its parent and the null pose put it, child = parent + q(parent)·(null child −
/// null parent). Sums over several poses, since a body that stands evenly fits in many.
class ConventionFit {
public:
    static constexpr std::size_t kReadings = 11;

    /// Segments of the body as they are read now, in metres; `scale`: how large they are against the null
    /// pose.
    void add(std::span<const SegmentPose> segments, const BodyOrigins& nullPose, double scale);

    /// Whether what was added fits as it is read, up to what other bodies and open joints are off by.
    [[nodiscard]] bool isRight() const;
    /// The reading that fits; Nothing if none does.
    [[nodiscard]] words::Kind looks() const;

private:
    /// By reading, what nine of ten joints are off by at most, in metres.
    std::array<double, kReadings> m_sums{};
    int m_poses = 0;
};

} // namespace posewire::model
