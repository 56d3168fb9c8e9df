// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"
#include "core/log/time.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/reference_body.h"
#include "core/model/session/session.h"
#include "tests/support/facts.h"

#include <gtest/gtest.h>

namespace posewire::model {

using namespace std::chrono_literals;

/// A log to which tests send datagrams at stamps of their choosing, and a session that follows it.
class SessionTest : public testing::Test {
protected:
    static constexpr log::Stamp at(log::Duration time) { return log::Stamp(time); }

    log::SenderId sender(const std::string& address = "127.0.0.1:40001") {
        return m_log.senders().intern({address, log::Transport::Udp, 9763});
    }

    void sendBytes(wire::Bytes bytes, log::Stamp stamp, const std::string& address = "127.0.0.1:40001") {
        log::Arrival arrival;
        arrival.stamp = stamp;
        arrival.sender = sender(address);
        arrival.flags.isFromBefore = m_isFromBefore;
        m_log.writer().append(bytes, arrival);
        m_log.writer().publish();
        m_now = stamp;
    }

    void send(wire::Body body, std::uint32_t sample, log::Stamp stamp, std::uint8_t datagramCounter = 0x80) {
        wire::Datagram datagram;
        datagram.body = std::move(body);
        datagram.header.sampleCounter = sample;
        datagram.header.datagramCounter = datagramCounter;
        datagram.header.timeCode = static_cast<std::uint32_t>(stamp.time_since_epoch() / 1ms);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        const auto bytes = wire::encode(datagram);
        ASSERT_TRUE(bytes.has_value());
        sendBytes(*bytes, stamp);
    }

    void follow() { m_session.follow(m_now); }

    /// Never twice the same, as living bodies are.
    static wire::PoseQuaternion swayingAt(float x, std::uint32_t sample) {
        return standingAt(x + 1e-6F * static_cast<float>(1 + sample % 1000));
    }

    /// A character whose pelvis is at (x, 0, 1), everything else as in the reference null pose.
    static wire::PoseQuaternion standingAt(float x) {
        wire::PoseQuaternion pose;
        std::uint32_t id = 0;
        for (const Eigen::Vector3d& origin : referenceOrigins()) {
            const auto floats = toFloats(origin);
            pose.segments.push_back({++id, {floats[0] + x, floats[1], floats[2]}, {1, 0, 0, 0}});
        }
        return pose;
    }

    CharacterKey key() { return {sender(), 0}; }

    log::PacketLog m_log;
    Session m_session{m_log};
    log::Stamp m_now{};
    bool m_isFromBefore = false; ///< what is sent
};

} // namespace posewire::model
