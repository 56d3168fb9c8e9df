// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"

#include "app/net/datagram_sender.h"
#include "app/net/listening.h"
#include "tests/app/gui/models/stage.h"
#include "tests/support/manual_clock.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
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

TEST_F(SessionDriverTest, AFileIsOpenedWhileThePortGoesOnReceiving) {
    QTemporaryDir folder;
    const QString path = folder.filePath("take.bin");
    {
        QFile file(path);
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        performer::Performer other{sending(1, {2})};
        for (std::uint64_t frame = 0; frame < 2000; ++frame) {
            for (const wire::Datagram& datagram : other.frame(frame)) {
                const auto bytes = *wire::encode(datagram);
                file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<qint64>(bytes.size()));
            }
        }
    }
    listenAndSend(50);
    ASSERT_EQ(openFile(driver, path), "");
    EXPECT_TRUE(driver.isPaused());
    EXPECT_EQ(driver.receiving().state().file, "take.bin");
    listenAndSend(50);
    const auto datagrams = [&](log::Transport transport) {
        std::uint64_t count = 0;
        for (const model::Sender& sender : driver.session().senders()) {
            count += sender.info.transport == transport ? sender.datagrams : 0;
        }
        return count;
    };
    EXPECT_TRUE(tickUntil(driver, [&] { return datagrams(log::Transport::Udp) == 100; }));
    EXPECT_EQ(datagrams(log::Transport::File), 2000U);
    EXPECT_EQ(driver.session().senders().size(), 2U);
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
              QStringLiteral("Opening long.bin was stopped; %1 packets of it were read.").arg(read));
    driver.tick();
    EXPECT_EQ(driver.session().end(), read);
    driver.cancelOpening();
    EXPECT_EQ(opened.count(), 1) << "there is nothing to stop any more";
}

} // namespace
} // namespace posewire::gui
