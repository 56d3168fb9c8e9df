// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/character_pose.h"

#include <Eigen/Core>

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

namespace posewire::exporting {

/// A point of type 03. Metres, Z-up.
struct Marker {
    std::uint32_t id = 0; ///< as sent
    Eigen::Vector3d position;
};

/// A whole sample of one character.
struct MotionSample {
    model::CharacterPose pose;   ///< without segments where markers are read
    std::vector<Marker> markers; ///< none where poses are read
    std::size_t rank = 0;        ///< of its type: of two with one counter the lower one counts
};

/// Puts the samples of one character into the order of their counters, each once. What comes late waits for
/// no longer than kWait, so memory does not grow with the range. A counter that jumps is believed where the
/// next sample agrees: then a new run begins.
class SampleOrder {
public:
    static constexpr log::Duration kWait = std::chrono::seconds(1);
    static constexpr std::size_t kMost = 512; ///< that wait

    using Take = std::function<void(const MotionSample& sample, bool beginsRun)>;
    explicit SampleOrder(Take take) : m_take(std::move(take)) {}

    void add(MotionSample sample);
    /// What comes next has nothing to do with the counters before: another sender.
    void beginRun();
    /// Nothing more comes.
    void finish() { beginRun(); }

private:
    [[nodiscard]] bool isExpected(std::uint32_t sample) const;
    void insert(MotionSample sample);
    void doubt(MotionSample sample);
    void release(log::Stamp now);
    void takeFirst();

    Take m_take;
    std::deque<MotionSample> m_waiting;   ///< by counter
    std::vector<MotionSample> m_doubted;  ///< agree with each other on another place
    std::optional<std::uint32_t> m_taken; ///< the newest of this run that has gone
};

} // namespace posewire::exporting
