// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/table_writer.h"

#include "app/cli/input_output.h"
#include "app/system/interruption.h"
#include "app/system/standard_streams.h"
#include "core/export/html.h"
#include "core/log/system_files.h"
#include "core/model/session/accounts.h"
#include "core/model/session/losses.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"
#include "core/words/say.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <span>
#include <utility>

namespace posewire::cli {

namespace {

using exporting::fixed;
using exporting::grouped;

constexpr std::size_t kNameWidth = 34;

struct Column {
    model::Figure figure;
    std::string_view title;
    std::size_t width;
    int decimals;
};
constexpr std::array<Column, 8> kColumns{{{model::Figure::RateWhole, "Hz", 9, 1},
                                          {model::Figure::Missing, "lost", 9, 0},
                                          {model::Figure::LossShare, "loss %", 8, 3},
                                          {model::Figure::Duplicates, "duplicates", 12, 0},
                                          {model::Figure::Reordered, "reordered", 11, 0},
                                          {model::Figure::Late, "late", 7, 0},
                                          {model::Figure::Jitter, "jitter ms", 10, 3},
                                          {model::Figure::SpacingMost, "gap ms", 9, 1}}};

bool isContinuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U;
}

std::string_view cut(std::string_view text, std::size_t most) {
    std::size_t at = 0;
    for (std::size_t count = 0; at < text.size(); ++at) {
        count += isContinuation(text[at]) ? 0 : 1;
        if (count > most) {
            break;
        }
    }
    return text.substr(0, at);
}

std::string left(std::string_view text, std::size_t width) {
    const std::string_view shown = cut(text, width);
    return std::string(shown) + std::string(width - widthOf(shown), ' ');
}

std::string right(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, widthOf(text)), ' ') + text;
}

template <class Cell>
std::string tableRow(std::string_view name, Cell cell) {
    std::string line = left(name, kNameWidth);
    for (const Column& column : kColumns) {
        line += right(cell(column), column.width);
    }
    return line;
}

std::string streamLine(const model::Losses& losses, const model::Stream& stream) {
    const model::StreamFigures figures = losses.figuresOf(stream);
    return tableRow("    " + wire::typeTitle(stream.key.type), [&](const Column& column) {
        return figures.has(column.figure) ? exporting::figureText(figures, column.figure, column.decimals)
                                          : std::string();
    });
}

std::string summaryLine(const model::SessionView& session, const exporting::MonitorFacts& facts) {
    const model::SenderTotals all = session.accounts().allSenders();
    std::string line = fixed(facts.durationS, 1) + " s   " + grouped(all.datagrams) +
                       " datagrams   malformed " + grouped(all.malformed) + "   not MXTP " +
                       grouped(all.foreign) + "   dropped by this computer " +
                       (all.hasUncountedDrops ? std::string("not known here") : grouped(all.kernelDrops));
    if (session.accounts().overtaken() != 0) {
        line += "   not looked at in time " + grouped(session.accounts().overtaken());
    }
    if (const model::Unproven unproven = session.accounts().unproven(); unproven.characters != 0) {
        line += "   unconfirmed characters " + grouped(unproven.characters);
    }
    if (facts.refusedDatagrams != 0) {
        line += "   refused by --sender " + grouped(facts.refusedDatagrams);
    }
    return line;
}

} // namespace

std::size_t widthOf(std::string_view text) {
    return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, isContinuation));
}

std::vector<std::string> liveTable(const model::SessionView& session, const exporting::MonitorFacts& facts) {
    std::vector<std::string> lines{summaryLine(session, facts)};
    for (const model::Sender& sender : session.roster().senders()) {
        if (sender.foreign != 0) {
            lines.push_back(say(sender.foreignFact(), words::Form::Sentence));
        }
    }
    if (session.roster().streams().empty()) {
        lines.emplace_back("No MXTP datagram so far.");
        return lines;
    }
    lines.push_back(tableRow("", [](const Column& column) { return std::string(column.title); }));
    const model::Losses losses(session, {});
    for (const model::Sender& sender : session.roster().senders()) {
        if (!exporting::hasSentMxtp(sender)) {
            continue;
        }
        lines.push_back(sender.address().shown() + " (" + std::string(log::nameOf(sender.info.transport)) +
                        ")");
        for (const model::Character* character : sender.characters) {
            if (!character->isConfirmed) {
                continue;
            }
            lines.push_back("  " + session.roster().displayName(character->key).shown() + " (" +
                            std::to_string(character->key.character) + ")");
            for (const model::Stream* stream : exporting::streamsByType(session, character->key)) {
                lines.push_back(streamLine(losses, *stream));
            }
        }
    }
    const model::RetiredTotals& retired = session.accounts().retired();
    if (retired.senders != 0) {
        lines.push_back("Retired senders: " + grouped(retired.senders) + ", with " +
                        grouped(retired.wellFormed()) + " datagrams, " + grouped(retired.samples) +
                        " samples, " + grouped(retired.lost) + " lost");
    }
    return lines;
}

std::string LiveDisplay::show(const std::vector<std::string>& lines, std::size_t rows, std::size_t columns) {
    std::string text;
    if (!m_isTerminal) {
        for (const std::string& line : lines) {
            text += line + '\n';
        }
        return text + '\n';
    }
    // A table longer than the terminal would scroll, and the next one could not be written over it.
    const bool isWhole = lines.size() < rows;
    const std::size_t shown = isWhole ? lines.size() : rows - 2;
    text = m_shown != 0 ? "\x1b[" + std::to_string(m_shown) + "A" : "";
    for (std::size_t i = 0; i < shown; ++i) {
        text += "\x1b[2K" + std::string(cut(lines[i], columns)) + '\n';
    }
    if (!isWhole) {
        const std::string more =
            "… " + std::to_string(lines.size() - shown) + " lines more; make the window higher";
        text += "\x1b[2K" + std::string(cut(more, columns)) + '\n';
    }
    m_shown = shown + (isWhole ? 0 : 1);
    return text + "\x1b[J";
}

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
