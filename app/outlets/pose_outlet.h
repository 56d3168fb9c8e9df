// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/outlets/outlet.h"
#include "core/feed/pose_feed.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace posewire::outlets {

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

/// A name as part of an address or a frame: "_" for all but ASCII letters, digits, "-" and ".".
[[nodiscard]] std::string plainName(std::string name);

/// Hands the poses of all characters to a writer as they are received.
class PoseOutlet final : public Outlet {
public:
    /// Samples are this late at most: as long as the viewport waits for late ones.
    static constexpr log::Duration kWait = std::chrono::milliseconds(50);

    /// From the newest packet of the log on. Log and clock must outlive it; the error is that of the writer.
    [[nodiscard]] static net::NetResult<std::unique_ptr<PoseOutlet>>
    start(const log::PacketLog& log, const log::Clock& clock, const MakeWriter& make);
    ~PoseOutlet() override;
    PoseOutlet(const PoseOutlet&) = delete;
    PoseOutlet& operator=(const PoseOutlet&) = delete;

    void update(const model::SessionView& session) override;
    [[nodiscard]] OutletState state() const override;

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
