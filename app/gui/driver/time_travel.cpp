// SPDX-License-Identifier: GPL-3.0-or-later
// Which moment is shown: followed, stopped, stepped or played.
#include "app/gui/driver/session_driver.h"

#include "core/model/body/character_pose.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

model::Cursor stoppedAt(std::uint64_t packet) {
    return {model::Cursor::Mode::Paused, packet};
}

std::uint64_t newestOf(const model::SessionView& session) {
    return session.end() == 0 ? 0 : session.end() - 1;
}

log::Stamp newestMoment(const model::SessionView& session) {
    const auto newest = session.packet(newestOf(session));
    return newest ? newest->stamp : session.now();
}

std::uint64_t shownPacket(const model::SessionView& session) {
    return session.cursor().mode == model::Cursor::Mode::Paused ? session.cursor().packet : newestOf(session);
}

/// The one whose samples are stepped: of its pose, or of anything that has samples.
std::optional<log::StreamKey> steppedStream(const model::SessionView& session,
                                            const model::CharacterKey& key) {
    if (const model::CharacterPose* pose = session.pose(key)) {
        return log::StreamKey{key.sender, key.character, pose->type};
    }
    const model::Character* character = session.find(key);
    if (character != nullptr) {
        const auto sampled = std::ranges::find_if(
            character->streams, [](const model::Stream* one) { return wire::isSampled(one->key.type); });
        if (sampled != character->streams.end()) {
            return (*sampled)->key;
        }
    }
    return std::nullopt;
}

} // namespace

void SessionDriver::setCursor(const model::Cursor& cursor) {
    const bool wasPaused = isPaused();
    change(&model::Session::setCursor, cursor);
    if (isPaused() != wasPaused) {
        emit pausedChanged(!wasPaused);
    }
}

/// The inspector shows the newest packet of that moment.
void SessionDriver::stopAt(std::uint64_t packet) {
    endPlaying();
    letGoOfPacket();
    setCursor(stoppedAt(packet));
}

void SessionDriver::letGoOfPacket() {
    model::Selection selection = shown().selection();
    if (selection.packet) {
        selection.packet.reset();
        select(selection);
    }
}

void SessionDriver::goLive() {
    showLive();
    letGoOfPacket();
    playLive();
}

void SessionDriver::playLive() {
    endPlaying();
    setCursor({});
}

void SessionDriver::setPaused(bool isPaused) {
    if (m_isFileShown) {
        play(isPlaying(Direction::Backwards) ? Direction::Backwards : Direction::Forwards);
    } else if (!isPaused) {
        playLive();
    } else if (!this->isPaused()) {
        setCursor(stoppedAt(newestOf(shown())));
    }
}

void SessionDriver::seek(double seconds) {
    showMoment(shown().firstStamp() + log::durationOf(seconds));
}

void SessionDriver::showMoment(log::Stamp moment) {
    stopAt(shown().packetAt(moment));
    m_comparing.showMoment(shown());
}

void SessionDriver::stepSamples(const model::CharacterKey& of, int steps) {
    const auto stream = steppedStream(shown(), of);
    if (const auto packet = stream ? shown().packetOfSample(*stream, steps) : std::nullopt) {
        stopAt(*packet);
    }
}

void SessionDriver::stepPackets(int steps) {
    const auto last = static_cast<std::int64_t>(newestOf(shown()));
    const auto first = std::min(static_cast<std::int64_t>(shown().begin()), last);
    const auto from = static_cast<std::int64_t>(shownPacket(shown()));
    const auto packet = static_cast<std::uint64_t>(std::clamp(from + steps, first, last));
    stopAt(packet);
    selectPacket(packet);
}

void SessionDriver::stepTime(log::Duration by) {
    showMoment(shown().cursorStamp() + by);
}

void SessionDriver::selectPacket(std::uint64_t number) {
    const auto selection = selectionOf(number);
    if (!selection) {
        return;
    }
    if (isPaused()) {
        endPlaying();
        setCursor(stoppedAt(number));
    }
    select(*selection);
}

void SessionDriver::jump(std::uint64_t packet, const QString& filter) {
    endPlaying();
    const bool wasPaused = isPaused();
    change(&model::Session::jump, selectionOf(packet).value_or(shown().selection()), filter.toStdString());
    if (isPaused() != wasPaused) {
        emit pausedChanged(!wasPaused);
    }
}

void SessionDriver::goBack() {
    endPlaying();
    const bool wasPaused = isPaused();
    change(&model::Session::goBack);
    if (isPaused() != wasPaused) {
        emit pausedChanged(!wasPaused);
    }
    emit wentBack();
}

void SessionDriver::play(Direction direction) {
    if (isPlaying(direction)) {
        endPlaying();
    } else if (shown().end() != 0) {
        beginPlaying(m_playSpeed * static_cast<int>(direction));
    }
}

void SessionDriver::beginPlaying(double speed) {
    const auto loop = m_isLooping ? loopRange() : std::nullopt;
    log::Stamp from = shown().cursorStamp();
    const bool isAtEnd = m_isFileShown && !loop && speed > 0 && shownPacket(shown()) == newestOf(shown());
    if (isAtEnd) { // it was played to its end: once more
        from = shown().firstStamp();
    }
    letGoOfPacket();
    m_playback.emplace(from, m_clock.monotonic(), speed, loop);
    model::Cursor cursor = stoppedAt(shownPacket(shown()));
    cursor.speed = m_playback->speed();
    setCursor(cursor);
}

void SessionDriver::endPlaying() {
    if (m_playback) {
        m_playback.reset();
        model::Cursor cursor = shown().cursor();
        cursor.speed = 0;
        setCursor(cursor);
    }
}

/// The range that figures are of, where it stands still; else all there is.
std::optional<model::TimeRange> SessionDriver::loopRange() const {
    if (shown().rangeChoice().fixed) {
        return shown().rangeChoice().fixed;
    }
    return model::TimeRange{shown().firstStamp(), newestMoment(shown()) + log::Duration(1)};
}

void SessionDriver::setPlaySpeed(double speed) {
    m_playSpeed = std::clamp(speed, model::Playback::kSlowest, model::Playback::kFastest);
    if (m_playback) {
        beginPlaying(std::copysign(m_playSpeed, m_playback->speed()));
    }
}

void SessionDriver::setLooping(bool isLooping) {
    m_isLooping = isLooping;
    if (m_playback) {
        beginPlaying(m_playback->speed());
    }
}

void SessionDriver::playOn() {
    if (!m_playback) {
        return;
    }
    const log::Stamp moment = m_playback->at(m_clock.monotonic());
    const bool hasCaughtUp = m_playback->speed() > 0 && moment >= newestMoment(shown()) && !m_isLooping;
    if (hasCaughtUp && !m_isFileShown) {
        playLive();
        return;
    }
    model::Cursor cursor = stoppedAt(shown().packetAt(moment));
    cursor.speed = m_playback->speed();
    if (cursor != shown().cursor()) { // tables keep their pace
        shown().setCursor(cursor);
        m_isChanged = true;
    }
    const bool isOver = hasCaughtUp || (m_playback->speed() < 0 && cursor.packet <= shown().begin());
    if (isOver && !m_isLooping) {
        endPlaying();
    }
}

} // namespace posewire::gui
