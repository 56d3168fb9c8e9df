// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"

#include "app/net/datagram_sender.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <QClipboard>
#include <QFileInfo>
#include <QGuiApplication>

#include <algorithm>
#include <cmath>
#include <vector>

namespace posewire::gui {

namespace {

constexpr std::chrono::milliseconds kTick(16);
constexpr std::chrono::milliseconds kSlowestTick(200);
constexpr log::Duration kTableTick = std::chrono::milliseconds(100);
constexpr log::Duration kRetry = std::chrono::seconds(2);
/// A backlog (a file, or a window that was blocked) is followed in pieces, so that the window stays awake: as
/// many as fit into this time of each tick.
constexpr std::size_t kPacketsAtOnce = 1'000;
constexpr log::Duration kFollowTime = std::chrono::milliseconds(12);
/// A demo that fell behind (a sleeping computer) continues from now instead of flooding the receiver with the
/// past.
constexpr log::Duration kGreatestLag = std::chrono::milliseconds(250);

/// The performer as a sender beside the window, until it is asked to stop.
void sendDemo(const std::stop_token& stop, int characters, std::uint16_t port) {
    auto sender = net::DatagramSender::connect({{"127.0.0.1", port}, net::SendTarget::Transport::Udp});
    if (!sender) {
        return;
    }
    performer::PerformerSettings settings;
    settings.characters = characters;
    performer::Performer performer(settings);
    const log::SystemClock clock;
    net::SendSchedule schedule(clock);
    const auto period =
        std::chrono::duration_cast<log::Duration>(log::Duration(std::chrono::seconds(1)) / settings.rateHz);
    std::vector<wire::Datagram> datagrams;
    std::vector<std::byte> bytes;
    log::Duration skipped{};
    for (std::uint64_t index = 0; !stop.stop_requested(); ++index) {
        performer.frameInto(index, datagrams);
        const log::Duration late = schedule.waitUntil(skipped + static_cast<std::int64_t>(index) * period);
        if (late > kGreatestLag) {
            skipped += late;
        }
        for (const wire::Datagram& datagram : datagrams) {
            bytes.clear();
            if (wire::encodeInto(datagram, bytes)) {
                // A datagram that the system does not take counts as one that a network lost.
                static_cast<void>(sender->send(bytes));
            }
        }
    }
}

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

void SessionDriver::tick() {
    const log::Stamp now = m_log.timeline().now(m_clock);
    const std::uint64_t endBefore = m_session.end();
    const log::Moment begin = m_clock.monotonic();
    bool hasNew = false;
    const auto follow = isOpening() ? &model::Session::followFile : &model::Session::follow;
    while ((m_session.*follow)(now, kPacketsAtOnce) && m_clock.monotonic() - begin < kFollowTime) {
        hasNew = true;
    }
    hasNew = hasNew || m_session.end() != endBefore;
    if (isOpening()) {
        showReading(hasNew);
        finishOpening();
    }
    m_meter.addFollow(m_clock.monotonic() - begin, m_session.end() - endBefore);
    const bool isTableTick = now - m_tableTick >= kTableTick;
    if (now - m_retry >= kRetry) {
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
        for (const Relaying::Loop& loop : m_receiving.relaying().takeLoops()) {
            model::Occurrence one = model::Occurrence::at(model::IncidentKind::RelayLoop, loop.returner, now,
                                                          m_session.end() == 0 ? 0 : m_session.end() - 1);
            one.detail = loop.text.toStdString();
            m_session.report(one);
            emit relayStopped();
        }
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

void SessionDriver::openFile(const QString& path) {
    m_import.reset();
    m_importBegin = m_session.end();
    m_import =
        std::make_unique<FileImport>(m_receiving.receiver(), m_log, path, m_log.timeline().now(m_clock));
}

/// What is read of a file is shown as it was then: by today's clock all of it would be old.
void SessionDriver::showReading(bool hasNew) {
    if (hasNew && m_session.end() != m_importBegin) {
        setPaused(true);
        change(&model::Session::setCursor, model::Cursor{model::Cursor::Mode::Paused, m_session.end() - 1});
    }
}

QString SessionDriver::openingText() const {
    return m_import == nullptr ? QString()
                               : tr("Opening %1: %2 %")
                                     .arg(QFileInfo(m_import->path()).fileName())
                                     .arg(std::floor(100 * m_import->share()));
}

void SessionDriver::finishOpening() {
    m_import->follow(m_session.end());
    const auto result = m_import->result();
    if (!result) {
        return;
    }
    if (!*result) {
        m_import.reset();
        emit fileOpened(false, result->error());
        return;
    }
    QStringList texts{result->value(), showFile(endReading())};
    texts.removeAll(QString());
    emit fileOpened(true, texts.join(QLatin1Char(' ')));
}

void SessionDriver::cancelOpening() {
    if (!isOpening()) {
        return;
    }
    const QString path = endReading();
    const std::uint64_t packets = m_session.end() - m_importBegin;
    const QString text = packets == 0 ? QString() : showFile(path);
    emit fileOpened(false, tr("Opening %1 was stopped; %2 packets of it were read. %3")
                               .arg(QFileInfo(path).fileName())
                               .arg(packets)
                               .arg(text)
                               .trimmed());
}

QString SessionDriver::endReading() {
    const QString path = m_import->path();
    m_import.reset();
    m_receiving.receiver().flush();
    while (m_session.followFile(
        m_log.timeline().now(m_clock))) { // where it was stopped: at most what is read at once
    }
    return path;
}

QString SessionDriver::showFile(const QString& path) {
    m_receiving.noteFile(path);
    m_session.endFile();
    setPaused(false);
    setPaused(true);
    return m_session.begin() <= m_importBegin
               ? QString()
               : tr("The first %1 of %2 packets no longer fit into memory: they are counted, but cannot be "
                    "looked at.")
                     .arg(m_session.begin() - m_importBegin)
                     .arg(m_session.end() - m_importBegin);
}

void SessionDriver::seek(double seconds) {
    const auto after = log::durationOf(seconds);
    setPaused(true);
    change(&model::Session::setCursor,
           model::Cursor{model::Cursor::Mode::Paused, m_session.packetAt(m_session.firstStamp() + after)});
}

void SessionDriver::setDemo(int characters) {
    m_demo = {}; // stops and joins the one that runs
    if (characters > 0) {
        if (m_receiving.openPort() == 0) {
            m_receiving.addPort({QStringLiteral("127.0.0.1"), 0});
        }
        m_demo = std::jthread(sendDemo, characters, m_receiving.openPort());
    }
    emit demoChanged(isDemoRunning());
}

void SessionDriver::selectPacket(std::uint64_t number) {
    const auto packet = m_session.packet(number);
    const model::PacketDigest* digest = m_session.digests().find(number);
    if (!packet || digest == nullptr) {
        return;
    }
    model::Selection selection{packet->sender, std::nullopt, -1, number};
    if (digest->type != 0) {
        selection.character = model::CharacterKey{packet->sender, digest->character};
    }
    const model::Selection& before = m_session.selection();
    selection.segment = before.character == selection.character ? before.segment : -1;
    select(selection);
}

void SessionDriver::setGhostVisible(bool isVisible) {
    change(&model::Session::setGhostShown, isVisible);
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
    change(&model::Session::setCursor, cursor);
    emit pausedChanged(isPaused);
}

void SessionDriver::copyText(const QString& text) {
    QGuiApplication::clipboard()->setText(text);
}

} // namespace posewire::gui
