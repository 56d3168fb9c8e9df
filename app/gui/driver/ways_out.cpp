// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/ways_out.h"

#include "app/gui/base/background.h"

#include <algorithm>

namespace posewire::gui {

bool WaysOut::add(const WayOut& choice, std::size_t row) {
    if (std::ranges::any_of(m_states,
                            [&](const WayOutState& state) { return state.target.isLike(choice); })) {
        return false;
    }
    row = std::min(row, m_states.size());
    const outlets::OutletKind* kind = outlets::findOutletKind(choice.kind.toStdString());
    m_states.insert(
        m_states.begin() + static_cast<std::ptrdiff_t>(row),
        WayOutState{.target = choice, .form = kind != nullptr ? kind->title : choice.kind.toStdString()});
    m_work.insert(m_work.begin() + static_cast<std::ptrdiff_t>(row), Work{.kind = kind});
    if (choice.isOn) {
        begin(row);
    }
    return true;
}

void WaysOut::remove(std::size_t row) {
    stop(row);
    m_states.erase(m_states.begin() + static_cast<std::ptrdiff_t>(row));
    m_work.erase(m_work.begin() + static_cast<std::ptrdiff_t>(row));
}

void WaysOut::setOn(std::size_t row, bool isOn) {
    if (m_states[row].target.isOn == isOn) {
        return;
    }
    m_states[row].target.isOn = isOn;
    if (isOn) {
        begin(row);
    } else {
        stop(row);
    }
}

void WaysOut::begin(std::size_t row) {
    WayOutState& state = m_states[row];
    const outlets::OutletKind* kind = m_work[row].kind;
    if (kind == nullptr) {
        refuse(row, "this version knows no " + state.target.kind.toStdString());
        return;
    }
    if (!kind->hasPoses && !m_relay) {
        m_relay = std::make_shared<net::Relay>(m_log, m_clock);
    }
    state.stage = WayOutState::Stage::LookingUp;
    state.problem.clear();
    const outlets::OutletChoice choice{displayText(state.target).toStdString(),
                                       state.target.character.toStdString()};
    m_work[row].answer =
        std::async(std::launch::async, [start = kind->start, choice,
                                        place = outlets::OutletPlace{m_log, m_clock, m_inputs, m_relay}] {
            return start(choice, place);
        });
}

void WaysOut::stop(std::size_t row) {
    readCounters();
    Work& work = m_work[row];
    if (work.outlet) {
        work.outlet.reset();
        work.before = m_states[row];
    } else if (work.answer.valid()) {
        m_abandoned.push_back(std::move(work.answer));
    }
    m_states[row].stage = WayOutState::Stage::Off;
    m_states[row].behind = 0;
    m_states[row].problem.clear();
}

void WaysOut::refuse(std::size_t row, const std::string& problem) {
    m_states[row].stage = WayOutState::Stage::Refused;
    m_states[row].problem = QString::fromStdString(problem);
}

void WaysOut::update(const model::SessionView& session) {
    for (const Work& work : m_work) {
        if (work.outlet) {
            work.outlet->update(session);
        }
    }
}

bool WaysOut::hasPoses() const {
    return std::ranges::any_of(
        m_work, [](const Work& work) { return work.outlet != nullptr && work.kind->hasPoses; });
}

void WaysOut::measure(const std::vector<net::InputStatus>& inputs) {
    std::erase_if(m_abandoned, [](const std::future<Started>& answer) { return isReady(answer); });
    takeAnswers();
    readCounters();
    stopLoops();
    heedInputs(inputs);
}

void WaysOut::takeAnswers() {
    for (std::size_t row = 0; row < m_states.size(); ++row) {
        if (!isReady(m_work[row].answer)) {
            continue;
        }
        Started started = m_work[row].answer.get();
        if (started) {
            m_work[row].outlet = std::move(*started);
            m_states[row].stage = WayOutState::Stage::Forwarding;
        } else {
            refuse(row, started.error().text);
        }
    }
}

void WaysOut::readCounters() {
    for (std::size_t row = 0; row < m_states.size(); ++row) {
        const Work& work = m_work[row];
        if (!work.outlet) {
            continue;
        }
        const outlets::OutletState now = work.outlet->state();
        WayOutState& state = m_states[row];
        state.receivers = now.receivers;
        state.sent = work.before.sent + now.sent;
        state.refused = work.before.refused + now.refused;
        state.skipped = work.before.skipped + now.skipped;
        state.behind = now.behind;
        state.problem = QString::fromStdString(now.problem);
    }
}

/// They stay off until the operator has seen to the loop and switches them on again.
void WaysOut::stopLoops() {
    for (std::size_t row = 0; row < m_states.size(); ++row) {
        const auto now = m_work[row].outlet ? m_work[row].outlet->state() : outlets::OutletState();
        if (now.returner) {
            stop(row);
            refuse(row, now.problem);
            m_states[row].target.isOn = false;
            m_loops.push_back({*now.returner, m_states[row].problem});
        }
    }
}

void WaysOut::heedInputs(const std::vector<net::InputStatus>& inputs) {
    if (std::ranges::equal(inputs, m_inputs, {}, &net::InputStatus::id, &net::InputStatus::id)) {
        return;
    }
    m_inputs = inputs;
    for (std::size_t row = 0; row < m_states.size(); ++row) {
        Work& work = m_work[row];
        if (work.outlet) {
            if (const auto problem = work.outlet->problemWith(inputs)) {
                stop(row);
                refuse(row, problem->text);
            }
        } else if (work.answer.valid() && !work.kind->hasPoses) {
            m_abandoned.push_back(std::move(work.answer)); // it was asked about other inputs
            begin(row);
        } else if (m_states[row].stage == WayOutState::Stage::Refused && m_states[row].target.isOn) {
            begin(row);
        }
    }
}

} // namespace posewire::gui
