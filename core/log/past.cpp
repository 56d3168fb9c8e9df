// SPDX-License-Identifier: MIT
#include "core/log/past.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace posewire::log {
namespace {

/// Read at once where packets follow one another.
constexpr std::size_t kWindow = std::size_t{64} << 10;

} // namespace

void Past::add(Part part) {
    auto shared = std::make_shared<const Part>(std::move(part));
    const std::lock_guard lock(m_mutex);
    m_parts.push_back(std::move(shared));
    m_begin.store(m_parts.front()->first, std::memory_order_release);
}

void Past::dropBefore(std::uint64_t number) {
    std::vector<std::shared_ptr<const Part>> dropped; // given back outside the lock
    const std::lock_guard lock(m_mutex);
    while (!m_parts.empty() && m_parts.front()->end() <= number) {
        dropped.push_back(std::move(m_parts.front()));
        m_parts.pop_front();
    }
    m_begin.store(m_parts.empty() ? UINT64_MAX : m_parts.front()->first, std::memory_order_release);
}

std::shared_ptr<const Past::Part> Past::find(std::uint64_t number) const {
    const std::lock_guard lock(m_mutex);
    const auto next =
        std::ranges::upper_bound(m_parts, number, {}, [](const auto& part) { return part->first; });
    const bool isInside = next != m_parts.begin() && number < (*std::prev(next))->end();
    return isInside ? *std::prev(next) : nullptr;
}

std::uint64_t Past::nextFrom(std::uint64_t number) const {
    const std::lock_guard lock(m_mutex);
    const auto next =
        std::ranges::upper_bound(m_parts, number, {}, [](const auto& part) { return part->end(); });
    return next == m_parts.end() ? UINT64_MAX : std::max(number, (*next)->first);
}

std::optional<Packet> PastReader::packet(std::uint64_t number) {
    if (m_part == nullptr || number < m_part->first || number >= m_part->end()) {
        m_part = m_past->find(number);
        if (m_part == nullptr) {
            return std::nullopt;
        }
    }
    const Past::Place& place = m_part->places[number - m_part->first];
    const std::byte* bytes = bytesOf(place, number == m_last + 1);
    m_last = number;
    if (bytes == nullptr && place.size != 0) {
        m_past->noteDamage();
        return std::nullopt;
    }
    const Arrival& arrival = place.arrival;
    return Packet{number,        arrival.stamp,      arrival.sender, arrival.kernelDropsBefore,
                  arrival.flags, {bytes, place.size}};
}

/// Null if the file does not have them, or there are none.
const std::byte* PastReader::bytesOf(const Past::Place& place, bool isNext) {
    if (place.isKept) {
        auto copy = std::make_shared<std::vector<std::byte>>(m_part->kept.get() + place.offset,
                                                             m_part->kept.get() + place.offset + place.size);
        const std::byte* bytes = copy->data();
        hold(std::move(copy));
        return bytes;
    }
    const bool isInWindow = m_windowFile == m_part->file && place.offset >= m_windowOffset &&
                            place.offset + place.size <= m_windowOffset + m_window->size();
    if (!isInWindow) {
        auto window = std::make_shared<std::vector<std::byte>>(
            isNext ? std::max<std::size_t>(kWindow, place.size) : place.size);
        window->resize(m_part->file->readAt(place.offset, *window));
        if (window->size() < place.size) {
            return nullptr;
        }
        hold(window);
        m_window = std::move(window);
        m_windowFile = m_part->file;
        m_windowOffset = place.offset;
    }
    return m_window->data() + (place.offset - m_windowOffset);
}

void PastWriter::add(std::uint64_t number, const Arrival& arrival, std::uint64_t offset, std::size_t size) {
    note(number, {offset, static_cast<std::uint32_t>(size), false, arrival}, {});
}

void PastWriter::keep(std::uint64_t number, const Arrival& arrival, std::span<const std::byte> bytes) {
    note(number, {0, static_cast<std::uint32_t>(bytes.size()), true, arrival}, bytes);
}

void PastWriter::note(std::uint64_t number, Past::Place place, std::span<const std::byte> kept) {
    if (number != m_first + m_places.size()) {
        finish();
        m_first = number;
    }
    if (place.isKept) {
        place.offset = m_kept.size();
        m_kept.insert(m_kept.end(), kept.begin(), kept.end());
    }
    if (m_places.empty()) {
        m_drops = m_dropsBefore;
    }
    m_places.push_back(place);
    if (m_heldIds.insert(place.arrival.sender).second) {
        if (auto held = m_senders.find(place.arrival.sender)) {
            m_held.push_back(std::move(held));
        }
    }
}

void PastWriter::finish() {
    if (m_places.empty()) {
        return;
    }
    Past::Part part{m_first, m_places.size(), {}, {}, m_file, std::exchange(m_held, {}), m_drops};
    const std::shared_ptr<std::byte[]> memory =
        m_past.scratch()->bytes(m_places.size() * sizeof(Past::Place));
    part.places = {memory, reinterpret_cast<Past::Place*>(memory.get())};
    std::uninitialized_copy(m_places.begin(), m_places.end(), part.places.get());
    if (!m_kept.empty()) {
        part.kept = m_past.scratch()->bytes(m_kept.size());
        std::copy(m_kept.begin(), m_kept.end(), part.kept.get());
    }
    m_first += m_places.size();
    m_past.add(std::move(part));
    m_places.clear();
    m_kept.clear();
    m_heldIds.clear();
}

} // namespace posewire::log
