// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"

#include "app/net/datagram_sender.h"
#include "app/net/listening.h"
#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"
#include "tests/app/gui/models/stage.h"
#include "tests/support/manual_clock.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>

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
    QSignalSpy opened(&driver, &SessionDriver::fileOpened);
    driver.openFile(path);
    EXPECT_TRUE(tickUntil(driver, [&] { return !driver.isOpening(); }));
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
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.session().end() >= 10; }));
    ASSERT_EQ(driver.session().characters().size(), 1U);
    EXPECT_NE(driver.session().pose(driver.session().characters()[0].key), nullptr);
}

TEST_F(SessionDriverTest, TheDemoSendsToTheAddressThatIsListenedAt) {
    driver.receiving().addPort({"127.0.0.2", 0});
    ASSERT_NE(driver.receiving().openPort(), 0);
    driver.setDemo(1);
    EXPECT_TRUE(tickUntil(driver, [&] { return driver.live().end() != 0; }));
    driver.setDemo(0);
}

TEST_F(SessionDriverTest, WhatIsHiddenIsOfTheSessionAndTheViewMoves) {
    const model::CharacterKey key{log::SenderId{0}, 1};
    driver.tick();
    QSignalSpy moved(&driver, &SessionDriver::moved);
    QSignalSpy ghost(&driver, &SessionDriver::ghostChanged);
    driver.setCharacterVisible(key, false);
    driver.setGhostVisible(true);
    driver.tick();
    EXPECT_TRUE(driver.session().isHidden(key));
    EXPECT_TRUE(driver.session().isGhostShown());
    EXPECT_EQ(moved.count(), 1);
    EXPECT_EQ(ghost.count(), 1);
    driver.setCharacterVisible(key, true);
    EXPECT_FALSE(driver.session().isHidden(key));
}

TEST_F(SessionDriverTest, PausingFreezesTheDisplayWhileTheLogGoesOn) {
    listenAndSend(10);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.session().end() >= 10; }));
    const model::CharacterKey key = driver.session().characters()[0].key;
    driver.setPaused(true);
    const std::uint32_t sample = driver.session().pose(key)->sample;
    listenAndSend(20);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.session().end() >= 30; }));
    EXPECT_EQ(driver.session().pose(key)->sample, sample);
    driver.setPaused(false);
    EXPECT_GT(driver.session().pose(key)->sample, sample);
}

TEST_F(SessionDriverTest, ATakeHasThePreRollAndWhatComesWhateverIsShown) {
    const QTemporaryDir folder;
    const RecordingChoice choice{
        .folder = folder.path(), .pattern = "take", .preRollSeconds = 60, .freeMegabytes = 0};
    listenAndSend(50);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.live().end() == 50; }));
    driver.setMarked(20, true);
    driver.setComment(30, QStringLiteral("left hand jumps: look"));
    driver.setPaused(true);
    ASSERT_EQ(driver.toggleRecording(choice), "");
    ASSERT_TRUE(driver.isRecording());
    driver.setMarked(35, true);
    driver.setMarked(20, false);
    listenAndSend(50);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.take()->figures.packets == 100; }));
    driver.setMarked(20, true);
    driver.setMarked(35, false);
    EXPECT_EQ(driver.take()->path, folder.filePath("take.pcapng"));
    EXPECT_EQ(driver.toggleRecording(choice), "");
    EXPECT_FALSE(driver.isRecording());
    ASSERT_TRUE(tickUntil(driver, [&] {
        QFile file(folder.filePath("take.pcapng"));
        return file.open(QIODevice::ReadOnly) && file.readAll().contains("Mark on packet 20 at ");
    }));
    ASSERT_EQ(openFile(driver, folder.filePath("take.pcapng")), "");
    EXPECT_EQ(driver.session().end(), 100U);
    const model::Annotations& read = driver.session().annotations();
    EXPECT_EQ(read.marks, (std::set<std::uint64_t>{20, 30}));
    ASSERT_EQ(read.comments.size(), 1U);
    EXPECT_EQ(read.comments.at(30), "left hand jumps: look");
}

