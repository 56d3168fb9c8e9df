// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/datagram_pacer.h"
#include "app/cli/send.h"
#include "core/export/json_value.h"
#include "core/log/recording_file.h"
#include "core/model/accounting/other_formats.h"
#include "core/model/accounting/stream_figures.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace posewire::cli {

namespace {

using exporting::JsonValue;

/// Counts of a stream for `monitor`, in the order of its report.
std::array<std::pair<model::Figure, std::uint64_t>, 11> valuesOf(const performer::SentFigures& sent) {
    using enum model::Figure;
    return {{{Datagrams, sent.datagrams},
             {Samples, sent.samples},
             {Lost, sent.lost},
             {Duplicates, sent.duplicates},
             {Reordered, sent.reordered},
             {Late, sent.late},
             {Incomplete, sent.incomplete},
             {Restarts, sent.restarts},
             {Step, sent.step},
             {FirstSample, sent.firstSample},
             {LastSample, sent.lastSample}}};
}

JsonValue jsonOf(std::uint8_t type, const performer::SentFigures& sent) {
    JsonValue json{{"type", wire::typeDigits(type)}};
    for (const auto& [figure, value] : valuesOf(sent)) {
        const model::FigureRow& row = model::rowOf(figure);
        if (wire::isSampled(type) || row.scope != model::FigureScope::Samples) {
            json[std::string(row.key)] = value;
        }
    }
    return json;
}

JsonValue jsonOf(const performer::FaultTally& tally) {
    return {{"offered", tally.offered},     {"dropped", tally.dropped},     {"duplicated", tally.duplicated},
            {"reordered", tally.reordered}, {"corrupted", tally.corrupted}, {"truncated", tally.truncated},
            {"withheld", tally.withheld}};
}

/// The streams of a truth are in the order of their characters.
JsonValue::array_t charactersOf(const performer::Truth& truth) {
    JsonValue::array_t characters;
    JsonValue::array_t streams;
    std::optional<std::uint8_t> character;
    const auto finish = [&] {
        if (character) {
            characters.push_back({{"id", *character}, {"streams", std::exchange(streams, {})}});
        }
    };
    for (const auto& [key, stream] : truth.streams()) {
        if (character != key.character) {
            finish();
            character = key.character;
        }
        streams.push_back(jsonOf(key.type, stream.figures()));
    }
    finish();
    return characters;
}

JsonValue jsonOf(const SendLine::Sender& sender, const performer::FaultTally& tally) {
    const performer::SenderFigures& figures = sender.truth().sender();
    return {{"address", sender.address},
            {"transport", sender.isTcp ? "tcp" : "udp"},
            {"datagrams", figures.datagrams},
            {"bytes", figures.bytes},
            {"malformed", figures.malformed},
            {"skippedBytes", sender.isTcp ? sender.streamed.skippedBytes() : 0},
            {"foreignDatagrams", figures.foreign},
            {"characters", charactersOf(sender.truth())},
            {"faults", jsonOf(tally)}};
}

} // namespace

net::NetResult<SendLine> SendLine::open(const std::vector<net::SendTarget>& targets,
                                        const performer::FaultSettings& faults, bool keepsTruth) {
    SendLine line(faults, keepsTruth);
    for (const net::SendTarget& target : targets) {
        auto sender = net::DatagramSender::connect(target);
        if (!sender) {
            return tl::unexpected(sender.error());
        }
        std::string address = sender->localAddress();
        const bool isTcp = target.transport == net::SendTarget::Transport::Tcp;
        line.m_senders.push_back(
            {std::move(address), net::textOf(target.endpoint), isTcp, std::move(*sender), {}, {}});
    }
    return line;
}

net::NetResult<void> SendLine::send(const performer::Sending& sending) {
    for (Sender& sender : m_senders) {
        const std::uint64_t before = sender.sender.sent();
        if (auto sent = sender.sender.send(sending.bytes); !sent) {
            return sent;
        }
        if (!m_keepsTruth || sender.sender.sent() == before) {
            continue; // what the system refused was not sent
        }
        if (sender.isTcp) {
            sender.streamed.add(sending);
        } else {
            sender.datagrams.add(sending);
        }
    }
    return {};
}

net::NetResult<void> SendLine::finish() {
    for (Sender& sender : m_senders) {
        sender.streamed.finish();
        if (auto flushed = sender.sender.flush(); !flushed) {
            return flushed;
        }
    }
    return {};
}

void SendLine::tellRefusals(const Console& console) {
    for (Sender& sender : m_senders) {
        if (sender.sender.refused() != 0 && !std::exchange(sender.isRefusalTold, true)) {
            console.complain(sender.target + ": the network refuses to send there; check the address, and "
                                             "that the network is connected. Still trying");
        }
    }
}

net::NetResult<void> SendRound::send(std::optional<log::Duration> until) {
    m_leaving.clear();
    for (std::size_t line = 0; line < m_lines.size(); ++line) {
        m_taken.clear();
        m_lines[line].faults().take(until, m_taken);
        for (performer::Sending& sending : m_taken) {
            m_leaving.push_back({line, std::move(sending)});
        }
    }
    if (m_lines.size() > 1) {
        std::ranges::stable_sort(m_leaving, {}, [](const Leaving& leaving) { return leaving.sending.due; });
    }
    for (Leaving& leaving : m_leaving) {
        // A busy computer sends later than planned; lateness counts from when it was sent.
        leaving.sending.due += m_schedule.waitUntil(leaving.sending.due);
        if (auto sent = m_lines[leaving.line].send(leaving.sending); !sent) {
            return sent;
        }
    }
    return {};
}

