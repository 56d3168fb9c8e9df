// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/skeleton.h"
#include "core/log/scratch.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace posewire::exporting {

/// Floats that are written one by one and wanted all together at the end. They lie in a scratch: a range of
/// hours takes no memory.
class FloatColumn {
public:
    explicit FloatColumn(std::shared_ptr<log::Scratch> scratch) : m_scratch(std::move(scratch)) {}

    void add(float value);
    [[nodiscard]] std::uint64_t size() const { return m_size; }
    /// All of them as bytes, piece by piece, as they lie in memory.
    template <class Visitor>
    void visit(Visitor&& visitor) const {
        for (std::size_t i = 0; i < m_blocks.size(); ++i) {
            const std::uint64_t left = m_size - i * kBlock;
            visitor(
                std::string_view(reinterpret_cast<const char*>(m_blocks[i].get()),
                                 sizeof(float) * (left < kBlock ? static_cast<std::size_t>(left) : kBlock)));
        }
    }

private:
    static constexpr std::size_t kBlock = 4096; ///< floats

    std::shared_ptr<log::Scratch> m_scratch;
    std::vector<std::shared_ptr<std::byte[]>> m_blocks;
    std::uint64_t m_size = 0;
};

/// The keys of one character: times, and for each joint its position and its rotation relative to its parent.
/// Y-up; rotations x y z w, each on the side of the one before, so that players turn the short way.
class KeyColumns {
public:
    KeyColumns(const Skeleton& skeleton, const std::shared_ptr<log::Scratch>& scratch);

    void add(double seconds, std::span<const model::SegmentPose> local);

    [[nodiscard]] std::uint64_t count() const { return m_times.size(); }
    /// Of the first key and of the last; each is later than the one before.
    [[nodiscard]] float firstTime() const { return m_first; }
    [[nodiscard]] float lastTime() const { return m_last; }
    [[nodiscard]] const FloatColumn& times() const { return m_times; }
    [[nodiscard]] const FloatColumn& positions(std::size_t joint) const { return m_positions[joint]; }
    [[nodiscard]] const FloatColumn& rotations(std::size_t joint) const { return m_rotations[joint]; }

private:
    FloatColumn m_times;
    std::vector<FloatColumn> m_positions;
    std::vector<FloatColumn> m_rotations;
    std::vector<Eigen::Quaterniond> m_newest; ///< by joint
    float m_first = 0;
    float m_last = 0;
};

} // namespace posewire::exporting
