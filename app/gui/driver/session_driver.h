// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/playback.h"
#include "app/gui/driver/demo.h"
#include "app/gui/driver/files.h"
#include "app/gui/driver/history.h"
#include "app/gui/driver/program_health.h"
#include "app/gui/driver/receiving.h"
#include "app/gui/driver/replaying.h"
#include "app/gui/driver/takes.h"
#include "core/model/session/held_up.h"
#include "core/model/session/session.h"

#include <QObject>
#include <QTimer>

namespace posewire::gui {

/// Owns what the window runs on, and lets all of it follow once each display tick: the live session what is
/// received, that of an opened file what is read. Receiving waits for neither.
class SessionDriver final : public QObject {
    Q_OBJECT

public:
    /// `cacheFolder`: where scratch files and the history may be; made if it is missing. Without one, all
    /// that can be looked back at is in memory.
    explicit SessionDriver(const log::Clock& clock, const QString& cacheFolder = {},
                           QObject* parent = nullptr);

    [[nodiscard]] Commands& commands() { return m_commands; }
    [[nodiscard]] Playback& playback() { return m_playback; }
    [[nodiscard]] History& history() { return m_history; }
    [[nodiscard]] Takes& takes() { return m_takes; }
    [[nodiscard]] Receiving& receiving() { return m_receiving; }
    [[nodiscard]] Files& files() { return m_files; }
    [[nodiscard]] Replaying& replaying() { return m_replaying; }
    [[nodiscard]] Demo& demo() { return m_demo; }
    [[nodiscard]] HealthMeter& health() { return m_health; }

    /// Begins to tick.
    void start() { m_timer.start(0); }
    /// One display tick: what the timer calls.
    void tick();

signals:
    /// The view moved: at most once a tick.
    void moved();
    /// Ten times a second, after the session has followed.
    void tableTick();
    /// A relay was switched off because its datagrams came back.
    void relayStopped();

private:
    [[nodiscard]] std::chrono::milliseconds sinceTick() const;
    /// What the operator asked for is shown soon: it does not wait out the rest after a long tick.
    void hasten();
    void tickTables(log::Stamp now);

    const log::Clock& m_clock;
    log::PacketLog m_log;
    History m_history;
    model::Session m_live{m_log};
    Commands m_commands{m_live};
    Playback m_playback{m_commands, m_clock};
    Takes m_takes{m_log, m_live};
    Receiving m_receiving{m_log, m_clock};
    Files m_files;
    Replaying m_replaying{m_clock}; ///< of one of the two
    Demo m_demo{m_receiving};
    HealthMeter m_health;
    QTimer m_timer;
    log::Moment m_tickBegin{}; ///< of the newest that the timer called
    model::HeldUp m_heldUp;
    log::Stamp m_tableTick{};
    log::Stamp m_retry{};
    bool m_isChanged = true;
};

} // namespace posewire::gui
