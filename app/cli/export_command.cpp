// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/cli/datagram_pacer.h"
#include "app/figure/mannequin_body.h"
#include "app/stage/range.h"
#include "app/system/interruption.h"
#include "app/system/standard_streams.h"
#include "app/usage/usage.h"
#include "core/export/motion/motion_export.h"
#include "core/log/byte_io.h"
#include "core/log/file_names.h"
#include "core/log/packet_log.h"
#include "core/log/pcapng_writer.h"
#include "core/model/accounting/other_formats.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/origin.h"
#include "core/model/session/roster.h"
#include "core/words/say.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace posewire::cli {

namespace {

namespace fs = std::filesystem;

/// The file is read again if this is too little.
constexpr std::size_t kMemoryCap = std::size_t{64} << 20;

std::shared_ptr<log::Scratch> newScratch() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    return error ? std::make_shared<log::Scratch>() : log::scratchOfFile(folder);
}

std::shared_ptr<const log::ByteStore> storeOf(const std::string& path) {
    const auto store = path == "-" ? tl::unexpected(log::FileError{}) : log::openStore(path);
    return store ? *store : nullptr;
}

double sizeOf(const std::string& path) {
    std::error_code error;
    const fs::path file = log::pathOf(path);
    const std::uintmax_t size = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
    return error ? 0 : static_cast<double>(size);
}

} // namespace

/// A file as a log with a session that has followed all of it, with the stamps of the file; where it has
/// none, time codes space it. What the log's memory drops is read from the file again, where it can be.
class RecordedSession {
public:
    explicit RecordedSession(const std::string& path)
        : m_name(log::nameOf(log::pathOf(path).filename())),
          m_size(sizeOf(path)),
          m_store(storeOf(path)),
          m_origin(m_store != nullptr ? log::LogLimits{.memoryCap = kMemoryCap} : log::LogLimits{},
                   newScratch()) {
        if (m_store != nullptr) {
            m_past.emplace(m_log.past(), m_log.senders(), m_store);
        }
    }

    void declare(const model::SenderOverride& usual) { m_session.setUsual(usual); }

    /// Reads all of it; `progress` gets from 0 to 1 how far it is, where the file has a size. Where it is cut
    /// off, what is before that was read.
    tl::expected<void, log::FileError> read(log::ByteSource& source,
                                            const std::function<void(double share)>& progress) {
        auto result = log::readFile(
            source,
            [&](const log::FileRecord& record) {
                take(record);
                if (m_packets % kPacketsAtOnce == 0 || m_bytesWaiting >= kBytesAtOnce) {
                    follow();
                    progress(m_size > 0 ? std::min(1.0, static_cast<double>(record.offset) / m_size) : 0);
                }
            },
            {}, &m_contents);
        follow();
        if (m_past) {
            m_past->finish();
        }
        m_session.endFile();
        return result;
    }

    [[nodiscard]] const model::Session& session() const { return m_session; }
    [[nodiscard]] const log::FileContents& contents() const { return m_contents; }

private:
    static constexpr std::uint64_t kPacketsAtOnce = 4'096;
    static constexpr std::uint64_t kBytesAtOnce = std::uint64_t{4} << 20;

    void take(const log::FileRecord& record) {
        const log::Stamp stamp =
            record.time ? m_clock.stampOf(*record.time, record.setBy) : log::Stamp(*m_pacer.due(record));
        m_newest = std::max(m_newest, stamp);
        const log::SenderId sender =
            m_log.senders().intern(record.sender.value_or(log::SenderInfo{m_name, log::Transport::File, 0}));
        const log::Arrival arrival = log::arrivalOf(record, sender, stamp);
        m_log.writer().append(record.bytes, arrival);
        if (m_past) {
            note(record, arrival);
        }
        ++m_packets;
        m_bytesWaiting += record.bytes.size();
    }
    void note(const log::FileRecord& record, const log::Arrival& arrival) {
        if (record.isInOnePiece) {
            m_past->add(m_packets, arrival, record.offset, record.bytes.size());
        } else {
            m_past->keep(m_packets, arrival, record.bytes);
        }
        if (m_past->isFull()) {
            m_past->finish();
        }
    }
    void follow() {
        m_bytesWaiting = 0;
        m_log.writer().publish();
        while (m_session.followFile(m_newest)) {
        }
    }

    std::string m_name;                            ///< of the sender of a raw file
    double m_size = 0;                             ///< bytes; 0 if it is not known
    std::shared_ptr<const log::ByteStore> m_store; ///< null if it can be read only once
    model::Origin m_origin;
    log::PacketLog& m_log = m_origin.log();
    model::Session& m_session = m_origin.session();
    log::RecordedClock m_clock{m_log.timeline()};
    std::optional<log::PastWriter> m_past;
    DatagramPacer m_pacer{1.0 / 240, 1.0};
    std::uint64_t m_packets = 0;
    std::uint64_t m_bytesWaiting = 0; ///< not followed yet
    log::Stamp m_newest{};
    log::FileContents m_contents;
};

