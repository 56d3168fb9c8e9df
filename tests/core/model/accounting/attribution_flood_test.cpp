// SPDX-License-Identifier: MIT
#include "core/log/packet_log.h"
#include "core/model/accounting/attribution.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/model/session/session.h"

#include <gtest/gtest.h>

#include <random>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

/// One stream at 100,000 samples a second: what it remembers of its samples is gone in 41 ms, long before
/// late arrivals have had their time.
class FloodTest : public testing::Test {
protected:
    static constexpr log::Duration kPeriod = 10us;

    void put(std::uint32_t sample, std::uint32_t drops, log::Duration late = {}) {
        m_datagram.header.sampleCounter = sample;
        m_datagram.header.datagramCounter = 0x80;
        wire::completeHeader(m_datagram, wire::HeaderEra::Counted);
        m_log.writer().append(*wire::encode(m_datagram), {.stamp = log::Stamp(100s) + sample * kPeriod + late,
                                                          .sender = m_sender,
                                                          .kernelDropsBefore = drops});
    }
    const Stream& follow() {
        m_log.writer().publish();
        m_session.follow(log::Stamp(1'000s));
        return m_session.roster().streams().front();
    }
    std::uint64_t lostHere(const Stream& stream) const {
        return stream.lostByCause()[static_cast<std::size_t>(LossCause::ThisComputer)];
    }

    log::PacketLog m_log;
    Session m_session{m_log};
    log::SenderId m_sender = m_log.senders().intern({"10.0.0.1:1", log::Transport::Udp, 9763});
    wire::Datagram m_datagram{{}, wire::CentreOfMass{}, {}};
};

TEST_F(FloodTest, EverySampleThatTheSocketDroppedIsThisComputers) {
    std::mt19937 random(7);
    std::uint32_t dropped = 0;
    std::uint32_t sampleAfter = 1;
    for (std::uint32_t sample = 1; sample <= 100'000; sampleAfter = sample) {
        const auto lost =
            static_cast<std::uint32_t>(sample > 1 && random() % 50 == 0 ? 1 + random() % 40 : 0);
        sample += lost;
        dropped += lost;
        put(sample, lost);
        ++sample;
    }
    put(sampleAfter, 0, 1s); // so that what came last is judged
    const Stream& stream = follow();
    EXPECT_EQ(stream.accounting.counts().lost, dropped);
    EXPECT_EQ(lostHere(stream), dropped);
}

TEST_F(FloodTest, WhatIsKnownOfAGapStaysWhenItsSamplesAreForgotten) {
    for (std::uint32_t sample = 1; sample <= 50'000; ++sample) {
        if (sample != 1'001 && sample != 1'002) {
            put(sample, sample == 1'003 ? 2 : 0);
        }
    }
    EXPECT_EQ(lostHere(follow()), 2U);
    // A new step makes every gap be counted again.
    for (std::uint32_t sample = 50'002; sample <= 52'000; sample += 2) {
        put(sample, 0);
    }
    EXPECT_EQ(lostHere(follow()), 2U);
    EXPECT_EQ(m_session.accounts().attribution().gaps().front().lost, 2U);
}

} // namespace
} // namespace posewire::model
