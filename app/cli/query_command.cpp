// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/cli/datagram_pacer.h"
#include "app/cli/record_packets.h"
#include "app/stage/range.h"
#include "core/export/json_value.h"
#include "core/feed/signal.h"

#include <array>
#include <charconv>
#include <cmath>
#include <deque>
#include <map>
#include <memory>

namespace posewire::cli {
namespace {

struct QueryOptions {
    std::string file;
    std::vector<std::string> expressions;
    bool asJson = false;
    std::optional<double> everySeconds;
    stage::Range range;
};

using Value = std::optional<double>;

/// Values of one sample of a character, or of one packet.
struct QueryRow {
    log::Stamp stamp{}; ///< of the first packet that had one of them
    log::SenderId sender{};
    std::string source{};
    std::optional<std::uint8_t> character{};
    std::optional<std::uint32_t> sample{};
    std::size_t filled = 0;
    std::vector<Value> values{};
};

/// Writes rows as CSV (RFC 4180) or JSON Lines.
class QueryTable {
public:
    QueryTable(Output& out, const std::vector<feed::Expression>& columns, bool asJson)
        : m_out(out), m_asJson(asJson) {
        m_line = asJson ? "{\"signals\":[" : "time [s],sample,character,source";
        for (const feed::Expression& column : columns) {
            const std::string unit = column.unit.empty() ? "" : " [" + column.unit + "]";
            m_line += m_line.back() == '[' ? "" : ",";
            m_line += asJson ? "{\"text\":" + json(column.text) + ",\"unit\":" + json(column.unit) + "}"
                             : quoted(column.text + unit);
        }
        m_out.write(m_line + (asJson ? "]}\n" : "\n"));
    }

    void write(double seconds, const QueryRow& row) {
        m_line.clear();
        addTime(m_asJson ? "{\"timeS\":" : "", seconds);
        add(m_asJson ? ",\"sample\":" : ",", row.sample);
        add(m_asJson ? ",\"character\":" : ",", row.character);
        if (row.source != m_source || m_sourceText.empty()) {
            m_source = row.source;
            m_sourceText = !m_asJson ? quoted(m_source) : m_source.empty() ? "null" : json(m_source);
        }
        m_line.append(m_asJson ? ",\"source\":" : ",").append(m_sourceText);
        m_line += m_asJson ? ",\"values\":[" : "";
        for (std::size_t i = 0; i < row.values.size(); ++i) {
            add(m_asJson && i == 0 ? "" : ",", row.values[i]);
        }
        m_out.write(m_line.append(m_asJson ? "]}\n" : "\n"));
    }

private:
    static std::string json(const std::string& text) { return exporting::jsonText(text); }

    /// A field of CSV.
    static std::string quoted(const std::string& text) {
        if (text.find_first_of(",\"\r\n") == std::string::npos) {
            return text;
        }
        std::string all = "\"";
        for (const char character : text) {
            all.append(character == '"' ? 2 : 1, character);
        }
        return all + '"';
    }

    /// Reads back to the same number.
    template <class Number>
    void add(std::string_view before, const std::optional<Number>& number) {
        m_line += before;
        if (!number) {
            m_line += m_asJson ? "null" : "";
            return;
        }
        if constexpr (std::is_floating_point_v<Number>) {
            if (!std::isfinite(*number)) {
                const std::string_view name = std::isnan(*number) ? "NaN"
                                              : *number > 0       ? "Infinity"
                                                                  : "-Infinity";
                m_line.append(m_asJson ? "\"" : "").append(name).append(m_asJson ? "\"" : "");
                return;
            }
        }
        std::array<char, 32> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), *number).ptr;
        m_line.append(digits.data(), end);
    }
    /// To the nanosecond.
    void addTime(std::string_view before, double seconds) {
        std::array<char, 32> digits{};
        const auto end =
            std::to_chars(digits.data(), digits.data() + digits.size(), seconds, std::chars_format::fixed, 9);
        m_line.append(before).append(digits.data(), end.ptr);
    }

    Output& m_out;
    bool m_asJson;
    std::string m_line;
    std::string m_source; ///< of the newest row, and as it is written
    std::string m_sourceText;
};

/// Means of the rows of a character in equal spans of time.
class SpanMeans {
public:
    SpanMeans(QueryTable& table, const std::vector<feed::Expression>& columns, double everySeconds)
        : m_table(table), m_every(everySeconds) {
        for (const feed::Expression& column : columns) {
            m_isAngle.push_back(column.dimension == field::Dimension::Angle);
        }
    }

