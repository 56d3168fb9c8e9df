// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"
#include "core/model/session/choices.h"
#include "core/model/session/moment.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace posewire::model {

class Accounts;
class Messages;
class Roster;
class Verdicts;
struct MemoryFigures;

/// The session as panels, exports and the viewport read it at a moment: what was received by then, and what
/// the operator chose. The moment is the operator's cursor, or now. The readers, each in a header of its own,
/// are of the same moment. One thread.
class SessionView {
public:
    ~SessionView();
    SessionView(const SessionView&) = delete;
    SessionView& operator=(const SessionView&) = delete;

    /// The session as it is now: this view while the cursor follows, else another of the same session.
    [[nodiscard]] const SessionView& atNow() const { return m_moment.isPaused() ? *m_ownNow : *this; }

    [[nodiscard]] const Roster& roster() const { return *m_roster; }
    [[nodiscard]] const Accounts& accounts() const { return *m_accounts; }
    [[nodiscard]] const Messages& messages() const { return *m_messages; }
    [[nodiscard]] const Verdicts& verdicts() const { return *m_verdicts; }
    [[nodiscard]] const Choices& choices() const { return m_moment.choices(); }

    /// What "now" means at the moment: its newest packet's stamp if it is in the past, else now().
    [[nodiscard]] log::Stamp cursorStamp() const { return m_moment.stamp(); }
    /// The range that was chosen, as it is at the moment; nothing for all there is.
    [[nodiscard]] std::optional<TimeRange> range() const;

    // All that was received, whatever the moment.
    [[nodiscard]] std::uint64_t end() const; ///< one past the newest packet
    [[nodiscard]] std::uint64_t begin() const;
    [[nodiscard]] log::Stamp now() const;
    [[nodiscard]] log::Stamp knownUntil() const; ///< what came, and what not
    /// Age of the newest packet that was looked at while others wait; 0 if none do, and of a file.
    [[nodiscard]] log::Duration behind() const;
    /// Of the first packet that was followed, even if the log has dropped it; 0 before there is one.
    [[nodiscard]] log::Stamp firstStamp() const;
    /// Of the oldest packet that can be looked at: firstStamp() as long as all are kept.
    [[nodiscard]] log::Stamp keptSince() const;
    /// What the receiving computer's clock showed: for times of day. All else is by stamps.
    [[nodiscard]] log::WallTime wallOf(log::Stamp stamp) const { return log().timeline().wallOf(stamp); }
    [[nodiscard]] bool isRecording() const;
    /// More of the recording is to come: that nothing is wrong yet says little.
    [[nodiscard]] bool isBeingRead() const;
    /// For readers on other threads.
    [[nodiscard]] const log::PacketLog& log() const;
    /// Nothing if the log has dropped it. The bytes are valid until the session follows the log again.
    [[nodiscard]] std::optional<log::Packet> packet(std::uint64_t number) const {
        return m_moment.packet(number);
    }
    /// The first packet from a stamp on; end() if there is none. Stamps are taken to grow.
    [[nodiscard]] std::uint64_t packetFrom(log::Stamp stamp) const;
    /// The newest packet that had been received by then; the oldest there is if all came later.
    [[nodiscard]] std::uint64_t packetAt(log::Stamp stamp) const;
    /// What is kept of all that came, decoded messages included, and its limits: one place decides.
    [[nodiscard]] MemoryFigures memory() const;

protected:
    /// Both outlive this.
    SessionView(Ingest& ingest, const Choices& choices);

private:
    /// `paused`: the view at the cursor that this one is beside; null for that one itself.
    SessionView(const Moment& moment, const SessionView* paused);

    Moment m_moment;
    std::unique_ptr<const Roster> m_roster;
    std::unique_ptr<const Accounts> m_accounts;
    std::unique_ptr<const Messages> m_messages;
    std::unique_ptr<const Verdicts> m_verdicts;
    std::unique_ptr<const SessionView> m_ownNow; ///< of the view at the cursor
};

} // namespace posewire::model
