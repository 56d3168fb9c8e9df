// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/driver/demo_sender.h"
#include "app/gui/driver/health_meter.h"
#include "app/gui/driver/receiving.h"
#include "app/gui/program_view.h"
#include "core/log/time.h"
#include "core/model/session/session.h"

#include <QObject>
#include <QTimer>

#include <memory>

namespace posewire::gui {

/// Lets the session follow the log, once each display tick, and carries out commands. Receiving does not wait
/// for it.
class SessionDriver final : public QObject, public Commands, public ProgramView {
    Q_OBJECT

public:
    explicit SessionDriver(const log::Clock& clock, QObject* parent = nullptr);
    ~SessionDriver() override;

    [[nodiscard]] model::SessionView& session() { return m_session; }
    [[nodiscard]] const model::SessionView& session() const { return m_session; }
    [[nodiscard]] Receiving& receiving() { return m_receiving; }

    /// Begins to tick.
    void start();
    /// One display tick: what the timer calls.
    void tick();

    /// Reads a file of datagrams and stops the display at its end. The answer is what went wrong, empty for
    /// nothing.
    [[nodiscard]] QString openFile(const QString& path);

    /// Stops the display this many seconds after the first packet there was.
    void seek(double seconds);

    /// 0 ends the demo.
    void setDemo(int characters);
    [[nodiscard]] bool isDemoRunning() const { return m_demo != nullptr; }

    /// Pictures shown since the start.
    void setPicturesShown(std::uint64_t pictures) { m_pictures = pictures; }

    [[nodiscard]] bool isPaused() const { return m_session.cursor().mode == model::Cursor::Mode::Paused; }

    // Commands
    void select(const model::Selection& selection) override;
    void selectRange(const model::RangeChoice& range) override;
    void selectPacket(std::uint64_t number) override;
    void setMarked(std::uint64_t packet, bool isMarked) override;
    void setComment(std::uint64_t packet, const QString& comment) override;
    void setOverride(log::SenderId sender, const model::SenderOverride& overrides) override;
    void setDisplayFilter(const QString& filter) override;
    void setThresholds(const model::Thresholds& thresholds) override;
    void frameCharacter(const model::CharacterKey& key) override;
    void setCharacterVisible(const model::CharacterKey& key, bool isVisible) override;
    void setGhostVisible(bool isVisible) override;
    void setPaused(bool isPaused) override;
    void copyText(const QString& text) override;
    void showDock(const QString& dock) override;

    // ProgramView
    [[nodiscard]] MonitorHealth monitorHealth() const override { return m_meter.health(); }
    [[nodiscard]] ReceivingState receivingState() const override { return m_receiving.state(); }

signals:
    /// The view moved: at most once a tick.
    void moved();
    /// Ten times a second, after the session has followed.
    void tableTick();
    void pausedChanged(bool isPaused);
    void demoChanged(bool isRunning);
    void frameRequested(const model::CharacterKey& key);
    void ghostChanged(bool isVisible);
    void dockRequested(const QString& dock);

private:
    /// What panels show has changed otherwise than by new packets.
    void announceChange();
    void measureHealth();

    const log::Clock& m_clock;
    log::PacketLog m_log;
    model::Session m_session;
    Receiving m_receiving;
    std::unique_ptr<DemoSender> m_demo;
    QTimer m_timer;
    HealthMeter m_meter;
    std::uint64_t m_pictures = 0;
    log::Stamp m_tableTick{};
    log::Stamp m_retry{};
    bool m_isChanged = true;
};

} // namespace posewire::gui