    void add(double seconds, const QueryRow& row, const std::function<bool()>& isWanted) {
        Span& span = m_spans[{row.sender, row.character}];
        const double number = std::floor(seconds / m_every);
        while (!span.columns.empty() && span.number < number && isWanted()) {
            end(span);
        }
        if (span.columns.empty()) {
            span.columns.resize(row.values.size());
            span.number = number;
            span.row = row;
        }
        span.row.sample = span.row.sample ? span.row.sample : row.sample;
        for (std::size_t i = 0; i < row.values.size(); ++i) {
            Column& column = span.columns[i];
            if (const Value& value = row.values[i]; value && !std::isnan(*value)) {
                column.first = column.count == 0 ? *value : column.first;
                // -179° and 179° are 2° from each other.
                const double from = *value - column.first;
                column.sum += m_isAngle[i] ? std::remainder(from, 360) : from;
                ++column.count;
            }
        }
    }

    void endAll() {
        for (auto& [key, span] : m_spans) {
            end(span);
        }
    }

private:
    struct Column {
        double first = 0;
        double sum = 0; ///< of differences from the first
        std::size_t count = 0;
    };
    struct Span {
        double number = 0; ///< from the first datagram of the file
        QueryRow row;
        std::vector<Column> columns;
    };

    /// Writes a span; the next one has nothing yet.
    void end(Span& span) {
        for (std::size_t i = 0; i < span.columns.size(); ++i) {
            const Column column = std::exchange(span.columns[i], {});
            const auto count = static_cast<double>(column.count);
            span.row.values[i] = column.count != 0 ? Value(column.first + column.sum / count) : std::nullopt;
        }
        m_table.write(span.number * m_every, span.row);
        span.row.sample.reset();
        ++span.number;
    }

    QueryTable& m_table;
    double m_every;
    std::vector<bool> m_isAngle;
    std::map<std::pair<log::SenderId, std::optional<std::uint8_t>>, Span> m_spans;
};

/// Reads signals from the records of a file and brings those of one sample together.
class Query {
public:
    Query(const QueryOptions& options, std::vector<feed::Expression> columns, Output& out)
        : m_options(options),
          m_out(out),
          m_columns(std::move(columns)),
          m_hasValues(m_columns.size()),
          m_table(out, m_columns, options.asJson) {
        for (const feed::Expression& column : m_columns) {
            m_readsAll = m_readsAll || column.types.empty();
            for (const std::uint8_t type : column.types) {
                m_reads[type] = true;
            }
        }
        if (options.everySeconds) {
            m_means.emplace(m_table, m_columns, *options.everySeconds);
        }
    }

    [[nodiscard]] bool isDone() const { return m_isDone || !m_out.isWanted(); }

    void operator()(const log::FileRecord& record) {
        const std::uint64_t number = m_number++;
        const auto header =
            record.flags.skipped ? tl::unexpected(wire::WireError{}) : wire::decodeHeader(record.bytes);
        const log::Stamp stamp =
            record.time ? log::Stamp() : log::Stamp(m_pacer.due(record).value_or(m_paced));
        m_paced = stamp.time_since_epoch();
        if (record.flags.skipped || (!m_readsAll && !(header && m_reads[header->type()]))) {
            m_packets.stampOf(record, stamp);
            return;
        }
        const field::Candidate& candidate = m_packets.packetOf(record, number, stamp);
        m_faults += candidate.fault != nullptr && wire::startsWithMagic(record.bytes) ? 1 : 0;
        if (!m_range) {
            m_range = m_options.range.times(m_packets.firstStamp(), m_packets.firstTime());
        }
        m_isDone = candidate.packet.stamp >= m_range->to;
        if (isDone()) {
            return;
        }
        field::Subject packet(candidate);
        QueryRow* row = nullptr;
        for (std::size_t i = 0; i < m_columns.size(); ++i) {
            if (const Value value = m_columns[i].signal(packet)) {
                row = row == nullptr || row->values[i] ? &rowOf(packet, i) : row;
                row->values[i] = value;
                ++row->filled;
                m_hasValues[i] = true;
            }
        }
        writeClosed(candidate.packet.stamp);
    }

    /// Call after the last record.
    void end() {
        while (!m_rows.empty()) {
            writeFirst();
        }
        if (m_means) {
            m_means->endAll();
        }
    }

    /// Packets that could have had values, but could not be decoded.
    [[nodiscard]] std::uint64_t faults() const { return m_faults; }
    /// Signals without any value.
    [[nodiscard]] std::vector<std::string> missing() const {
        std::vector<std::string> texts;
        for (std::size_t i = 0; i < m_columns.size(); ++i) {
            if (!m_hasValues[i]) {
                texts.push_back(m_columns[i].text);
            }
        }
        return texts;
    }

private:
    static constexpr std::size_t kMostOpen = 512;
    static constexpr log::Duration kOpen = std::chrono::milliseconds(250);

