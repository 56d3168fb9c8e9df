// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"

#include "app/gui/base/logging.h"
#include "app/gui/base/sight.h"
#include "app/net/datagram_sender.h"
#include "app/system/process_figures.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace posewire::gui {

namespace {

/// A demo that fell behind (a sleeping computer) continues from now instead of flooding the receiver with the
/// past.
constexpr log::Duration kGreatestLag = std::chrono::milliseconds(250);

/// The performer as a sender beside the window, until it is asked to stop.
void sendDemo(const std::stop_token& stop, int characters, const net::Endpoint& to) {
    auto sender = net::DatagramSender::connect({to, net::SendTarget::Transport::Udp});
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

std::optional<double> shareOf(const std::optional<double>& before, const std::optional<double>& now,
                              double seconds) {
    return before && now ? std::optional((*now - *before) / seconds) : std::nullopt;
}

constexpr std::chrono::milliseconds kTick(16);
constexpr std::chrono::milliseconds kSlowestTick(200);
constexpr log::Duration kTableTick = std::chrono::milliseconds(100);
// While no window is in sight, or nothing has come for a while: ages are all that changes.
constexpr std::chrono::milliseconds kRestingTick(200);
constexpr log::Duration kUnseenNap = std::chrono::milliseconds(20);
constexpr log::Duration kSlowTableTick = std::chrono::seconds(1);
constexpr log::Duration kQuiet = std::chrono::seconds(2);
constexpr log::Duration kRetry = std::chrono::seconds(2);
/// A backlog (a file, or a window that was blocked) is followed in pieces, so that the window stays awake: as
/// many as fit into this time of each tick.
constexpr std::size_t kPacketsAtOnce = 1'000;
constexpr log::Duration kFollowTime = std::chrono::milliseconds(12);

} // namespace

Files::Files(Commands& commands, const log::Clock& clock, const QString& cacheFolder)
    : m_commands(commands),
      m_clock(clock),
      m_cacheFolder(cacheFolder),
      m_comparing(commands, clock, cacheFolder) {}

void Files::open(const QString& path) {
    close();
    qCInfo(filesLog).noquote() << "opening" << path;
    m_file = std::make_unique<OpenedFile>(m_clock, path, m_cacheFolder);
    m_file->session().setUsual(m_commands.usual());
    m_file->session().setThresholds(m_commands.live().verdicts().thresholds());
}

bool Files::follow(log::Duration most) {
    const bool hasRead = isReading() && read(most);
    return m_comparing.follow(most) || hasRead;
}

bool Files::read(log::Duration most) {
    const bool isFirst = m_file->session().end() == 0;
    const bool hasNew = m_file->follow(most);
    if (hasNew && isFirst) {
        show();
    }
    if (const QString failure = m_file->failure(); !failure.isEmpty()) {
        qCInfo(filesLog).noquote() << "not opened:" << failure;
        close();
        emit opened(false, failure);
    } else if (!m_file->isReading()) {
        qCInfo(filesLog) << "read," << m_file->session().end() << "packets";
        emit opened(true, m_file->notes().join(QLatin1Char(' ')));
    }
    return hasNew && m_commands.isFileShown();
}

QString Files::openingText() const {
    const OpenedFile* file = isReading() ? m_file.get() : m_comparing.file();
    return isOpening() ? tr("Opening %1: %2 %").arg(file->name()).arg(std::floor(100 * file->share()))
                       : QString();
}

void Files::cancelOpening() {
    if (!isReading()) {
        m_comparing.stopReading();
        return;
    }
    m_file->stop();
    const QString text = m_file->notes().join(QLatin1Char(' '));
    if (m_file->session().end() == 0) {
        close();
    } else {
        show();
    }
    emit opened(false, text);
}

void Files::show() {
    if (m_file != nullptr && m_file->session().end() != 0) {
        m_commands.show(m_file->session());
    }
}

void Files::close() {
    if (m_file != nullptr) {
        m_commands.showLive();
        emit closing();
        m_comparing.endOf(m_file->session().log());
        m_file.reset();
    }
}

void Demo::setCharacters(int characters) {
    m_thread = {}; // stops and joins the one that runs
    if (characters > 0) {
        if (m_receiving.openPort() == 0) {
            m_receiving.addPort({QStringLiteral("127.0.0.1"), 0});
        }
        m_thread = std::jthread(sendDemo, characters, m_receiving.openPlace());
    }
    emit changed();
}

void HealthMeter::add(const Reading& reading) {
    const std::optional<Reading> before = std::exchange(m_before, reading);
    m_health.bufferFill = reading.bufferFill;
    m_health.memoryBytes = reading.memoryBytes;
    const log::Duration follow = std::exchange(m_follow, {});
    const std::uint64_t followed = std::exchange(m_followed, 0);
    const std::uint64_t pictures = m_pictures - std::exchange(m_picturesBefore, m_pictures);
    if (followed != 0) {
        m_health.followUsPerPacket =
            static_cast<double>(follow.count()) * 1e-3 / static_cast<double>(followed);
    }
    const double seconds = before ? log::secondsOf(reading.monotonic - before->monotonic) : 0;
    if (seconds <= 0) {
        return;
    }
    m_health.receiverShare = shareOf(before->receiverCpuS, reading.receiverCpuS, seconds);
    m_health.processShare = shareOf(before->processCpuS, reading.processCpuS, seconds);
    m_health.followShare = log::secondsOf(follow) / seconds;
    m_health.framesPerSecond = static_cast<double>(pictures) / seconds;
}

SessionDriver::SessionDriver(const log::Clock& clock, const QString& cacheFolder, QObject* parent)
    : QObject(parent),
      m_clock(clock),
      m_local({}, scratchIn(cacheFolder)),
      m_history(m_local.log(), cacheFolder),
      m_files(m_commands, clock, cacheFolder) {
    connect(&m_commands, &Commands::changed, this, &SessionDriver::hasten);
    connect(&m_files.comparing(), &Comparing::changed, this, &SessionDriver::hasten);
    connect(&m_files, &Files::closing, this, [this] { m_replaying.endOf(m_files.file()->session().log()); });
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        m_tickBegin = m_clock.monotonic();
        tick();
        // A tick that takes long is followed by a rest as long: the window never takes more than half a
        // processor.
        const auto took = sinceTick();
        const bool isResting = (!m_isInSight || m_isQuiet) && !m_receiving.waysOut().hasPoses();
        const auto tick = took > kTick || !isResting ? kTick : kRestingTick;
        m_timer.start(std::clamp(std::max(tick - took, took), std::chrono::milliseconds(1), kSlowestTick));
    });
}

