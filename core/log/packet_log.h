// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/chunk_history.h"
#include "core/log/log_reader.h"
#include "core/log/log_writer.h"
#include "core/log/packet.h"
#include "core/log/past.h"
#include "core/log/scratch.h"
#include "core/log/sender_table.h"
#include "core/log/timeline.h"

namespace posewire::log {

/// Every packet received, in the order of arrival: append-only, in chunks, the oldest dropped at a cap of
/// memory; what of those lies in a file (see Past) is still read as any other packet. One thread writes, any
/// number read, each through a LogReader of its own:
///
///     PacketLog log;
///     log.writer().append(bytes, {.stamp = now, .sender = log.senders().intern(info)});
///     log.writer().publish();
///
///     LogReader reader(log);
///     reader.refresh();
///     for (auto number = reader.begin(); number != reader.end(); ++number) {
///         if (const auto packet = reader.packet(number)) { … packet->bytes … }
///     }
class PacketLog {
public:
    /// `scratch`: for what is kept of each packet besides its bytes.
    explicit PacketLog(LogLimits limits = {},
                       const std::shared_ptr<Scratch>& scratch = std::make_shared<Scratch>())
        : m_past(scratch), m_history(limits, scratch), m_writer(m_history, m_senders) {}

    /// For one thread at a time; another may take over when the first has ended.
    [[nodiscard]] LogWriter& writer() { return m_writer; }

    [[nodiscard]] SenderTable& senders() { return m_senders; }
    [[nodiscard]] const SenderTable& senders() const { return m_senders; }

    /// The time that its stamps are of.
    [[nodiscard]] Timeline& timeline() { return m_timeline; }
    [[nodiscard]] const Timeline& timeline() const { return m_timeline; }

    /// From any thread.
    [[nodiscard]] LogFigures figures() const { return m_history.figures(); }

    /// Packets that lie in files.
    [[nodiscard]] Past& past() { return m_past; }
    [[nodiscard]] const Past& past() const { return m_past; }
    [[nodiscard]] const std::shared_ptr<Scratch>& scratch() const { return m_past.scratch(); }

    [[nodiscard]] const ChunkHistory& history() const { return m_history; }

private:
    Past m_past;
    ChunkHistory m_history;
    SenderTable m_senders;
    Timeline m_timeline;
    LogWriter m_writer;
};

} // namespace posewire::log
