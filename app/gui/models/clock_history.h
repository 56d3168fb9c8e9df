// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/nominal_rate.h"
#include "core/log/time.h"
#include "core/model/session/session_view.h"

#include <deque>
#include <optional>
#include <string>

namespace posewire::gui {

/// How the sender's clocks run: header time code against sample counter and receive stamps, and the wall
/// clock of type 25 beside it. Reads at the cursor, at most the last minute.
class ClockHistory {
public:
    /// Takes in what is new for a character; begins anew where the character changes or the cursor went back.
    void follow(model::SessionView& view, const std::optional<model::CharacterKey>& key);

    /// Header time code of the newest sample; nothing before the first.
    [[nodiscard]] std::optional<std::uint32_t> headerMs() const;
    /// Text of the newest type 25, "10:42:17.511"; nothing where none came or it is no time code.
    [[nodiscard]] const std::optional<std::string>& type25() const { return m_type25; }
    /// Type 25 minus the header time code of the same datagram, in ms within half a day.
    [[nodiscard]] std::optional<double> offsetMs() const { return m_offsetMs; }

    /// Frames a second by the time code alone.
    [[nodiscard]] std::optional<double> frameHz() const { return m_rate.frameHz(); }

    /// Header clock against this computer's, in parts per million: slope over the last minute by least
    /// squares, with its standard error; above 0 the sender's runs faster. Nothing before
    /// `kLeastDriftSeconds`.
    struct Drift {
        double ppm = 0;
        double error = 0;
    };
    static constexpr double kLeastDriftSeconds = 10;
    [[nodiscard]] const std::optional<Drift>& drift() const { return m_drift; }
    [[nodiscard]] double observedSeconds() const;

    /// The newest place where the time code did not go on as its samples did.
    struct Jump {
        double milliseconds = 0; ///< how far off
        log::Stamp stamp{};
    };
    [[nodiscard]] const std::optional<Jump>& lastJump() const { return m_jump; }

    /// Stamp of the newest sample; 0 before the first.
    [[nodiscard]] log::Stamp lastStamp() const {
        return m_readings.empty() ? log::Stamp() : m_readings.back().stamp;
    }

private:
    struct Reading {
        log::Stamp stamp;
        std::uint32_t sample;
        std::uint32_t timeCode;
    };
    void add(const Reading& reading);
    void findJump(const Reading& reading);
    void readType25(model::SessionView& view);
    [[nodiscard]] std::optional<Drift> fitDrift() const;

    std::optional<model::CharacterKey> m_key;
    std::uint8_t m_type = 0;
    std::deque<Reading> m_readings;
    NominalRate m_rate;
    std::optional<Jump> m_jump;
    std::optional<Drift> m_drift;
    std::optional<std::string> m_type25;
    std::optional<double> m_offsetMs;
};

} // namespace posewire::gui
