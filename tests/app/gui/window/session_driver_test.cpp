// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/session_driver.h"

#include "app/net/datagram_sender.h"
#include "app/net/udp_binding.h"
#include "tests/app/gui/models/stage.h"

#include <QSignalSpy>

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

class SessionDriverTest : public testing::Test {
protected:
    void listenAndSend(std::uint64_t frames) {
        if (driver.receiving().openPort() == 0) {
            driver.receiving().addPort({"127.0.0.1", 0});
        }
        if (!m_sender) {
            auto sender = net::DatagramSender::connect(
                {{{"127.0.0.1", driver.receiving().openPort()}, net::SendTarget::Transport::Udp}});
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
    auto holder = net::bindUdp({{"127.0.0.1", 0}, {}}, 1 << 16);
    ASSERT_TRUE(holder);
    const std::uint16_t port = holder->front()->localPort();
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

TEST_F(SessionDriverTest, TheDemoGoesThroughARealSocket) {
    driver.receiving().addPort({"127.0.0.1", 0});
    driver.setDemo(2);
    EXPECT_TRUE(tickUntil(driver, [&] { return driver.session().characters().size() == 2; }));
    EXPECT_EQ(driver.session().sources()[0].info.transport, log::Transport::Udp);
    driver.setDemo(0);
    EXPECT_FALSE(driver.isDemoRunning());
}

} // namespace
} // namespace posewire::gui
