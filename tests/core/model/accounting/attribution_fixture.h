// SPDX-License-Identifier: MIT
#pragma once

#include "tests/core/model/session/session_fixture.h"

#include "core/model/accounting/attribution.h"
#include "core/model/session/accounts.h"

namespace posewire::model {

/// Streams of one sender at 250 Hz, of which single datagrams fail to come.
class AttributionTest : public SessionTest {
protected:
    struct Sent {
        std::uint8_t type = 2;
        std::uint32_t drops = 0;
        log::Transport transport = log::Transport::Udp;
        bool isTruncated = false;
        std::uint8_t datagramCounter = 0x80;
        bool afterClosed = false;
        const char* address = "127.0.0.1:40001";
        const char* probe = "";
        bool isLostOnWay = false;
        bool dropsUncounted = false;
    };

    void put(std::uint32_t sample, const Sent& sent) {
        wire::Datagram datagram;
        if (sent.type == 2) {
            datagram.body = wire::PoseQuaternion{{{1, {0, 0, 1}, {1, 0, 0, 0}}}};
        } else if (sent.type == 25) {
            datagram.body = wire::TimeCode{};
        } else {
            datagram.body = wire::CentreOfMass{};
        }
        datagram.header.sampleCounter = sample;
        datagram.header.timeCode = static_cast<std::uint32_t>(m_at.time_since_epoch() / 1ms);
        datagram.header.datagramCounter = sent.datagramCounter;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        auto bytes = *wire::encode(datagram);
        if (sent.isTruncated) {
            bytes.resize(bytes.size() - 4);
        }
        log::Arrival arrival;
        arrival.stamp = m_at;
        arrival.sender = m_log.senders().intern({sent.address, sent.transport, 9763, sent.probe});
        arrival.kernelDropsBefore = sent.drops;
        arrival.flags.afterClosed = sent.afterClosed;
        arrival.flags.isLostOnWay = sent.isLostOnWay;
        arrival.flags.dropsUncounted = sent.dropsUncounted;
        m_log.writer().append(bytes, arrival);
        m_log.writer().publish();
        m_now = m_at;
    }
    void frames(std::uint32_t first, std::uint32_t last) { frames(first, last, Sent()); }
    void frames(std::uint32_t first, std::uint32_t last, const Sent& sent) {
        for (std::uint32_t sample = first; sample <= last; ++sample, m_at += 4ms) {
            put(sample, sent);
        }
    }
    /// 200 samples of two streams fail to come; `next`: what comes first after them.
    void silentInBothStreams(const Sent& next) {
        for (std::uint32_t sample = 1; sample <= 400; ++sample, m_at += 4ms) {
            if (sample <= 100 || sample > 300) {
                put(sample, sample == 301 ? next : Sent());
                put(sample, {.type = 24});
            }
        }
        follow();
    }
    static words::Fact factOf(const Gap& gap) { return gap.evidenceFact(gap.mainCause()); }
    const Gap& onlyGap() {
        follow();
        EXPECT_EQ(m_session.accounts().attribution().gaps().size(), 1U);
        return m_session.accounts().attribution().gaps().front();
    }

    log::Stamp m_at{10s};
};

} // namespace posewire::model
