// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/options.h"

#include "app/gui/base/dock_layout.h"
#include "app/gui/theme/language.h"
#include "app/gui/theme/words.h"
#include "app/usage/usage.h"
#include "core/log/output_file.h"

#include <QFile>
#include <QFileInfo>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace posewire::gui {

namespace {

/// An earlier screenshot, most likely: scripts take the same one again and again.
bool isPicture(const QString& path) {
    QFile file(path);
    return QFileInfo(path).isFile() && file.open(QIODevice::ReadOnly) &&
           file.read(4) == QByteArray("\x89PNG");
}

constexpr double kSecondsOfDay = 86'400;

constexpr std::array kThemes{std::pair{ThemeChoice::Dark, "dark"}, std::pair{ThemeChoice::Light, "light"},
                             std::pair{ThemeChoice::System, "system"}};

std::string themeForms() {
    std::vector<std::string> names;
    std::ranges::transform(kThemes, std::back_inserter(names),
                           [](const auto& theme) { return theme.second; });
    return usage::joined(names, "|");
}

/// The first two lines of --version; the libraries of the window follow.
std::string versionText() {
    return "posewire " + std::string(usage::version()) + "\nQt " + qVersion();
}

usage::Reading into(QString& place) {
    return [&place](const std::string& text) {
        place = QString::fromStdString(text);
        return std::string();
    };
}

usage::Reading into(QStringList& list) {
    return [&list](const std::string& text) {
        list += QString::fromStdString(text);
        return std::string();
    };
}

usage::Reading into(std::vector<InputAddress>& inputs, InputAddress::Kind kind) {
    return [&inputs, kind](const std::string& text) {
        const auto input = parseInputAddress(QString::fromStdString(text), kind);
        if (input) {
            inputs.push_back(*input);
        }
        return input ? std::string() : input.error().toStdString();
    };
}

usage::Reading intoHosts(QStringList& hosts) {
    return [&hosts](const std::string& text) {
        const auto allowed = parseAllowed(QString::fromStdString(text));
        if (!allowed || allowed->isEmpty()) {
            return "--sender: " +
                   (allowed ? tr("a host or a net is missing.") : allowed.error()).toStdString();
        }
        hosts += *allowed;
        return std::string();
    };
}

usage::Reading into(std::optional<ThemeChoice>& theme) {
    return [&theme](const std::string& text) {
        theme = themeNamed(QString::fromStdString(text));
        return theme ? std::string() : "--theme: '" + text + "' is none of " + themeForms();
    };
}

usage::Reading intoLanguage(QString& language) {
    return [&language](const std::string& text) {
        language = QString::fromStdString(text);
        return languages().contains(language) || text == kPseudoLanguage
                   ? std::string()
                   : "--language: '" + text + "' is none of " + languages().join(u'|').toStdString();
    };
}

usage::Reading into(QSize& size) {
    return [&size](const std::string& text) {
        constexpr QSize kMost(16'384, 16'384);
        const QStringList sides = QString::fromStdString(text).split(QLatin1Char('x'));
        size = sides.size() == 2 ? QSize(sides[0].toInt(), sides[1].toInt()) : QSize();
        const bool isFit = !size.isEmpty() && size.boundedTo(kMost) == size;
        return isFit ? std::string()
                     : "--size: '" + text + "' is not a size such as 1600x1000, up to 16384x16384";
    };
}

struct Declared {
    usage::CommandLine line;
    Options options;
    QStringList groups; ///< for each UDP port

    explicit Declared(std::function<std::string()> version)
        : line("posewire", "Network monitor for MVN motion-capture streams.", std::move(version)) {
        declareInputs(line.arguments());
        declareWindow(line.arguments());
        declareScreenshot(line.arguments());
    }

    void declareInputs(usage::Arguments arguments) {
        const auto file =
            arguments.read("FILE", into(options.file),
                           "recording to look at: pcap, pcapng, MVNX, or datagrams back to back");
        arguments
            .read("--udp [ADDRESS:]PORT", into(options.udpPorts, InputAddress::Kind::Udp),
                  "listen on a UDP port (repeatable; 9763 if nothing else is asked for). ADDRESS is one of "
                  "this computer's, if it has several networks and only one is meant: broadcasts and "
                  "multicast may then not arrive")
            .repeatable();
        arguments
            .read("--sender HOST|NET", intoHosts(options.allowed),
                  "listen only to this address, net (such as 192.168.1.0/24) or host (repeatable); others "
                  "are only counted")
            .repeatable()
            .formerly("--from");
        arguments
            .read("--multicast GROUP", into(groups), "join a multicast group at the UDP ports (repeatable)")
            .repeatable();
        arguments
            .read("--tcp-listen [ADDRESS:]PORT", into(options.tcpInputs, InputAddress::Kind::TcpListener),
                  "let senders connect by TCP, as MVN does (repeatable)")
            .repeatable();
        arguments
            .read("--tcp HOST:PORT", into(options.tcpInputs, InputAddress::Kind::TcpConnection),
                  "connect to a sender that listens (repeatable)")
            .repeatable();
        stage::addStageSince(arguments, options.stage);
        arguments
            .add("--demo [CHARACTERS]", options.demoCharacters,
                 "send walking characters to the listening port, by UDP on this computer; 2 by default")
            .within(1, 20);
        arguments
            .add("--seek SECONDS", options.seekSeconds,
                 "stop this many seconds after the beginning of FILE instead of at its end")
            .within(0.0, kSecondsOfDay)
            .needs(file);
        arguments.choice("--up auto|y|z", options.up,
                         "axis that is up in types 02, 21 and 22, instead of what poses look like");
        arguments.read("--compare FILE", into(options.comparedFile),
                       "compare what is shown with this recording");
    }

