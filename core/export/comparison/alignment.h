// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_reader.h"
#include "core/model/session/session_view.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace posewire::exporting {

/// The samples of a character that hold a pose, in the order of their counters.
class Timetable {
public:
    /// Further ones are left out: 24 bytes each. Two hours at 240 Hz.
    static constexpr std::size_t kMost = 2'000'000;

    /// Reads the first character of the source. Fails as cancelled only.
    [[nodiscard]] static tl::expected<Timetable, log::FileError> of(const feed::PoseSource& source,
                                                                    const ExportProgress& progress);

    [[nodiscard]] const std::vector<SampleMoment>& samples() const { return m_samples; }
    [[nodiscard]] bool isCut() const { return m_isCut; }
    [[nodiscard]] std::uint32_t step() const { return m_step; } ///< of the counters; 0 if there is none
    [[nodiscard]] double rateHz() const { return m_rateHz; }    ///< 0 if it is not known
    /// Between two samples, in ms; 0 if it is not known.
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

enum class AlignBy : std::uint8_t {
    TimeCode, ///< of the headers
    Sample,   ///< counters
    Begin,    ///< time since the first pose of each
};

/// The partner of a sample is the one of the second recording that is `offset` later by this measure: ms, or
/// counts of samples.
struct Alignment {
    AlignBy by = AlignBy::Begin;
    double offset = 0;
    friend bool operator==(const Alignment&, const Alignment&) = default;
};

/// How far an alignment is moved by one sample of the second recording.
[[nodiscard]] double stepOf(AlignBy by, const Timetable& second);

/// By time code where both have moments in common by that, else by sample counter where they have, else by
/// their beginnings.
[[nodiscard]] AlignBy naturalAlignment(const Timetable& first, const Timetable& second);

/// Finds partners in the second of two recordings. By value: for any thread.
class Partners {
public:
    Partners(std::shared_ptr<const Timetable> first, std::shared_ptr<const Timetable> second,
             const Alignment& alignment);
    /// The same, moved by hand. Costs nothing.
    [[nodiscard]] Partners withOffset(double offset) const;

    /// Place in the second timetable; nothing if no sample there is of that moment: none is nearer than
    /// half the time between two samples of whichever recording has more of them, or half a count. Of several
    /// that are as near the first one.
    [[nodiscard]] std::optional<std::size_t> of(const SampleMoment& moment) const;

    [[nodiscard]] const Timetable& first() const { return *m_first; }
    [[nodiscard]] const Timetable& second() const { return *m_second; }
    [[nodiscard]] const Alignment& alignment() const { return m_alignment; }
    [[nodiscard]] bool isCommon(const SampleMoment& moment) const;

private:
    std::shared_ptr<const Timetable> m_first;
    std::shared_ptr<const Timetable> m_second;
    Alignment m_alignment;
    double m_tolerance = 0.5;
    using Places = std::vector<std::pair<double, std::uint32_t>>;
    std::shared_ptr<const Places> m_places; ///< by measure: places in the second timetable
};

using CharacterPair = std::pair<model::CharacterKey, model::CharacterKey>;

/// Which character of the one session is the same as which of the other: those with the same name, then those
/// with the same ID, then the others in order. Each has one partner at most; in the order of the first.
[[nodiscard]] std::vector<CharacterPair> pairCharacters(const model::SessionView& first,
                                                        const model::SessionView& second);

} // namespace posewire::exporting
