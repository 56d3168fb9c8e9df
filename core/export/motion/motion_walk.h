// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_source.h"
#include "core/export/motion/sample_order.h"
#include "core/log/byte_io.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace posewire::exporting {

/// What is read of a character.
enum class MotionContent : std::uint8_t {
    Segments, ///< the poses that the viewport would show
    Markers,  ///< the points of type 03
};

/// How far long work is, from 0 to 1. It goes on where the answer is true.
using ExportProgress = std::function<bool(double share)>;

/// A sample of the character at a place of the source.
using TakeSample = std::function<void(std::size_t character, const MotionSample& sample, bool beginsRun)>;

/// Hands out all whole samples of a range, those of each character in the order of their counters, for who
/// reads several logs in step.
class MotionWalk {
public:
    /// The source outlives this.
    MotionWalk(const MotionSource& source, MotionContent content, TakeSample take);
    ~MotionWalk();
    MotionWalk(const MotionWalk&) = delete;
    MotionWalk& operator=(const MotionWalk&) = delete;

    /// Reads on for some packets; false where there were none left: all samples were handed out.
    bool advance();
    /// How much of the range was read, from 0 to 1.
    [[nodiscard]] double share() const;
    /// Packets of the range that the log had dropped before they were read.
    [[nodiscard]] std::uint64_t passedOver() const;

private:
    struct Parts;
    std::unique_ptr<Parts> m_parts;
};

/// The same at once: how many were passed over. Fails as cancelled only.
[[nodiscard]] tl::expected<std::uint64_t, log::FileError> walkMotion(const MotionSource& source,
                                                                     MotionContent content,
                                                                     const TakeSample& take,
                                                                     const ExportProgress& progress);

} // namespace posewire::exporting
