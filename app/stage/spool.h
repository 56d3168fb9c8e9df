// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/disk_history.h"
#include "core/log/packet_log.h"
#include "core/log/recording_file.h"

#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace posewire::stage {

/// What a probe has received and no server has stored yet, in files as any other recording: they are written
/// while no server takes it, and go once it is stored. What a probe that died has left is there for the next
/// one. One thread.
class Spool {
public:
    /// `most`: bytes on the disk.
    Spool(std::string folder, std::uint64_t most) : m_folder(std::move(folder)), m_most(most) {}

    /// Writes the log from its oldest packet in memory on. Returns what is wrong, if anything is.
    std::optional<log::FileError> begin(log::PacketLog& log);
    [[nodiscard]] bool isOpen() const { return m_history != nullptr; }
    /// What the log has is stored now: the files go.
    void drop() { m_history.reset(); }
    /// The files stay for the next probe.
    void leave();
    [[nodiscard]] std::uint64_t bytes() const { return m_history ? m_history->figures().bytes : 0; }

    /// Remembers which packet was stored last, also if this process is killed.
    void noteStored(log::WallTime time, std::span<const std::byte> bytes);
    /// Hands out what the probes before have left and had not stored, in order.
    void readLeft(const log::FileVisitor& take) const;
    /// All of that is stored now: those files go.
    void dropLeft() const;

private:
    std::string m_folder;
    std::uint64_t m_most;
    std::unique_ptr<log::DiskHistory> m_history;
    std::ofstream m_stored; ///< a file beside the recordings
};

} // namespace posewire::stage
