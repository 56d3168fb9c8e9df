// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"

#include "app/gui/driver/process_figures.h"
#include "core/log/time.h"

#include <QClipboard>
#include <QGuiApplication>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kTickMs = 16;
constexpr int kSlowestTickMs = 200;
constexpr std::int64_t kTableTickNs = 100 * log::kMillisecondNs;
constexpr std::int64_t kRetryNs = 2 * log::kSecondNs;
/// A backlog (a file, or a window that was blocked) is followed in pieces, so that the window stays awake.
constexpr std::size_t kPacketsPerTick = 50'000;

} // namespace

SessionDriver::SessionDriver(const log::Clock& clock, QObject* parent)
    : QObject(parent), m_clock(clock), m_session(m_log), m_receiving(m_log, clock) {
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        const std::int64_t begin = m_clock.monotonicNs();
        tick();
        // A tick that takes long is followed by a rest as long: the window never takes more than half a
        // processor.
        const auto tookMs = static_cast<int>((m_clock.monotonicNs() - begin) / log::kMillisecondNs);
        m_timer.start(std::clamp(std::max(kTickMs - tookMs, tookMs), 1, kSlowestTickMs));
    });
}

SessionDriver::~SessionDriver() = default;

void SessionDriver::start() {
    m_timer.start(0);
}

void SessionDriver::tick() {
    const std::int64_t nowNs = m_clock.wallNs();
    const std::uint64_t endBefore = m_session.end();
    const std::int64_t beginNs = m_clock.monotonicNs();
    const bool hasNew = m_session.follow(nowNs, kPacketsPerTick);
    m_meter.addFollow(m_clock.monotonicNs() - beginNs, m_session.end() - endBefore);
    const bool isTableTick = std::abs(nowNs - m_tableTickNs) >= kTableTickNs;
    if (std::abs(nowNs - m_retryNs) >= kRetryNs) {
        m_retryNs = nowNs;
        m_receiving.retry();
    }
    // Without new packets ages still grow: figures fade at the tables' pace.
    if ((hasNew && !isPaused()) || m_isChanged ||
        (isTableTick && !m_session.characters().empty() && !isPaused())) {
        m_isChanged = false;
        emit moved();
    }
    if (isTableTick) {
        m_tableTickNs = nowNs;
        m_receiving.measure(nowNs);
        m_receiving.examine(m_session, nowNs);
        measureHealth();
        emit tableTick();
    }
}

void SessionDriver::measureHealth() {
    const std::int64_t nowNs = m_clock.monotonicNs();
    if (m_meter.isDue(nowNs)) {
        net::Receiver& receiver = m_receiving.receiver();
        m_meter.add({nowNs, receiver.cpuSeconds(), processCpuSeconds(), receiver.takeBufferFill(),
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
    const auto afterNs = static_cast<std::int64_t>(seconds * 1e9);
    setPaused(true);
    m_session.setCursor(
        {model::Cursor::Mode::Paused, m_session.packetAt(m_session.firstStampNs() + afterNs)});
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
    m_tableTickNs = 0;
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
