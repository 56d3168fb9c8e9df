// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include "tests/core/model/incidents/incidents_fixture.h"

#include <algorithm>
#include <array>
#include <functional>

namespace posewire::model {

/// A session that is sent poses 10 ms apart, and what an operator is told of it.
class VerdictTest : public IncidentsTest {
protected:
    using Kind = words::Kind;
    using Names = std::vector<std::string>;

    TakeVerdict verdict() {
        follow();
        return verdictOf(m_session, recentSpan(m_session));
    }
    TakeVerdict verdictAfter(log::Duration silence) {
        follow();
        m_session.follow(m_at - 10ms + silence);
        return verdictOf(m_session, recentSpan(m_session));
    }
    /// The same as pose(), of the character with the ID 1.
    void poseOfOther(std::uint32_t sample, const std::string& address = "127.0.0.1:40001") {
        wire::Datagram datagram{{}, swayingAt(0, sample), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.character = 1;
        datagram.header.timeCode = static_cast<std::uint32_t>(m_at.time_since_epoch() / 1ms);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, address);
    }
    TakeVerdict verdictOn(std::uint8_t character) {
        follow();
        return verdictOf(m_session, recentSpan(m_session), CharacterKey{sender(), character});
    }
    /// The reason of a verdict.
    static words::Fact reasonOf(const TakeVerdict& verdict) { return partOf(verdict.said, "reason"); }
    static words::Told toldBy(const TakeVerdict& verdict) { return toldIn(reasonOf(verdict)); }
    words::Told reason() { return toldBy(verdict()); }
    /// Whether a verdict is about a loss.
    static bool isOfLoss(const TakeVerdict& verdict) {
        const words::Kind kind = reasonOf(verdict).kind;
        return kind == words::Kind::Loss || kind == words::Kind::LostHere;
    }

    /// What incidents say was lost, by cause.
    std::array<std::uint64_t, kLossCauses> told() {
        std::array<std::uint64_t, kLossCauses> sums{};
        for (const ListedIncident& one : listedIncidents(m_session)) {
            sums[static_cast<std::size_t>(one.incident.cause.value_or(LossCause::Unknown))] +=
                one.incident.samples;
        }
        return sums;
    }
    std::array<std::uint64_t, kLossCauses> lost() {
        std::array<std::uint64_t, kLossCauses> sums{};
        for (const Stream& stream : m_session.roster().streams()) {
            const auto own = stream.lostByCause();
            std::transform(sums.begin(), sums.end(), own.begin(), sums.begin(), std::plus());
        }
        return sums;
    }
};

} // namespace posewire::model
