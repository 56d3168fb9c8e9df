// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"

#include "app/gui/base/logging.h"
#include "app/gui/base/saving.h"
#include "app/net/datagram_sender.h"
#include "app/system/process_figures.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <QClipboard>
#include <QDir>
#include <QFile>
#include <QGuiApplication>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
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

std::uint64_t freeBytes(const QString& folder) {
    // QStorageInfo knows nothing where the table of mounts lacks the root, as in a chroot.
    std::error_code failed;
    const auto space = std::filesystem::space(QFile::encodeName(folder).toStdString(), failed);
    return failed ? 0 : space.available;
}

/// The most that something of ours takes in a folder.
std::uint64_t tenthOfFree(const QString& folder) {
    return freeBytes(folder) / 10;
}

std::shared_ptr<log::Scratch> scratchIn(const QString& folder) {
    if (folder.isEmpty() || !QDir().mkpath(folder)) {
        return std::make_shared<log::Scratch>();
    }
    return std::make_shared<log::Scratch>(QFile::encodeName(folder).toStdString(), tenthOfFree(folder));
}

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

} // namespace

SessionDriver::SessionDriver(const log::Clock& clock, QString cacheFolder, QObject* parent)
    : QObject(parent),
      m_clock(clock),
      m_cacheFolder(std::move(cacheFolder)),
      m_log({}, scratchIn(m_cacheFolder)),
      m_live(m_log),
      m_receiving(m_log, clock) {
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        m_tickBegin = m_clock.monotonic();
        tick();
        // A tick that takes long is followed by a rest as long: the window never takes more than half a
        // processor.
        const auto took = sinceTick();
        m_timer.start(std::clamp(std::max(kTick - took, took), std::chrono::milliseconds(1), kSlowestTick));
    });
}

std::chrono::milliseconds SessionDriver::sinceTick() const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(m_clock.monotonic() - m_tickBegin);
}

void SessionDriver::hasten() {
    const auto left = std::max(kTick - sinceTick(), std::chrono::milliseconds(0));
    if (m_timer.isActive() && left < m_timer.remainingTimeAsDuration()) {
        m_timer.start(left);
    }
}

std::shared_ptr<log::Scratch> SessionDriver::scratchOfFile() const {
    return m_cacheFolder.isEmpty() ? std::make_shared<log::Scratch>()
                                   : log::scratchOfFile(QFile::encodeName(m_cacheFolder).toStdString());
}

void SessionDriver::tick() {
    const log::Stamp now = m_log.timeline().now(m_clock);
    const std::uint64_t endBefore = m_live.end();
    const log::Moment begin = m_clock.monotonic();
    m_live.setHeldUp(m_heldUp.at(now) || m_receiving.receiver().isHeldUp());
    while (m_live.follow(now, kPacketsAtOnce) && m_clock.monotonic() - begin < kFollowTime) {
    }
    const bool hasNew = m_live.end() != endBefore;
    m_meter.addFollow(m_clock.monotonic() - begin, m_live.end() - endBefore);
    m_isChanged = (isReading(m_file.get()) && readFile()) || m_isChanged;
    playOn();
    followComparison();
    const bool isTableTick = now - m_tableTick >= kTableTick;
    if (isTableTick) { // tables and pictures say the same
        m_live.judge();
        if (m_file != nullptr) {
            m_file->session().judge();
        }
    }
    if (now - m_retry >= kRetry) {
        m_retry = now;
        m_receiving.retry();
    }
    // Without new packets ages still grow: figures fade at the tables' pace.
    if ((hasNew && !isPaused()) || m_isChanged ||
        (isTableTick && !m_live.characters().empty() && !isPaused())) {
        m_isChanged = false;
        emit moved();
    }
    if (isTableTick) {
        m_tableTick = now;
        m_receiving.measure(now);
        for (const Relaying::Loop& loop : m_receiving.relaying().takeLoops()) {
            model::Occurrence one = model::Occurrence::at(model::IncidentKind::RelayLoop, loop.returner, now,
                                                          m_live.end() == 0 ? 0 : m_live.end() - 1);
            one.detail = loop.text.toStdString();
            m_live.report(one);
            emit relayStopped();
        }
        m_receiving.examine(m_live, now);
        watchTakes(now);
        measureHealth();
        emit tableTick();
    }
}

QString SessionDriver::toggleRecording(const RecordingChoice& choice) {
    QString problem;
    if (isRecording()) {
        m_takes.stop(m_live);
    } else {
        problem = m_takes.start(choice, m_live);
    }
    emit recordingChanged({});
    return problem;
}

/// One that ends by itself is an incident of this computer.
void SessionDriver::watchTakes(log::Stamp now) {
    m_takes.keepMarks(m_live);
    const std::string problem = m_takes.takeProblem();
    if (problem.empty()) {
        return;
    }
    model::Occurrence one = model::Occurrence::at(model::IncidentKind::RecordingEnded, log::kNoSender, now,
                                                  m_live.end() == 0 ? 0 : m_live.end() - 1);
    one.detail = "The recording has ended: " + problem + '.';
    m_live.report(one);
    emit recordingChanged(QString::fromStdString(one.detail));
}

void SessionDriver::measureHealth() {
    const log::Moment now = m_clock.monotonic();
    if (m_meter.isDue(now)) {
        net::Receiver& receiver = m_receiving.receiver();
        m_meter.add({now, receiver.cpuSeconds(), system::processCpuSeconds(), receiver.takeBufferFill(),
                     system::processMemoryBytes(), m_pictures});
    }
}

