// SPDX-License-Identifier: MIT
#include "core/model/accounting/sample_window.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

namespace posewire::model {
namespace {

constexpr std::size_t kFirstCapacity = 64;

} // namespace

SampleWindow::Slot SampleWindow::find(std::uint32_t sample) const {
    if (m_size == 0 || distance(back().sample, sample) < 0) {
        return {m_size, false};
    }
    // Most late arrivals are near the end: the search widens from there.
    std::size_t high = m_size - 1;
    std::size_t low = high;
    for (std::size_t reach = 1; low > 0 && distance(sample, (*this)[low].sample) < 0; reach *= 2) {
        high = low;
        low = low > reach ? low - reach : 0;
    }
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (distance((*this)[middle].sample, sample) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return {low, (*this)[low].sample == sample};
}

std::size_t SampleWindow::insert(std::size_t index, std::uint32_t sample, log::Stamp stamp) {
    if (m_size == m_most) {
        forgetFront();
        index = index == 0 ? 0 : index - 1;
    } else if (m_size == m_entries.size()) {
        unwind();
        m_entries.resize(std::max(kFirstCapacity, m_entries.size() * 2));
    }
    ++m_size;
    for (std::size_t i = m_size - 1; i > index; --i) {
        at(i) = at(i - 1);
    }
    at(index) = {.stamp = stamp, .sample = sample, .isAdvance = index + 1 == m_size};
    return index;
}

SampleWindow::Mark SampleWindow::mark(std::size_t index, std::uint8_t datagram, bool isLast) {
    Entry& entry = at(index);
    if (entry.parts == kUnmarked && datagram == 0 && isLast) {
        entry.parts = kWhole;
        entry.last = 0;
        entry.isComplete = true;
        return Mark::Completing;
    }
    if (entry.parts == kUnmarked) {
        entry.parts = takeMask();
    } else if (entry.parts == kWhole) {
        if (datagram == 0) {
            return Mark::Duplicate;
        }
        entry.parts = takeMask();
        m_masks[entry.parts][0] = true;
    }
    Mask& mask = m_masks[entry.parts];
    if (mask[datagram & 127]) {
        return Mark::Duplicate;
    }
    mask[datagram & 127] = true;
    if (isLast && entry.last == 0xff) {
        entry.last = datagram;
    }
    const bool isWhole = entry.last != 0xff && (~mask << (127 - entry.last)).none();
    if (isWhole && !entry.isComplete) {
        entry.isComplete = true;
        return Mark::Completing;
    }
    return Mark::Part;
}

void SampleWindow::complete(std::size_t index) {
    Entry& entry = at(index);
    entry.last = 0;
    entry.isComplete = true;
}

bool SampleWindow::contains(std::size_t index, std::uint8_t datagram) const {
    const Entry& entry = (*this)[index];
    if (entry.parts == kWhole || entry.parts == kUnmarked) {
        return entry.parts == kWhole && datagram == 0;
    }
    return m_masks[entry.parts][datagram & 127];
}

std::uint16_t SampleWindow::takeMask() {
    if (m_spareMasks.empty()) {
        m_masks.push_back({});
        return static_cast<std::uint16_t>(m_masks.size() - 1);
    }
    const std::uint16_t parts = m_spareMasks.back();
    m_spareMasks.pop_back();
    m_masks[parts] = {};
    return parts;
}

void SampleWindow::forgetFront() {
    if (const std::uint16_t parts = at(0).parts; parts < kUnmarked) {
        m_spareMasks.push_back(parts);
    }
    ++m_front;
    --m_size;
    m_hasForgotten = true;
}

/// Makes the ring begin at the front.
void SampleWindow::unwind() {
    const std::size_t front = m_entries.empty() ? 0 : m_front & (m_entries.size() - 1);
    std::rotate(m_entries.begin(), m_entries.begin() + static_cast<std::ptrdiff_t>(front), m_entries.end());
    m_front = 0;
}

std::size_t SampleWindow::setMost(std::size_t most) {
    m_most = most;
    const std::size_t forgotten = m_size - std::min(m_size, most);
    for (std::size_t i = 0; i < forgotten; ++i) {
        forgetFront();
    }
    if (m_entries.size() > most) {
        compact();
    }
    return forgotten;
}

/// Gives back the memory of what is not in use.
void SampleWindow::compact() {
    unwind();
    m_entries.resize(std::bit_ceil(std::max(kFirstCapacity, m_size)));
    m_entries.shrink_to_fit();
    std::vector<Mask> masks;
    for (Entry& entry : std::span(m_entries).first(m_size)) {
        if (entry.parts < kUnmarked) {
            masks.push_back(m_masks[entry.parts]);
            entry.parts = static_cast<std::uint16_t>(masks.size() - 1);
        }
    }
    m_masks = std::move(masks);
    m_spareMasks = std::vector<std::uint16_t>(); // not {}: that keeps the memory
}

std::size_t SampleWindow::memoryBytes() const {
    return m_entries.capacity() * sizeof(Entry) + m_masks.capacity() * sizeof(Mask) +
           m_spareMasks.capacity() * sizeof(std::uint16_t);
}

void SampleWindow::clear() {
    m_front = 0;
    m_size = 0;
    m_hasForgotten = false;
    m_masks.clear();
    m_spareMasks.clear();
}

} // namespace posewire::model
