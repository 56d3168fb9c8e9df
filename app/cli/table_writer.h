// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/reports.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace posewire::cli {

/// The table of `monitor` while it runs: a line for the whole, then each sender with its characters and a
/// line for each of their streams. Texts from the wire are made harmless for a terminal.
[[nodiscard]] std::vector<std::string> liveTable(const model::SessionView& session,
                                                 const exporting::MonitorFacts& facts);

[[nodiscard]] std::size_t widthOf(std::string_view text);

/// Shows tables one after another: over each other on a terminal, else as blocks of lines.
class LiveDisplay {
public:
    explicit LiveDisplay(bool isTerminal) : m_isTerminal(isTerminal) {}

    /// Text and escape sequences that show these lines on a terminal of that size.
    [[nodiscard]] std::string show(const std::vector<std::string>& lines, std::size_t rows,
                                   std::size_t columns);

private:
    bool m_isTerminal;
    std::size_t m_shown = 0; ///< lines on the terminal that are to be written over
};

/// Writes tables or lines on a thread of its own: who reads slowly or not at all (a pager, a stopped
/// terminal) delays nobody. It holds the newest table only; one that was not begun in time is replaced by the
/// next. Lines it holds all.
class TableWriter {
public:
    /// Writes to this descriptor, which stays the caller's; on a terminal one table over the other.
    TableWriter(int descriptor, bool isTerminal)
        : m_descriptor(descriptor),
          m_isTerminal(isTerminal),
          m_display(isTerminal),
          m_thread([this] { run(); }) {}
    /// What is not written by now is left out.
    ~TableWriter();
    TableWriter(const TableWriter&) = delete;
    TableWriter& operator=(const TableWriter&) = delete;

    /// Returns at once.
    void show(std::vector<std::string> lines);

    /// A line of text, without its newline. Of what can wait, this waits until there is room or nobody reads.
    void add(std::string line, bool canWait);
    /// False while so many lines wait that the next one should.
    [[nodiscard]] bool hasRoom() const;
    /// Lines that were not written, or not to their ends.
    [[nodiscard]] std::uint64_t unwritten() const { return m_unwritten; }

    /// Waits until everything is written, or nobody reads; at most a second once `isInterrupted` says
    /// so.
    void finish(bool (*isInterrupted)());

    /// False once the reader has gone or writing has failed; failure() is empty for a reader that has gone.
    [[nodiscard]] bool isWanted() const { return m_isWanted; }
    [[nodiscard]] std::string failure() const;

private:
    static constexpr std::size_t kMostLines = 256;

    void run();
    [[nodiscard]] bool hasWork() const { return m_newest || !m_lines.empty(); }
    void write(std::string_view text, bool isOfLines);
    void noteFailure();

    int m_descriptor;
    bool m_isTerminal;
    LiveDisplay m_display; ///< the thread's own
    mutable std::mutex m_mutex;
    std::condition_variable m_changed;
    std::optional<std::vector<std::string>> m_newest;
    std::deque<std::string> m_lines;
    std::atomic<std::uint64_t> m_unwritten = 0; ///< of the lines
    std::string m_failure;
    bool m_isWriting = false;
    std::atomic<bool> m_isStopping = false;
    std::atomic<bool> m_isWanted = true;
    std::thread m_thread;
};

} // namespace posewire::cli
