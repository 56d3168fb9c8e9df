// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_figures.h"
#include "core/model/session/session_view.h"
#include "core/model/session/verdict.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace posewire::exporting {

struct MonitorFacts {
    double durationS = 0;
    std::int64_t receiveBufferBytes = 0; ///< the smallest that a socket was granted; 0 without any
    std::vector<std::string> exceeded{}; ///< one line for each limit that was not kept
    std::uint64_t refusedDatagrams = 0;  ///< from those who are not listened to
    bool hasMemory = false;              ///< what is kept, too, which no two runs have in common
};

/// One JSON object without a newline: every sender with its characters, their streams and all their figures.
[[nodiscard]] std::string monitorReport(const model::SessionView& session, const MonitorFacts& facts);

struct StreamReportOptions {
    std::optional<model::TimeRange> range{}; ///< all there is without one; either end may be open
    std::string application{};               ///< name and version of who writes it
    std::vector<std::string> exceeded{};     ///< one line for each limit that was not kept
    std::vector<std::pair<std::string, std::string>> settings{}; ///< what was set, in words
};

/// What a technician attaches to a ticket: one HTML file without anything outside it, light and dark, to be
/// read and to be printed. A verdict in words, plots over time, every figure of every stream, gaps with their
/// causes, events, what the characters said about themselves.
[[nodiscard]] std::string streamReport(const model::SessionView& session, const StreamReportOptions& options);

/// The streams of a character by type, whichever came first.
[[nodiscard]] std::vector<const model::Stream*> streamsByType(const model::SessionView& session,
                                                              const model::CharacterKey& key);

/// A figure as people read it: "12,345", "2.50". What is not known is 0.
[[nodiscard]] std::string figureText(const model::StreamFigures& figures, model::Figure figure, int decimals);

/// False if all that came from a sender was something else.
[[nodiscard]] bool hasSentMxtp(const model::Sender& sender);

/// One JSON object a line: at intervals, and at once when the verdict changes. Each says what the verdict is,
/// how each character does, the incidents that are new or have changed since the line before, and the numbers
/// of those that came to nothing.
class VerdictLines {
public:
    explicit VerdictLines(log::Duration interval) : m_interval(interval) {}

    /// The line that is due at a time of the log, without a newline; nothing if none is.
    [[nodiscard]] std::optional<std::string> lineAt(const model::SessionView& session, log::Stamp now);
    /// Leaves out the line that is due, where one is: what it had to tell is told by the next one. False
    /// where none is due.
    bool skipLine(const model::SessionView& session, log::Stamp now);
    /// The last one, also where none is due, once all is settled; nothing if the one before says all.
    [[nodiscard]] std::optional<std::string> lastLine(const model::SessionView& session, log::Stamp now);

private:
    struct Changes;
    [[nodiscard]] bool isDue(const model::TakeVerdict& verdict, log::Stamp now) const;
    void await(const model::TakeVerdict& verdict, log::Stamp now);
    [[nodiscard]] std::string line(const model::SessionView& session, log::Stamp now,
                                   const model::TakeVerdict& verdict, const Changes& changes);
    [[nodiscard]] Changes changesOf(const model::SessionView& session);

    log::Duration m_interval;
    std::optional<log::Stamp> m_next;
    std::optional<log::Stamp> m_newest;
    model::TakeVerdict m_verdict;
    std::map<std::uint64_t, std::uint64_t> m_told; ///< of what is listed: by number a sum of what it said
};

} // namespace posewire::exporting
