// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/outlet_watch.h"

#include "app/outlets/follow.h"

#include <utility>

namespace posewire::cli {
namespace {

std::string countText(std::uint64_t count, std::string_view one) {
    return std::to_string(count) + ' ' + std::string(one) + (count == 1 ? "" : "s");
}

} // namespace

net::NetResult<std::unique_ptr<outlets::Outlet>> OutletWatch::started(const outlets::OutletChoice& choice,
                                                                      const outlets::OutletPlace& place) {
    if (choice.place.empty()) {
        return net::netError(net::NetError::Kind::BadEndpoint, "write HOST:PORT of the receiver");
    }
    if (choice.place != "-" || m_kind->place != "-") {
        return m_kind->start(choice, place);
    }
    m_lines.emplace(system::kStandardOutput, false);
    return outlets::PoseOutlet::start(place.log, place.clock,
                                      outlets::followInto([&lines = *m_lines](std::string line) {
                                          const bool hasRoom = lines.hasRoom();
                                          if (hasRoom) {
                                              lines.add(std::move(line), false);
                                          }
                                          return hasRoom;
                                      }));
}

bool OutletWatch::start(const MonitorOptions& options, const log::Clock& clock,
                        std::vector<net::InputStatus> inputs) {
    m_kind = outlets::findOutletKind(options.outlet);
    if (m_kind == nullptr) {
        return true;
    }
    const std::string place = options.to.empty() ? std::string(m_kind->place) : options.to;
    auto outlet = started({place, options.character}, {m_run.log(), clock, std::move(inputs), {}});
    if (!outlet) {
        m_console.complain("--to: " + outlet.error().text);
        return false;
    }
    m_outlet = std::move(*outlet);
    if (!m_lines) {
        m_console.complain("to " + m_outlet->state().place);
    }
    return true;
}

void OutletWatch::look() {
    if (m_outlet == nullptr) {
        return;
    }
    m_outlet->update(m_run.session());
    if (std::string problem = m_outlet->state().problem; problem != m_problem) {
        m_problem = std::move(problem);
        if (!m_problem.empty()) {
            m_console.complain(m_problem);
        }
    }
}

void OutletWatch::end() {
    if (m_outlet == nullptr) {
        return;
    }
    const outlets::OutletState state = m_outlet->state();
    m_outlet.reset();
    if (m_lines) {
        m_lines->finish(system::Interruption::hasCome);
    }
    std::string told = countText(state.sent, m_kind->unit) + " sent";
    if (state.poses != 0) {
        told.insert(0, countText(state.poses, "pose") + ", ");
    }
    if (const std::uint64_t left = state.refused + state.skipped; left != 0) {
        told += ", " + countText(left, m_kind->unit) + " left out";
    }
    m_console.complain(told);
    if (state.missed != 0) {
        m_console.complain(countText(state.missed, "packet") +
                           " came faster than poses could be made of them");
    }
}

} // namespace posewire::cli
