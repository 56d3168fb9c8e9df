// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/replay.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace posewire::net {
namespace {

/// So often what was looked at in the log is let go of.
constexpr std::uint64_t kHeldPackets = 1'024;

log::Duration scaled(log::Duration duration, double factor) {
    return log::Duration(static_cast<std::int64_t>(static_cast<double>(duration.count()) * factor));
}

} // namespace

Replay::Replay(const log::PacketLog& log, const log::Clock& clock, ReplayChoice choice)
    : m_choice(std::move(choice)), m_clock(clock), m_reader(log), m_start(clock.monotonic()) {
    m_figures.position = m_choice.begin;
    m_thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Replay::~Replay() = default;

ReplayFigures Replay::figures() const {
    const std::lock_guard lock(m_mutex);
    return m_figures;
}

void Replay::run(const std::stop_token& stop) {
    auto sender = DatagramSender::connect(m_choice.target);
    NetResult<void> result = sender ? NetResult<void>() : tl::unexpected(sender.error());
    bool isToBegin = result.has_value();
    while (isToBegin) {
        const std::uint64_t before = sender->sent();
        result = sendRound(*sender, stop);
        isToBegin = result && m_choice.isLooping && !stop.stop_requested() && sender->sent() != before;
    }
    if (result && !stop.stop_requested()) {
        result = sender->flush();
    }
    const std::lock_guard lock(m_mutex);
    m_figures.isOver = true;
    if (!result) {
        m_figures.problem = result.error().text;
    }
}

NetResult<void> Replay::sendRound(DatagramSender& sender, const std::stop_token& stop) {
    std::optional<log::Stamp> first;
    log::Duration due{};
    std::uint64_t packets = 0;
    std::uint64_t missing = figures().missing;
    for (std::uint64_t number = m_choice.begin; number < m_choice.end; ++number) {
        if (number % kHeldPackets == 0) {
            m_reader.refresh();
        }
        const auto packet = m_reader.packet(number);
        if (!packet) {
            ++missing;
            continue;
        }
        if (!first && m_roundBegin == log::Duration::zero()) {
            m_start = m_clock.monotonic(); // looking for the first one is no part of it
        }
        if (!packet->flags.isFromBefore) {
            first = first.value_or(packet->stamp);
            due = std::max(due, packet->stamp - *first);
        }
        ++packets;
        if (!waitFor(m_roundBegin + scaled(due, 1 / m_choice.speed), stop)) {
            return {};
        }
        if (!packet->flags.skipped) {
            if (auto sent = sender.send(packet->bytes); !sent) {
                return sent;
            }
        }
        note(sender, number + 1, missing);
    }
    const auto intervals = static_cast<std::int64_t>(std::max<std::uint64_t>(packets, 2) - 1);
    const log::Duration least = std::chrono::milliseconds(1);
    m_roundBegin += scaled(due + std::max(due / intervals, least), 1 / m_choice.speed);
    note(sender, m_choice.end, missing);
    const std::lock_guard lock(m_mutex);
    ++m_figures.rounds;
    return {};
}

bool Replay::waitFor(log::Duration due, const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        const log::Duration left = due - (m_clock.monotonic() - m_start);
        if (left <= log::Duration::zero()) {
            return true;
        }
        std::unique_lock lock(m_mutex);
        m_changed.wait_for(lock, stop, left, [] { return false; });
    }
    return false;
}

void Replay::note(const DatagramSender& sender, std::uint64_t position, std::uint64_t missing) {
    const std::lock_guard lock(m_mutex);
    m_figures.position = position;
    m_figures.sent = sender.sent();
    m_figures.refused = sender.refused();
    m_figures.missing = missing;
}

} // namespace posewire::net
