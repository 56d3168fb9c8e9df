// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/table_writer.h"

#include "app/cli/input_output.h"
#include "app/system/interruption.h"
#include "app/system/standard_streams.h"
#include "core/log/system_files.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <span>
#include <utility>

namespace posewire::cli {

TableWriter::TableWriter(int descriptor, bool isTerminal)
    : m_descriptor(descriptor),
      m_isTerminal(isTerminal),
      m_display(isTerminal),
      m_thread([this] { run(); }) {}

TableWriter::~TableWriter() {
    {
        const std::lock_guard lock(m_mutex);
        m_isStopping = true;
    }
    m_changed.notify_all();
    m_thread.join();
}

void TableWriter::show(std::vector<std::string> lines) {
    {
        const std::lock_guard lock(m_mutex);
        m_newest = std::move(lines);
    }
    m_changed.notify_all();
}

void TableWriter::add(std::string line, bool canWait) {
    std::unique_lock lock(m_mutex);
    if (canWait) {
        constexpr std::chrono::milliseconds step{20};
        const auto hasRoom = [this] { return m_lines.size() < kMostLines || !m_isWanted; };
        while (!m_changed.wait_for(lock, step, hasRoom) && !system::Interruption::hasCome()) {
        }
    }
    m_lines.push_back(std::move(line) + '\n');
    ++m_unwritten;
    m_changed.notify_all();
}

bool TableWriter::hasRoom() const {
    const std::lock_guard lock(m_mutex);
    return m_lines.size() < kMostLines;
}

void TableWriter::finish(bool (*isInterrupted)()) {
    using namespace std::chrono;
    constexpr milliseconds step{20};
    constexpr seconds patience{1};
    std::optional<steady_clock::time_point> interrupted;
    std::unique_lock lock(m_mutex);
    while (m_isWanted && (hasWork() || m_isWriting)) {
        m_changed.wait_for(lock, step);
        if (isInterrupted() && !interrupted) {
            interrupted = steady_clock::now();
        }
        if (interrupted && steady_clock::now() - *interrupted >= patience) {
            return;
        }
    }
}

std::string TableWriter::failure() const {
    const std::lock_guard lock(m_mutex);
    return m_failure;
}

void TableWriter::run() {
    std::unique_lock lock(m_mutex);
    while (true) {
        m_changed.wait(lock, [this] { return m_isStopping || hasWork(); });
        if (m_isStopping) {
            return;
        }
        std::string text;
        const bool hasLines = !m_lines.empty();
        const auto table = std::exchange(m_newest, std::nullopt);
        for (; !m_lines.empty(); m_lines.pop_front()) {
            text += m_lines.front();
        }
        m_isWriting = true;
        m_changed.notify_all();
        lock.unlock();
        if (table) {
            const system::TerminalSize size = system::terminalSize();
            text += m_display.show(*table, size.rows, size.columns);
        }
        write(text, hasLines);
        lock.lock();
        m_isWriting = false;
        m_changed.notify_all();
    }
}

void TableWriter::write(std::string_view text, bool isOfLines) {
    constexpr std::size_t piece = 512; // the least that a pipe or a terminal with room takes at once
    constexpr std::chrono::milliseconds pause{50};
    while (!text.empty() && !m_isStopping && m_isWanted) {
        if (!log::hasRoom(m_descriptor, pause)) {
            continue;
        }
        const std::ptrdiff_t count =
            log::writeSome(m_descriptor, std::as_bytes(std::span(text.substr(0, piece))));
        if (count >= 0) {
            const std::string_view written = text.substr(0, static_cast<std::size_t>(count));
            m_unwritten -= isOfLines ? static_cast<std::size_t>(std::ranges::count(written, '\n')) : 0;
            text.remove_prefix(written.size());
        } else if (errno != EINTR && errno != EAGAIN) {
            noteFailure();
        }
    }
}

void TableWriter::noteFailure() {
    const int error = errno;
    const bool hasReaderGone = error == EPIPE || (error == EIO && m_isTerminal);
    const std::lock_guard lock(m_mutex);
    m_isWanted = false;
    m_changed.notify_all();
    if (!hasReaderGone) {
        m_failure = standardOutputFailure(error);
    }
}

} // namespace posewire::cli
