// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/chunk_history.h"
#include "core/log/log_reader.h"
#include "core/log/log_writer.h"
#include "core/log/packet.h"
#include "core/log/source_table.h"

namespace posewire::log {

/// Every packet received, in the order of arrival: append-only, in chunks, the oldest dropped at a cap of
/// memory. One thread writes, any number read, each through a LogReader of its own:
///
///     PacketLog log;
///     log.writer().append(bytes, {.stampNs = now, .source = log.sources().intern(info)});
///     log.writer().publish();
///
///     LogReader reader(log);
///     reader.refresh();
///     for (auto number = reader.begin(); number != reader.end(); ++number) {
///         if (const auto packet = reader.packet(number)) { … packet->bytes … }
///     }
class PacketLog {
public:
    explicit PacketLog(LogLimits limits = {}) : m_history(limits), m_writer(m_history) {}

    /// For one thread at a time; another may take over when the first has ended.
    [[nodiscard]] LogWriter& writer() { return m_writer; }

    /// To be interned by the writing thread, to be read by all.
    [[nodiscard]] SourceTable& sources() { return m_sources; }
    [[nodiscard]] const SourceTable& sources() const { return m_sources; }

    /// From any thread.
    [[nodiscard]] LogFigures figures() const { return m_history.figures(); }

    /// What a LogReader looks at.
    [[nodiscard]] const ChunkHistory& history() const { return m_history; }

private:
    ChunkHistory m_history;
    SourceTable m_sources;
    LogWriter m_writer;
};

} // namespace posewire::log
