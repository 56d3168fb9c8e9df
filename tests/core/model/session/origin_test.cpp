// SPDX-License-Identifier: MIT
#include "core/model/session/origin.h"

#include "core/model/incidents/incident_follower.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/wire/codec.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

/// The same address at two places, as behind two routers: each lacks samples 11 and 12, and the computer of
/// the first has dropped them.
class OriginTest : public testing::Test {
protected:
    OriginTest() {
        for (std::uint32_t sample = 1; sample <= 40; ++sample) {
            if (sample < 11 || sample > 12) {
                receive(m_origins[0], sample, sample == 13 ? 2 : 0);
                receive(m_origins[1], sample, 0);
            }
        }
        for (Origin& origin : m_origins) {
            origin.session().followFile(m_at);
            origin.session().endFile();
        }
    }

    void receive(Origin& origin, std::uint32_t sample, std::uint32_t drops) {
        wire::Datagram datagram;
        datagram.body = wire::PoseQuaternion{{{1, {0, 0, 1}, {1, 0, 0, 0}}}};
        datagram.header.sampleCounter = sample;
        datagram.header.datagramCounter = 0x80;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        m_at = log::Stamp(sample * 10ms);
        const log::SenderInfo info{"192.168.1.20:51000", log::Transport::Udp, 9763};
        origin.log().writer().append(
            *wire::encode(datagram),
            {.stamp = m_at, .sender = origin.log().senders().intern(info), .kernelDropsBefore = drops});
        origin.log().writer().publish();
    }

    [[nodiscard]] static std::uint64_t lostBy(const Origin& origin, LossCause cause) {
        const Stream& stream = *origin.session().roster().streams().begin();
        return stream.lostByCause()[static_cast<std::size_t>(cause)];
    }

    std::array<Origin, 2> m_origins;
    log::Stamp m_at{};
};

TEST_F(OriginTest, EqualAddressesAreTwoSenders) {
    for (const Origin& origin : m_origins) {
        EXPECT_EQ(origin.session().roster().senders().size(), 1U);
        EXPECT_EQ(origin.session().roster().streams().begin()->accounting.counts().samples, 38U);
    }
}

TEST_F(OriginTest, DropsExplainNoGapOfAnother) {
    EXPECT_EQ(lostBy(m_origins[0], LossCause::ThisComputer), 2U);
    EXPECT_EQ(lostBy(m_origins[1], LossCause::ThisComputer), 0U);
    EXPECT_EQ(lostBy(m_origins[1], LossCause::Unknown), 2U);
    EXPECT_EQ(m_origins[1].session().accounts().allSenders().kernelDrops, 0U);
}

} // namespace
} // namespace posewire::model
