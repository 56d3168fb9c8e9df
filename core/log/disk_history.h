// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/log_reader.h"
#include "core/log/packet_log.h"
#include "core/log/past.h"
#include "core/log/pcapng_writer.h"
#include "core/log/system_files.h"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace posewire::log {

struct DiskHistoryChoice {
    std::string folder;                          ///< exists
    std::uint64_t most = std::uint64_t{8} << 30; ///< bytes of all files; at least 16 MiB
    std::uint64_t leaveFree = std::uint64_t{1}
                              << 30; ///< bytes: the oldest file goes before the disk is as full
};

struct DiskHistoryFigures {
    std::uint64_t bytes = 0; ///< of all files
    std::uint64_t begin = 0; ///< number of the oldest packet in them
    std::uint64_t end = 0;   ///< one past the newest
    /// Packets that the log had dropped before they could be written: the disk was too slow.
    std::uint64_t missed = 0;
};

/// Follows a log and keeps what it received in files, the oldest of which go at a cap: the log's Past, so
/// that packets which memory has dropped are read from there. Each file is a recording as any other; they are
/// removed at the end, and stay where the process dies. One thread of its own: a slow disk delays no one.
class DiskHistory {
public:
    /// All files together are as many of these as fit.
    static constexpr std::uint64_t kFiles = 16;

    /// Begins with the oldest packet in memory. Fails if no file can be made. `log` must outlive it.
    static tl::expected<std::unique_ptr<DiskHistory>, FileError>
    start(PacketLog& log, const DiskHistoryChoice& choice, const RecordingInfo& info);
    /// The log forgets what lay in the files, and they go, but for leave().
    ~DiskHistory();
    DiskHistory(const DiskHistory&) = delete;
    DiskHistory& operator=(const DiskHistory&) = delete;

    // From any thread.
    [[nodiscard]] DiskHistoryFigures figures() const;
    /// Why nothing more is kept. Nothing as long as all is well.
    [[nodiscard]] std::optional<FileError> failure() const;

    /// The files stay at the end, with everything that was received, as if the process had died.
    void leave() { m_isLeft = true; }

private:
    using Result = PcapngWriter::Result;
    struct File {
        std::string path;
        std::uint64_t first; ///< packet
        Descriptor lock;     ///< shows that its process lives; not open if the disk knows no locks
        std::uint64_t bytes = 0;
    };

    DiskHistory(PacketLog& log, const DiskHistoryChoice& choice, const RecordingInfo& info)
        : m_log(log), m_choice(choice), m_info(info), m_follower(log), m_senders(log.senders()) {}
    void run(const std::stop_token& stop);
    Result follow(const std::stop_token& stop);
    Result write(const Packet& packet);
    Result handOver();
    /// Whose first packet is `first`.
    Result beginFile(std::uint64_t first);
    tl::expected<std::string, FileError> createNext();
    Result endFile() {
        return m_writer->addStatistics().and_then([this] { return handOver(); });
    }
    /// Goes on in a new file where others made room.
    Result makeRoom(const FileError& why);
    void dropOldest();
    [[nodiscard]] bool isDiskFull() const;
    void note(const Result& result);

    PacketLog& m_log;
    const DiskHistoryChoice m_choice;
    const RecordingInfo m_info;
    LogFollower m_follower;
    SenderFinder m_senders;
    std::deque<File> m_files; ///< the newest is being written
    std::uint64_t m_fileCount = 0;
    bool m_isLeft = false;
    std::unique_ptr<ByteSink> m_sink;
    std::optional<PcapngWriter> m_writer;
    std::optional<PastWriter> m_past;
    mutable std::mutex m_mutex; ///< guards the figures and the failure
    std::condition_variable_any m_changed;
    DiskHistoryFigures m_figures;
    std::optional<FileError> m_failure;
    std::jthread m_thread; ///< last: it uses all of the above
};

/// A file of a history whose process is gone: it died with packets that nobody has saved.
struct LostHistory {
    std::string path;
    std::uint64_t bytes = 0;
    WallTime end{}; ///< when it was written last
};

/// Those in a folder, the oldest first.
[[nodiscard]] std::vector<LostHistory> lostHistories(const std::string& folder);
/// When the first packet of a recording was received; empty if it has none that can be read.
[[nodiscard]] std::optional<WallTime> beginOf(const std::string& path);
/// Removes the oldest of them, until they are not more than that many bytes, and files that were never
/// written.
void discardHistories(const std::string& folder, std::uint64_t most);

} // namespace posewire::log
