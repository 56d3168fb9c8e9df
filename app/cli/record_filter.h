// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/filter/filter.h"
#include "core/log/raw_file.h"
#include "core/log/sender_table.h"

#include <optional>
#include <string>

namespace posewire::cli {

/// A filter over the records of one file, in their order. A file without stamps is as if all came at once.
class RecordFilter {
public:
    explicit RecordFilter(filter::Filter filter) : m_filter(std::move(filter)) {}

    /// `index` is what the output counts; runs of skipped bytes count too.
    [[nodiscard]] bool matches(const log::FileRecord& record, std::uint64_t index);

private:
    filter::Filter m_filter;
    model::PacketDigester m_digester;
    log::SenderTable m_senders;
    wire::Datagram m_datagram;
    std::optional<std::int64_t> m_firstStampNs;
};

/// Why a filter was not understood, over three lines: the reason, the text, and a caret under the place.
[[nodiscard]] std::string markedError(std::string_view text, const filter::FilterError& error);

} // namespace posewire::cli
