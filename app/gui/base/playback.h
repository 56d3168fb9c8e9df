// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "core/log/clock.h"
#include "core/model/session/playback.h"

#include <optional>

namespace posewire::gui {

/// Moves the moment that is shown: follows, stops, steps or plays. Receiving goes on meanwhile.
class Playback {
public:
    /// Both must outlive it.
    Playback(Commands& commands, const log::Clock& clock) : m_commands(commands), m_clock(clock) {}

    /// Follows the stream again; lets go of a packet that is selected, and of a range.
    void goLive();
    /// Stops the display where it is; if it is stopped, plays from there.
    void playOrStop();
    [[nodiscard]] bool isPaused() const;
    /// Stops the display this many seconds after the first packet there was.
    void seek(double seconds);
    /// Stops the display there. Commands::goBack() leads back, but not into the middle of a drag.
    void showMoment(log::Stamp moment, bool isDrag = false);
    /// The first sample that is kept, of all streams that are there by then.
    void goToFirst();
    /// The last sample of a recording; the newest of what is received, which it follows.
    void goToLast();
    /// The range of figures, exports and replays begins or ends with the sample that is shown.
    void setRangeEdge(bool isEnd);
    /// Moves the edge of the range that was set last by samples of a character, and the display with it.
    void trimRange(const model::CharacterKey& of, int steps);
    /// Stops the display, and moves it by samples of a character, by packets or by time.
    void stepSamples(const model::CharacterKey& of, int steps);
    void stepPackets(int steps);
    void stepTime(log::Duration by);
    enum class Direction { Backwards = -1, Forwards = 1 };
    /// Plays from the moment that is shown on, up to what is live or to the end of the file; stops if it
    /// plays that way already.
    void play(Direction direction);
    [[nodiscard]] bool isPlaying(Direction direction) const;
    /// Sets how many times as fast as received it plays, above 0; also while it plays.
    void setSpeed(double speed);
    [[nodiscard]] double speed() const { return m_speed; }
    /// Plays the range that is selected, or all, again and again.
    void setLooping(bool isLooping);
    [[nodiscard]] bool isLooping() const { return m_isLooping; }

    /// One display tick: moves what plays on; true if it moved.
    bool follow();

private:
    void stopAt(std::uint64_t packet);
    void begin(double speed);
    void end();
    [[nodiscard]] std::optional<model::TimeRange> loopRange() const;

    Commands& m_commands;
    const log::Clock& m_clock;
    std::optional<model::Playback> m_playing; ///< means nothing while the cursor stands still
    bool m_isEndSet = true;                   ///< the edge of the range that was set last
    double m_speed = 1;
    bool m_isLooping = false;
};

} // namespace posewire::gui
