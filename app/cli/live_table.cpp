// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/live_table.h"

#include "core/export/html.h"
#include "core/export/session_reading.h"
#include "core/model/session/accounts.h"
#include "core/model/session/losses.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>

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

/// At most `most` characters.
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

/// A line with a cell for each column.
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
                       grouped(all.foreign) + "   dropped by this computer " + grouped(all.kernelDrops);
    if (session.accounts().overtaken() != 0) {
        line += "   not looked at in time " + grouped(session.accounts().overtaken());
    }
    if (const model::Unproven unproven = session.accounts().unproven(); unproven.characters != 0) {
        line += "   unconfirmed characters " + grouped(unproven.characters);
    }
    if (facts.refusedDatagrams != 0) {
        line += "   refused by --from " + grouped(facts.refusedDatagrams);
    }
    return line;
}

} // namespace

std::size_t widthOf(std::string_view text) {
    return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, isContinuation));
}

std::vector<std::string> liveTable(const model::SessionView& session, const exporting::MonitorFacts& facts) {
    std::vector<std::string> lines{summaryLine(session, facts)};
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

} // namespace posewire::cli
