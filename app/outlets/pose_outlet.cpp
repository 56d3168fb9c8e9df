// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/pose_outlet.h"

#include "core/log/log_reader.h"
#include "core/model/session/roster.h"

#include <QEventLoop>

#include <algorithm>
#include <cctype>
#include <future>
#include <utility>
#include <vector>

namespace posewire::outlets {

std::string plainName(std::string name) {
    std::ranges::replace_if(
        name, [](unsigned char c) { return c > 0x7f || (std::isalnum(c) == 0 && c != '-' && c != '.'); },
        '_');
    return name;
}

PoseOutlet::PoseOutlet(const log::PacketLog& log, const log::Clock& clock) : m_log(log), m_clock(clock) {}

PoseOutlet::~PoseOutlet() {
    {
        const std::lock_guard lock(m_mutex);
        m_isStopping = true;
    }
    m_wake.notify_all();
    m_thread.join();
}

net::NetResult<std::unique_ptr<PoseOutlet>>
PoseOutlet::start(const log::PacketLog& log, const log::Clock& clock, const MakeWriter& make) {
    std::unique_ptr<PoseOutlet> outlet(new PoseOutlet(log, clock));
    std::promise<net::NetResult<void>> made;
    outlet->m_thread = std::thread([&outlet = *outlet, &made, make] {
        outlet.run(make, [&made](net::NetResult<void> result) { made.set_value(std::move(result)); });
    });
    if (auto result = made.get_future().get(); !result) {
        return tl::unexpected(std::move(result.error()));
    }
    return outlet;
}

void PoseOutlet::update(const model::SessionView& session) {
    std::vector<model::CharacterKey> keys;
    for (const model::Character* one : session.roster().listed()) {
        keys.push_back(one->key);
    }
    feed::PoseSource source = feed::poseSourceOf(session, model::kAllTime, keys);
    source.endPacket = session.end();
    {
        const std::lock_guard lock(m_mutex);
        m_newest = std::move(source);
    }
    m_wake.notify_all();
}

OutletState PoseOutlet::state() const {
    const std::lock_guard lock(m_mutex);
    return m_state;
}

/// Returns what update() was given last; nothing after a while, so that Qt's events are processed.
std::optional<feed::PoseSource> PoseOutlet::await() {
    constexpr std::chrono::milliseconds kLongest{10};
    std::unique_lock lock(m_mutex);
    m_wake.wait_for(lock, kLongest, [this] { return m_isStopping || m_newest; });
    return std::exchange(m_newest, {});
}

void PoseOutlet::run(const MakeWriter& make, const std::function<void(net::NetResult<void>)>& tell) {
    QEventLoop events;
    auto writer = make(m_log);
    const auto publish = [&](std::uint64_t poses, std::uint64_t missed) {
        OutletState state;
        state.poses = poses;
        state.missed = missed;
        (*writer)->tell(state);
        const std::lock_guard lock(m_mutex);
        m_state = std::move(state);
        return m_isStopping;
    };
    if (!writer) {
        tell(tl::unexpected(writer.error()));
        return;
    }
    publish(0, 0);
    const std::uint64_t first = log::LogReader(m_log).end();
    feed::PoseFeed feed({&m_log, first, UINT64_MAX, {}}, feed::PoseContent::Segments, kWait);
    feed.update({&m_log, first, first, {}}); // reads no packet before the first update()
    tell({});
    std::uint64_t poses = 0;
    const feed::TakePose take = [&](const feed::PoseSample& sample) {
        (*writer)->take(feed.characterOf(sample), sample);
        ++poses;
    };
    for (bool isStopping = false; !isStopping;) {
        if (auto newest = await()) {
            feed.update(std::move(*newest));
        }
        while (feed.advance(take, m_log.timeline().now(m_clock))) {
        }
        events.processEvents();
        isStopping = publish(poses, feed.missed());
    }
}

} // namespace posewire::outlets
