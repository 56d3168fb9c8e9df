// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_filter_run.h"

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

/// So often the thread hands over what it found and lets go of what the log has dropped.
constexpr std::uint64_t kPacketsAtATime = 8192;

} // namespace

PacketFilterRun::PacketFilterRun(const log::PacketLog& log, const model::PacketDigests& digests,
                                 filter::Filter filter, log::Stamp firstStamp)
    : m_log(log),
      m_filter(std::move(filter)),
      m_firstStamp(firstStamp),
      m_begin(digests.begin()),
      m_next(digests.begin()),
      m_end(digests.end()) {
    m_excerpts.push_back(digests.excerpt(m_begin));
    m_thread = std::thread([this] { run(); });
}

PacketFilterRun::~PacketFilterRun() {
    cancel();
    m_thread.join();
}

void PacketFilterRun::cancel() {
    const std::lock_guard lock(m_mutex);
    m_isCancelled.store(true, std::memory_order_relaxed);
    m_changed.notify_all();
}

PacketFilterRun::Found PacketFilterRun::take(const model::PacketDigests& digests) {
    const std::lock_guard lock(m_mutex);
    const std::uint64_t end = m_end.load(std::memory_order_relaxed);
    if (digests.end() > end && !isCancelled()) {
        m_excerpts.push_back(digests.excerpt(end));
        m_end.store(digests.end(), std::memory_order_relaxed);
        m_changed.notify_all();
    }
    return std::exchange(m_found, {});
}

PacketFilterRun::Progress PacketFilterRun::progress() const {
    return {m_next.load(std::memory_order_relaxed) - m_begin,
            m_end.load(std::memory_order_relaxed) - m_begin};
}

void PacketFilterRun::wait() {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [&] {
        return isCancelled() ||
               m_next.load(std::memory_order_relaxed) == m_end.load(std::memory_order_relaxed);
    });
}

/// Sleeps where there is nothing to do; nothing where the run is over.
std::optional<model::PacketDigests::Excerpt> PacketFilterRun::nextExcerpt() {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [this] { return isCancelled() || !m_excerpts.empty(); });
    if (isCancelled()) {
        return std::nullopt;
    }
    model::PacketDigests::Excerpt excerpt = std::move(m_excerpts.front());
    m_excerpts.pop_front();
    return excerpt;
}

void PacketFilterRun::hand(Found& found, std::uint64_t next) {
    const std::lock_guard lock(m_mutex);
    m_found.packets.insert(m_found.packets.end(), found.packets.begin(), found.packets.end());
    m_found.problems.insert(m_found.problems.end(), found.problems.begin(), found.problems.end());
    found.packets.clear();
    found.problems.clear();
    m_next.store(next, std::memory_order_relaxed);
    m_changed.notify_all();
}

void PacketFilterRun::lookAt(const model::PacketDigests::Excerpt& excerpt, log::LogReader& reader) {
    Found found;
    for (std::uint64_t number = excerpt.begin(); number < excerpt.end() && !isCancelled(); ++number) {
        if ((number - excerpt.begin()) % kPacketsAtATime == 0) {
            hand(found, number);
            reader.refresh();
        }
        const auto packet = reader.packet(number);
        if (!packet) {
            continue;
        }
        const model::PacketDigest& digest = excerpt.at(number);
        const bool isRead = !packet->flags.skipped && wire::decodeInto(packet->bytes, m_datagram).has_value();
        const log::SenderInfo* sender = m_log.senders().find(packet->sender);
        if (m_filter.matches({*packet, digest, isRead ? &m_datagram : nullptr, sender, m_firstStamp})) {
            found.packets.push_back(number);
            if (digest.isProblem()) {
                found.problems.push_back(number);
            }
        }
    }
    hand(found, excerpt.end());
}

void PacketFilterRun::run() {
    log::LogReader reader(m_log);
    while (const auto excerpt = nextExcerpt()) {
        lookAt(*excerpt, reader);
    }
}

} // namespace posewire::gui
