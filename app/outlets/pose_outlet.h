// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "core/feed/pose_feed.h"
#include "core/log/clock.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace posewire::outlets {

struct OutletState {
    std::string place;         ///< where others find it
    std::size_t receivers = 0; ///< now
    std::uint64_t poses = 0;   ///< handed to the writer
    std::uint64_t sent = 0;    ///< lines or datagrams, of all receivers
    std::uint64_t skipped = 0; ///< of them, left out for receivers that did not read in time
    std::uint64_t missed = 0;  ///< packets that the log had dropped before the outlet read them
};

/// Writes poses in one form. Made, used and destroyed on the outlet's thread, which processes Qt's events.
class PoseWriter {
public:
    virtual ~PoseWriter() = default;
    /// Never waits for a receiver.
    virtual void take(const feed::PoseCharacter& character, const feed::PoseSample& sample) = 0;
    /// Fills in all but `poses` and `missed`.
    virtual void tell(OutletState& state) const = 0;
};
using MakeWriter = std::function<net::NetResult<std::unique_ptr<PoseWriter>>(const log::PacketLog& log)>;

/// Hands the poses of all characters to a writer as they are received, on a thread of its own: receiving
/// never waits for it.
class PoseOutlet {
public:
    /// Samples are this late at most: as long as the viewport waits for late ones.
    static constexpr log::Duration kWait = std::chrono::milliseconds(50);

    /// From the newest packet of the log on. Log and clock must outlive it; the error is that of the writer.
    [[nodiscard]] static net::NetResult<std::unique_ptr<PoseOutlet>>
    start(const log::PacketLog& log, const log::Clock& clock, const MakeWriter& make);
    ~PoseOutlet();
    PoseOutlet(const PoseOutlet&) = delete;
    PoseOutlet& operator=(const PoseOutlet&) = delete;

    /// Poses are of the characters as this session knows them, up to where it has followed the log. From the
    /// thread that has it follow, again and again.
    void update(const model::SessionView& session);
    [[nodiscard]] OutletState state() const;

private:
    PoseOutlet(const log::PacketLog& log, const log::Clock& clock);
    void run(const MakeWriter& make, const std::function<void(net::NetResult<void>)>& tell);
    [[nodiscard]] std::optional<feed::PoseSource> await();

    const log::PacketLog& m_log;
    const log::Clock& m_clock;
    mutable std::mutex m_mutex; ///< guards what follows
    std::condition_variable m_wake;
    std::optional<feed::PoseSource> m_newest;
    OutletState m_state;
    bool m_isStopping = false;
    std::thread m_thread;
};

} // namespace posewire::outlets
