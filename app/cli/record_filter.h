// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/filter/filter.h"
#include "core/log/recording_file.h"
#include "core/log/sender_table.h"
#include "core/log/time.h"

#include <optional>
#include <string>

namespace posewire::cli {

/// A filter over the records of one file, in order. In a file without stamps all records have the same time.
class RecordFilter {
public:
    explicit RecordFilter(filter::Filter filter) : m_filter(std::move(filter)) {}

    /// `index` is the number in the output; runs of skipped bytes count too.
    [[nodiscard]] bool matches(const log::FileRecord& record, std::uint64_t index);

private:
    filter::Filter m_filter;
    model::PacketDigester m_digester;
    log::SenderTable m_senders;
    wire::Datagram m_datagram;
    std::optional<log::Stamp> m_firstStamp;
};

/// Why a filter was rejected, in three lines: the reason, the filter, and a caret under the place.
[[nodiscard]] std::string markedError(std::string_view text, const filter::FilterError& error);

} // namespace posewire::cli
