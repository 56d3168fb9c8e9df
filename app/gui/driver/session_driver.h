// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/base/program_view.h"
#include "app/gui/driver/comparing.h"
#include "app/gui/driver/opened_file.h"
#include "app/gui/driver/program_health.h"
#include "app/gui/driver/receiving.h"
#include "app/gui/driver/replaying.h"
#include "app/gui/driver/takes.h"
#include "core/log/disk_history.h"
#include "core/model/session/held_up.h"
#include "core/model/session/playback.h"
#include "core/model/session/session.h"

#include <QObject>
#include <QTimer>

#include <memory>
#include <thread>

namespace posewire::gui {

/// Lets the live session follow what is received, and that of an opened file what is read, once each display
/// tick; carries out commands in the one that is shown. Receiving waits for neither.
class SessionDriver final : public QObject, public Commands, public ProgramView {
    Q_OBJECT

public:
    /// `cacheFolder`: where scratch files and the history may be; made where it is missing. Without one, all
    /// that can be looked back at is in memory.
    explicit SessionDriver(const log::Clock& clock, QString cacheFolder = {}, QObject* parent = nullptr);

    /// What is shown: what is received, or the file.
    [[nodiscard]] model::SessionView& session() { return shown(); }
    /// What is received, whatever is shown.
    [[nodiscard]] model::SessionView& live() { return m_live; }
    /// Null where none is open.
    [[nodiscard]] OpenedFile* file() { return m_file.get(); }
    [[nodiscard]] Receiving& receiving() { return m_receiving; }

    /// Begins to tick.
    void start() { m_timer.start(0); }
    /// One display tick: what the timer calls.
    void tick();

    /// Keeps what is received on the disk, too, as many bytes of it at most and no more than a tenth of what
    /// is free, so that it can be looked back at when memory has dropped it; 0 for nothing. What was kept
    /// before goes. The answer is why nothing can be kept, empty where it can.
    QString keepHistory(std::uint64_t most);
    [[nodiscard]] const QString& cacheFolder() const { return m_cacheFolder; }
    /// Null where nothing is kept.
    [[nodiscard]] const log::DiskHistory* diskHistory() const { return m_history.get(); }

    /// What earlier runs that did not end well have left of theirs, the oldest first.
    [[nodiscard]] std::vector<log::LostHistory> lostHistories() const;
    void discardLostHistories();

    /// Begins a take of what is received, or ends it; whatever is shown. The answer is why it cannot begin,
    /// empty where it does.
    QString toggleRecording(const RecordingChoice& choice);
    [[nodiscard]] bool isRecording() const { return m_takes.isRecording(); }
    [[nodiscard]] std::optional<TakeState> take() const { return m_takes.state(m_live); }

    /// Sends what is shown to the network again; see Replaying.
    QString startReplay(const ReplayRequest& request) { return m_replaying.start(request, shown()); }
    void stopReplay() { m_replaying.stop(); }
    [[nodiscard]] const net::Replay* replay() const { return m_replaying.current(); }

    /// Begins to read a file of datagrams, instead of one that is open; fileOpened() says how it went. It is
    /// shown as soon as there is something of it.
    void openFile(const QString& path);
    [[nodiscard]] bool isOpening() const { return isReading(m_file.get()) || isReading(compared()); }
    /// Reads no further: what was read of the file is there, and fileOpened() says so.
    void cancelOpening();
    /// "Opening take.pcapng: 43 %"; empty where nothing is opened.
    [[nodiscard]] QString openingText() const;

    [[nodiscard]] bool isFileShown() const { return m_isFileShown; }
    /// Where a file is open, and has something to show.
    void showFile();
    void showLive();
    void closeFile();

    /// Begins to read a second recording, which what is shown is compared with; comparisonChanged() says how
    /// it went.
    void compareWith(const QString& path);
    /// Null where nothing is compared.
    [[nodiscard]] const OpenedFile* compared() const { return m_comparing.file(); }

    /// Sends the performer's characters to a port of this computer, through a real socket; 0 ends that.
    void setDemo(int characters);
    [[nodiscard]] bool isDemoRunning() const { return m_demo.joinable(); }