namespace {

using exporting::ExportedMotion;
using exporting::MotionFormat;
using feed::PoseSource;

struct ExportOptions {
    std::string input;
    std::string output;
    std::string format;
    stage::Range range;
    std::vector<std::string> characters; ///< none: all
    std::string up;                      ///< "y", "z"; others: as detected
    bool replaces = false;
};

/// The share that is done, in one line of standard error; nothing unless that is a terminal.
class ProgressLine {
public:
    explicit ProgressLine(std::string command) : m_command(std::move(command)) {}
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// "reading", 0 to 1; ten times a second at most.
    void show(const std::string& work, double share) {
        const auto now = std::chrono::steady_clock::now();
        if (!m_isTerminal || now < m_next) {
            return;
        }
        m_next = now + std::chrono::milliseconds(100);
        m_isShown = true;
        std::cerr << "\r\x1b[K" << m_command << ": " << work << ' ' << std::lround(100 * share) << " %"
                  << std::flush;
    }

    /// Before anything else is written there.
    void clear() {
        if (std::exchange(m_isShown, false)) {
            std::cerr << "\r\x1b[K" << std::flush;
        }
    }

private:
    std::string m_command;
    bool m_isTerminal = system::isTerminal(system::kStandardError);
    bool m_isShown = false;
    std::chrono::steady_clock::time_point m_next{};
};

std::string formatNames() {
    std::string names;
    for (const MotionFormat& format : exporting::motionFormats()) {
        names += (names.empty() ? "" : ", ") + std::string(format.suffix);
    }
    return names;
}

/// For the help, from the table of formats.
std::string formatHelp() {
    std::string text = "otherwise by the name of the file.";
    std::string alone;
    for (const MotionFormat& format : exporting::motionFormats()) {
        text += std::string(" ") + format.suffix + ": " + format.holds +
                "; missing samples: " + words::say(format.gaps, words::Form::Headline) + '.';
        if (!format.holdsSeveral) {
            alone += (alone.empty() ? "" : ", ") + std::string(format.suffix);
        }
    }
    return alone.empty()
               ? text
               : text + " Of several characters " + alone + " get a file each, named after them: take-NAME." +
                     alone.substr(0, alone.find(','));
}

tl::expected<const MotionFormat*, std::string> formatOf(const ExportOptions& options) {
    if (!options.format.empty()) {
        const MotionFormat* format = exporting::findMotionFormat(options.format);
        return format != nullptr
                   ? tl::expected<const MotionFormat*, std::string>(format)
                   : tl::unexpected("\"" + options.format + "\" is no format; there are " + formatNames());
    }
    const MotionFormat* format = exporting::motionFormatOf(options.output);
    return format != nullptr
               ? tl::expected<const MotionFormat*, std::string>(format)
               : tl::unexpected(options.output + ": its name says no format; end it with one of " +
                                formatNames() + ", or add --format");
}

/// A whole text may be a name, with commas in it.
std::vector<std::string> wordsOf(const std::string& text, const auto& isKnown) {
    if (isKnown(text)) {
        return {text};
    }
    std::vector<std::string> words;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        if (comma != begin) {
            words.push_back(text.substr(begin, comma - begin));
        }
        begin = comma + 1;
    }
    return words;
}

/// Those whose name or ID is asked for, or one line about what is wrong.
tl::expected<std::vector<model::CharacterKey>, std::string> chosen(const ExportOptions& options,
                                                                   const model::SessionView& session) {
    const std::vector<const model::Character*> all = session.atNow().roster().listed();
    std::vector<model::CharacterKey> keys;
    std::string known;
    for (const model::Character* one : all) {
        keys.push_back(one->key);
        known += (known.empty() ? "" : ", ") + session.roster().displayName(one->key).shown() + " (" +
                 std::to_string(one->key.character) + ")";
    }
    if (options.characters.empty()) {
        return keys;
    }
    const auto is = [&](const model::CharacterKey& key, const std::string& word) {
        const model::ForeignText name = session.roster().displayName(key);
        return name == word || name.shown() == word || std::to_string(key.character) == word;
    };
    std::vector<model::CharacterKey> wanted;
    const auto isKnown = [&](const std::string& word) {
        return std::ranges::any_of(keys, [&](const auto& key) { return is(key, word); });
    };
    for (const std::string& text : options.characters) {
        for (const std::string& word : wordsOf(text, isKnown)) {
            if (!isKnown(word)) {
                return tl::unexpected("\"" + model::shownText(word) + "\" is no character of " +
                                      options.input + "; there " +
                                      (known.empty() ? "are none" : "is " + known));
            }
            std::ranges::copy_if(keys, std::back_inserter(wanted), [&](const auto& key) {
                return is(key, word) && std::ranges::find(wanted, key) == wanted.end();
            });
        }
    }
    return wanted;
}

std::string nothingText(const ExportOptions& options, const feed::PoseSource& source,
                        const log::FileContents& contents) {
    if (source.characters.empty()) {
        const std::string other = model::otherContents(contents, options.input);
        return options.input + ": has no characters, so there is nothing to export" +
               (other.empty() ? "; is it a recording of MXTP?" : ": it " + other);
    }
    return options.input + ": no poses (types 01, 02, 05, 21, 22, 03) of " +
           (source.characters.size() == 1 ? source.characters[0].name.shown() : "these characters") +
           (options.range.isAll() ? ", so there is nothing to export; was Position + Orientation streamed?"
                                  : " between these times; try without --since and --until");
}

