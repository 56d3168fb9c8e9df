// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/log_reader.h"
#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace posewire::log {

class PacketLog;
class Timeline;

/// When a recording goes on in another file, and when it ends by itself.
struct RecordingLimits {
    std::uint64_t fileBytes = 0; ///< of one file, about; 0 for any
    Duration fileTime{};         ///< of one file; 0 for any
    std::uint64_t leaveFree = 0; ///< bytes: it ends before its disk is as full
    std::string otherFolder{};   ///< to go on in if that of the recording is gone for good; empty for none
};

/// A file of a recording that was removed, moved, replaced or cut meanwhile.
struct Displaced {
    std::string problem; ///< in words, with its name
    std::string path;    ///< of the file that stands for it, with all of it that the log still had
    std::uint64_t lost;  ///< packets of it that the log had dropped
};

/// Where a recording goes on: "take 3.pcapng", "take 3 part 2.pcapng" and so on.
[[nodiscard]] std::string partPath(const std::string& path, unsigned part);

struct RecordingFigures {
    std::uint64_t packets = 0;
    std::uint64_t bytes = 0; ///< of all its files so far
    unsigned files = 1;
    /// Packets that the log had dropped before they could be written: the disk was too slow. The recording
    /// shows them as dropped by this computer.
    std::uint64_t missed = 0;
    std::uint64_t fileBegin = 0; ///< the packet of the log that the newest file begins with, or would have
    std::string path{};          ///< of the first file that is there, as far as is known
    std::vector<Displaced> displaced{};
};

/// Follows a log and writes it down. One thread; `log` and `sink` must outlive it. After a failure nothing
/// more is written.
class Recorder {
public:
    using Result = PcapngWriter::Result;

    /// Begins with packet `from`, or the oldest one that the log still has.
    Recorder(const PacketLog& log, ByteSink& sink, std::uint64_t from = 0);
    /// Goes on where another recorder has ended, with its follower: what the log drops meanwhile is missed.
    Recorder(const PacketLog& log, ByteSink& sink, LogFollower follower);

    /// `before`: packets of the log from before the first one that come ahead of it, as
    /// PacketFlags::isFromBefore; those that the log has dropped are left out.
    Result begin(const RecordingInfo& info, std::span<const std::uint64_t> before = {});

    /// Writes what is new and hands it to the system.
    Result follow();

    /// Brings what was written to the disk, where anything was since the last time. May take long.
    Result sync();

    /// Writes the statistics so far with notes on all of it, which is what counts if nothing comes after.
    Result note(std::span<const std::string> notes);

    /// Writes what is new and the statistics that a recording ends with; all of it is on the disk then.
    Result finish(std::span<const std::string> notes = {});

    [[nodiscard]] RecordingFigures figures() const {
        return {m_writer.packets(), m_writer.bytes(), 1, m_follower.overtaken() - m_missedBefore, m_first};
    }
    /// How many packets of the file come before one of the log: its number there.
    [[nodiscard]] std::uint64_t placeOf(std::uint64_t packet) const;
    [[nodiscard]] const LogFollower& follower() const { return m_follower; }

private:
    /// Packets that the log had dropped.
    struct Hole {
        std::uint64_t begin;
        std::uint64_t end;
    };

    Result writeNew();
    Result write(const Packet& packet);

    ByteSink& m_sink;
    const PacketLog& m_log;
    LogFollower m_follower;
    const std::uint64_t m_first; ///< packet
    const std::uint64_t m_missedBefore;
    std::vector<Hole> m_holes;
    SenderFinder m_senders;
    PcapngWriter m_writer;
    std::uint64_t m_before = 0; ///< packets ahead of the first one
    std::uint64_t m_synced = 0; ///< the packet after the last one on the disk
};

/// A Recorder on a thread of its own: a slow disk delays no one. What was received is in the file within a
/// tenth of a second, also if the process is killed, and on the disk within about a second, also if the
/// power fails.
class Recording {
public:
    /// Records from packet `from` on, after packets from before it (see Recorder). Fails if the file cannot
    /// be made. `log` must outlive the recording.
    static tl::expected<std::unique_ptr<Recording>, FileError>
    start(const PacketLog& log, const std::string& path, const RecordingInfo& info,
          const OutputRules& rules = {}, std::uint64_t from = 0, const RecordingLimits& limits = {},
          std::vector<std::uint64_t> before = {});
    /// The same to a sink that is there already, without limits.
    static tl::expected<std::unique_ptr<Recording>, FileError> start(const PacketLog& log,
                                                                     std::unique_ptr<ByteSink> sink,
                                                                     const RecordingInfo& info,
                                                                     std::uint64_t from = 0);

    /// Stops as stop() does.
    ~Recording();

    /// What operators have said so far of packets of the log, by its numbers: all of it, in place of what was
    /// set before. Each is in the file that has its packet within about a second; if that had ended, in
    /// the one that is being written, in other words.
    void setMarks(std::vector<RecordedMark> marks);

    /// Writes what the log holds and ends the file with notes on it. Fails with what went wrong since the
    /// start; again and again with the same.
    tl::expected<void, FileError> stop(std::vector<std::string> notes = {});

    // From any thread.
    [[nodiscard]] RecordingFigures figures() const;
    /// Why nothing more is written: the disk is full, say. Nothing as long as all is well.
    [[nodiscard]] std::optional<FileError> failure() const;

private:
    using Result = Recorder::Result;

    Recording(const PacketLog& log, std::unique_ptr<ByteSink> sink, std::uint64_t from);
    static tl::expected<std::unique_ptr<Recording>, FileError> begin(std::unique_ptr<Recording> recording,
                                                                     const RecordingInfo& info);
    void run();
    [[nodiscard]] RecordingFigures figuresNow() const;
    bool note(const Result& result);
    bool carryOut(const std::function<Result()>& step);
    [[nodiscard]] bool isFileFull() const;
    Result goOn();
    std::uint64_t forgetGone(std::uint64_t begin);
    [[nodiscard]] tl::expected<std::unique_ptr<ByteSink>, FileError> createPart(std::string& path,
                                                                                bool mayMove);
    Result keepMarks();
    [[nodiscard]] tl::expected<std::vector<std::string>, FileError> noteMarks();
    Result finish();

    const PacketLog& m_log;
    std::string m_path; ///< that others are named after; empty if a sink was given
    RecordingInfo m_info;
    RecordingLimits m_limits;
    std::vector<std::uint64_t> m_fromBefore; ///< packets that come first
    // The thread's own:
    std::unique_ptr<ByteSink> m_sink;
    std::optional<Recorder> m_recorder;
    unsigned m_part = 1;
    std::string m_file;                    ///< that is being written
    std::vector<RecordingFigures> m_ended; ///< of each file before
    std::vector<Displaced> m_displaced;
    std::chrono::steady_clock::time_point m_fileBegin = std::chrono::steady_clock::now();
    std::vector<RecordedMark> m_kept;   ///< marks as they are noted
    std::vector<RecordedMark> m_before; ///< as they were when the file before ended

    mutable std::mutex m_mutex;
    std::vector<RecordedMark> m_marks;
    std::vector<std::string> m_notes;
    std::condition_variable m_changed;
    bool m_isStopping = false;
    RecordingFigures m_figures;
    std::optional<FileError> m_failure;
    std::thread m_thread;
};

} // namespace posewire::log
