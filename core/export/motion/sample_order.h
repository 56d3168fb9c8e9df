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

/// Puts the samples of one character into the order of their counters, each once. Each waits for kWait, so
/// that what is late has its place, also from before a restart; memory does not grow with the range. A
/// counter that is far from the others is believed where the next ones agree with it: what is lost in between
/// is lost, or a new run begins. By the same rules as model::Probation, which counts, so that what is
/// exported is what was counted.
class SampleOrder {
public:
    static constexpr log::Duration kWait = std::chrono::seconds(4);
    static constexpr std::size_t kMost = 2048; ///< that wait

    using Take = std::function<void(const MotionSample& sample, bool beginsRun)>;
    explicit SampleOrder(Take take) : m_take(std::move(take)) {}

    void add(MotionSample sample);
    /// All that waits goes; what comes next has nothing to do with the counters before: another sender.
    void flush();

private:
    /// Samples between two restarts.
    struct Run {
        std::deque<MotionSample> waiting;   ///< by counter
        std::uint32_t highest = 0;          ///< counter, taken or not
        std::optional<std::uint32_t> taken; ///< the newest that has gone

        [[nodiscard]] bool lacks(std::uint32_t sample) const;
        void insert(MotionSample sample);
    };
    struct Doubted {
        MotionSample sample;
        bool isFresh = true; ///< the run has not advanced since
    };

    [[nodiscard]] bool isExpected(std::uint32_t sample) const;
    [[nodiscard]] bool mayStraggle(std::uint32_t sample) const;
    void advance();
    void doubt(MotionSample sample);
    [[nodiscard]] std::size_t agreeing(std::uint32_t sample) const;
    void believe(std::uint32_t sample);
    void release(log::Stamp now);
    void takeFirst();

    Take m_take;
    std::deque<Run> m_runs; ///< the newest last; those before it may still get what is late
    std::vector<Doubted> m_doubted;
};

} // namespace posewire::exporting
