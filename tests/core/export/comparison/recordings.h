// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/comparison/pose_comparison.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/roster.h"
#include "core/model/session/session.h"
#include "core/performer/performer.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace posewire::exporting {

using namespace std::chrono_literals;

/// What a performer sent, in a log of its own.
struct Recording {
    static constexpr log::Stamp kStart{1'700'000'000s};

    /// Changes a datagram; false leaves it out.
    using Change = std::function<bool(wire::Datagram&)>;

    /// Frames from `from` to before `to`; the first one comes at kStart.
    void perform(const performer::PerformerSettings& settings, std::uint64_t from, std::uint64_t to,
                 const Change& change = {}) {
        performer::Performer performer(settings);
        const log::Stamp begin = newest == log::Stamp() ? kStart : newest + 1s;
        for (std::uint64_t frame = from; frame < to; ++frame) {
            newest = begin + log::durationOf(static_cast<double>(frame - from) / settings.rateHz);
            for (wire::Datagram& datagram : performer.frame(frame)) {
                if (change && !change(datagram)) {
                    continue;
                }
                log::Arrival arrival;
                arrival.stamp = newest;
                arrival.sender = packets.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
                packets.writer().append(wire::encode(datagram).value(), arrival);
            }
        }
        packets.writer().publish();
        while (session.followFile(newest)) {
        }
    }

    [[nodiscard]] feed::PoseSource source(const model::TimeRange& range = model::kAllTime) const {
        std::vector<model::CharacterKey> keys;
        if (!session.atNow().roster().listed().empty()) {
            keys.push_back(session.atNow().roster().listed().front()->key);
        }
        return feed::poseSourceOf(session, range, keys);
    }
    [[nodiscard]] std::shared_ptr<const Timetable> timetable() const {
        auto table = Timetable::of(source(), {});
        EXPECT_TRUE(table.has_value());
        return std::make_shared<const Timetable>(std::move(*table));
    }

    static performer::PerformerSettings settings(double rateHz = 60) {
        performer::PerformerSettings settings;
        settings.characters = 1;
        settings.rateHz = rateHz;
        settings.types = {2, 12, 13};
        return settings;
    }

    log::PacketLog packets;
    model::Session session{packets};
    log::Stamp newest{};
};

[[nodiscard]] inline MotionComparison compare(const Recording& first, const Recording& second,
                                              const Alignment& alignment,
                                              model::DifferenceFrame frame = model::DifferenceFrame::World,
                                              const model::TimeRange& range = model::kAllTime) {
    const Partners partners(first.timetable(), second.timetable(), alignment);
    const feed::PoseSource one = first.source(range);
    const feed::PoseSource other = second.source();
    const auto result = compareMotion({one, other, partners, frame}, {});
    EXPECT_TRUE(result.has_value());
    return *result;
}

} // namespace posewire::exporting
