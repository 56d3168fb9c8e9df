// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"

#include "app/gui/base/sight.h"
#include "app/net/datagram_sender.h"
#include "app/net/listening.h"
#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"
#include "core/model/session/accounts.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/words/say.h"
#include "tests/app/gui/models/stage.h"
#include "tests/support/manual_clock.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QWidget>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <climits>
#include <optional>
#include <thread>

namespace posewire::gui {
namespace {

/// Ticks until something holds, at most five seconds.
template <typename Condition>
bool tickUntil(SessionDriver& driver, const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (!condition() && std::chrono::steady_clock::now() < end) {
        driver.tick();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return condition();
}

/// What is said once the file is open.
QString openFile(SessionDriver& driver, const QString& path) {
    QSignalSpy opened(&driver.files(), &Files::opened);
    driver.files().open(path);
    EXPECT_TRUE(tickUntil(driver, [&] { return !driver.files().isOpening(); }));
    return opened.count() == 1 ? opened[0][1].toString() : QStringLiteral("not opened once");
}

class SessionDriverTest : public testing::Test {
protected:
    void listenAndSend(std::uint64_t frames) {
        if (driver.receiving().openPort() == 0) {
            driver.receiving().addPort({"127.0.0.1", 0});
        }
        if (!m_sender) {
            auto sender = net::DatagramSender::connect(
                {{"127.0.0.1", driver.receiving().openPort()}, net::SendTarget::Transport::Udp});
            ASSERT_TRUE(sender);
            m_sender.emplace(std::move(*sender));
        }
        for (std::uint64_t i = 0; i < frames; ++i) {
            for (const wire::Datagram& datagram : performer.frame(m_frame)) {
                ASSERT_TRUE(m_sender->send(*wire::encode(datagram)));
            }
            ++m_frame;
        }
    }

    log::SystemClock clock;
    SessionDriver driver{clock};
    performer::Performer performer{sending(1, {2})};

private:
    std::optional<net::DatagramSender> m_sender;
    std::uint64_t m_frame = 0;
};

TEST_F(SessionDriverTest, WhatArrivesAtThePortIsInTheSessionAtTheNextTick) {
    listenAndSend(10);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().session().end() >= 10; }));
    ASSERT_EQ(driver.commands().session().roster().characters().size(), 1U);
    EXPECT_NE(
        driver.commands().session().messages().pose(driver.commands().session().roster().characters()[0].key),
        nullptr);
}

TEST_F(SessionDriverTest, TheDemoSendsToTheAddressThatIsListenedAt) {
    driver.receiving().addPort({"127.0.0.2", 0});
    ASSERT_NE(driver.receiving().openPort(), 0);
    driver.demo().setCharacters(1);
    EXPECT_TRUE(tickUntil(driver, [&] { return driver.commands().live().end() != 0; }));
    driver.demo().setCharacters(0);
}

TEST_F(SessionDriverTest, WhatIsHiddenIsOfTheSessionAndTheViewMoves) {
    const model::CharacterKey key{log::SenderId{0}, 1};
    driver.tick();
    QSignalSpy moved(&driver, &SessionDriver::moved);
    driver.commands().setCharacterVisible(key, false);
    driver.commands().setGhostVisible(true);
    driver.tick();
    EXPECT_TRUE(driver.commands().session().roster().isHidden(key));
    EXPECT_TRUE(driver.commands().session().choices().isGhostShown);
    EXPECT_EQ(moved.count(), 1);
    driver.commands().setCharacterVisible(key, true);
    EXPECT_FALSE(driver.commands().session().roster().isHidden(key));
}

TEST_F(SessionDriverTest, PausingFreezesTheDisplayWhileTheLogGoesOn) {
    listenAndSend(10);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().session().end() >= 10; }));
    const model::CharacterKey key = driver.commands().session().roster().characters()[0].key;
    driver.playback().playOrStop();
    const std::uint32_t sample = driver.commands().session().messages().pose(key)->sample;
    listenAndSend(20);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().session().end() >= 30; }));
    EXPECT_EQ(driver.commands().session().messages().pose(key)->sample, sample);
    driver.playback().goLive();
    EXPECT_GT(driver.commands().session().messages().pose(key)->sample, sample);
}

