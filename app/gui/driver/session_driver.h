// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/playback.h"
#include "app/gui/base/program_state.h"
#include "app/gui/driver/comparing.h"
#include "app/gui/driver/history.h"
#include "app/gui/driver/opened_file.h"
#include "app/gui/driver/receiving.h"
#include "app/gui/driver/replaying.h"
#include "app/gui/driver/takes.h"
#include "core/log/time.h"
#include "core/model/session/held_up.h"
#include "core/model/session/origin.h"

#include <QObject>
#include <QTimer>

#include <cstdint>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

namespace posewire::gui {

/// Recordings that are open: one that can be shown instead of what is received, and one that what is shown is
/// compared with.
class Files final : public QObject {
    Q_OBJECT

public:
    /// Commands and clock must outlive it.
    Files(Commands& commands, const log::Clock& clock, const QString& cacheFolder);

    /// Begins to read a file of datagrams, instead of one that is open; opened() says how it went. It is
    /// shown as soon as there is something of it.
    void open(const QString& path);
    /// Null if none is open.
    [[nodiscard]] OpenedFile* file() { return m_file.get(); }
    /// Shows the file that is open, if there is something of it.
    void show();
    void close();
    [[nodiscard]] Comparing& comparing() { return m_comparing; }

    /// Either of them is being read.
    [[nodiscard]] bool isOpening() const { return isReading() || m_comparing.isReading(); }
    /// Reads no further: what was read of the file is there, and opened() or the comparison says so.
    void cancelOpening();
    /// "Opening take.pcapng: 43 %"; empty if none is being read.
    [[nodiscard]] QString openingText() const;

    /// One display tick, for about as long as `most` each; true if there is something new to show.
    bool follow(log::Duration most);

signals:
    /// A file was read, or could not be. `text` is what is to be said about it, empty for nothing.
    void opened(bool isRead, const QString& text);
    /// The file's session goes after this, and must not be looked at any more.
    void closing();

private:
    [[nodiscard]] bool isReading() const { return m_file != nullptr && m_file->isReading(); }
    /// True if there was anything new of the file.
    bool read(log::Duration most);

    Commands& m_commands;
    const log::Clock& m_clock;
    const QString m_cacheFolder;
    std::unique_ptr<OpenedFile> m_file;
    Comparing m_comparing; ///< after the file, which it reads
};

/// The performer as a sender beside the window.
class Demo final : public QObject {
    Q_OBJECT

public:
    explicit Demo(Receiving& receiving) : m_receiving(receiving) {}

    /// Sends this many characters to a port of this computer, through a real socket; 0 ends that.
    void setCharacters(int characters);
    [[nodiscard]] bool isRunning() const { return m_thread.joinable(); }

signals:
    void changed();

private:
    Receiving& m_receiving;
    std::jthread m_thread;
};

/// Makes figures of what this program does out of counters that only grow.
class HealthMeter {
public:
    static constexpr log::Duration kPeriod = std::chrono::milliseconds(500);

    /// Counters at a moment of the monotonic clock.
    struct Reading {
        log::Moment monotonic{};
        std::optional<double> receiverCpuS{};
        std::optional<double> processCpuS{};
        std::optional<double> bufferFill{};
        std::optional<std::uint64_t> memoryBytes{};
    };

    /// Time that the session took to follow a number of packets.
    void addFollow(log::Duration took, std::uint64_t packets) {
        m_follow += took;
        m_followed += packets;
    }

    /// Pictures shown since the start, and how they are drawn now.
    void setPictures(std::uint64_t shown, PictureHealth health) {
        m_pictures = shown;
        m_health.picture = std::move(health);
    }
    /// Memory of the bodies in the viewport, and its limit.
    void setMeshMemory(std::size_t bytes, std::size_t most) {
        m_health.meshBytes = bytes;
        m_health.mostMeshBytes = most;
    }

    /// It is time for another reading.
    [[nodiscard]] bool isDue(log::Moment monotonic) const {
        return !m_before || monotonic - m_before->monotonic >= kPeriod;
    }
    void add(const Reading& reading);

    [[nodiscard]] const MonitorHealth& health() const { return m_health; }

private:
    std::optional<Reading> m_before;
    log::Duration m_follow{};
    std::uint64_t m_followed = 0;
    std::uint64_t m_pictures = 0;
    std::uint64_t m_picturesBefore = 0;
    MonitorHealth m_health;
};

/// Owns what the window runs on, and lets all of it follow once each display tick: the live session what is
/// received, that of an opened file what is read. Receiving waits for neither.
class SessionDriver final : public QObject {
    Q_OBJECT

public:
    /// `cacheFolder`: where scratch files and the history may be; made if it is missing. Without one, all
    /// that can be looked back at is in memory.
    explicit SessionDriver(const log::Clock& clock, const QString& cacheFolder = {},
                           QObject* parent = nullptr);
    /// Ends the take. The history on disk stays unless all takes are there.
    ~SessionDriver() override;

    [[nodiscard]] Commands& commands() { return m_commands; }
    [[nodiscard]] Playback& playback() { return m_playback; }
    [[nodiscard]] History& history() { return m_history; }
    [[nodiscard]] Takes& takes() { return m_takes; }
    [[nodiscard]] Receiving& receiving() { return m_receiving; }
    [[nodiscard]] Files& files() { return m_files; }
    [[nodiscard]] Replaying& replaying() { return m_replaying; }
    [[nodiscard]] Demo& demo() { return m_demo; }
    [[nodiscard]] HealthMeter& health() { return m_health; }
    /// Returns whether any window could be seen at the last tick.
    [[nodiscard]] bool isInSight() const { return m_isInSight; }

    void start() { m_timer.start(0); }
    /// One display tick: what the timer calls.
    void tick();

signals:
    /// The view moved: at most once a tick.
    void moved();
    /// Ten times a second, or once if nothing changes or can be seen, after the session has followed.
    void tableTick();
    /// A relay was switched off because its datagrams came back.
    void wayOutStopped();

private:
    [[nodiscard]] std::chrono::milliseconds sinceTick() const;
    /// What the operator asked for is shown soon: it does not wait out the rest after a long tick.
    void hasten();
    void tickTables(log::Stamp now);

    const log::Clock& m_clock;
    model::Origin m_local; ///< the inputs of this computer
    History m_history;
    Commands m_commands{m_local.session()};
    Playback m_playback{m_commands, m_clock};
    Takes m_takes{m_local};
    Receiving m_receiving{m_local.log(), m_clock};
    Files m_files;
    Replaying m_replaying{m_clock}; ///< of one of the two
    Demo m_demo{m_receiving};
    HealthMeter m_health;
    QTimer m_timer;
    log::Moment m_tickBegin{}; ///< of the newest that the timer called
    model::HeldUp m_heldUp;
    log::Stamp m_tableTick{};
    log::Stamp m_changed{}; ///< when a packet came last, or something else to show
    log::Stamp m_retry{};
    bool m_isChanged = true;
    bool m_isInSight = true;
    bool m_isQuiet = false;
};

} // namespace posewire::gui
