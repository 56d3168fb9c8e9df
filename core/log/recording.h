// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/log_follower.h"
#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace posewire::log {

class PacketLog;
class Timeline;

struct RecordingFigures {
    std::uint64_t packets = 0;
    std::uint64_t bytes = 0; ///< of the file so far
    /// Packets that the log had dropped before they could be written: the disk was too slow. The recording
    /// shows them as dropped by this computer.
    std::uint64_t missed = 0;
};

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

    /// Brings what was written to the disk, where anything was since the last time. May take long.
    Result sync();

    /// Writes what is new and the statistics that a recording ends with; all of it is on the disk then.
    Result finish();

    [[nodiscard]] RecordingFigures figures() const {
        return {m_writer.packets(), m_writer.bytes(), m_follower.overtaken()};
    }

private:
    Result writeNew();

    ByteSink& m_sink;
    const Timeline& m_timeline;
    LogFollower m_follower;
    SenderFinder m_senders;
    PcapngWriter m_writer;
    std::uint64_t m_synced = 0; ///< the packet after the last one on the disk
};

/// A Recorder on a thread of its own: a slow disk delays nobody. What was received is in the file within a
/// tenth of a second, also where the process is killed, and on the disk within about a second, also where the
/// power fails.
class Recording {
public:
    /// Records from packet `from` on. Fails where the file cannot be made. `log` must outlive the recording.
    static tl::expected<std::unique_ptr<Recording>, FileError>
    start(const PacketLog& log, const std::string& path, const RecordingInfo& info,
          const OutputRules& rules = {}, std::uint64_t from = 0);
    /// The same to a sink that is there already.
    static tl::expected<std::unique_ptr<Recording>, FileError> start(const PacketLog& log,
                                                                     std::unique_ptr<ByteSink> sink,
                                                                     const RecordingInfo& info,
                                                                     std::uint64_t from = 0);

    /// Stops as stop() does.
    ~Recording();

    /// Writes what the log holds and ends the file. Fails with what went wrong since the start; again and
    /// again with the same.
    tl::expected<void, FileError> stop();

    // From any thread.
    [[nodiscard]] RecordingFigures figures() const;
    /// Why nothing more is written: the disk is full, say. Nothing as long as all is well.
    [[nodiscard]] std::optional<FileError> failure() const;

private:
    Recording(const PacketLog& log, std::unique_ptr<ByteSink> sink, std::uint64_t from);
    void run();
    bool note(const Recorder::Result& result);

    std::unique_ptr<ByteSink> m_sink;
    Recorder m_recorder; ///< the thread's own
    mutable std::mutex m_mutex;
    std::condition_variable m_changed;
    bool m_isStopping = false;
    RecordingFigures m_figures;
    std::optional<FileError> m_failure;
    std::thread m_thread;
};

} // namespace posewire::log
