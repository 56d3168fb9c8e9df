// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/json_value.h"
#include "core/model/session/verdict.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Verdict and incidents for programs: in the report, and line by line while it goes on.
namespace posewire::exporting {

[[nodiscard]] JsonValue verdictJson(const model::SessionView& session, const model::TakeVerdict& verdict);
[[nodiscard]] JsonValue incidentJson(const model::SessionView& session, const model::ListedIncident& listed);
/// All there are.
[[nodiscard]] JsonValue incidentsJson(const model::SessionView& session);

/// One JSON object a line: at intervals, and at once when the verdict changes. Each says what the verdict is,
/// how each character does, the incidents that are new or have changed since the line before, and the numbers
/// of those that came to nothing.
class VerdictLines {
public:
    explicit VerdictLines(log::Duration interval) : m_interval(interval) {}

    /// The line that is due at a time of the log, without a newline; nothing where none is.
    [[nodiscard]] std::optional<std::string> lineAt(const model::SessionView& session, log::Stamp now);
    /// Leaves out the line that is due, where one is: what it had to tell is told by the next one. False
    /// where none is due.
    bool skipLine(const model::SessionView& session, log::Stamp now);
    /// The last one, also where none is due, once all is settled; nothing where the one before says all.
    [[nodiscard]] std::optional<std::string> lastLine(const model::SessionView& session, log::Stamp now);

private:
    /// Of the incidents since the line before.
    struct Changes {
        JsonValue::List changed;
        std::vector<std::uint64_t> gone; ///< their numbers
    };
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