std::chrono::milliseconds SessionDriver::sinceTick() const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(m_clock.monotonic() - m_tickBegin);
}

void SessionDriver::hasten() {
    m_isChanged = true;
    m_tableTick = {};
    const auto left = std::max(kTick - sinceTick(), std::chrono::milliseconds(0));
    if (m_timer.isActive() && left < m_timer.remainingTimeAsDuration()) {
        m_timer.start(left);
    }
}

SessionDriver::~SessionDriver() {
    if (!m_takes.end()) {
        m_history.leave();
    }
}

void SessionDriver::tick() {
    const log::Stamp now = m_local.log().timeline().now(m_clock);
    model::Session& live = m_local.session();
    const std::uint64_t endBefore = live.end();
    const log::Moment begin = m_clock.monotonic();
    live.setHeldUp(m_heldUp.at(now) || m_receiving.receiver().isHeldUp());
    while (live.follow(now, kPacketsAtOnce) && m_clock.monotonic() - begin < kFollowTime) {
    }
    const bool hasNew = live.end() != endBefore;
    if (hasNew) {
        m_receiving.waysOut().update(live);
    }
    m_health.addFollow(m_clock.monotonic() - begin, live.end() - endBefore);
    m_isChanged = m_playback.follow() || m_isChanged;
    m_isChanged = m_files.follow(kFollowTime) || m_isChanged;
    m_isInSight = isAnyWindowInSight();
    const bool isWanted = m_isInSight || m_receiving.waysOut().hasPoses();
    m_receiving.receiver().setNap(isWanted ? net::ReceiverOptions().nap : kUnseenNap);
    m_changed = hasNew || m_isChanged || m_files.isOpening() ? now : m_changed;
    const bool isWaiting = live.end() == 0 && m_files.file() == nullptr; // help looks for why nothing comes
    m_isQuiet = !isWaiting && now - m_changed > kQuiet;
    const bool isTableTick = now - m_tableTick >= (m_isQuiet || !m_isInSight ? kSlowTableTick : kTableTick);
    if (isTableTick) { // tables and pictures say the same
        live.sharpenRange();
        live.judge();
        if (OpenedFile* file = m_files.file()) {
            file->session().sharpenRange();
            file->session().judge();
        }
    }
    if (now - m_retry >= kRetry) {
        m_retry = now;
        m_receiving.retry();
    }
    // Without new packets ages still grow: figures fade at the tables' pace.
    const bool isMoving = hasNew || (isTableTick && !live.roster().characters().empty());
    m_isChanged = m_isChanged || (isMoving && !m_playback.isPaused());
    if (m_isInSight && std::exchange(m_isChanged, false)) {
        emit moved();
    }
    if (isTableTick) {
        m_tableTick = now;
        tickTables(now);
        emit tableTick();
    }
}

void SessionDriver::tickTables(log::Stamp now) {
    model::Session& live = m_local.session();
    m_receiving.measure(now);
    live.setKernel(m_receiving.state().kernel);
    for (const WaysOut::Loop& loop : m_receiving.waysOut().takeLoops()) {
        live.report(model::IncidentKind::RelayLoop, now,
                    {words::Kind::RelayStopped, {{"problem", loop.text.toStdString()}}}, loop.returner);
        emit wayOutStopped();
    }
    for (const std::string& probe : m_receiving.takeSilentProbes()) {
        live.report(model::IncidentKind::ProbeSilent, now, {words::Kind::ProbeSilent, {{"probe", probe}}});
    }
    m_receiving.examine(live, now);
    m_takes.follow(now);
    if (const log::Moment moment = m_clock.monotonic(); m_health.isDue(moment)) {
        net::Receiver& receiver = m_receiving.receiver();
        m_health.add({moment, receiver.cpuSeconds(), system::processCpuSeconds(), receiver.takeBufferFill(),
                      system::processMemoryBytes()});
    }
}

} // namespace posewire::gui
