// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"

#include "app/gui/driver/process_figures.h"
#include "core/log/time.h"

#include <QClipboard>
#include <QGuiApplication>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr std::chrono::milliseconds kTick(16);
constexpr std::chrono::milliseconds kSlowestTick(200);
constexpr log::Duration kTableTick = std::chrono::milliseconds(100);
constexpr log::Duration kRetry = std::chrono::seconds(2);
/// A backlog (a file, or a window that was blocked) is followed in pieces, so that the window stays awake.
constexpr std::size_t kPacketsPerTick = 50'000;

} // namespace

SessionDriver::SessionDriver(const log::Clock& clock, QObject* parent)
    : QObject(parent), m_clock(clock), m_session(m_log), m_receiving(m_log, clock) {
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        const log::Moment begin = m_clock.monotonic();
        tick();
        // A tick that takes long is followed by a rest as long: the window never takes more than half a
        // processor.
        const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(m_clock.monotonic() - begin);
        m_timer.start(std::clamp(std::max(kTick - took, took), std::chrono::milliseconds(1), kSlowestTick));
    });
}

SessionDriver::~SessionDriver() = default;

void SessionDriver::start() {
    m_timer.start(0);
}

void SessionDriver::tick() {
    const log::Stamp now = m_clock.wall();
    const std::uint64_t endBefore = m_session.end();
    const log::Moment begin = m_clock.monotonic();
    const bool hasNew = m_session.follow(now, kPacketsPerTick);
    m_meter.addFollow(m_clock.monotonic() - begin, m_session.end() - endBefore);
    const bool isTableTick = std::chrono::abs(now - m_tableTick) >= kTableTick;
    if (std::chrono::abs(now - m_retry) >= kRetry) {
        m_retry = now;
        m_receiving.retry();
    }
    // Without new packets ages still grow: figures fade at the tables' pace.
    if ((hasNew && !isPaused()) || m_isChanged ||
        (isTableTick && !m_session.characters().empty() && !isPaused())) {
        m_isChanged = false;
        emit moved();
    }
    if (isTableTick) {
        m_tableTick = now;
        m_receiving.measure(now);
        m_receiving.examine(m_session, now);
        measureHealth();
        emit tableTick();
    }
}

void SessionDriver::measureHealth() {
    const log::Moment now = m_clock.monotonic();
    if (m_meter.isDue(now)) {
        net::Receiver& receiver = m_receiving.receiver();
        m_meter.add({now, receiver.cpuSeconds(), processCpuSeconds(), receiver.takeBufferFill(),
                     processMemoryBytes(), m_pictures});
    }
}

QString SessionDriver::openFile(const QString& path) {
    const QString problem = m_receiving.openFile(path);
    if (problem.isEmpty()) {
        m_session.followFile();
        setPaused(false);
        setPaused(true);
    }
    return problem;
}

void SessionDriver::seek(double seconds) {
    const auto after = log::durationOf(seconds);
    setPaused(true);
    m_session.setCursor({model::Cursor::Mode::Paused, m_session.packetAt(m_session.firstStamp() + after)});
    announceChange();
}

void SessionDriver::setDemo(int characters) {
    m_demo.reset();
    if (characters > 0) {
        if (m_receiving.openPort() == 0) {
            m_receiving.addPort({QStringLiteral("127.0.0.1"), 0});
        }
        m_demo = std::make_unique<DemoSender>(characters, m_receiving.openPort());
    }
    emit demoChanged(isDemoRunning());
}

void SessionDriver::select(const model::Selection& selection) {
    m_session.setSelection(selection);
    announceChange();
}

void SessionDriver::selectRange(const model::RangeChoice& range) {
    m_session.setRange(range);
    announceChange();
}

void SessionDriver::selectPacket(std::uint64_t number) {
    const auto packet = m_session.packet(number);
    const model::PacketDigest* digest = m_session.digests().find(number);
    if (!packet || digest == nullptr) {
        return;
    }
    const bool hasCharacter = digest->type != 0;
    model::Selection selection{packet->sender, std::nullopt, -1, number};
    if (hasCharacter) {
        selection.character = model::CharacterKey{packet->sender, digest->character};
    }
    const model::Selection& before = m_session.selection();
    selection.segment = before.character == selection.character ? before.segment : -1;
    select(selection);
}

void SessionDriver::setMarked(std::uint64_t packet, bool isMarked) {
    m_session.setMarked(packet, isMarked);
    announceChange();
}

void SessionDriver::setComment(std::uint64_t packet, const QString& comment) {
    m_session.setComment(packet, comment.toStdString());
    announceChange();
}

void SessionDriver::setOverride(log::SenderId sender, const model::SenderOverride& overrides) {
    m_session.setOverride(sender, overrides);
    announceChange();
}

void SessionDriver::setDisplayFilter(const QString& filter) {
    m_session.setDisplayFilter(filter.toStdString());
    announceChange();
}

void SessionDriver::setThresholds(const model::Thresholds& thresholds) {
    m_session.setThresholds(thresholds);
    announceChange();
}

void SessionDriver::announceChange() {
    m_isChanged = true;
    m_tableTick = {};
}

void SessionDriver::frameCharacter(const model::CharacterKey& key) {
    emit frameRequested(key);
}

void SessionDriver::setCharacterVisible(const model::CharacterKey& key, bool isVisible) {
    m_session.setHidden(key, !isVisible);
    announceChange();
}

void SessionDriver::setGhostVisible(bool isVisible) {
    m_session.setGhostShown(isVisible);
    announceChange();
    emit ghostChanged(isVisible);
}

void SessionDriver::setPaused(bool isPaused) {
    if (isPaused == this->isPaused()) {
        return;
    }
    model::Cursor cursor;
    if (isPaused) {
        const std::uint64_t end = m_session.end();
        cursor = {model::Cursor::Mode::Paused, end == 0 ? 0 : end - 1};
    }
    m_session.setCursor(cursor);
    announceChange();
    emit pausedChanged(isPaused);
}

void SessionDriver::copyText(const QString& text) {
    QGuiApplication::clipboard()->setText(text);
}

void SessionDriver::showDock(const QString& dock) {
    emit dockRequested(dock);
}

} // namespace posewire::gui