void tell(const std::vector<ExportedMotion>& exported, const feed::PoseSource& source,
          const MotionFormat& format, const Console& console) {
    for (const ExportedMotion& one : exported) {
        console.complain(words::say(exporting::describe(one, source, format), words::Form::Headline));
        const feed::PoseCharacter& character = source.characters[one.character];
        for (const words::Fact& line : character.remark.lines) {
            console.complain(character.name.shown() + ": " + words::say(line, words::Form::Headline));
        }
    }
    for (std::size_t i = 0; i < source.characters.size(); ++i) {
        if (std::ranges::find(exported, i, &ExportedMotion::character) == exported.end()) {
            console.complain(source.characters[i].name.shown() + ": no poses, left out");
        }
    }
}

std::string outputPath(const ExportOptions& options) {
    return options.output == "-" ? std::string(log::kStandardOutput) : options.output;
}

ExitStatus writeMotion(const ExportOptions& options, const MotionFormat& format, RecordedSession& recorded,
                       ProgressLine& line, const Console& console) {
    const model::SessionView& session = recorded.session();
    const auto keys = chosen(options, session);
    if (!keys) {
        return console.unusable(keys.error());
    }
    const log::Stamp first = session.firstStamp();
    const feed::PoseSource source =
        feed::poseSourceOf(session, options.range.times(first, session.wallOf(first)), *keys);
    if (options.output == "-" && !format.holdsSeveral && source.characters.size() > 1) {
        return console.unusable(std::string("standard output holds one file, and ") + format.suffix +
                                " has one for each character; choose one with --characters");
    }
    const auto exported = exporting::exportMotion({source,
                                                   format,
                                                   outputPath(options),
                                                   {options.replaces, {options.input}},
                                                   "Posewire " + std::string(usage::version()),
                                                   figure::mannequinBody},
                                                  [&](double share) {
                                                      line.show("writing", share);
                                                      return !system::Interruption::hasCome();
                                                  });
    line.clear();
    if (!exported) {
        using Kind = log::FileError::Kind;
        if (options.output == "-" && exported.error().kind == Kind::Unread) {
            return ExitStatus::Fine; // who reads has enough
        }
        const bool isCancelled = exported.error().kind == Kind::Cancelled;
        return console.unusable(isCancelled ? "interrupted; " + options.output + " was not written"
                                            : exported.error().text);
    }
    if (exported->empty()) {
        return console.unusable(nothingText(options, source, recorded.contents()));
    }
    tell(*exported, source, format, console);
    return ExitStatus::Fine;
}

ExitStatus exportRecording(const ExportOptions& options, const Console& console) {
    const system::Interruption interruption; // so that no half file is left
    const auto format = formatOf(options);
    if (!format) {
        return console.unusable(format.error());
    }
    const auto file = openInput(options.input, system::Interruption::hasCome);
    if (!file) {
        return console.unusable(file.error().text);
    }
    if (const auto checked = log::checkOutput(outputPath(options), {options.replaces, {options.input}});
        !checked) {
        return console.unusable(checked.error().text);
    }
    ProgressLine line("posewire-cli export");
    RecordedSession recorded(options.input);
    recorded.declare({.up = model::upNamed(options.up)});
    WatchedInput input(**file, recorded.contents(), [&](const std::string& text) {
        line.clear();
        console.complain(text);
    });
    const auto read = recorded.read(input, [&](double share) { line.show("reading", share); });
    line.clear();
    if (system::Interruption::hasCome()) {
        return console.unusable("interrupted; " + options.output + " was not written");
    }
    const ExitStatus status = readingStatus(read, console);
    if (status == ExitStatus::Unusable) {
        return status;
    }
    if (recorded.session().begin() != 0) {
        console.complain(options.input + ": does not fit into memory and cannot be read twice: the first " +
                         std::to_string(recorded.session().begin()) +
                         " packets are left out; save it to a file first");
    }
    return worse(status, writeMotion(options, **format, recorded, line, console));
}

} // namespace

Command addExportCommand(CommandLine& program) {
    auto options = std::make_shared<ExportOptions>();
    Arguments arguments =
        program.addCommand("export", "Write the motion of a recording for other programs: " + formatNames());
    arguments
        .add("FILE", options->input, "pcap, pcapng, MVNX, or datagrams back to back; - for standard input")
        .required();
    arguments.add("-o,--output FILE", options->output, "the file to write; - for standard output")
        .required()
        .formerly("--to");
    arguments.add("--format FORMAT", options->format, formatHelp());
    stage::addRange(arguments, options->range)[0].formerly("--from");
    arguments.add("--characters LIST", options->characters,
                  "names or IDs, with commas between them (default: all); may be given several times");
    addUp(arguments, options->up);
    addOutputs(arguments, options->replaces);
    return {"export", [options](Console& console) { return exportRecording(*options, console); }};
}

} // namespace posewire::cli
