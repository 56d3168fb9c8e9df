// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/system/interruption.h"
#include "core/export/json.h"
#include "core/export/protocol_reference.h"
#include "core/filter/filter.h"

#include <memory>

namespace posewire::cli {

namespace {

struct EncodeOptions {
    std::string input;
    std::string output = "-";
    bool replaces = false;
};

class LineEncoder {
public:
    LineEncoder(Output& out, Console& console, std::string name)
        : m_out(out), m_console(console), m_name(std::move(name)) {}

    void encode(std::string_view line, std::size_t number) {
        if (line.find_first_not_of(" \t") == std::string_view::npos) {
            return;
        }
        const auto bytes = exporting::datagramFromJson(line);
        if (bytes) {
            m_out.write(*bytes);
        } else if (bytes.error().kind == exporting::JsonFault::Kind::NotDatagram) {
            ++m_withoutDatagram;
        } else {
            m_console.complain(m_name + ": line " + std::to_string(number) + ": " + bytes.error().text +
                               "; the line is left out");
            m_hasFaults = true;
        }
    }

    [[nodiscard]] ExitStatus conclude() {
        if (m_withoutDatagram != 0) {
            const bool isOne = m_withoutDatagram == 1;
            m_console.complain(
                m_name + ": " + std::to_string(m_withoutDatagram) + (isOne ? " line holds" : " lines hold") +
                " no datagram (an error, or skipped bytes) and " + (isOne ? "is left out" : "are left out"));
        }
        return m_hasFaults || m_withoutDatagram != 0 ? ExitStatus::Faults : ExitStatus::Fine;
    }

private:
    Output& m_out;
    Console& m_console;
    std::string m_name;
    std::size_t m_withoutDatagram = 0;
    bool m_hasFaults = false;
};

ExitStatus encode(const EncodeOptions& options, Console& console) {
    const system::Interruption interruption; // so that no half file is left
    const auto source = openInput(options.input, system::Interruption::hasCome);
    if (!source) {
        return console.unusable(source.error().text);
    }
    auto out = Output::open(options.output, {options.replaces, {options.input}});
    if (!out) {
        return console.unusable(out.error());
    }
    LineReader lines(**source);
    LineEncoder encoder(*out, console, (*source)->name());
    while (out->isWanted()) {
        const auto line = lines.next();
        if (!line) {
            return console.unusable(line.error().text);
        }
        if (!*line) {
            break;
        }
        encoder.encode(**line, lines.lineNumber());
    }
    const ExitStatus status = encoder.conclude();
    if (const auto finished = out->finish(); !finished) {
        return console.unusable(finished.error());
    }
    return status;
}

} // namespace

Command addEncodeCommand(CommandLine& program) {
    auto options = std::make_shared<EncodeOptions>();
    Arguments arguments =
        program.addCommand("encode", "Turn the output of decode --json back into datagrams");
    arguments.add("FILE", options->input, "JSON Lines; - for standard input").required();
    arguments
        .add("-o,--output FILE", options->output,
             "where the datagrams go, back to back; - for standard output")
        .showDefault();
    addOutputs(arguments, options->replaces);
    return {"encode", [options](Console& console) { return encode(*options, console); }};
}

Command addReferenceCommand(CommandLine& program) {
    Arguments arguments = program.addCommand("reference", "Print the protocol reference in Markdown");
    auto isFilterWanted = std::make_shared<bool>(false);
    arguments.flag("--filter", *isFilterWanted, "print the language of decode --filter instead");
    return {"reference", [isFilterWanted](Console& console) {
                console.out.write(*isFilterWanted ? filter::filterReference()
                                                  : exporting::protocolReference());
                return ExitStatus::Fine;
            }};
}

} // namespace posewire::cli