TEST_F(SessionDriverTest, ATakeHasThePreRollAndWhatComesWhateverIsShown) {
    const QTemporaryDir folder;
    const RecordingChoice choice{
        .folder = folder.path(), .pattern = "take", .preRollSeconds = 60, .freeMegabytes = 0};
    listenAndSend(50);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().live().end() == 50; }));
    driver.commands().setMarked(20, true);
    driver.commands().setComment(30, QStringLiteral("left hand jumps: look"));
    driver.playback().playOrStop();
    ASSERT_EQ(driver.takes().toggle(choice), "");
    ASSERT_TRUE(driver.takes().isRecording());
    driver.commands().setMarked(35, true);
    driver.commands().setMarked(20, false);
    listenAndSend(50);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.takes().state()->figures.packets == 100; }));
    driver.commands().setMarked(20, true);
    driver.commands().setMarked(35, false);
    EXPECT_EQ(driver.takes().state()->path, folder.filePath("take.pcapng"));
    EXPECT_EQ(driver.takes().toggle(choice), "");
    EXPECT_FALSE(driver.takes().isRecording());
    ASSERT_TRUE(tickUntil(driver, [&] {
        QFile file(folder.filePath("take.pcapng"));
        return file.open(QIODevice::ReadOnly) && file.readAll().contains("Mark on packet 20 at ");
    }));
    ASSERT_EQ(openFile(driver, folder.filePath("take.pcapng")), "");
    EXPECT_EQ(driver.commands().session().end(), 100U);
    const model::Annotations& read = driver.commands().session().choices().annotations;
    EXPECT_EQ(read.marks, (std::set<std::uint64_t>{20, 30}));
    ASSERT_EQ(read.comments.size(), 1U);
    EXPECT_EQ(read.comments.at(30), "left hand jumps: look");
}

TEST_F(SessionDriverTest, TheEndOfATakeIsNoOutage) {
    const QTemporaryDir folder;
    const RecordingChoice choice{.folder = folder.path(), .pattern = "take", .freeMegabytes = 0};
    listenAndSend(1);
    ASSERT_EQ(driver.takes().toggle(choice), "");
    for (std::uint64_t sent = 2; sent <= 31; ++sent) {
        listenAndSend(1);
        ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().live().end() == sent; }));
    }
    const auto isBad = [](const model::TakeVerdict& one) {
        return one.state == model::TakeVerdict::State::Bad;
    };
    ASSERT_TRUE(tickUntil(driver, [&] { return isBad(driver.commands().live().verdicts().all().all); }));
    EXPECT_EQ(driver.takes().toggle(choice), "");
    ASSERT_TRUE(tickUntil(driver, [&] {
        QFile file(folder.filePath("take.pcapng"));
        return file.open(QIODevice::ReadOnly) && file.readAll().contains("Posewire: received for ");
    }));
    ASSERT_EQ(openFile(driver, folder.filePath("take.pcapng")), "");
    EXPECT_FALSE(isBad(driver.commands().session().verdicts().all().all))
        << say(driver.commands().session().verdicts().all().all.said, words::Form::Headline);
}