std::vector<log::LostHistory> SessionDriver::lostHistories() const {
    return m_cacheFolder.isEmpty() ? std::vector<log::LostHistory>()
                                   : log::lostHistories(QFile::encodeName(m_cacheFolder).toStdString());
}

void SessionDriver::discardLostHistories() {
    log::discardHistories(QFile::encodeName(m_cacheFolder).toStdString(), 0);
}

QString SessionDriver::keepHistory(std::uint64_t most) {
    m_history.reset();
    log::discardHistories(QFile::encodeName(m_cacheFolder).toStdString(), most);
    if (most == 0 || m_cacheFolder.isEmpty()) {
        return {};
    }
    if (!m_log.scratch()->hasFile()) { // what is kept of each packet would grow in memory
        return tr("There is no room for scratch files in %1: only what is in memory can be looked back at.")
            .arg(m_cacheFolder);
    }
    const QString application =
        QCoreApplication::applicationName() + u' ' + QCoreApplication::applicationVersion();
    const log::DiskHistoryChoice choice{QFile::encodeName(m_cacheFolder).toStdString(),
                                        std::min(most, tenthOfFree(m_cacheFolder))};
    if (freeBytes(m_cacheFolder) < choice.leaveFree) {
        return tr("Less than 1 GB is free on the disk of %1: only what is in memory can be looked back at.")
            .arg(m_cacheFolder);
    }
    auto history = log::DiskHistory::start(m_log, choice, {{}, {}, application.toStdString()});
    if (!history) {
        return QString::fromStdString(history.error().text);
    }
    m_history = std::move(*history);
    qCInfo(filesLog).noquote() << "history in" << m_cacheFolder << "of at most" << choice.most << "bytes";
    return {};
}

void SessionDriver::openFile(const QString& path) {
    closeFile();
    qCInfo(filesLog).noquote() << "opening" << path;
    m_file = std::make_unique<OpenedFile>(m_clock, path, scratchOfFile());
    m_file->session().setThresholds(m_live.thresholds());
}

bool SessionDriver::readFile() {
    const bool isFirst = m_file->session().end() == 0;
    const bool hasNew = m_file->follow(kFollowTime);
    if (hasNew && isFirst) {
        showFile();
    }
    if (!m_file->isReading()) {
        tellOpened();
    }
    return hasNew && m_isFileShown;
}

void SessionDriver::tellOpened() {
    if (const QString failure = m_file->failure(); !failure.isEmpty()) {
        qCInfo(filesLog).noquote() << "not opened:" << failure;
        closeFile();
        emit fileOpened(false, failure);
        return;
    }
    qCInfo(filesLog) << "read," << m_file->session().end() << "packets";
    emit fileOpened(true, m_file->notes().join(QLatin1Char(' ')));
}

QString SessionDriver::openingText() const {
    const OpenedFile* file = isReading(m_file.get()) ? m_file.get() : compared();
    return isOpening() ? tr("Opening %1: %2 %").arg(file->name()).arg(std::floor(100 * file->share()))
                       : QString();
}

void SessionDriver::cancelOpening() {
    if (!isReading(m_file.get())) {
        stopReadingCompared();
        return;
    }
    m_file->stop();
    const QString text = m_file->notes().join(QLatin1Char(' '));
    if (m_file->session().end() == 0) {
        closeFile();
    } else {
        showFile();
    }
    emit fileOpened(false, text);
}

void SessionDriver::setFileShown(bool isShown) {
    if (m_isFileShown != isShown) {
        endPlaying();
        m_isFileShown = isShown;
        m_isChanged = true;
        m_tableTick = {};
        emit shownChanged();
    }
}

void SessionDriver::showFile() {
    setFileShown(m_file != nullptr && m_file->session().end() != 0);
}

void SessionDriver::showLive() {
    setFileShown(false);
}

void SessionDriver::closeFile() {
    if (m_file != nullptr) {
        showLive();
        emit fileClosing();
        m_comparing.endOf(m_file->session().log());
        m_replaying.endOf(m_file->session().log());
        m_file.reset();
    }
}

void SessionDriver::setDemo(int characters) {
    m_demo = {}; // stops and joins the one that runs
    if (characters > 0) {
        if (m_receiving.openPort() == 0) {
            m_receiving.addPort({QStringLiteral("127.0.0.1"), 0});
        }
        m_demo = std::jthread(sendDemo, characters, m_receiving.openPlace());
    }
    emit demoChanged(isDemoRunning());
}

std::optional<model::Selection> SessionDriver::selectionOf(std::uint64_t number) const {
    const auto packet = shown().packet(number);
    const model::PacketDigest* digest = shown().digests().find(number);
    if (!packet || digest == nullptr) {
        return std::nullopt;
    }
    model::Selection selection{packet->sender, std::nullopt, -1, number};
    if (digest->type != 0) {
        selection.character = model::CharacterKey{packet->sender, digest->character};
    }
    const model::Selection& before = shown().selection();
    selection.segment = before.character == selection.character ? before.segment : -1;
    return selection;
}

void SessionDriver::setGhostVisible(bool isVisible) {
    change(&model::Session::setGhostShown, isVisible);
    emit ghostChanged(isVisible);
}

void SessionDriver::showIncident(std::optional<std::uint64_t> number, std::optional<model::CharacterKey> of) {
    change(&model::Session::askForIncident, number, of);
    showDock(QStringLiteral("events"));
}

void SessionDriver::copyText(const QString& text) {
    QGuiApplication::clipboard()->setText(text);
}

} // namespace posewire::gui
