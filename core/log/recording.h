// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/recorder.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace posewire::log {

/// A Recorder on a thread of its own: a slow disk delays nobody. What was received is in the file within a
/// tenth of a second, also where the process is killed.
class Recording {
public:
    struct Figures {
        std::uint64_t packets = 0;
        std::uint64_t bytes = 0;  ///< of the file so far
        std::uint64_t missed = 0; ///< see Recorder
    };

    /// Records from packet `from` on. Fails where the file cannot be made. `log` must outlive the recording.
    static tl::expected<std::unique_ptr<Recording>, FileError>
    start(const PacketLog& log, const std::string& path, const RecordingInfo& info, std::uint64_t from = 0);

    /// Stops as stop() does.
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    /// Writes what the log holds and ends the file. Fails with what went wrong since the start; again and
    /// again with the same.
    tl::expected<void, FileError> stop();

    // From any thread.
    [[nodiscard]] Figures figures() const;
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
    Figures m_figures;
    std::optional<FileError> m_failure;
    std::thread m_thread;
};

} // namespace posewire::log