TEST_F(SessionDriverTest, ATakeTellsOfTheSilenceAtItsEnd) {
    const QTemporaryDir folder;
    const RecordingChoice choice{.folder = folder.path(), .pattern = "take", .freeMegabytes = 0};
    listenAndSend(1);
    ASSERT_EQ(driver.toggleRecording(choice), "");
    for (int i = 0; i < 30; ++i) {
        listenAndSend(1);
        driver.tick();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const auto isBad = [](const model::TakeVerdict& one) {
        return one.state == model::TakeVerdict::State::Bad;
    };
    ASSERT_TRUE(tickUntil(driver, [&] { return isBad(driver.live().verdicts().all); }));
    EXPECT_EQ(driver.toggleRecording(choice), "");
    ASSERT_TRUE(tickUntil(driver, [&] {
        QFile file(folder.filePath("take.pcapng"));
        return file.open(QIODevice::ReadOnly) && file.readAll().contains("Posewire: received for ");
    }));
    ASSERT_EQ(openFile(driver, folder.filePath("take.pcapng")), "");
    EXPECT_TRUE(tickUntil(driver, [&] { return isBad(driver.session().verdicts().all); }))
        << driver.session().verdicts().all.text;
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
    const auto& comments = driver.session().annotations().comments;
    ASSERT_EQ(comments.size(), 1U);
    EXPECT_EQ(comments.begin()->first, 7U);
    EXPECT_EQ(comments.begin()->second, "a stumble\nask Mira");
}

TEST_F(SessionDriverTest, ATakeThatCannotBeginSaysWhy) {
    const QTemporaryDir folder;
    const RecordingChoice full{.folder = folder.path(), .freeMegabytes = INT_MAX};
    EXPECT_TRUE(driver.toggleRecording(full).contains("MB are free"));
    EXPECT_FALSE(driver.isRecording());
    EXPECT_TRUE(driver.toggleRecording({.folder = "/proc/none"}).contains("/proc/none"));
}

TEST_F(SessionDriverTest, AnnouncesAPauseOnce) {
    const QSignalSpy spy(&driver, &SessionDriver::pausedChanged);
    driver.setPaused(true);
    driver.setPaused(true);
    driver.setPaused(false);
    EXPECT_EQ(spy.count(), 2);
}

TEST_F(SessionDriverTest, ASelectionMovesTheViewAtTheNextTick) {
    driver.tick();
    const QSignalSpy spy(&driver, &SessionDriver::moved);
    driver.tick();
    EXPECT_EQ(spy.count(), 0);
    driver.select({});
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
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.live().end() == 50; }));
    const QSignalSpy shown(&driver, &SessionDriver::shownChanged);
    ASSERT_EQ(openFile(driver, writeFile(folder, 2000)), "");
    EXPECT_EQ(shown.count(), 1);
    EXPECT_TRUE(driver.isFileShown());
    EXPECT_TRUE(driver.isPaused()) << "by today's clock all of it would be old";
    EXPECT_EQ(driver.session().end(), 2000U);
    listenAndSend(50);
    EXPECT_TRUE(tickUntil(driver, [&] { return driver.live().end() == 100; }));
    EXPECT_EQ(driver.live().senders().size(), 1U);
    EXPECT_EQ(driver.live().cursor().mode, model::Cursor::Mode::Following);
    for (const model::Incident& incident : driver.live().incidents().all()) {
        EXPECT_NE(incident.kind, model::IncidentKind::Conflict) << incident.text();
    }
    driver.goLive();
    EXPECT_FALSE(driver.isPaused());
    EXPECT_EQ(driver.session().end(), 100U);
    driver.showFile();
    EXPECT_EQ(driver.session().end(), 2000U) << "it is still open";
}

TEST_F(SessionDriverTest, GoingLiveLetsGoOfThePacketThatIsHeldAndPlayingOnDoesNot) {
    listenAndSend(50);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.live().end() == 50; }));
    driver.setPaused(true);
    driver.selectPacket(42);
    driver.setPaused(false);
    EXPECT_EQ(driver.session().selection().packet, 42U);
    driver.goLive();
    EXPECT_FALSE(driver.session().selection().packet);
    EXPECT_FALSE(driver.isPaused());
}

TEST_F(SessionDriverTest, WhatIsAskedForIsDoneInTheSessionThatIsShown) {
    const QTemporaryDir folder;
    listenAndSend(10);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.live().end() == 10; }));
    ASSERT_EQ(openFile(driver, writeFile(folder, 20)), "");
    driver.setMarked(15, true);
    driver.setPaused(false); // a file stands still
    EXPECT_TRUE(driver.isPaused());
    EXPECT_TRUE(driver.session().annotations().marks.contains(15));
    EXPECT_TRUE(driver.live().annotations().marks.empty());
}

