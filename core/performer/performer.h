// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/character.h"
#include "core/wire/codec.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace posewire::performer {

/// The revision of the specification that the sender follows.
///
/// E: no types 05, 13, 20–25; 10, 11 and 12 without a length; points as 100 · segment + point; header bytes
/// 17–23 zero. J, K: header bytes 17–23 zero; type 24 of 12 bytes. N: as real senders since 2019.
enum class Revision : std::uint8_t { E, J, K, N };

struct PerformerSettings {
    int characters = 2;              ///< 1 to kMaxCharacters
    std::uint64_t seed = 1;          ///< the same seed gives the same bytes
    double rateHz = 240.0;           ///< frames a second, 1 to 1000
    std::vector<std::uint8_t> types; ///< message types to send; empty means all of the revision
    Revision revision = Revision::N;
    std::string motion = "walk"; ///< one of motionNames()
    int props = 0;               ///< 0 to 4 for each character
    bool isYUp = false;          ///< types 02, 21 and 22
    /// Of revisions J and K type 25 without a length, and 12 with the tags of the text alone; MVN never sent
    /// these.
    bool asOnPaper = false;
    bool fingers = false;                        ///< both hands of each character; revision N only
    std::uint32_t firstSample = 1;               ///< sample counter of frame 0
    std::uint32_t startTimeOfDayMs = 36'000'000; ///< time code of frame 0: 10:00:00
};

inline constexpr int kMaxCharacters = 32;

/// One sentence; empty if a Performer can be made of the settings.
std::optional<std::string> findProblem(const PerformerSettings& settings);

/// All types that a sender of the revision has.
std::vector<std::uint8_t> typesOf(Revision revision);

/// A synthetic sender: characters in motion and every message about them, each consistent with all others
/// since all come from the same motion. Frame n is a pure function of the settings and n: frames can
/// be requested in any order, fastest in theirs. There is no clock inside. One thread at a time.
class Performer {
public:
    /// The settings must be without a problem. Takes a few milliseconds a character.
    explicit Performer(PerformerSettings settings);

    /// Every datagram of frame `index` (at time index / rateHz) in sending order: character by character,
    /// types ascending. Includes the character information (types 10 to 13) in the frames in which it is due:
    /// 12 once a second, the others every five seconds, both in frame 0.
    std::vector<wire::Datagram> frame(std::uint64_t index);
    /// The same, reusing the memory of `into`.
    void frameInto(std::uint64_t index, std::vector<wire::Datagram>& into);

    const PerformerSettings& settings() const { return m_settings; }
    const std::vector<Character>& characters() const { return m_characters; }

private:
    void addInformation(const Character& character, std::vector<wire::Datagram>& into, bool withScale) const;
    void addFrameTypes(Character& character, std::uint64_t index, std::vector<wire::Datagram>& into) const;
    bool sends(std::uint8_t type) const;
    void add(const Character& character, wire::Body body, std::vector<wire::Datagram>& into) const;

    PerformerSettings m_settings;
    std::vector<std::uint8_t> m_types;
    std::vector<Character> m_characters;
};

} // namespace posewire::performer
