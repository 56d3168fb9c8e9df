// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/playback.h"

#include "core/model/body/character_pose.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
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

/// Streams that send at all have sent by then.
constexpr log::Duration kBeginning = std::chrono::milliseconds(200);

/// The packet by which all streams that send at the beginning of what is kept have sent a sample.
std::uint64_t firstWholePacket(const model::SessionView& session) {
    const log::Stamp until = session.keptSince() + kBeginning;
    std::uint64_t packet = session.begin();
    for (const model::Stream& stream : session.roster().streams()) {
        const auto number = session.messages().firstSample(stream.key);
        const auto first = number ? session.packet(*number) : std::nullopt;
        if (first && wire::isSampled(stream.key.type) && first->stamp <= until) {
            packet = std::max(packet, *number);
        }
    }
    return packet;
}

/// Of the oldest pose of the sample that is shown.
log::Stamp shownSampleStamp(const model::SessionView& session) {
    constexpr double kMost = 0.05;
    log::Stamp stamp = session.cursorStamp();
    for (const model::Character* character : session.roster().listed()) {
        const model::CharacterPose* pose = session.messages().pose(character->key);
        if (pose == nullptr) {
            continue;
        }
        const model::Stream* stream = session.roster().find(
            log::StreamKey{character->key.sender, character->key.character, pose->type});
        const double rateHz = stream == nullptr ? 0 : stream->statistics.rateHz();
        const double halfASample = std::min(kMost, 0.5 / rateHz); // seconds
        if (log::secondsOf(session.cursorStamp() - pose->stamp) < halfASample) {
            stamp = std::min(stamp, pose->stamp);
        }
    }
    return stamp;
}

std::uint64_t shownPacket(const model::SessionView& session) {
    return session.choices().cursor.mode == model::Cursor::Mode::Paused ? session.choices().cursor.packet
                                                                        : newestOf(session);
}

