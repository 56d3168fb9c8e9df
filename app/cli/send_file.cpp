// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/datagram_pacer.h"
#include "app/cli/send.h"
#include "core/log/recording_file.h"

#include <limits>

namespace posewire::cli {
namespace {

/// Sends records when they are due, until an error.
class RecordSender {
public:
    RecordSender(const SendOptions& options, std::vector<SendLine>& lines, const Console& console)
        : m_lines(lines),
          m_console(console),
          m_schedule(m_clock),
          m_round(lines, m_schedule),
          m_pacer(1.0 / options.performer.rateHz, options.speed, options.fromSeconds,
                  options.untilSeconds.value_or(std::numeric_limits<double>::infinity())),
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
        note(m_round.sendUntil(*due));
        for (SendLine& line : m_lines) {
            line.faults().offer({record.bytes.begin(), record.bytes.end()}, *due);
        }
        note(m_round.sendUntil(*due + log::Duration(1)));
        for (SendLine& line : m_lines) {
            line.tellRefusals(m_console);
        }
    }

    /// The recording will not be repeated.
    void finish() {
        if (m_failure.empty()) {
            note(m_round.sendRest());
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
        const std::string other = log::otherContents(contents);
        console.complain(path + ": no datagrams found" +
                         (other.empty() ? "; is it a recording of MXTP?" : ": it " + other));
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
