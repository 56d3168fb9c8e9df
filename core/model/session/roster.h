// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/moment.h"
#include "core/model/session/roll.h"

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace posewire::model {

/// Who is who at a moment: a character is the same one through restarts of its sender.
class Roster {
public:
    explicit Roster(const Moment& moment);

    // All that was received, whatever the moment.
    [[nodiscard]] const KeyedList<log::SenderId, Sender>& senders() const { return m_roll.senders(); }
    [[nodiscard]] const KeyedList<CharacterKey, Character>& characters() const { return m_roll.characters(); }
    [[nodiscard]] const KeyedList<log::StreamKey, Stream>& streams() const { return m_roll.streams(); }
    [[nodiscard]] const Sender* find(log::SenderId id) const { return senders().find(id); }
    [[nodiscard]] const Character* find(const CharacterKey& key) const { return characters().find(key); }
    [[nodiscard]] const Stream* find(const log::StreamKey& key) const { return streams().find(key); }
    /// The axis that is up in types 02, 21 and 22 of a sender.
    [[nodiscard]] UpAxis up(log::SenderId id) const;
    /// "10.0.0.5:40001"; "this computer" for kNoSender; "a retired sender" for one retired long ago.
    [[nodiscard]] ForeignText addressOf(log::SenderId id) const;

    /// A sender that is restarted has another port, and some senders use a port for each kind of message. So
    /// a character of the same host with the same ID that fell silent before this one came is the same one:
    /// what this one has not sent yet is taken from there. Null if there is none, or if both turned out to
    /// send at the same time.
    [[nodiscard]] const Character* predecessor(const CharacterKey& key) const;
    /// Whether another sender has taken over by the moment; its character is shown instead of this one.
    [[nodiscard]] bool isSuperseded(const CharacterKey& key) const;
    /// The one that is shown for a character: itself, or the newest that has taken over.
    [[nodiscard]] CharacterKey current(const CharacterKey& key) const;
    /// A character with all that it took over from, oldest first, itself last; empty if there is none.
    [[nodiscard]] std::vector<const Character*> lineage(const CharacterKey& key) const;
    /// Whether two are one character, before and after restarts of its sender.
    [[nodiscard]] bool isSame(const CharacterKey& a, const CharacterKey& b) const;
    /// All characters that are to be shown, in order of first appearance: one that was restarted stays where
    /// it was.
    [[nodiscard]] std::vector<const Character*> listed() const;
    /// One of these; null for others.
    [[nodiscard]] const Character* findListed(const CharacterKey& key) const;

    /// "Factory", or "Character 1" with its ID if no name was sent, or there is no such character.
    [[nodiscard]] ForeignText displayName(const CharacterKey& key) const;
    [[nodiscard]] Colour colour(const CharacterKey& key) const;

    /// Others that are listed now, and have the same name at the moment.
    struct Namesakes {
        std::size_t all = 0;
        std::size_t ofSameId = 0;        ///< among them
        std::size_t ofSameIdAndHost = 0; ///< among these
    };
    /// All names are looked up once until something else is received.
    [[nodiscard]] Namesakes namesakes(const CharacterKey& key) const;

    // Choices of the operator, which hold through restarts of the sender.
    [[nodiscard]] bool isHidden(const CharacterKey& key) const;
    [[nodiscard]] bool isLifted(const CharacterKey& key) const;
    [[nodiscard]] bool isSelected(const CharacterKey& key) const;

private:
    /// Null if none has taken over by the moment.
    [[nodiscard]] const Character* successor(const Character& character) const;
    [[nodiscard]] bool isChosen(const std::set<CharacterKey>& chosen, const CharacterKey& key) const;
    [[nodiscard]] const ForeignText& metadataValue(const CharacterKey& key, std::string_view tag) const;
    /// A name, the name with the ID, and with the host of the sender too.
    [[nodiscard]] std::array<std::string, 3> namesOf(const CharacterKey& key) const;

    Moment m_moment;
    const Roll& m_roll;
    mutable std::unordered_map<std::string, std::size_t> m_names; ///< how many listed characters have each
    mutable std::pair<std::uint64_t, std::uint64_t> m_namesAt;    ///< end of the moment, and of now
};

} // namespace posewire::model
