// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"
#include "core/model/session/session.h"
#include "core/model/session/verdict.h"
#include "core/performer/performer.h"
#include "tests/support/facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace posewire::model {

using namespace std::chrono_literals;

/// Changes a datagram on its way.
using ContentChange = std::function<void(wire::Datagram&)>;

/// A session that is sent a performance, changed on its way: what it finds wrong with the content.
class ContentTest : public testing::Test {
protected:
    ContentTest() {
        m_settings.characters = 1;
        m_settings.rateHz = 60;
        m_settings.types = {2, 12, 13};
    }

    /// All datagrams of the next seconds; frames that are changed go on from where they stopped.
    void perform(double seconds, const ContentChange& change = {}) {
        performer::Performer performer(m_settings);
        const auto frames = static_cast<std::uint64_t>(seconds * m_settings.rateHz);
        for (std::uint64_t end = m_frame + frames; m_frame < end; ++m_frame) {
            for (wire::Datagram& datagram : performer.frame(m_frame)) {
                if (change) {
                    change(datagram);
                }
                send(*wire::encode(datagram), stampOf(m_frame));
            }
        }
        m_session.follow(m_now);
    }
    void send(wire::Bytes bytes, log::Stamp stamp, const char* address = "127.0.0.1:40001") {
        log::Arrival arrival;
        arrival.stamp = m_now = stamp;
        arrival.sender = m_log.senders().intern({address, log::Transport::Udp, 9763});
        m_log.writer().append(bytes, arrival);
        m_log.writer().publish();
    }
    [[nodiscard]] log::Stamp stampOf(std::uint64_t frame) const {
        return log::Stamp(100s) + log::durationOf(static_cast<double>(frame) / m_settings.rateHz);
    }

    /// All of one fault, also those that are over.
    std::vector<Incident> of(ContentFault fault) { return of(IncidentKind::Content, fault); }
    std::vector<Incident> of(IncidentKind kind, ContentFault fault = ContentFault::None) {
        std::vector<Incident> found;
        std::ranges::copy_if(m_session.verdicts().incidents().all(), std::back_inserter(found),
                             [&](const Incident& one) { return one.kind == kind && one.what == fault; });
        return found;
    }
    /// One for each incident about content or scale, for a test to say what there should not be.
    std::vector<std::string> told() {
        std::vector<std::string> all;
        for (const Incident& one : m_session.verdicts().incidents().all()) {
            if (one.kind == IncidentKind::Content || one.kind == IncidentKind::Scale) {
                all.push_back(std::string(factsOf(one.what).word) + ": " +
                              say(one.fact(), words::Form::Sentence));
            }
        }
        return all;
    }
    TakeVerdict verdict() { return verdictOf(m_session, recentSpan(m_session)); }
    /// The one that there is, and all that there is.
    Incident only(ContentFault fault) {
        EXPECT_EQ(told().size(), 1U) << testing::PrintToString(told());
        const auto found = of(fault);
        EXPECT_EQ(found.size(), 1U) << factsOf(fault).word;
        return found.empty() ? Incident() : found.front();
    }

    performer::PerformerSettings m_settings;
    std::uint64_t m_frame = 0;
    log::PacketLog m_log;
    Session m_session{m_log};
    log::Stamp m_now{};
};

/// Changes the segments of whole poses.
inline ContentChange ofSegments(const std::function<void(std::vector<wire::SegmentQuaternion>&)>& change) {
    return [change](wire::Datagram& datagram) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            change(pose->segments);
        }
    };
}
inline ContentChange ofEach(const std::function<void(wire::SegmentQuaternion&)>& change) {
    return ofSegments([change](auto& segments) { std::ranges::for_each(segments, change); });
}

} // namespace posewire::model
