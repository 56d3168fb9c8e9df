// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/verdict.h"
#include "tests/core/model/session/session_fixture.h"

#include <algorithm>
#include <string>
#include <vector>

namespace posewire::model {

/// A session that is sent poses 10 ms apart, and its events.
class IncidentsTest : public SessionTest {
protected:
    void pose(std::uint32_t sample, const std::string& address = "127.0.0.1:40001") {
        wire::Datagram datagram;
        datagram.body = swayingAt(0, sample);
        datagram.header.sampleCounter = sample;
        datagram.header.character = m_character;
        datagram.header.timeCode =
            static_cast<std::uint32_t>((m_at + m_timeCodeOff).time_since_epoch() / 1ms);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, address);
    }
    void poses(std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t sample = first; sample <= last; ++sample, m_at += 10ms) {
            pose(sample);
        }
    }
    /// The same with a time code that stands still.
    void posesOfOneTimeCode(std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t sample = first; sample <= last; ++sample, m_at += 10ms) {
            m_timeCodeOff -= 10ms;
            pose(sample);
        }
    }
    void name(const std::string& who, const std::string& address = "127.0.0.1:40001") {
        wire::Datagram datagram{{}, wire::MetaData{true, "name:" + who + "\n"}, {}};
        datagram.header.character = m_character;
        datagram.header.datagramCounter = 0x80;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, address);
    }
    std::vector<Incident> of(IncidentKind kind) {
        follow();
        std::vector<Incident> found;
        std::ranges::copy_if(m_session.verdicts().incidents().all(), std::back_inserter(found),
                             [&](const Incident& event) { return event.kind == kind; });
        return found;
    }
    log::Stamp m_at{100s};
    log::Duration m_timeCodeOff{};
    std::uint8_t m_character = 0; ///< whose poses
};

} // namespace posewire::model
