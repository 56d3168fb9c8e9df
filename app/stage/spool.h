// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/disk_history.h"
#include "core/log/packet_log.h"
#include "core/log/recording_file.h"

#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

namespace posewire::stage {

/// Keeps on the disk, as recordings, the packets that no server has stored yet. The files are removed once
/// they are stored; a probe that starts finds those of one that died. One thread.
class Spool {
public:
    /// `most`: bytes on the disk.
    Spool(std::string folder, std::uint64_t most) : m_folder(std::move(folder)), m_most(most) {}

    /// Writes the log, from the oldest packet in memory on. Returns the error, if there is one.
    std::optional<log::FileError> begin(log::PacketLog& log);
    [[nodiscard]] bool isOpen() const { return m_history != nullptr; }
    /// Removes the files.
    void drop() { m_history.reset(); }
    /// Completes the files for the next probe.
    void leave();
    [[nodiscard]] std::uint64_t bytes() const { return m_history ? m_history->figures().bytes : 0; }

    /// Remembers the packet that was stored last, even if this process is killed.
    void noteStored(log::WallTime time, std::span<const std::byte> bytes);
    /// Calls `take` in order for the packets that earlier probes left and no server has stored.
    void readLeft(const log::FileVisitor& take) const;
    /// Removes the files of earlier probes.
    void dropLeft() const;

private:
    std::string m_folder;
    std::uint64_t m_most;
    std::unique_ptr<log::DiskHistory> m_history;
    std::ofstream m_stored; ///< a file beside the recordings
};

} // namespace posewire::stage