tl::expected<void, std::string> writeTruth(const SendOptions& options, const std::vector<SendLine>& lines) {
    JsonValue::array_t senders;
    std::uint64_t foreign = 0;
    for (const SendLine& line : lines) {
        for (const SendLine::Sender& sender : line.senders()) {
            senders.push_back(jsonOf(sender, line.faults().tally()));
            foreign += sender.truth().sender().foreign;
        }
    }
    JsonValue report{{"durationS", options.durationSeconds},
                     {"foreignDatagrams", foreign},
                     {"sources", std::move(senders)}};
    if (!options.fault.kind.empty()) {
        report["content"] = {{"what", options.fault.kind}, {"fromS", options.fault.fromSeconds}};
    }
    return Output::writeFile(options.truth, {options.replaces}, exporting::jsonText(report, 2) + "\n");
}

namespace {

/// Sends records when they are due, until an error.
class RecordSender {
public:
    RecordSender(const SendOptions& options, std::vector<SendLine>& lines, const Console& console)
        : m_lines(lines),
          m_console(console),
          m_schedule(m_clock),
          m_round(lines, m_schedule),
          m_pacer(1.0 / options.performer.rateHz, options.speed, options.range),
          m_end(options.durationSeconds > 0.0 ? log::durationOf(options.durationSeconds)
                                              : log::Duration::max()) {}

    void operator()(const log::FileRecord& record) {
        if (isRoundOver()) {
            return;
        }
        if (record.flags.skipped) {
            m_skipped += record.bytes.size();
            return;
        }
        const auto due = m_pacer.due(record);
        m_isDone = due && *due >= m_end;
        if (!due || m_isDone) {
            return;
        }
        if (m_datagrams++ == 0) {
            m_schedule.startNow(); // opening and reading is no part of it
        }
        note(m_round.send(*due));
        for (SendLine& line : m_lines) {
            line.faults().offer({record.bytes.begin(), record.bytes.end()}, *due);
        }
        note(m_round.send(*due + log::Duration(1)));
        for (SendLine& line : m_lines) {
            line.tellRefusals(m_console);
        }
    }

    /// The recording will not be repeated.
    void finish() {
        if (m_failure.empty()) {
            note(m_round.send(std::nullopt));
        }
    }

    void beginAgain() { m_pacer.beginAgain(); }
    [[nodiscard]] bool isDone() const { return m_isDone; }
    /// Nothing more of the recording is wanted, at least until it begins again.
    [[nodiscard]] bool isRoundOver() const { return m_isDone || m_pacer.isPast(); }
    [[nodiscard]] std::uint64_t datagrams() const { return m_datagrams; }
    [[nodiscard]] std::uint64_t skipped() const { return m_skipped; }
    [[nodiscard]] const std::string& failure() const { return m_failure; }

private:
    void note(const net::NetResult<void>& sent) {
        if (!sent && m_failure.empty()) {
            m_failure = sent.error().text;
            m_isDone = true;
        }
    }

    std::vector<SendLine>& m_lines;
    const Console& m_console;
    log::SystemClock m_clock;
    net::SendSchedule m_schedule;
    SendRound m_round;
    DatagramPacer m_pacer;
    log::Duration m_end;
    std::uint64_t m_datagrams = 0;
    std::uint64_t m_skipped = 0;
    std::string m_failure;
    bool m_isDone = false;
};

tl::expected<void, log::FileError> sendOnce(const std::string& path, RecordSender& sender,
                                            log::FileContents& contents, const Console& console) {
    const auto file = openInput(path, [&] { return sender.isRoundOver(); });
    if (!file) {
        return tl::unexpected(file.error());
    }
    WatchedInput input(**file, contents, console.complain);
    return log::readFile(input, std::ref(sender), {}, &contents);
}

ExitStatus concludeFile(const std::string& path, const RecordSender& sender,
                        const log::FileContents& contents, Console& console) {
    if (!sender.failure().empty()) {
        return console.unusable(sender.failure());
    }
    if (sender.datagrams() == 0) {
        const std::string other = model::otherContents(contents, path);
        console.complain(path + (other.empty()
                                     ? ": no datagrams between these times; try without --since and --until"
                                     : ": no datagrams found: it " + other));
        return ExitStatus::Faults;
    }
    if (sender.skipped() != 0) {
        console.complain(path + ": " + std::to_string(sender.skipped()) +
                         " bytes belong to no datagram and were not sent; decode shows where");
        return ExitStatus::Faults;
    }
    return ExitStatus::Fine;
}

} // namespace

ExitStatus sendFile(const SendOptions& options, std::vector<SendLine>& lines, Console& console) {
    RecordSender records(options, lines, console);
    ExitStatus reading = ExitStatus::Fine;
    log::FileContents contents;
    bool isToBegin = true;
    while (isToBegin) {
        const std::uint64_t before = records.datagrams();
        const auto result = sendOnce(options.file, records, contents, console);
        if (reading == ExitStatus::Fine) { // a file that is cut off is told once
            reading = readingStatus(result, console);
        }
        if (reading == ExitStatus::Unusable) {
            return reading;
        }
        const bool hadSome = records.datagrams() != before;
        isToBegin = options.loops && hadSome && !records.isDone() && options.file != "-";
        records.beginAgain();
    }
    records.finish();
    return worse(reading, concludeFile(options.file, records, contents, console));
}

} // namespace posewire::cli