/// The one whose samples are stepped: of its pose, or of anything that has samples.
std::optional<log::StreamKey> steppedStream(const model::SessionView& session,
                                            const model::CharacterKey& key) {
    if (const model::CharacterPose* pose = session.messages().pose(key)) {
        return log::StreamKey{key.sender, key.character, pose->type};
    }
    const model::Character* character = session.roster().find(key);
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

void Playback::stopAt(std::uint64_t packet) {
    m_commands.unselectPacket(); // the newest one of the moment is inspected then
    m_commands.setCursor(stoppedAt(packet));
}

void Playback::goLive() {
    m_commands.showLive();
    if (isPaused()) {
        m_commands.leave();
    }
    m_commands.unselectPacket();
    m_commands.setCursor({});
    if (m_commands.session().choices().range.fixed) {
        m_commands.selectRange({});
    }
}

bool Playback::isPaused() const {
    return m_commands.session().choices().cursor.mode == model::Cursor::Mode::Paused;
}

void Playback::playOrStop() {
    if (!isPaused()) {
        m_commands.setCursor(stoppedAt(newestOf(m_commands.session())));
    } else {
        play(isPlaying(Direction::Backwards) ? Direction::Backwards : Direction::Forwards);
    }
}

void Playback::seek(double seconds) {
    showMoment(m_commands.session().firstStamp() + log::durationOf(seconds));
}

void Playback::showMoment(log::Stamp moment, bool isDrag) {
    if (!isDrag) {
        m_commands.leave();
    }
    const model::SessionView& session = m_commands.session();
    const bool isKept = moment > session.keptSince() + kBeginning;
    stopAt(isKept ? session.packetAt(moment) : std::max(session.packetAt(moment), firstWholePacket(session)));
}

void Playback::goToFirst() {
    m_commands.leave();
    stopAt(firstWholePacket(m_commands.session()));
}

void Playback::goToLast() {
    if (!m_commands.isFileShown()) {
        goLive();
    } else if (m_commands.session().end() != 0) {
        m_commands.leave();
        stopAt(newestOf(m_commands.session()));
    }
}

void Playback::setRangeEdge(bool isEnd) {
    const model::SessionView& session = m_commands.session();
    if (session.end() == 0) {
        return;
    }
    model::TimeRange range = session.choices().range.fixed.value_or(
        model::TimeRange{session.keptSince(), newestMoment(session) + log::Duration(1)});
    const log::Stamp after = session.cursorStamp() + log::Duration(1);
    if (isEnd) {
        range = {range.from < after ? range.from : session.keptSince(), after};
    } else {
        const log::Stamp from = shownSampleStamp(session);
        range = {from, range.to > from ? range.to : newestMoment(session) + log::Duration(1)};
    }
    m_commands.selectRange({.fixed = range});
    m_isEndSet = isEnd;
}

void Playback::trimRange(const model::CharacterKey& of, int steps) {
    const model::SessionView& session = m_commands.session();
    if (const auto range = session.choices().range.fixed) {
        stopAt(session.packetAt(m_isEndSet ? range->to - log::Duration(1) : range->from));
        // A range may begin with another character, a moment before the sample of this one comes.
        const model::CharacterPose* pose = session.messages().pose(of);
        const bool isYetToCome = !m_isEndSet && pose != nullptr && pose->stamp < range->from;
        stepSamples(of, steps + (isYetToCome ? 1 : 0));
        const log::Stamp edge = session.cursorStamp();
        if (m_isEndSet ? edge >= range->from : edge < range->to) {
            setRangeEdge(m_isEndSet);
        }
    }
}

void Playback::stepSamples(const model::CharacterKey& of, int steps) {
    const auto stream = steppedStream(m_commands.session(), of);
    if (const auto packet =
            stream ? m_commands.session().messages().packetOfSample(*stream, steps) : std::nullopt) {
        stopAt(*packet);
    }
}

void Playback::stepPackets(int steps) {
    const model::SessionView& session = m_commands.session();
    const auto last = static_cast<std::int64_t>(newestOf(session));
    const auto first = std::min(static_cast<std::int64_t>(session.begin()), last);
    const auto from = static_cast<std::int64_t>(shownPacket(session));
    const auto packet = static_cast<std::uint64_t>(std::clamp(from + steps, first, last));
    stopAt(packet);
    m_commands.selectPacket(packet);
}

void Playback::stepTime(log::Duration by) {
    const std::uint64_t before = shownPacket(m_commands.session());
    showMoment(m_commands.session().cursorStamp() + by, true);
    if (by > log::Duration::zero() && shownPacket(m_commands.session()) == before) { // a longer silence
        stopAt(std::min(before + 1, newestOf(m_commands.session())));
    }
}

bool Playback::isPlaying(Direction direction) const {
    return m_commands.session().choices().cursor.speed * static_cast<int>(direction) > 0;
}

void Playback::play(Direction direction) {
    if (isPlaying(direction)) {
        end();
    } else if (m_commands.session().end() != 0) {
        begin(m_speed * static_cast<int>(direction));
    }
}

void Playback::begin(double speed) {
    const model::SessionView& session = m_commands.session();
    const auto loop = m_isLooping ? loopRange() : std::nullopt;
    log::Stamp from = session.cursorStamp();
    const bool isAtEnd =
        m_commands.isFileShown() && !loop && speed > 0 && shownPacket(session) == newestOf(session);
    if (isAtEnd) { // it was played to its end: once more
        from = session.firstStamp();
    }
    m_commands.unselectPacket();
    m_playing.emplace(from, m_clock.monotonic(), speed, loop);
    model::Cursor cursor = stoppedAt(shownPacket(session));
    cursor.speed = m_playing->speed();
    m_commands.setCursor(cursor);
}

void Playback::end() {
    model::Cursor cursor = m_commands.session().choices().cursor;
    cursor.speed = 0;
    m_commands.setCursor(cursor);
}

/// The range that figures are of, if it is fixed; else all there is.
std::optional<model::TimeRange> Playback::loopRange() const {
    const model::SessionView& session = m_commands.session();
    if (session.choices().range.fixed) {
        return session.choices().range.fixed;
    }
    return model::TimeRange{session.firstStamp(), newestMoment(session) + log::Duration(1)};
}

void Playback::setSpeed(double speed) {
    m_speed = std::clamp(speed, model::Playback::kSlowest, model::Playback::kFastest);
    if (const double before = m_commands.session().choices().cursor.speed; before != 0) {
        begin(std::copysign(m_speed, before));
    }
}

void Playback::setLooping(bool isLooping) {
    m_isLooping = isLooping;
    if (const double before = m_commands.session().choices().cursor.speed; before != 0) {
        begin(before);
    }
}

bool Playback::follow() {
    const model::SessionView& session = m_commands.session();
    if (session.choices().cursor.speed == 0) {
        return false;
    }
    const log::Stamp moment = m_playing->at(m_clock.monotonic());
    const bool hasCaughtUp = m_playing->speed() > 0 && moment >= newestMoment(session) && !m_isLooping;
    if (hasCaughtUp && !m_commands.isFileShown()) {
        m_commands.setCursor({});
        return true;
    }
    model::Cursor cursor = stoppedAt(session.packetAt(moment));
    cursor.speed = m_playing->speed();
    const bool hasMoved = cursor != session.choices().cursor;
    m_commands.playTo(cursor);
    const bool isOver = hasCaughtUp || (m_playing->speed() < 0 && cursor.packet <= session.begin());
    if (isOver && !m_isLooping) {
        end();
    }
    return hasMoved;
}

} // namespace posewire::gui