TEST_F(SessionDriverTest, CommentsOfACaptureAreThoseOfItsPackets) {
    const QTemporaryDir folder;
    const QString path = folder.filePath("commented.pcapng");
    {
        const auto sink = log::createFile(path.toStdString());
        ASSERT_TRUE(sink);
        log::PcapngWriter writer(**sink);
        ASSERT_TRUE(writer.begin({}));
        const std::vector<std::byte> bytes(40, std::byte{7});
        for (int i = 0; i < 20; ++i) {
            log::Packet packet;
            packet.stamp = log::Stamp(1'700'000'000s + i * 10ms);
            packet.bytes = bytes;
            const std::vector<std::string> comments{"a stumble", "ask Mira"};
            ASSERT_TRUE(writer.add(packet, {"10.0.0.5:50000", log::Transport::Udp, 9763},
                                   i == 7 ? comments : std::vector<std::string>()));
        }
        ASSERT_TRUE(writer.addStatistics());
    }
    ASSERT_EQ(openFile(driver, path), "");
    const auto& comments = driver.commands().session().choices().annotations.comments;
    ASSERT_EQ(comments.size(), 1U);
    EXPECT_EQ(comments.begin()->first, 7U);
    EXPECT_EQ(comments.begin()->second, "a stumble\nask Mira");
}

TEST_F(SessionDriverTest, ATakeThatCannotBeginSaysWhy) {
    const QTemporaryDir folder;
    const RecordingChoice full{.folder = folder.path(), .freeMegabytes = INT_MAX};
    EXPECT_TRUE(driver.takes().toggle(full).contains("MB are free"));
    EXPECT_FALSE(driver.takes().isRecording());
    EXPECT_TRUE(driver.takes().toggle({.folder = "/proc/none"}).contains("/proc/none"));
}

TEST_F(SessionDriverTest, ASelectionMovesTheViewAtTheNextTick) {
    driver.tick();
    const QSignalSpy spy(&driver, &SessionDriver::moved);
    driver.tick();
    EXPECT_EQ(spy.count(), 0);
    driver.commands().select({});
    driver.tick();
    EXPECT_EQ(spy.count(), 1);
}

TEST_F(SessionDriverTest, APortThatIsTakenIsToldAndTriedAgain) {
    net::Input taken({}, net::InputKind::Udp, {"127.0.0.1", 0});
    auto holder = net::bindUdp(taken, 1 << 16);
    ASSERT_TRUE(holder);
    const std::uint16_t port = holder->front().socket->localPort();
    driver.receiving().addPort({"127.0.0.1", port});
    ASSERT_EQ(driver.receiving().state().ports.size(), 1U);
    EXPECT_THAT(driver.receiving().state().ports[0].problem.toStdString(),
                testing::HasSubstr(std::to_string(port)));
    EXPECT_EQ(driver.receiving().openPort(), 0);
    holder->clear();
    driver.receiving().retry();
    EXPECT_TRUE(driver.receiving().state().ports[0].problem.isEmpty());
    EXPECT_EQ(driver.receiving().openPort(), port);
}

/// Writes a raw file of samples; its path.
QString writeFile(const QTemporaryDir& folder, std::uint64_t frames) {
    QFile file(folder.filePath("take.bin"));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    performer::Performer other{sending(1, {2})};
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        for (const wire::Datagram& datagram : other.frame(frame)) {
            const auto bytes = *wire::encode(datagram);
            file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<qint64>(bytes.size()));
        }
    }
    return file.fileName();
}

TEST_F(SessionDriverTest, AFileTouchesNothingOfWhatIsReceived) {
    const QTemporaryDir folder;
    listenAndSend(50);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().live().end() == 50; }));
    const QSignalSpy shown(&driver.commands(), &Commands::switched);
    ASSERT_EQ(openFile(driver, writeFile(folder, 2000)), "");
    EXPECT_EQ(shown.count(), 1);
    EXPECT_TRUE(driver.commands().isFileShown());
    EXPECT_TRUE(driver.playback().isPaused()) << "by today's clock all of it would be old";
    EXPECT_EQ(driver.commands().session().end(), 2000U);
    listenAndSend(50);
    EXPECT_TRUE(tickUntil(driver, [&] { return driver.commands().live().end() == 100; }));
    EXPECT_EQ(driver.commands().live().roster().senders().size(), 1U);
    EXPECT_EQ(driver.commands().live().choices().cursor.mode, model::Cursor::Mode::Following);
    for (const model::Incident& incident : driver.commands().live().verdicts().incidents().all()) {
        EXPECT_NE(incident.kind, model::IncidentKind::Conflict)
            << say(incident.fact(), words::Form::Sentence);
    }
    driver.playback().goLive();
    EXPECT_FALSE(driver.playback().isPaused());
    EXPECT_EQ(driver.commands().session().end(), 100U);
    driver.files().show();
    EXPECT_EQ(driver.commands().session().end(), 2000U) << "it is still open";
}

TEST_F(SessionDriverTest, GoingLiveLetsGoOfThePacketAndTheRangeThatAreHeld) {
    listenAndSend(50);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().live().end() == 50; }));
    driver.playback().playOrStop();
    driver.commands().selectPacket(42);
    driver.playback().setRangeEdge(false);
    driver.playback().goToLast();
    EXPECT_FALSE(driver.commands().session().choices().selection.packet);
    EXPECT_FALSE(driver.commands().session().range());
    EXPECT_FALSE(driver.playback().isPaused());
}

