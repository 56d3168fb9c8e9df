// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/follow_watch.h"

#include "app/outlets/follow.h"

#include <utility>

namespace posewire::cli {
namespace {

std::string countText(std::uint64_t count, const std::string& one) {
    return std::to_string(count) + ' ' + one + (count == 1 ? "" : "s");
}

} // namespace

bool FollowWatch::start(const MonitorOptions& options, const log::Clock& clock) {
    if (options.follow.empty()) {
        return true;
    }
    outlets::MakeWriter make;
    if (options.follow != "-") {
        make = outlets::followAt(options.follow);
    } else {
        m_lines.emplace(system::kStandardOutput, false);
        make = outlets::followInto([&lines = *m_lines](std::string line) {
            const bool hasRoom = lines.hasRoom();
            if (hasRoom) {
                lines.add(std::move(line), false);
            }
            return hasRoom;
        });
    }
    auto started = outlets::PoseOutlet::start(m_run.log(), clock, make);
    if (!started) {
        m_console.complain("--to: " + started.error().text);
        return false;
    }
    m_outlet = std::move(*started);
    if (!m_lines) {
        m_console.complain("poses are at " + m_outlet->state().place);
    }
    return true;
}

void FollowWatch::look() {
    if (m_outlet != nullptr) {
        m_outlet->update(m_run.session());
    }
}

void FollowWatch::end() {
    if (m_outlet == nullptr) {
        return;
    }
    const outlets::OutletState state = m_outlet->state();
    m_outlet.reset();
    if (m_lines) {
        m_lines->finish(system::Interruption::hasCome);
    }
    m_console.complain(countText(state.poses, "pose") + ", " + countText(state.sent, "line") + " sent" +
                       (state.skipped == 0 ? std::string()
                                           : ", " + countText(state.skipped, "line") +
                                                 " left out: those before had not been read"));
    if (state.missed != 0) {
        m_console.complain(countText(state.missed, "packet") +
                           " came faster than poses could be made of them");
    }
}

} // namespace posewire::cli
