// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/log_reader.h"
#include "core/log/pcapng_writer.h"

namespace posewire::log {

class PacketLog;

/// Follows a log and writes it down. One thread; `log` and `sink` must outlive it. After a failure nothing
/// more is written.
class Recorder {
public:
    using Result = PcapngWriter::Result;

    /// Begins with packet `from`, or the oldest one that the log still has.
    Recorder(const PacketLog& log, ByteSink& sink, std::uint64_t from = 0);

    Result begin(const RecordingInfo& info);

    /// Writes what is new and hands it to the system.
    Result follow();

    /// Writes what is new and the statistics that a recording ends with.
    Result finish();

    [[nodiscard]] std::uint64_t packets() const { return m_writer.packets(); }
    [[nodiscard]] std::uint64_t bytes() const { return m_writer.bytes(); }

    /// Packets that the log had dropped before they could be written: the disk was too slow. The recording
    /// shows them as dropped by this computer.
    [[nodiscard]] std::uint64_t missed() const { return m_missed; }

private:
    Result writeNew();

    const PacketLog& m_log;
    ByteSink& m_sink;
    LogReader m_reader;
    PcapngWriter m_writer;
    std::uint64_t m_next;
    std::uint64_t m_missed = 0;
    std::uint64_t m_missedBeforeNext = 0;
};

} // namespace posewire::log
