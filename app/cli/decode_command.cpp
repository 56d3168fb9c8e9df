// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/cli/record_packets.h"
#include "core/export/json.h"
#include "core/log/recording_file.h"
#include "core/model/foreign_text.h"
#include "core/wire/codec.h"
#include "core/wire/field_tree.h"
#include "core/wire/type_table.h"
#include "core/words/say.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace posewire::cli {
namespace {

/// On one line, and nothing in it that a terminal would obey or that turns the direction of what follows.
std::string onOneLine(std::string_view value) {
    std::string text;
    for (const char character : model::visibleText(value)) {
        text += character == '\n' ? "\\n" : character == '\t' ? "␉" : std::string(1, character);
    }
    return text;
}

std::string row(const wire::FieldNode& node, std::size_t depth) {
    constexpr std::size_t offsetWidth = 8;
    constexpr std::size_t nameWidth = 30;
    std::string line = std::to_string(node.offset);
    line.insert(0, line.size() < offsetWidth ? offsetWidth - line.size() : 0, ' ');
    line.append(2 + 2 * depth, ' ').append(node.name);
    if (!node.value.empty()) {
        line.resize(std::max(line.size(), offsetWidth + 2 + nameWidth), ' ');
        line.append("  ").append(onOneLine(node.value));
        line.append(wire::unitSymbol(node.unit).empty() ? "" : "  ").append(wire::unitSymbol(node.unit));
    }
    return line + '\n';
}

/// Every field of a datagram with its offset, value and unit, one per line, then notices and errors.
std::string fieldListing(wire::Bytes bytes) {
    const wire::FieldTree tree = wire::fieldTree(bytes);
    std::string text;
    std::vector<std::size_t> depths;
    for (const wire::FieldNode& node : tree.nodes) {
        depths.push_back(node.parent < 0 ? 0 : depths[static_cast<std::size_t>(node.parent)] + 1);
        text += row(node, depths.back());
    }
    for (const wire::Notice& notice : tree.notices) {
        text += "  notice: " + wire::noticeText(notice) + '\n';
    }
    if (tree.fault) {
        text += "  error: " + wire::errorText(*tree.fault) + '\n';
    }
    return text;
}

/// Returns why a list of fields, divided by commas, cannot be used; empty if it can.
std::string readFields(const std::string& text, std::vector<std::string>& fields) {
    const std::vector<std::string> known = exporting::jsonFields();
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string& field = fields.emplace_back(text.substr(begin, end - begin));
        if (std::find(known.begin(), known.end(), field) == known.end()) {
            return "there is no field \"" + field + "\"; choose from " + usage::joined(known, ", ");
        }
        begin = end + 1;
    }
    return {};
}

struct DecodeOptions {
    std::vector<std::string> files;
    bool asJson = false;
    exporting::JsonChoice choice{};
    std::string filter;

    [[nodiscard]] bool isJson() const { return asJson || choice.hasNames || !choice.fields.empty(); }
};

class RecordWriter {
public:
    /// Without a filter everything is written.
    RecordWriter(Output& out, const DecodeOptions& options, const filter::Filter& filter)
        : m_out(out), m_options(options) {
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
        if (m_filter && !m_filter->matches(m_packets.packetOf(record, place.index))) {
            return;
        }
        if (!wire::decodeInto(record.bytes, m_datagram)) {
            m_firstFault = m_faults == 0 ? record.offset : m_firstFault;
            ++m_faults;
        }
        m_out.write(m_options.isJson() ? exporting::datagramJson(place, record.bytes, m_options.choice) + '\n'
                                       : listed(place, record));
    }

    /// Call after the last record.
    void endSkipped() {
        const std::uint64_t skipped = std::exchange(m_skipped, 0);
        if (skipped == 0) {
            return;
        }
        const exporting::DatagramPlace place{m_index++, m_skippedFrom, std::nullopt, std::nullopt};
        if (m_filter && !m_filter->matches(m_packets.packetOf(
                            {.offset = m_skippedFrom, .bytes = m_firstSkipped, .flags = {.skipped = true}},
                            place.index))) {
            return;
        }
        m_out.write(m_options.isJson()
                        ? exporting::skippedJson(place, skipped, m_options.choice) + '\n'
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
        return {m_index++, record.offset, record.time,
                record.sender ? std::optional(record.sender->address) : std::nullopt, record.flags.shared};
    }
    static std::string listed(const exporting::DatagramPlace& place, const log::FileRecord& record) {
        const auto header = wire::decodeHeader(record.bytes);
        return "#" + std::to_string(place.index) + "  offset " + std::to_string(place.offset) + "  " +
               std::to_string(record.bytes.size()) + " bytes" +
               (header ? "  " + wire::typeTitle(header->type()) : "") +
               (place.sender ? "  from " + *place.sender : "") + '\n' +
               (place.shared != 0
                    ? "  notice: " + say(words::sharedFact(place.shared), words::Form::Sentence) + '\n'
                    : "") +
               fieldListing(record.bytes) + '\n';
    }

    Output& m_out;
    const DecodeOptions& m_options;
    std::optional<filter::Filter> m_filter;
    RecordPackets m_packets;
    std::vector<std::byte>
        m_firstSkipped;        ///< the part of skipped bytes that a filter sees: at most one packet's worth
    wire::Datagram m_datagram; ///< the newest; its memory is reused
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
    const auto file = openInput(path, [&] { return !console.out.isWanted(); });
    if (!file) {
        return console.unusable(file.error().text);
    }
    RecordWriter writer(console.out, options, filter);
    log::FileContents contents;
    WatchedInput input(**file, contents, console.complain);
    const auto result = log::readFile(input, std::ref(writer), {}, &contents);
    writer.endSkipped();
    const std::string complaint = writer.complaint((*file)->name());
    if (!complaint.empty()) {
        console.complain(complaint);
    }
    const ExitStatus faults = complaint.empty() ? ExitStatus::Fine : ExitStatus::Faults;
    const bool isPipeAtItsEnd = path == "-" && contents.isEmpty; // it may well have nothing
    return worse(faults, isPipeAtItsEnd ? readingStatus(result, console)
                                        : readingStatus(result, contents, (*file)->name(), console));
}

ExitStatus decode(const DecodeOptions& options, Console& console) {
    const auto filter = filter::Filter::compile(options.filter);
    if (!filter) {
        return console.unusable("--filter: " + markedError(options.filter, filter.error()));
    }
    ExitStatus status = ExitStatus::Fine;
    for (const std::string& path : options.files) {
        if (!options.isJson() && options.files.size() > 1) {
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
    arguments
        .add("FILE", options->files, "datagrams back to back, or pcap, pcapng or MVNX; - for standard input")
        .required();
    arguments.flag("--json", options->asJson, "one JSON object a line for each datagram");
    arguments.flag("--names", options->choice.hasNames,
                   "the same, with the names of segments, points and joints beside their ids");
    arguments.read(
        "--fields NAMES",
        [options](const std::string& text) { return readFields(text, options->choice.fields); },
        "JSON of these fields alone, in this order, such as index,sample,body.segments");
    arguments.add("--filter", options->filter,
                  "only packets that this matches, such as \"type == 02 && position.z > 2\"; "
                  "reference --filter has the language");
    return {"decode", [options](Console& console) { return decode(*options, console); }};
}

} // namespace posewire::cli
