// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/comparison/timetable.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Which sample of one recording belongs to which of another.
namespace posewire::exporting {

enum class AlignBy : std::uint8_t {
    TimeCode, ///< of the headers
    Sample,   ///< counters
    Begin,    ///< time since the first pose of each
};
/// "timecode", "sample", "begin": for commands and settings.
[[nodiscard]] const char* keyOf(AlignBy by);
[[nodiscard]] std::optional<AlignBy> alignByOf(std::string_view key);

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

    /// Place in the second timetable; nothing where no sample there is of that moment: none is nearer than
    /// half the time between two samples of whichever recording has more of them, or half a count. Of several
    /// that are as near the first one.
    [[nodiscard]] std::optional<std::size_t> of(const SampleMoment& moment) const;

    [[nodiscard]] const Timetable& first() const { return *m_first; }
    [[nodiscard]] const Timetable& second() const { return *m_second; }
    [[nodiscard]] const Alignment& alignment() const { return m_alignment; }
    /// Whether a moment of the first recording is in the time that both have.
    [[nodiscard]] bool isCommon(const SampleMoment& moment) const;

private:
    [[nodiscard]] double measure(const Timetable& table, const SampleMoment& moment) const;

    std::shared_ptr<const Timetable> m_first;
    std::shared_ptr<const Timetable> m_second;
    Alignment m_alignment;
    double m_tolerance = 0.5;
    using Places = std::vector<std::pair<double, std::uint32_t>>;
    std::shared_ptr<const Places> m_places; ///< by measure: places in the second timetable
};

} // namespace posewire::exporting