    /// Pictures shown since the start.
    void setPicturesShown(std::uint64_t pictures) { m_pictures = pictures; }
    /// How they are drawn now.
    void setPictureHealth(PictureHealth health) { m_picture = std::move(health); }
    /// What the bodies in the viewport take, and can become.
    void setMeshMemory(std::size_t bytes, std::size_t most) {
        m_meshBytes = bytes;
        m_mostMeshBytes = most;
    }

    // The moment that is shown; receiving goes on, whatever it is.
    /// What is received, as it comes.
    void goLive() override;
    /// Stops the display where it is, or follows the stream again. A file is played instead.
    void setPaused(bool isPaused);
    [[nodiscard]] bool isPaused() const { return shown().cursor().mode == model::Cursor::Mode::Paused; }
    /// Stops the display this many seconds after the first packet there was.
    void seek(double seconds);
    void showMoment(log::Stamp moment) override;
    /// Stops the display, and moves it by samples of a character, by packets or by time.
    void stepSamples(const model::CharacterKey& of, int steps);
    void stepPackets(int steps);
    void stepTime(log::Duration by);
    enum class Direction { Backwards = -1, Forwards = 1 };
    /// Plays from the moment that is shown on, up to what is live or to the end of the file; where it plays
    /// that way already, it stops there.
    void play(Direction direction);
    [[nodiscard]] bool isPlaying(Direction direction) const {
        return shown().cursor().speed * static_cast<int>(direction) > 0;
    }
    /// Times as fast as it was, above 0; also of what plays.
    void setPlaySpeed(double speed);
    [[nodiscard]] double playSpeed() const { return m_playSpeed; }
    /// Plays the range that is selected, or all, again and again.
    void setLooping(bool isLooping);
    [[nodiscard]] bool isLooping() const { return m_isLooping; }

    /// A new span counts for the take: counts, incidents and verdict from now on.
    void resetForTake() {
        m_live.resetForTake();
        m_isChanged = true;
        m_tableTick = {};
    }

    /// What streams must keep from now on.
    void setThresholds(const model::Thresholds& thresholds) {
        m_live.setThresholds(thresholds);
        m_isChanged = true;
    }

    // Commands
    void select(const model::Selection& selection) override {
        change(&model::Session::setSelection, selection);
    }
    void selectRange(const model::RangeChoice& range) override { change(&model::Session::setRange, range); }
    void selectPacket(std::uint64_t number) override;
    void setMarked(std::uint64_t packet, bool isMarked) override {
        change(&model::Session::setMarked, packet, isMarked);
    }
    void setComment(std::uint64_t packet, const QString& comment) override {
        change(&model::Session::setComment, packet, comment.toStdString());
    }
    void setOverride(log::SenderId sender, const model::SenderOverride& overrides) override {
        change(&model::Session::setOverride, sender, overrides);
    }
    void setDisplayFilter(const QString& filter) override {
        change(&model::Session::setDisplayFilter, filter.toStdString());
    }
    void jump(std::uint64_t packet, const QString& filter) override;
    void goBack() override;
    void frameCharacter(const model::CharacterKey& key) override { emit frameRequested(key); }
    void setCharacterVisible(const model::CharacterKey& key, bool isVisible) override {
        change(&model::Session::setHidden, key, !isVisible);
    }
    void setLifted(const model::CharacterKey& key, bool isLifted) override {
        change(&model::Session::setLifted, key, isLifted);
    }
    void forgetSender(log::SenderId sender) override { change(&model::Session::forget, sender); }
    void setGhostVisible(bool isVisible) override;
    void showIncident(std::optional<std::uint64_t> number, std::optional<model::CharacterKey> of) override;
    void askForComparison() override { emit comparisonRequested(); }
    void endComparison() override;
    void setComparison(const ComparisonChoice& choice) override;
    void setComparing(bool isOn) override;
    void saveComparison(const QString& path) override;
    void copyText(const QString& text) override;
    void showDock(const QString& dock) override { emit dockRequested(dock); }

