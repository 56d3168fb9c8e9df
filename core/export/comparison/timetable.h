// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_reader.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace posewire::exporting {

/// When a sample was made, by everything that may tell.
struct SampleMoment {
    std::uint32_t sample = 0;
    std::uint32_t timeCode = 0; ///< ms
    log::Stamp stamp{};         ///< when it was received
    std::uint64_t packet = 0;   ///< that completed it
};

/// The samples of a character that hold a pose, in the order of their counters.
class Timetable {
public:
    /// Further ones are left out: 24 bytes each. Two hours at 240 Hz.
    static constexpr std::size_t kMost = 2'000'000;

    /// Of the first character of the source. Fails as cancelled only.
    [[nodiscard]] static tl::expected<Timetable, log::FileError> of(const feed::PoseSource& source,
                                                                    const ExportProgress& progress);

    [[nodiscard]] const std::vector<SampleMoment>& samples() const { return m_samples; }
    [[nodiscard]] bool isCut() const { return m_isCut; }
    [[nodiscard]] std::uint32_t step() const { return m_step; } ///< of the counters; 0 where there is none
    [[nodiscard]] double rateHz() const { return m_rateHz; }    ///< 0 where it is not known
    /// Between two samples, in ms; 0 where it is not known.
    [[nodiscard]] double periodMs() const { return m_rateHz > 0 ? 1000 / m_rateHz : 0; }

    /// Since the first sample, in ms: by counters, so that no jitter is in it, through restarts by when it
    /// was received. Of a sample that came after the last one of the table as well.
    [[nodiscard]] double millisecondsOf(const SampleMoment& moment) const;

private:
    /// Samples between two restarts.
    struct Run {
        std::uint64_t packet = 0; ///< of its first sample
        std::uint32_t sample = 0;
        double milliseconds = 0;
    };
    void add(const model::CharacterPose& pose, bool beginsRun);

    std::vector<SampleMoment> m_samples;
    std::vector<Run> m_runs;
    std::uint32_t m_step = 0;
    double m_rateHz = 0;
    bool m_isCut = false;
};

} // namespace posewire::exporting
