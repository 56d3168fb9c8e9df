// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/replaying.h"

#include "app/gui/base/background.h"

#include <algorithm>
#include <utility>

namespace posewire::gui {

QString Replaying::start(const ReplayRequest& request, const model::SessionView& view) {
    net::ReplayChoice choice;
    choice.target = request.target;
    choice.speed = std::clamp(request.speed, net::ReplayChoice::kSlowest, net::ReplayChoice::kFastest);
    choice.isLooping = request.isLooping;
    choice.begin = view.begin();
    choice.end = view.end();
    if (request.range) {
        choice.begin = view.packetFrom(request.range->from);
        choice.end = view.packetFrom(request.range->to);
    }
    if (choice.begin >= choice.end) {
        return tr("There is no packet to send.");
    }
    stop();
    m_log = &view.log();
    m_replay = std::make_unique<net::Replay>(view.log(), m_clock, std::move(choice));
    return {};
}

void Replaying::stop() {
    std::erase_if(m_ending, [](const Ending& one) { return isReady(one.end); });
    if (m_replay != nullptr) { // a connection may take seconds to be given up
        m_ending.push_back({m_log, std::async(std::launch::async,
                                              [last = std::move(m_replay)]() mutable { last.reset(); })});
    }
}

void Replaying::endOf(const log::PacketLog& log) {
    if (m_log == &log) {
        stop();
    }
    std::erase_if(m_ending, [&log](const Ending& one) { return one.log == &log; }); // each waits
}

} // namespace posewire::gui