    /// That of the packet's sample, or a new one if that has a value in the column.
    QueryRow& rowOf(field::Subject& packet, std::size_t column) {
        const log::Packet& from = packet.candidate.packet;
        const wire::Header* header = packet.header();
        const auto character = header != nullptr ? std::optional(header->character) : std::nullopt;
        const auto sample = header != nullptr ? std::optional(header->sampleCounter) : std::nullopt;
        for (auto row = m_rows.rbegin(); row != m_rows.rend(); ++row) {
            if (row->sender == from.sender && row->character == character && row->sample == sample) {
                if (!row->values[column]) {
                    return *row;
                }
                break;
            }
        }
        QueryRow row = m_spare.empty() ? QueryRow() : std::move(m_spare.back());
        if (!m_spare.empty()) {
            m_spare.pop_back();
        }
        const log::SenderInfo* info = packet.candidate.sender;
        row.stamp = from.stamp;
        row.sender = from.sender;
        row.source = info != nullptr ? info->address : std::string();
        row.character = character;
        row.sample = sample;
        row.filled = 0;
        row.values.assign(m_columns.size(), std::nullopt);
        return m_rows.emplace_back(std::move(row));
    }

    /// Rows that have all their values, or have waited for long enough.
    void writeClosed(log::Stamp now) {
        while (!m_rows.empty() && (m_rows.front().filled == m_columns.size() || m_rows.size() > kMostOpen ||
                                   now - m_rows.front().stamp > kOpen)) {
            writeFirst();
        }
    }

    void writeFirst() {
        const QueryRow& row = m_rows.front();
        const double seconds = log::secondsOf(row.stamp - m_packets.firstStamp());
        if (row.stamp >= m_range->from && m_means) {
            m_means->add(seconds, row, [this] { return m_out.isWanted(); });
        } else if (row.stamp >= m_range->from) {
            m_table.write(seconds, row);
        }
        m_spare.push_back(std::move(m_rows.front()));
        m_rows.pop_front();
    }

    const QueryOptions& m_options;
    Output& m_out;
    std::vector<feed::Expression> m_columns;
    std::vector<bool> m_hasValues;
    QueryTable m_table;
    std::optional<SpanMeans> m_means;
    std::array<bool, 256> m_reads{}; ///< message types
    bool m_readsAll = false;
    bool m_isDone = false;
    std::optional<model::TimeRange> m_range; ///< known from the first packet on
    DatagramPacer m_pacer{1.0 / 240, 1.0};
    log::Duration m_paced{};
    RecordPackets m_packets;
    std::deque<QueryRow> m_rows; ///< that may still get values, in the order of their first ones
    std::vector<QueryRow> m_spare;
    std::uint64_t m_number = 0;
    std::uint64_t m_faults = 0;
};

ExitStatus query(const QueryOptions& options, Console& console) {
    std::vector<feed::Expression> columns;
    for (const std::string& text : options.expressions) {
        auto column = feed::parseSignal(text);
        if (!column) {
            return console.unusable(markedError(text, column.error()));
        }
        columns.push_back(*std::move(column));
    }
    if (options.everySeconds && *options.everySeconds <= 0) {
        return console.unusable("--every must be more than 0");
    }
    const Query* reading = nullptr;
    const auto file = openInput(options.file, [&] { return reading != nullptr && reading->isDone(); });
    if (!file) {
        return console.unusable(file.error().text);
    }
    Query query(options, std::move(columns), console.out);
    reading = &query;
    log::FileContents contents;
    WatchedInput input(**file, contents, console.complain);
    const auto result = log::readFile(input, std::ref(query), {}, &contents);
    query.end();
    const std::string name = (*file)->name();
    if (query.faults() != 0) {
        console.complain(name + ": " + std::to_string(query.faults()) +
                         " datagrams could not be decoded; decode shows what is wrong with each");
    }
    for (const std::string& text : query.missing()) {
        console.complain(name + ": no values of " + text);
    }
    return worse(query.faults() != 0 ? ExitStatus::Faults : ExitStatus::Fine,
                 readingStatus(result, contents, name, console));
}

} // namespace

Command addQueryCommand(CommandLine& program) {
    auto options = std::make_shared<QueryOptions>();
    Arguments arguments = program.addCommand("query", "Print signals of a file over time: fields, distances, "
                                                      "angles, speeds, rates");
    arguments
        .add("FILE", options->file, "pcap, pcapng, MVNX, or datagrams back to back; - for standard input")
        .required();
    arguments
        .add("EXPRESSION", options->expressions,
             "signals, such as \"position.z of LeftHand\", \"speed(2.position of Pelvis)\" or 2.jitter; "
             "reference --filter has the language")
        .required();
    arguments.flag(
        "--json", options->asJson,
        "one JSON object a line: the first with the signals and their units, then one for each sample");
    arguments.flag("--csv", "a table with the units in its first line (default)");
    arguments
        .add("--every SECONDS", options->everySeconds,
             "one line for each span as long, from the first datagram on, with the mean of each signal's "
             "values in "
             "it; of a signal without values there the field is empty. Means of angles go the short way "
             "round.")
        .seconds();
    stage::addRange(arguments, options->range);
    return {"query", [options](Console& console) { return query(*options, console); }};
}

} // namespace posewire::cli
