// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/replay.h"
#include "core/model/session/session_view.h"

#include <QCoreApplication>
#include <QString>

#include <future>
#include <memory>
#include <vector>

namespace posewire::gui {

/// Packets that the operator wants to be sent again.
struct ReplayRequest {
    net::SendTarget target;
    double speed = 1;
    bool isLooping = false;
    std::optional<model::TimeRange> range{}; ///< nothing for all there is
};

/// Sends what a session shows to the network again, one replay at a time. The window waits for none that
/// ends.
class Replaying {
    Q_DECLARE_TR_FUNCTIONS(Replaying)

public:
    explicit Replaying(const log::Clock& clock) : m_clock(clock) {}

    /// Ends the one before. Returns why it cannot begin; empty if it does.
    QString start(const ReplayRequest& request, const model::SessionView& view);
    void stop();
    /// Ends what is sent of a log that is about to go, and waits until it is not read any more.
    void endOf(const log::PacketLog& log);

    /// Null before the first, and after one was stopped.
    [[nodiscard]] const net::Replay* current() const { return m_replay.get(); }

private:
    struct Ending {
        const log::PacketLog* log;
        std::future<void> end;
    };

    const log::Clock& m_clock;
    const log::PacketLog* m_log = nullptr; ///< that the replay is of
    std::unique_ptr<net::Replay> m_replay;
    std::vector<Ending> m_ending;
};

} // namespace posewire::gui