TEST_F(SessionDriverTest, WhatIsAskedForIsDoneInTheSessionThatIsShown) {
    const QTemporaryDir folder;
    listenAndSend(10);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().live().end() == 10; }));
    ASSERT_EQ(openFile(driver, writeFile(folder, 20)), "");
    driver.commands().setMarked(15, true);
    driver.playback().playOrStop(); // a file stands still or plays
    EXPECT_TRUE(driver.playback().isPaused());
    EXPECT_TRUE(driver.commands().session().choices().annotations.marks.contains(15));
    EXPECT_TRUE(driver.commands().live().choices().annotations.marks.empty());
}

TEST_F(SessionDriverTest, ClosingAFileSaysSoBeforeItsSessionGoes) {
    const QTemporaryDir folder;
    ASSERT_EQ(openFile(driver, writeFile(folder, 20)), "");
    std::vector<std::string> order;
    QObject::connect(&driver.commands(), &Commands::switched, &driver, [&] {
        EXPECT_EQ(&driver.commands().session(), &driver.commands().live());
        order.emplace_back("shown");
    });
    QObject::connect(&driver.files(), &Files::closing, &driver, [&] {
        EXPECT_EQ(driver.files().file()->session().end(), 20U);
        order.emplace_back("closing");
    });
    driver.files().close();
    EXPECT_THAT(order, testing::ElementsAre("shown", "closing"));
    EXPECT_EQ(driver.files().file(), nullptr);
    driver.files().show();
    EXPECT_FALSE(driver.commands().isFileShown());
}

TEST_F(SessionDriverTest, AFileThatCannotBeReadIsNeverShown) {
    listenAndSend(10);
    QSignalSpy opened(&driver.files(), &Files::opened);
    const QSignalSpy shown(&driver.commands(), &Commands::switched);
    driver.files().open("/no/such/file");
    ASSERT_TRUE(tickUntil(driver, [&] { return opened.count() == 1; }));
    EXPECT_FALSE(opened[0][0].toBool());
    EXPECT_TRUE(opened[0][1].toString().contains("no such file"));
    EXPECT_EQ(shown.count(), 0);
    EXPECT_EQ(driver.files().file(), nullptr);
}

TEST_F(SessionDriverTest, AfterAResetOnlyWhatCameSinceCounts) {
    listenAndSend(10);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().live().end() == 10; }));
    driver.commands().resetForTake();
    EXPECT_EQ(driver.commands().live().choices().reset, driver.commands().live().now());
    ASSERT_TRUE(driver.commands().live().range());
    EXPECT_EQ(driver.commands()
                  .live()
                  .accounts()
                  .countsOf(driver.commands().live().roster().characters()[0].key,
                            *driver.commands().live().range())
                  .samples,
              0U);
    EXPECT_EQ(driver.commands().live().roster().streams()[0].accounting.counts().samples, 10U)
        << "what was received stays";
}

