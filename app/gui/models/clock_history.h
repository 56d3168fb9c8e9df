// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "core/log/stream_index.h"
#include "core/log/time.h"
#include "core/model/accounting/nominal_rate.h"
#include "core/model/message.h"
#include "core/model/session/session_view.h"

#include <cstdint>
#include <optional>
#include <string>

namespace posewire::gui {

/// How the sender's clocks run: header time code against sample counter and receive stamps, and the wall
/// clock of type 25 beside it. Reads at the cursor, at most the last minute.
class ClockHistory {
public:
    /// Takes in what is new for a character; starts over where the character changes or the cursor went back.
    void follow(model::SessionView& view, const std::optional<model::CharacterKey>& key);

    /// Header time code of the newest sample; nothing before the first.
    [[nodiscard]] std::optional<std::uint32_t> headerMs() const;
    /// Text of the newest type 25, "10:42:17.511"; nothing if none came or it is no time code.
    [[nodiscard]] const std::optional<std::string>& type25() const { return m_type25; }
    /// Type 25 minus the header time code of the same datagram, in ms within half a day.
    [[nodiscard]] std::optional<double> offsetMs() const { return m_offsetMs; }

    /// Frames a second by the time code alone.
    [[nodiscard]] std::optional<double> frameHz() const { return m_rate.frameHz(); }

    /// Header clock against this computer's, as the stream's accounting has it, over the last minute; nothing
    /// while that does not know.
    [[nodiscard]] const std::optional<model::ClockSkew>& drift() const { return m_drift; }

    /// The newest place where the time code did not advance with its samples.
    struct Jump {
        double milliseconds = 0; ///< how far off
        log::Stamp stamp{};
        log::WallTime time{}; ///< of the stamp
    };
    [[nodiscard]] const std::optional<Jump>& lastJump() const { return m_jump; }

    /// 0 before there is one.
    [[nodiscard]] log::Stamp lastStamp() const { return m_lastStamp; }

private:
    struct Reading {
        log::Stamp stamp;
        std::uint32_t sample;
        std::uint32_t timeCode;
    };
    void add(const Reading& reading);
    [[nodiscard]] bool isStraggler(const Reading& reading);
    [[nodiscard]] std::optional<double> jumpBetween(const Reading& before, const Reading& reading) const;
    [[nodiscard]] bool isCorrupt(const Reading& reading);
    void readType25(const model::Message* message);

    std::optional<log::StreamKey> m_stream;
    log::Stamp m_lastStamp{};
    std::optional<Reading> m_newest; ///< that is no straggler and not corrupt
    std::vector<Reading> m_doubtful; ///< from far away, in a row: late or corrupt, or the counter restarted
    std::vector<Reading> m_jumped;   ///< in a row: corrupt, or the time code has jumped
    model::NominalRate m_rate;
    std::optional<Jump> m_jump;
    std::optional<model::ClockSkew> m_drift;
    std::optional<std::string> m_type25;
    std::optional<double> m_offsetMs;
};

enum class ClockChoice { Header, Type25 };

/// "00:10:39.175", or dashes where there is none.
[[nodiscard]] QString clockText(const ClockHistory& clock, ClockChoice choice);

/// Both clocks side by side, their offset, drift, frame rate, last jump.
[[nodiscard]] std::vector<Property> clockFacts(const ClockHistory& clock);

} // namespace posewire::gui
