// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/cli/field_listing.h"
#include "app/cli/input.h"
#include "app/cli/record_filter.h"
#include "core/export/json.h"
#include "core/log/recording_file.h"
#include "core/wire/codec.h"
#include "core/wire/type_table.h"

namespace posewire::cli {
namespace {

struct DecodeOptions {
    std::vector<std::string> files;
    bool asJson = false;
    std::string filter;
};

/// Writes one file's records and counts their faults.
class RecordWriter {
public:
    /// Without a filter everything is written.
    RecordWriter(Output& out, bool asJson, const filter::Filter& filter) : m_out(out), m_asJson(asJson) {
        if (!filter.matchesEverything()) {
            m_filter.emplace(filter);
        }
    }

    void operator()(const log::FileRecord& record) {
        if (!m_out.isWanted()) {
            return;
        }
        if (record.flags.skipped) {
            skip(record);
            return;
        }
        endSkipped();
        const exporting::DatagramPlace place = placeOf(record);
        if (m_filter && !m_filter->matches(record, place.index)) {
            return;
        }
        if (!wire::decode(record.bytes)) {
            m_firstFault = m_faults == 0 ? record.offset : m_firstFault;
            ++m_faults;
        }
        m_out.write(m_asJson ? exporting::datagramJson(place, record.bytes) + '\n' : listed(place, record));
    }

    /// Call after the last record.
    void endSkipped() {
        const std::uint64_t skipped = std::exchange(m_skipped, 0);
        if (skipped == 0) {
            return;
        }
        const exporting::DatagramPlace place{m_index++, m_skippedFrom, std::nullopt, std::nullopt};
        if (m_filter &&
            !m_filter->matches({.offset = m_skippedFrom, .bytes = m_firstSkipped, .flags = {.skipped = true}},
                               place.index)) {
            return;
        }
        m_out.write(m_asJson
                        ? exporting::skippedJson(place, skipped) + '\n'
                        : "#" + std::to_string(place.index) + "  offset " + std::to_string(place.offset) +
                              "  " + std::to_string(skipped) + " bytes that belong to no datagram\n\n");
        m_allSkipped += skipped;
    }

    /// One line about the faults; empty if there were none.
    [[nodiscard]] std::string complaint(const std::string& name) const {
        std::string text;
        if (m_faults != 0) {
            text = std::to_string(m_faults) + " of " + std::to_string(m_datagrams) +
                   " datagrams could not be decoded, the first at byte " + std::to_string(m_firstFault);
        }
        if (m_allSkipped != 0) {
            text +=
                (text.empty() ? "" : "; ") + std::to_string(m_allSkipped) + " bytes belong to no datagram";
        }
        return text.empty() ? text : name + ": " + text + "; the output says what is wrong with each";
    }

private:
    void skip(const log::FileRecord& record) {
        if (m_skipped == 0) {
            m_skippedFrom = record.offset;
            m_firstSkipped.clear();
        }
        const std::size_t room = wire::kMaxDatagramSize - m_firstSkipped.size();
        const auto kept = m_filter ? record.bytes.first(std::min(room, record.bytes.size())) : wire::Bytes();
        m_firstSkipped.insert(m_firstSkipped.end(), kept.begin(), kept.end());
        m_skipped += record.bytes.size();
    }
    exporting::DatagramPlace placeOf(const log::FileRecord& record) {
        ++m_datagrams;
        return {m_index++, record.offset, record.stamp,
                record.sender ? std::optional(record.sender->address) : std::nullopt};
    }
    static std::string listed(const exporting::DatagramPlace& place, const log::FileRecord& record) {
        const auto header = wire::decodeHeader(record.bytes);
        return "#" + std::to_string(place.index) + "  offset " + std::to_string(place.offset) + "  " +
               std::to_string(record.bytes.size()) + " bytes" +
               (header ? "  " + wire::typeTitle(header->type()) : "") +
               (place.sender ? "  from " + *place.sender : "") + '\n' + fieldListing(record.bytes) + '\n';
    }

    Output& m_out;
    bool m_asJson;
    std::optional<RecordFilter> m_filter;
    std::vector<std::byte>
        m_firstSkipped; ///< the part of skipped bytes that a filter sees: at most one packet's worth
    std::uint64_t m_index = 0;
    std::uint64_t m_datagrams = 0;
    std::uint64_t m_faults = 0;
    std::uint64_t m_firstFault = 0;
    std::uint64_t m_skipped = 0;
    std::uint64_t m_skippedFrom = 0;
    std::uint64_t m_allSkipped = 0;
};

ExitStatus decodeFile(const std::string& path, const DecodeOptions& options, const filter::Filter& filter,
                      Console& console) {
    const auto file = openInput(path);
    if (!file) {
        console.complain(file.error().text);
        return ExitStatus::Unusable;
    }
    RecordWriter writer(console.out, options.asJson, filter);
    const auto result = log::readFile(**file, std::ref(writer));
    writer.endSkipped();
    if (!result) {
        console.complain(result.error().text);
        return ExitStatus::Unusable;
    }
    const std::string complaint = writer.complaint((*file)->name());
    if (complaint.empty()) {
        return ExitStatus::Fine;
    }
    console.complain(complaint);
    return ExitStatus::Faults;
}

ExitStatus decode(const DecodeOptions& options, Console& console) {
    const auto filter = filter::Filter::compile(options.filter);
    if (!filter) {
        console.complain(markedError(options.filter, filter.error()));
        return ExitStatus::Unusable;
    }
    ExitStatus status = ExitStatus::Fine;
    for (const std::string& path : options.files) {
        if (!options.asJson && options.files.size() > 1) {
            console.out.write(path + "\n\n");
        }
        status = worse(status, decodeFile(path, options, *filter, console));
    }
    return status;
}

} // namespace

Command addDecodeCommand(CommandLine& program) {
    auto options = std::make_shared<DecodeOptions>();
    Arguments arguments =
        program.addCommand("decode", "Show the datagrams of files, field by field or as JSON Lines");
    arguments.add("FILE", options->files, "datagrams back to back, or pcap or pcapng; - for standard input")
        .required();
    arguments.flag("--json", options->asJson, "one JSON object a line for each datagram");
    arguments.add("--filter", options->filter,
                  "only packets that this matches, such as \"type == 02 && position.z > 2\"; "
                  "reference --filter has the language");
    return {"decode", [options](Console& console) { return decode(*options, console); }};
}

} // namespace posewire::cli