    void declareWindow(usage::Arguments arguments) {
        arguments.read("--layout " + (layoutNames() + QStringList("FILE")).join(u'|').toStdString(),
                       into(options.layout), "begin with a layout that ships, or with one from a file");
        arguments.flag("--reset-layout", options.resetsLayout, "forget where windows and docks were");
        arguments.read("--settings FILE", into(options.settingsFile), "keep settings in this file");
        arguments.read("--theme " + themeForms(), into(options.theme),
                       "colours; those of the system by default");
        arguments.read("--language CODE", intoLanguage(options.language),
                       "language of the window, such as en; that of the system by default");
        arguments.read("--size WxH", into(options.size), "size of the window");
        arguments.flag("--no-tour", options.skipsTour, "do not offer the user guide at the first start");
        arguments.read("--mode OCTAL", log::setFileMode,
                       "permissions of recordings, reports and all other files that are made, such as 0640 "
                       "for a shared folder; 0600 by default");
        arguments.flag("--forget-history", options.forgetsHistory,
                       "at the end, remove what earlier runs have left of the history on disk, too");
        arguments.read("--metrics [ADDRESS:]PORT", into(options.metrics),
                       "serve the figures of what is received there for Prometheus, at "
                       "http://ADDRESS:PORT/metrics; PORT alone is for this computer only");
        arguments.verbose(options.isVerbose, "inputs, files, settings and OpenGL");
        arguments.flag("--startup-time", options.printsStartupTime,
                       "print how long it took until the window was on screen");
    }

    void declareScreenshot(usage::Arguments arguments) {
        arguments.read("--screenshot FILE.png", into(options.screenshotFile),
                       "save a picture of the window and end");
        arguments.flag("--force", options.replaces,
                       "replace the file of --screenshot also if it is no picture");
        arguments.read(
            "--part NAME", into(options.screenshotPart),
            "take the screenshot of this dock or bar alone, by its name, such as packets or healthBar");
        arguments
            .add("--after SECONDS", options.screenshotAfterSeconds,
                 "seconds to wait before the screenshot; 3 by default")
            .within(0.0, kSecondsOfDay);
    }
};

/// No file that is read is written. One line for the user, or nothing.
std::string outputProblem(const Options& options) {
    const std::vector<std::string> inUse{options.file.toStdString(), options.comparedFile.toStdString()};
    const auto check = [&](const QString& path, bool mayReplace) {
        const auto checked = log::checkOutput(path.toStdString(), {mayReplace, inUse});
        return path.isEmpty() || checked ? std::string() : checked.error().text;
    };
    std::string problem =
        check(options.screenshotFile, options.replaces || isPicture(options.screenshotFile));
    if (problem.empty() && QFile::exists(options.settingsFile)) {
        problem = check(options.settingsFile, true);
    }
    return problem;
}

/// The parser would take whatever follows "--demo" for its value: only a number is, else there are two
/// characters.
std::vector<std::string> withDemoCompleted(QStringList arguments) {
    for (qsizetype i = 0; i < arguments.size(); ++i) {
        if (arguments[i] == QLatin1String("--demo")) {
            bool hasNumber = false;
            static_cast<void>(arguments.value(i + 1).toInt(&hasNumber));
            arguments[i] += QLatin1Char('=') + (hasNumber ? arguments.takeAt(i + 1) : QStringLiteral("2"));
        }
    }
    std::vector<std::string> texts;
    std::ranges::transform(arguments, std::back_inserter(texts), &QString::toStdString);
    return texts;
}

} // namespace

usage::Program programUsage() {
    return Declared(versionText).line.usage();
}

QString themeName(ThemeChoice choice) {
    return QLatin1String(
        std::ranges::find(kThemes, choice, &std::pair<ThemeChoice, const char*>::first)->second);
}

std::optional<ThemeChoice> themeNamed(const QString& name) {
    const auto* found =
        std::ranges::find_if(kThemes, [&](const auto& each) { return name == QLatin1String(each.second); });
    return found != kThemes.end() ? std::optional(found->first) : std::nullopt;
}

std::vector<InputAddress> inputsToOpen(const Options& options, const InputChoices& choices) {
    std::vector<InputAddress> inputs = options.udpPorts;
    inputs.insert(inputs.end(), options.tcpInputs.begin(), options.tcpInputs.end());
    const bool isAsked = !inputs.empty() || !options.file.isEmpty() || options.stage.isAsked();
    if (!isAsked && choices.inputs) {
        return *choices.inputs;
    }
    if (options.udpPorts.empty() && (!isAsked || options.demoCharacters > 0)) {
        inputs.insert(inputs.begin(), InputAddress{});
    }
    return inputs;
}

QStringList allowedAtStart(const Options& options, const InputChoices& choices) {
    return options.allowed.isEmpty() ? choices.allowed : options.allowed;
}

tl::expected<Options, usage::EarlyExit> parseOptions(const QStringList& arguments,
                                                     const std::function<std::string()>& libraries) {
    Declared declared([&] { return versionText() + libraries(); });
    if (const auto parsed = declared.line.parse(withDemoCompleted(arguments)); !parsed) {
        return tl::unexpected(parsed.error());
    }
    Options& options = declared.options;
    if (!declared.groups.isEmpty() && options.udpPorts.empty()) {
        options.udpPorts.push_back({});
    }
    for (InputAddress& port : options.udpPorts) {
        port.groups = declared.groups;
    }
    if (const auto problem = options.stage.isAsked() ? options.stage.problem() : std::nullopt) {
        return tl::unexpected(declared.line.mistake(*problem));
    }
    if (const std::string problem = outputProblem(options); !problem.empty()) {
        return tl::unexpected(declared.line.mistake(problem));
    }
    return options;
}

} // namespace posewire::gui
