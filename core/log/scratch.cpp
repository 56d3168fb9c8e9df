// SPDX-License-Identifier: MIT
#include "core/log/scratch.h"

#include "core/log/file_names.h"
#include "core/log/system_memory.h"

#include <algorithm>
#include <functional>
#include <system_error>

namespace posewire::log {
namespace {

/// Few sizes, so that what was given back is taken again.
constexpr std::size_t kLeast = 512;

constexpr std::size_t roundedUp(std::size_t size) {
    return (size + kLeast - 1) / kLeast * kLeast;
}

} // namespace

Scratch::Scratch(const std::string& folder, std::uint64_t most)
    : m_file(openMemoryFile(folder)), m_most(most) {}

Scratch::~Scratch() {
    for (std::byte* segment : m_segments) {
        unmapSegment(segment, kSegment);
    }
    if (m_file != kNoMemoryFile) {
        closeMemoryFile(m_file);
    }
}

std::shared_ptr<std::byte[]> Scratch::bytes(std::size_t size) {
    return {take(size), [owner = shared_from_this(), size](std::byte* used) { owner->give(used, size); }};
}

bool Scratch::hasFile() const {
    const std::lock_guard lock(m_mutex);
    return m_file != kNoMemoryFile;
}

ScratchFigures Scratch::figures() const {
    const std::lock_guard lock(m_mutex);
    return {m_segments.size() * kSegment, m_heapBytes};
}

std::byte* Scratch::take(std::size_t size) {
    const std::size_t rounded = roundedUp(size);
    const std::lock_guard lock(m_mutex);
    if (auto spare = m_spare.find(rounded); spare != m_spare.end() && !spare->second.empty()) {
        std::byte* memory = spare->second.back();
        spare->second.pop_back();
        return memory;
    }
    if (m_file != kNoMemoryFile && rounded <= kSegment &&
        (m_used + rounded <= kSegment || grow() != nullptr)) {
        std::byte* memory = m_segments.back() + m_used;
        m_used += rounded;
        return memory;
    }
    m_heapBytes += size;
    return static_cast<std::byte*>(::operator new (size, std::align_val_t{alignof(std::max_align_t)}));
}

void Scratch::give(std::byte* memory, std::size_t size) {
    const std::lock_guard lock(m_mutex);
    if (isInFile(memory)) {
        m_spare[roundedUp(size)].push_back(memory);
    } else {
        m_heapBytes -= size;
        ::operator delete (memory, std::align_val_t{alignof(std::max_align_t)});
    }
}

/// What is full is seldom looked at. Null if the file grows no more, now and later: what is kept in memory
/// instead is bounded by others, and not twice.
std::byte* Scratch::grow() {
    const std::uint64_t end = m_segments.size() * kSegment;
    std::byte* segment = end + kSegment <= m_most ? mapSegment(m_file, end, kSegment) : nullptr;
    if (segment == nullptr) {
        closeMemoryFile(m_file);
        m_file = kNoMemoryFile;
        return nullptr;
    }
    std::ranges::for_each(m_segments, [](std::byte* full) { letGo(full, kSegment); });
    m_segments.push_back(segment);
    m_used = 0;
    return segment;
}

bool Scratch::isInFile(const std::byte* memory) const {
    return std::ranges::any_of(m_segments, [memory](const std::byte* segment) {
        return !std::less<>()(memory, segment) && std::less<>()(memory, segment + kSegment);
    });
}

std::shared_ptr<Scratch> scratchOfFile(const std::filesystem::path& folder) {
    std::error_code failed;
    const std::filesystem::space_info space = std::filesystem::space(folder, failed);
    return failed ? std::make_shared<Scratch>()
                  : std::make_shared<Scratch>(nameOf(folder), space.available / 2);
}

} // namespace posewire::log
