// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_counts.h"
#include "core/model/keys.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace posewire::model {

/// The time that figures are of: all of it, a length of time before the cursor, from the reset to the cursor,
/// or between two stamps.
struct RangeChoice {
    log::Duration last{}; ///< above 0: this long before the cursor
    std::optional<TimeRange> fixed{};
    bool isSinceReset = false;

    friend bool operator==(const RangeChoice&, const RangeChoice&) = default;
};

struct Cursor {
    enum class Mode : std::uint8_t { Following, Paused };
    Mode mode = Mode::Following;
    std::uint64_t packet = 0; ///< paused: the newest packet that counts
    double speed = 0;         ///< paused: how fast it is moved, as Playback says; 0: it stands still
    friend bool operator==(const Cursor&, const Cursor&) = default;
};

/// Bytes of a packet that were looked for, from `begin` to before `end`.
struct FoundBytes {
    std::uint64_t packet = 0;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    friend bool operator==(const FoundBytes&, const FoundBytes&) = default;
};

struct Selection {
    std::optional<log::SenderId> sender{};
    std::optional<CharacterKey> character{};
    int segment = -1;                      ///< position in the pose datagram, -1 for none
    std::optional<std::uint64_t> packet{}; ///< its number in the log; nothing: the newest one
    std::optional<FoundBytes> found{};     ///< by the newest search
    friend bool operator==(const Selection&, const Selection&) = default;
};

struct IncidentRequest {
    std::optional<std::uint64_t> number{}; ///< of the incident; nothing: none of them
    std::optional<CharacterKey> of{};      ///< whose are listed; nothing: the list stays as it is
    std::uint64_t count = 0;               ///< of requests so far
};

/// Kept by packet number, also if the log has dropped the packet.
struct Annotations {
    std::set<std::uint64_t> marks;
    std::map<std::uint64_t, std::string> comments; ///< UTF-8, never empty

    friend bool operator==(const Annotations&, const Annotations&) = default;
};

/// From one view to another: to packets from elsewhere, or to another moment.
struct Jump {
    std::string filterBefore;
    Selection selectionBefore;
    Cursor cursorBefore;
    std::string filter; ///< that it put instead; the same if it kept the one before
};

/// Part of the session, so that all panels agree without knowing each other.
struct Choices {
    Cursor cursor;
    Selection selection;
    RangeChoice range;         ///< what time statistics are of; stays while the selection changes
    std::string displayFilter; ///< which packets are listed, in the filter language; empty for all
    std::vector<Jump> jumps;   ///< that can be undone, the newest last
    std::vector<Jump> undone;  ///< that can be made again, the newest last
    Annotations annotations;
    IncidentRequest incidentRequest; ///< the newest
    std::set<CharacterKey> hidden;   ///< characters that are not drawn
    std::set<CharacterKey> lifted;   ///< characters that are put on the floor, where they were sent below it
    bool isGhostShown = false;       ///< the null pose of the shown character over its figure
    log::Stamp reset{};              ///< what was before does not count for the take; 0: all counts

    /// Jumps that can be undone; the oldest are forgotten.
    static constexpr std::size_t kMostJumps = 50;

    /// The one that put the filter in force there; null if the operator chose it.
    [[nodiscard]] const Jump* filterJump() const;
    /// What the operator filters by, also while a jump put another filter in its place.
    [[nodiscard]] const std::string& ownFilter() const;
    /// Shows packets from elsewhere, and stops at the one that is selected. From a filter that a jump put
    /// there one goes back to the operator's own.
    void jump(const Selection& to, std::string filter);
    /// Before another moment is shown: goBack() leads here again.
    void leave();
    /// To the filter, the selection and the moment before the newest jump. False, and nothing happens, if
    /// there was none.
    bool goBack() { return travel(jumps, undone); }
    /// Undoes goBack().
    bool goForward() { return travel(undone, jumps); }
    void askForIncident(std::optional<std::uint64_t> number, std::optional<CharacterKey> of);

private:
    bool travel(std::vector<Jump>& from, std::vector<Jump>& to);
};

} // namespace posewire::model