TEST_F(SessionDriverTest, ClosingAFileSaysSoBeforeItsSessionGoes) {
    const QTemporaryDir folder;
    ASSERT_EQ(openFile(driver, writeFile(folder, 20)), "");
    std::vector<std::string> order;
    QObject::connect(&driver, &SessionDriver::shownChanged, &driver, [&] {
        EXPECT_EQ(&driver.session(), &driver.live());
        order.emplace_back("shown");
    });
    QObject::connect(&driver, &SessionDriver::fileClosing, &driver, [&] {
        EXPECT_EQ(driver.file()->session().end(), 20U);
        order.emplace_back("closing");
    });
    driver.closeFile();
    EXPECT_THAT(order, testing::ElementsAre("shown", "closing"));
    EXPECT_EQ(driver.file(), nullptr);
    driver.showFile();
    EXPECT_FALSE(driver.isFileShown());
}

TEST_F(SessionDriverTest, AFileThatCannotBeReadIsNeverShown) {
    listenAndSend(10);
    QSignalSpy opened(&driver, &SessionDriver::fileOpened);
    const QSignalSpy shown(&driver, &SessionDriver::shownChanged);
    driver.openFile("/no/such/file");
    ASSERT_TRUE(tickUntil(driver, [&] { return opened.count() == 1; }));
    EXPECT_FALSE(opened[0][0].toBool());
    EXPECT_TRUE(opened[0][1].toString().contains("no such file"));
    EXPECT_EQ(shown.count(), 0);
    EXPECT_EQ(driver.file(), nullptr);
}

TEST_F(SessionDriverTest, AfterAResetOnlyWhatCameSinceCounts) {
    listenAndSend(10);
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.live().end() == 10; }));
    driver.resetForTake();
    EXPECT_EQ(driver.live().reset(), driver.live().now());
    ASSERT_TRUE(driver.live().range());
    EXPECT_EQ(driver.live().countsOf(driver.live().characters()[0].key, *driver.live().range()).samples, 0U);
    EXPECT_EQ(driver.live().streams()[0].accounting.counts().samples, 10U) << "what was received stays";
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
    ASSERT_EQ(opened.session().characters().size(), 1U);
    manual.advance(5s);
    opened.tick();
    for (const model::Incident& event : opened.session().incidents().all()) {
        EXPECT_NE(event.severity(), model::IncidentSeverity::Error) << event.text();
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
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.session().characters().size() == 1; }));
    EXPECT_EQ(driver.session().senders()[0].info.transport, log::Transport::Tcp);
    EXPECT_TRUE(driver.receiving().removePort(listening));
    EXPECT_FALSE(driver.receiving().removePort(listening));
    EXPECT_TRUE(driver.receiving().state().ports.empty());
}

TEST_F(SessionDriverTest, TheDemoGoesThroughARealSocket) {
    driver.receiving().addPort({"127.0.0.1", 0});
    driver.setDemo(2);
    EXPECT_TRUE(tickUntil(driver, [&] { return driver.session().characters().size() == 2; }));
    EXPECT_EQ(driver.session().senders()[0].info.transport, log::Transport::Udp);
    driver.setDemo(0);
    EXPECT_FALSE(driver.isDemoRunning());
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
    const QSignalSpy opened(&driver, &SessionDriver::fileOpened);
    driver.openFile(file.fileName());
    ASSERT_TRUE(tickUntil(driver, [&] { return driver.session().end() > 0; }));
    ASSERT_TRUE(driver.isOpening());
    driver.cancelOpening();
    EXPECT_FALSE(driver.isOpening());
    EXPECT_TRUE(driver.isPaused());
    ASSERT_EQ(opened.count(), 1);
    EXPECT_FALSE(opened[0][0].toBool());
    const std::uint64_t read = driver.session().end();
    EXPECT_LT(read, 20'000U);
    EXPECT_EQ(opened[0][1].toString(),
              QStringLiteral("Opening long.bin was stopped: %1 packets of it are here.").arg(read));
    EXPECT_EQ(driver.file()->notes(), QStringList(opened[0][1].toString())) << "said as long as it is open";
    driver.tick();
    EXPECT_EQ(driver.session().end(), read);
    driver.cancelOpening();
    EXPECT_EQ(opened.count(), 1) << "there is nothing to stop any more";
}

} // namespace
} // namespace posewire::gui
