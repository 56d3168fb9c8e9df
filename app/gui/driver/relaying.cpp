// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/relaying.h"

#include "app/gui/base/background.h"

#include <algorithm>

namespace posewire::gui {

bool Relaying::add(const RelayChoice& choice, std::size_t row) {
    const auto isSame = [&](const RelayState& state) {
        return state.target.host == choice.host && state.target.port == choice.port;
    };
    if (std::ranges::any_of(m_states, isSame)) {
        return false;
    }
    row = std::min(row, m_states.size());
    m_states.insert(m_states.begin() + static_cast<std::ptrdiff_t>(row), RelayState{choice});
    m_work.insert(m_work.begin() + static_cast<std::ptrdiff_t>(row), Work{});
    if (choice.isOn) {
        begin(row);
    }
    return true;
}

void Relaying::remove(std::size_t row) {
    stop(row);
    m_states.erase(m_states.begin() + static_cast<std::ptrdiff_t>(row));
    m_work.erase(m_work.begin() + static_cast<std::ptrdiff_t>(row));
}

void Relaying::setOn(std::size_t row, bool isOn) {
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

void Relaying::begin(std::size_t row) {
    if (!m_relay) {
        m_relay = std::make_unique<net::Relay>(m_log, m_clock);
    }
    RelayState& state = m_states[row];
    state.stage = RelayState::Stage::LookingUp;
    state.problem.clear();
    m_work[row].answer = std::async(
        std::launch::async, [&relay = *m_relay, inputs = m_inputs,
                             target = net::Endpoint{state.target.host.toStdString(), state.target.port}] {
            return relay.add(target, inputs);
        });
}

void Relaying::stop(std::size_t row) {
    readCounters();
    Work& work = m_work[row];
    if (work.id) {
        m_relay->remove(*work.id);
        work.id.reset();
        work.before = m_states[row];
    } else if (work.answer.valid()) {
        m_abandoned.push_back(std::move(work.answer));
        work.answer = {};
    }
    m_states[row].stage = RelayState::Stage::Off;
    m_states[row].behind = 0;
    m_states[row].problem.clear();
}

void Relaying::measure(const std::vector<net::InputStatus>& inputs) {
    dropAbandoned();
    takeAnswers();
    readCounters();
    stopLoops();
    heedInputs(inputs);
}

void Relaying::dropAbandoned() {
    std::erase_if(m_abandoned, [this](Answer& answer) {
        if (!isReady(answer)) {
            return false;
        }
        if (const auto id = answer.get()) {
            m_relay->remove(*id);
        }
        return true;
    });
}

void Relaying::takeAnswers() {
    for (std::size_t row = 0; row < m_states.size(); ++row) {
        if (!isReady(m_work[row].answer)) {
            continue;
        }
        const auto id = m_work[row].answer.get();
        RelayState& state = m_states[row];
        state.stage = id ? RelayState::Stage::Forwarding : RelayState::Stage::Refused;
        if (id) {
            m_work[row].id = *id;
        } else {
            state.problem = QString::fromStdString(id.error().text);
        }
    }
}

void Relaying::readCounters() {
    if (!m_relay) {
        return;
    }
    const std::vector<net::RelayTarget> targets = m_relay->targets();
    for (std::size_t row = 0; row < m_states.size(); ++row) {
        const Work& work = m_work[row];
        const auto target = std::ranges::find(
            targets, work.id, [](const net::RelayTarget& each) { return std::optional(each.id); });
        if (target == targets.end()) {
            continue;
        }
        RelayState& state = m_states[row];
        state.sent = work.before.sent + target->sent;
        state.refused = work.before.refused + target->refused;
        state.skipped = work.before.skipped + target->skipped;
        state.behind = target->behind;
        state.problem = QString::fromStdString(target->problem);
    }
}

/// They stay off until the operator has seen to the loop and switches them on again.
void Relaying::stopLoops() {
    for (const net::RelayTarget& target : m_relay ? m_relay->targets() : std::vector<net::RelayTarget>()) {
        const auto work = std::ranges::find(m_work, std::optional(target.id), &Work::id);
        if (!target.isStopped || work == m_work.end()) {
            continue;
        }
        const auto row = static_cast<std::size_t>(work - m_work.begin());
        stop(row);
        RelayState& state = m_states[row];
        state.target.isOn = false;
        state.stage = RelayState::Stage::Refused;
        state.problem = QString::fromStdString(target.problem);
        m_loops.push_back({target.returner, state.problem});
    }
}

void Relaying::heedInputs(const std::vector<net::InputStatus>& inputs) {
    if (std::ranges::equal(inputs, m_inputs, {}, &net::InputStatus::id, &net::InputStatus::id)) {
        return;
    }
    m_inputs = inputs;
    for (std::size_t row = 0; row < m_states.size(); ++row) {
        Work& work = m_work[row];
        if (work.id) {
            if (const auto problem = m_relay->problemWith(*work.id, inputs)) {
                stop(row);
                m_states[row].stage = RelayState::Stage::Refused;
                m_states[row].problem = QString::fromStdString(problem->text);
            }
        } else if (work.answer.valid()) {
            m_abandoned.push_back(std::move(work.answer)); // it was asked about other inputs
            begin(row);
        } else if (m_states[row].stage == RelayState::Stage::Refused && m_states[row].target.isOn) {
            begin(row);
        }
    }
}

} // namespace posewire::gui
