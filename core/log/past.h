// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"
#include "core/log/packet.h"
#include "core/log/scratch.h"
#include "core/log/sender_table.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

namespace posewire::log {

/// The packets of a log that lie in files: where the log's memory has dropped them, they are read from there.
/// Parts come from one thread, which has written them or found them; they are read from any.
class Past {
public:
    static constexpr std::size_t kPacketsOfPart = 2048;
    static constexpr std::size_t kKeptBytesOfPart = std::size_t{4} << 20;

    /// Where a packet lies, and what is known of it besides its bytes.
    struct Place {
        std::uint64_t offset; ///< in the file, or in what is kept of the part
        std::uint32_t size;
        bool isKept; ///< its bytes are not in one piece in the file
        Arrival arrival;
    };

    /// Packets that follow one another.
    struct Part {
        std::uint64_t first = 0;
        std::uint64_t count = 0;
        std::shared_ptr<Place[]> places;
        std::shared_ptr<std::byte[]> kept; ///< null if all lies in the file
        std::shared_ptr<const ByteStore> file;
        std::vector<SenderTable::Held> senders;
        std::optional<DropSums> drops; ///< before its first packet; empty if unknown

        [[nodiscard]] std::uint64_t end() const { return first + count; }
    };

    explicit Past(std::shared_ptr<Scratch> scratch) : m_scratch(std::move(scratch)) {}

    /// Numbers grow; some may be left out.
    void add(Part part);
    void dropBefore(std::uint64_t number);

    /// Number of its oldest packet; UINT64_MAX if there is none.
    [[nodiscard]] std::uint64_t begin() const { return m_begin.load(std::memory_order_acquire); }
    /// The part that has a packet; null if there is none.
    [[nodiscard]] std::shared_ptr<const Part> find(std::uint64_t number) const;
    /// The first number from one on that it has a packet of; UINT64_MAX if there is none.
    [[nodiscard]] std::uint64_t nextFrom(std::uint64_t number) const;

    [[nodiscard]] const std::shared_ptr<Scratch>& scratch() const { return m_scratch; }

    /// True if a reader did not find in a file what lay there: somebody else has cut it, or the disk fails.
    [[nodiscard]] bool isDamaged() const { return m_isDamaged.load(std::memory_order_relaxed); }
    void noteDamage() const { m_isDamaged.store(true, std::memory_order_relaxed); }

private:
    const std::shared_ptr<Scratch> m_scratch;
    mutable std::mutex m_mutex; ///< guards the parts
    std::deque<std::shared_ptr<const Part>> m_parts;
    std::atomic<std::uint64_t> m_begin = UINT64_MAX;
    mutable std::atomic<bool> m_isDamaged = false;
};

/// Reads packets of a Past: one at a time where they are far from each other, many at once where they follow
/// one another. One thread.
class PastReader {
public:
    /// The bytes of a packet stay valid until as many others were read.
    static constexpr std::size_t kHeld = 64;

    explicit PastReader(const Past& past) : m_past(&past) {}

    /// Empty if there is none of that number, or the file has changed since.
    [[nodiscard]] std::optional<Packet> packet(std::uint64_t number);

private:
    using Buffer = std::shared_ptr<std::vector<std::byte>>;

    [[nodiscard]] const std::byte* bytesOf(const Past::Place& place, bool isNext);
    void hold(Buffer buffer) { m_held[m_holds++ % kHeld] = std::move(buffer); }

    const Past* m_past;
    std::shared_ptr<const Past::Part> m_part; ///< of the packet read last
    std::uint64_t m_last = UINT64_MAX;        ///< its number
    Buffer m_window;                          ///< what was read last of the file
    std::shared_ptr<const ByteStore> m_windowFile;
    std::uint64_t m_windowOffset = 0;
    std::array<Buffer, kHeld> m_held;
    std::size_t m_holds = 0;
};

/// Notes where the packets of a log lie in a file. One thread.
class PastWriter {
public:
    PastWriter(Past& past, const SenderTable& senders, std::shared_ptr<const ByteStore> file)
        : m_past(past), m_senders(senders), m_file(std::move(file)) {}
    /// Leaves out what was not finished.
    ~PastWriter() = default;
    PastWriter(const PastWriter&) = delete;
    PastWriter& operator=(const PastWriter&) = delete;

    // Where numbers are left out a part ends.
    /// A packet whose bytes lie in the file. The log has its sender still.
    void add(std::uint64_t number, const Arrival& arrival, std::uint64_t offset, std::size_t size);
    /// One whose bytes do not, in one piece.
    void keep(std::uint64_t number, const Arrival& arrival, std::span<const std::byte> bytes);

    /// What this computer dropped before the packet that is noted next, seen or not.
    void noteDrops(const std::optional<DropSums>& before) { m_dropsBefore = before; }

    /// There is enough for a part.
    [[nodiscard]] bool isFull() const {
        return m_places.size() >= Past::kPacketsOfPart || m_kept.size() >= Past::kKeptBytesOfPart;
    }
    /// What was noted is a part, for readers to see: all of it must be in the file by now.
    void finish();

private:
    void note(std::uint64_t number, Past::Place place, std::span<const std::byte> kept);

    Past& m_past;
    const SenderTable& m_senders;
    std::shared_ptr<const ByteStore> m_file;
    std::uint64_t m_first = 0;
    std::optional<DropSums> m_dropsBefore; ///< the packet that is noted next
    std::optional<DropSums> m_drops;       ///< before m_first
    std::vector<Past::Place> m_places;
    std::vector<std::byte> m_kept;
    std::vector<SenderTable::Held> m_held;
    std::unordered_set<SenderId> m_heldIds;
};

} // namespace posewire::log
