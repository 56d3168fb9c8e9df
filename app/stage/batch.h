// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/memory_sink.h"
#include "core/log/packet.h"
#include "core/log/pcapng_writer.h"
#include "core/log/recording_file.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace posewire::stage {

/// The layout of batches and of health that this version writes and reads; see packaging/stage.md.
inline constexpr int kLayout = 1;

// Headers of a batch.
inline constexpr const char* kLayoutHeader = "Posewire-Layout";
inline constexpr const char* kRunHeader = "Posewire-Run";     ///< of the probe: sixteen hexadecimal digits
inline constexpr const char* kFirstHeader = "Posewire-First"; ///< number of its first packet in that run
inline constexpr const char* kCountHeader = "Posewire-Count"; ///< of its packets

/// Sixteen hexadecimal digits that no other run has.
[[nodiscard]] std::string newRun();

/// Packets that follow one another, as a recording in memory: untouched datagrams with the stamps, senders
/// and drops that the probe has of them.
class Batch {
public:
    /// Bytes. A message of NATS holds 1 MB unless its server is configured otherwise.
    static constexpr std::size_t kMostBytes = 900'000;

    Batch() = default;
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;

    [[nodiscard]] bool isEmpty() const { return m_count == 0; }
    [[nodiscard]] bool hasRoomFor(const log::Packet& packet) const;
    [[nodiscard]] std::uint64_t first() const { return m_first; }
    [[nodiscard]] std::uint64_t count() const { return m_count; }
    [[nodiscard]] std::span<const std::byte> bytes() const { return m_bytes; }

    void clear();
    /// The packet follows the last one that was added.
    void add(const log::Packet& packet, const log::SenderInfo& sender);

private:
    std::vector<std::byte> m_bytes;
    log::MemorySink m_sink{m_bytes};
    std::optional<log::PcapngWriter> m_writer;
    std::uint64_t m_first = 0;
    std::uint64_t m_count = 0;
};

/// Calls `visit` for each packet. Fails at the first damage, after the packets before it.
[[nodiscard]] tl::expected<void, log::FileError> readBatch(std::span<const std::byte> bytes,
                                                           const log::FileVisitor& visit);

} // namespace posewire::stage
