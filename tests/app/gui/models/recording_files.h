// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"
#include "tests/app/gui/models/stage.h"

namespace posewire::gui {

/// Writes frames [from, to) of a performer to a file, the first one at Stage::kStart; `change` may alter what
/// is sent. Returns the path.
inline QString recordFrames(const QString& path, performer::Performer& performer, std::uint64_t from,
                            std::uint64_t to, const std::function<void(wire::Datagram&)>& change = {}) {
    auto sink = log::createFile(path.toStdString()).value();
    log::PcapngWriter writer(*sink);
    EXPECT_TRUE(writer.begin({}));
    for (std::uint64_t frame = from; frame < to; ++frame) {
        const double seconds = static_cast<double>(frame - from) / performer.settings().rateHz;
        const log::Stamp at = Stage::kStart + log::durationOf(seconds);
        for (wire::Datagram& datagram : performer.frame(frame)) {
            if (change) {
                change(datagram);
            }
            const auto bytes = wire::encode(datagram).value();
            EXPECT_TRUE(writer.add({0, at, {}, 0, {}, bytes}, {"10.0.0.2:4000", log::Transport::Udp, 9763}));
        }
    }
    EXPECT_TRUE(writer.addStatistics());
    EXPECT_TRUE(sink->flush());
    return path;
}

/// Moves a segment of poses of type 02 up, in metres.
inline void raise(wire::Datagram& datagram, std::size_t segment, float metres) {
    if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
        pose->segments[segment].position[2] += metres;
    }
}

} // namespace posewire::gui
