// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/choices.h"
#include "core/model/session/detection.h"

#include <QString>

namespace posewire::gui {

struct ComparisonChoice;

/// What a panel may ask for. Each command is carried out before the next display tick; panels never change
/// the session themselves.
class Commands {
public:
    virtual ~Commands() = default;

    virtual void select(const model::Selection& selection) = 0;
    /// What time statistics are of.
    virtual void selectRange(const model::RangeChoice& range) = 0;
    /// Selects a packet with its sender and character; a display that is stopped moves there. Nothing happens
    /// where there is no such packet.
    virtual void selectPacket(std::uint64_t number) = 0;
    /// Follows what is received, and lets go of a packet that is selected.
    virtual void goLive() = 0;
    /// Stops the display at a moment.
    virtual void showMoment(log::Stamp moment) = 0;
    virtual void setMarked(std::uint64_t packet, bool isMarked) = 0;
    virtual void setComment(std::uint64_t packet, const QString& comment) = 0;
    /// What is declared about a sender counts instead of what was detected.
    virtual void setOverride(log::SenderId sender, const model::SenderOverride& overrides) = 0;
    /// What the list of packets shows; empty for all.
    virtual void setDisplayFilter(const QString& filter) = 0;
    /// Stops at a packet with another filter, or the same, so that goBack() brings all back as it was.
    /// Nothing is selected where there is no such packet.
    virtual void jump(std::uint64_t packet, const QString& filter) = 0;
    virtual void goBack() = 0;
    /// Points the camera at a character.
    virtual void frameCharacter(const model::CharacterKey& key) = 0;
    virtual void setCharacterVisible(const model::CharacterKey& key, bool isVisible) = 0;
    /// Puts a character on the floor that is sent below it.
    virtual void setLifted(const model::CharacterKey& key, bool isLifted) = 0;
    /// Takes a sender out of all lists from which nothing more is expected. Nothing happens where it sends.
    virtual void forgetSender(log::SenderId sender) = 0;
    /// Shows the null pose of the shown character as a ghost over its figure.
    virtual void setGhostVisible(bool isVisible) = 0;
    /// Brings the list of incidents to the front: with one selected where there is a number, with those of a
    /// character alone where there is one.
    virtual void showIncident(std::optional<std::uint64_t> number,
                              std::optional<model::CharacterKey> of = {}) = 0;
    /// Asks which recording what is shown is to be compared with, and compares it.
    virtual void askForComparison() = 0;
    virtual void endComparison() = 0;
    virtual void setComparison(const ComparisonChoice& choice) = 0;
    /// Gives up what is worked out of the range, or begins with it again.
    virtual void setComparing(bool isOn) = 0;
    /// Writes the differences to a file; its place was chosen in askWhereToSave().
    virtual void saveComparison(const QString& path) = 0;
    virtual void copyText(const QString& text) = 0;
    /// Brings a dock before the others, by its object name.
    virtual void showDock(const QString& dock) = 0;
};

} // namespace posewire::gui