TEST_F(SessionDriverTest, AFinishedRecordingIsNoSenderThatStopped) {
    QTemporaryDir folder;
    const QString path = folder.filePath("take.bin");
    {
        QFile file(path);
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        for (const wire::Datagram& datagram : performer.frame(0)) {
            const auto bytes = *wire::encode(datagram);
            file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<qint64>(bytes.size()));
        }
    }
    log::ManualClock manual(log::WallTime(1'700'000'000s));
    SessionDriver opened{manual};
    ASSERT_EQ(openFile(opened, path), "");
    ASSERT_EQ(opened.commands().session().roster().characters().size(), 1U);
    manual.advance(5s);
    opened.tick();
    for (const model::Incident& event : opened.commands().session().verdicts().incidents().all()) {
        EXPECT_NE(event.severity(), model::IncidentSeverity::Error)
            << say(event.fact(), words::Form::Sentence);
    }
}

TEST_F(SessionDriverTest, InputsOfTcpAreToldAsTheyStand) {
    using Kind = InputAddress::Kind;
    driver.receiving().addPort({"127.0.0.1", 0, Kind::TcpListener});
    ASSERT_EQ(driver.receiving().state().ports.size(), 1U);
    const InputAddress listening = driver.receiving().state().ports[0].port;
    EXPECT_NE(listening.port, 0);
    EXPECT_EQ(driver.receiving().openPort(), 0) << "the demo sends by UDP";
    auto sender =
        net::DatagramSender::connect({{"127.0.0.1", listening.port}, net::SendTarget::Transport::Tcp});
    ASSERT_TRUE(sender);
    for (const wire::Datagram& datagram : performer.frame(0)) {
        ASSERT_TRUE(sender->send(*wire::encode(datagram)));
    }
    ASSERT_TRUE(
        tickUntil(driver, [&] { return driver.commands().session().roster().characters().size() == 1; }));
    EXPECT_EQ(driver.commands().session().roster().senders()[0].info.transport, log::Transport::Tcp);
    EXPECT_TRUE(driver.receiving().removePort(listening));
    EXPECT_FALSE(driver.receiving().removePort(listening));
    EXPECT_TRUE(driver.receiving().state().ports.empty());
}

TEST_F(SessionDriverTest, TheDemoGoesThroughARealSocket) {
    driver.receiving().addPort({"127.0.0.1", 0});
    driver.demo().setCharacters(2);
    EXPECT_TRUE(
        tickUntil(driver, [&] { return driver.commands().session().roster().characters().size() == 2; }));
    EXPECT_EQ(driver.commands().session().roster().senders()[0].info.transport, log::Transport::Udp);
    driver.demo().setCharacters(0);
    EXPECT_FALSE(driver.demo().isRunning());
}

TEST_F(SessionDriverTest, OpeningAFileCanBeStoppedAndWhatWasReadStays) {
    const QTemporaryDir folder;
    QFile file(folder.filePath("long.bin"));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    for (std::uint64_t frame = 0; frame < 20'000; ++frame) { // more than is read before it was looked at
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            const auto bytes = *wire::encode(datagram);
            file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<qint64>(bytes.size()));
        }
    }
    file.close();
    const QSignalSpy opened(&driver.files(), &Files::opened);
    driver.files().open(file.fileName());
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.commands().session().end() > 0; }));
    ASSERT_TRUE(driver.files().isOpening());
    driver.files().cancelOpening();
    EXPECT_FALSE(driver.files().isOpening());
    EXPECT_TRUE(driver.playback().isPaused());
    ASSERT_EQ(opened.count(), 1);
    EXPECT_FALSE(opened[0][0].toBool());
    const std::uint64_t read = driver.commands().session().end();
    EXPECT_LT(read, 20'000U);
    EXPECT_EQ(opened[0][1].toString(),
              QStringLiteral("Opening long.bin was stopped: %1 packets of it are here.").arg(read));
    EXPECT_EQ(driver.files().file()->notes(), QStringList(opened[0][1].toString()))
        << "said as long as it is open";
    driver.tick();
    EXPECT_EQ(driver.commands().session().end(), read);
    driver.files().cancelOpening();
    EXPECT_EQ(opened.count(), 1) << "there is nothing to stop any more";
}

/// How often tables are refreshed in ten seconds.
qsizetype refreshesInTenSeconds(SessionDriver& driver, log::ManualClock& clock) {
    QSignalSpy refreshed(&driver, &SessionDriver::tableTick);
    for (int tick = 0; tick < 625; ++tick) {
        driver.tick();
        clock.advance(16ms);
    }
    return refreshed.count();
}

TEST(SessionDriver, RestsWhileNoWindowIsInSight) {
    log::ManualClock clock(log::WallTime(1'700'000'000s));
    SessionDriver driver(clock);
    EXPECT_GE(refreshesInTenSeconds(driver, clock), 80);
    QWidget window;
    window.show();
    QCoreApplication::processEvents();
    EXPECT_TRUE(isAnyWindowInSight());
    window.showMinimized();
    QCoreApplication::processEvents();
    EXPECT_FALSE(isAnyWindowInSight());
    EXPECT_LE(refreshesInTenSeconds(driver, clock), 11);
}

} // namespace
} // namespace posewire::gui
