// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_filter_run.h"

#include "core/log/log_reader.h"

#include <algorithm>

namespace posewire::gui {

namespace {

/// So often the thread hands over what it found and lets go of what the log has dropped.
constexpr std::uint64_t kPacketsAtATime = 8192;

} // namespace

PacketFilterRun::PacketFilterRun(const log::PacketLog& log, filter::Filter filter, std::int64_t firstStampNs)
    : m_log(log), m_filter(std::move(filter)), m_firstStampNs(firstStampNs) {
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

std::vector<std::uint64_t> PacketFilterRun::take(std::uint64_t end) {
    const std::lock_guard lock(m_mutex);
    const auto kept = std::ranges::lower_bound(m_found, end);
    std::vector<std::uint64_t> taken(m_found.begin(), kept);
    m_found.erase(m_found.begin(), kept);
    m_isAwake = true;
    m_changed.notify_all();
    return taken;
}

PacketFilterRun::Progress PacketFilterRun::progress() const {
    const std::uint64_t begin = m_begin.load(std::memory_order_relaxed);
    return {m_next.load(std::memory_order_relaxed) - begin, m_end.load(std::memory_order_relaxed) - begin};
}

void PacketFilterRun::wait() {
    const std::uint64_t end = m_log.figures().end;
    std::unique_lock lock(m_mutex);
    m_isAwake = true;
    m_changed.notify_all();
    m_changed.wait(lock, [&] { return isCancelled() || m_next.load(std::memory_order_relaxed) >= end; });
}

/// Sleeps where there is nothing to do; false where the run is over.
bool PacketFilterRun::rest(std::uint64_t end) {
    std::unique_lock lock(m_mutex);
    if (m_next.load(std::memory_order_relaxed) == end) {
        m_changed.wait(lock, [this] { return isCancelled() || m_isAwake; });
    }
    m_isAwake = false;
    return !isCancelled();
}

void PacketFilterRun::hand(std::vector<std::uint64_t>& found, std::uint64_t number) {
    const std::lock_guard lock(m_mutex);
    m_found.insert(m_found.end(), found.begin(), found.end());
    found.clear();
    m_next.store(number, std::memory_order_relaxed);
    m_changed.notify_all();
}

void PacketFilterRun::run() {
    log::LogReader reader(m_log);
    model::PacketDigester digester;
    wire::Datagram datagram;
    std::vector<std::uint64_t> found;
    m_begin.store(reader.begin(), std::memory_order_relaxed);
    std::uint64_t number = reader.begin();
    do {
        reader.refresh();
        number = std::max(number, reader.begin());
        m_end.store(reader.end(), std::memory_order_relaxed);
        const std::uint64_t end = std::min(reader.end(), number + kPacketsAtATime);
        for (; number < end && !isCancelled(); ++number) {
            const auto packet = reader.packet(number);
            if (!packet) {
                continue;
            }
            const bool isRead =
                !packet->flags.skipped && wire::decodeInto(packet->bytes, datagram).has_value();
            const wire::Datagram* read = isRead ? &datagram : nullptr;
            const model::PacketDigest digest = digester.add(*packet, read);
            const log::SourceInfo* source = m_log.sources().find(packet->source);
            if (m_filter.matches({*packet, digest, read, source, m_firstStampNs})) {
                found.push_back(number);
            }
        }
        hand(found, number);
    } while (rest(reader.end()));
}

} // namespace posewire::gui