    // ProgramView
    [[nodiscard]] MonitorHealth monitorHealth() const override {
        MonitorHealth health = m_meter.health();
        health.meshBytes = m_meshBytes;
        health.mostMeshBytes = m_mostMeshBytes;
        health.picture = m_picture;
        return health;
    }
    [[nodiscard]] ReceivingState receivingState() const override { return m_receiving.state(); }
    [[nodiscard]] const ComparisonState& comparison() const override { return m_comparing.state(); }

signals:
    /// The view moved: at most once a tick.
    void moved();
    /// Ten times a second, after the session has followed.
    void tableTick();
    void pausedChanged(bool isPaused);
    /// session() is another one now.
    void shownChanged();
    /// The file's session goes after this, and must not be looked at any more.
    void fileClosing();
    /// A relay was switched off because its datagrams came back.
    void relayStopped();
    /// A file was read, or could not be. `text` is what is to be said about it, empty for nothing.
    void fileOpened(bool isRead, const QString& text);
    void comparisonRequested();
    /// A second recording is open, or none any more; `text` is what is to be said, empty for nothing.
    void comparisonChanged(const QString& text);
    void demoChanged(bool isRunning);
    /// A take began or ended; `problem` is why it ended by itself, empty where it did not.
    void recordingChanged(const QString& problem);
    void frameRequested(const model::CharacterKey& key);
    void ghostChanged(bool isVisible);
    void dockRequested(const QString& dock);
    /// What was seen before the newest jump is shown again.
    void wentBack();

private:
    /// Calls a setter of the session, and shows what came of it.
    template <class Setter, class... Arguments>
    void change(Setter setter, const Arguments&... arguments) {
        (shown().*setter)(arguments...);
        m_isChanged = true;
        m_tableTick = {};
        hasten();
    }
    [[nodiscard]] std::chrono::milliseconds sinceTick() const;
    /// What the operator asked for does not wait out the rest after a long tick.
    void hasten();
    /// The same with the moment that is shown.
    void setCursor(const model::Cursor& cursor);
    void stopAt(std::uint64_t packet);
    void letGoOfPacket();
    void playLive();
    void beginPlaying(double speed);
    void endPlaying();
    /// Moves what plays on.
    void playOn();
    [[nodiscard]] std::optional<model::TimeRange> loopRange() const;
    void measureHealth();
    void watchTakes(log::Stamp now);
    /// A packet with its sender and character; nothing where there is no such packet.
    [[nodiscard]] std::optional<model::Selection> selectionOf(std::uint64_t packet) const;
    [[nodiscard]] static bool isReading(const OpenedFile* file) {
        return file != nullptr && file->isReading();
    }
    [[nodiscard]] std::shared_ptr<log::Scratch> scratchOfFile() const;
    void followComparison();
    void stopReadingCompared();
    /// True if there was anything new of the file.
    bool readFile();
    void tellOpened();
    void setFileShown(bool isShown);
    [[nodiscard]] model::Session& shown() { return m_isFileShown ? m_file->session() : m_live; }
    [[nodiscard]] const model::Session& shown() const { return m_isFileShown ? m_file->session() : m_live; }

    const log::Clock& m_clock;
    const QString m_cacheFolder; ///< empty for none
    log::PacketLog m_log;
    std::unique_ptr<log::DiskHistory> m_history; ///< null where nothing is kept
    model::Session m_live;
    Takes m_takes{m_log};
    Receiving m_receiving;
    std::unique_ptr<OpenedFile> m_file; ///< null where none is open
    Replaying m_replaying{m_clock};     ///< of one of the two
    Comparing m_comparing{m_clock};     ///< after the logs that it reads
    bool m_isFileShown = false;
    std::optional<model::Playback> m_playback; ///< while something plays
    double m_playSpeed = 1;
    bool m_isLooping = false;
    std::jthread m_demo;
    QTimer m_timer;
    log::Moment m_tickBegin{}; ///< of the newest that the timer called
    model::HeldUp m_heldUp;
    HealthMeter m_meter;
    std::uint64_t m_pictures = 0;
    std::size_t m_meshBytes = 0;
    std::size_t m_mostMeshBytes = 0;
    PictureHealth m_picture;
    log::Stamp m_tableTick{};
    log::Stamp m_retry{};
    bool m_isChanged = true;
};

} // namespace posewire::gui
