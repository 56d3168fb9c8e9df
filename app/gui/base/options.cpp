// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/options.h"

#include "app/gui/base/dock_layout.h"
#include "app/gui/theme/words.h"
#include "app/usage/usage.h"
#include "core/log/output_file.h"

#include <QCommandLineParser>
#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::gui {

namespace {

/// An earlier screenshot, most likely: scripts take the same one again and again.
bool isPicture(const QString& path) {
    QFile file(path);
    return QFileInfo(path).isFile() && file.open(QIODevice::ReadOnly) &&
           file.read(4) == QByteArray("\x89PNG");
}

constexpr int kMaxDemoCharacters = 20;

/// These may be given several times.
const QStringList kRepeatable{"udp", "from", "multicast", "tcp-listen", "tcp"};

constexpr std::array kThemes{std::pair{ThemeChoice::Dark, "dark"}, std::pair{ThemeChoice::Light, "light"},
                             std::pair{ThemeChoice::System, "system"}};

tl::unexpected<EarlyExit> wrong(const QString& text) {
    return tl::unexpected(EarlyExit{
        2, QStringLiteral("posewire: ") + text + tr("\nTry 'posewire --help' for what there is.\n"), false});
}

QString themeForms() {
    QStringList names;
    for (const auto& [choice, name] : kThemes) {
        names += QLatin1String(name);
    }
    return names.join(QLatin1Char('|'));
}

QString descriptionText() {
    return tr("Network monitor for MVN motion-capture streams.");
}

QString fileText() {
    return tr("Recording to look at: pcap, pcapng, or datagrams back to back.");
}

/// The forms of values are those of usage::Option.
QList<QCommandLineOption> optionTable() {
    return {
        {"udp",
         tr("Listen on a UDP port (repeatable; 9763 if nothing else is asked for). ADDRESS is one of this "
            "computer's, where it has several networks and only one is meant: broadcasts and multicast may "
            "then not arrive."),
         "[ADDRESS:]PORT"},
        {"from",
         tr("Listen only to this address, net (such as 192.168.1.0/24) or host (repeatable). Others are "
            "only counted."),
         "HOST|NET"},
        {"multicast", tr("Join a multicast group at the UDP ports (repeatable)."), "GROUP"},
        {"tcp-listen", tr("Let senders connect by TCP, as MVN does (repeatable)."), "[ADDRESS:]PORT"},
        {"tcp", tr("Connect to a sender that listens (repeatable)."), "HOST:PORT"},
        {"demo", tr("Send walking characters to the listening port, by UDP on this computer; 2 by default."),
         "[CHARACTERS]"},
        {"seek", tr("Stop this many seconds after the beginning of FILE instead of at its end."), "SECONDS"},
        {"compare", tr("Compare what is shown with this recording."), "FILE"},
        {"layout", tr("Begin with a layout that ships, or with one from a file."),
         layoutNames().join(QLatin1Char('|')) + QStringLiteral("|FILE")},
        {"reset-layout", tr("Forget where windows and docks were.")},
        {"settings", tr("Keep settings in this file."), "FILE"},
        {"theme", tr("Colours; those of the system by default."), themeForms()},
        {"screenshot", tr("Save a picture of the window and end."), "FILE.png"},
        {"force", tr("Replace the file of --screenshot also where it is no picture.")},
        {"part",
         tr("Take the screenshot of this dock or bar alone, by its name, such as packets or healthBar."),
         "NAME"},
        {"after", tr("Seconds to wait before the screenshot; 3 by default."), "SECONDS"},
        {"size", tr("Size of the window."), "WxH"},
        {"no-tour", tr("Do not lead through the window at the first start.")},
        {"verbose", tr("Tell on standard error what is done with inputs, files, settings and OpenGL.")},
        {"startup-time", tr("Print how long it took until the window was on screen.")},
        {{"h", "help"}, tr("Show this text.")},
        {{"v", "version"}, tr("Show the version.")},
    };
}

void describe(QCommandLineParser& parser) {
    parser.setApplicationDescription(descriptionText());
    parser.setOptionsAfterPositionalArgumentsMode(QCommandLineParser::ParseAsOptions);
    parser.addPositionalArgument(QStringLiteral("file"), fileText(), QStringLiteral("[FILE]"));
    parser.addOptions(optionTable());
}

/// Reads options into their places. What is wrong with the first bad one is kept.
struct Reader {
    const QCommandLineParser& parser;
    Options options{};
    QString problem{};

    void refuse(const QString& text) { problem = problem.isEmpty() ? text : problem; }

    void readInputs(InputAddress::Kind kind, std::vector<InputAddress>& inputs) {
        for (const QString& text : parser.values(kindName(kind))) {
            if (const auto input = parseInputAddress(text, kind)) {
                inputs.push_back(*input);
            } else {
                refuse(input.error());
            }
        }
    }

    void readAllInputs() {
        readInputs(InputAddress::Kind::Udp, options.udpPorts);
        readInputs(InputAddress::Kind::TcpListener, options.tcpInputs);
        readInputs(InputAddress::Kind::TcpConnection, options.tcpInputs);
        const QStringList groups = parser.values(QStringLiteral("multicast"));
        if (!groups.isEmpty() && options.udpPorts.empty()) {
            options.udpPorts.push_back({});
        }
        for (InputAddress& port : options.udpPorts) {
            port.groups = groups;
        }
    }

    void readAllowed() {
        for (const QString& text : parser.values(QStringLiteral("from"))) {
            const auto allowed = parseAllowed(text);
            if (!allowed || allowed->isEmpty()) {
                refuse(QStringLiteral("--from: ") +
                       (allowed ? tr("a host or a net is missing.") : allowed.error()));
                continue;
            }
            options.allowed += *allowed;
        }
    }

    void readTheme() {
        const QString name = parser.value(QStringLiteral("theme"));
        options.theme = themeNamed(name);
        if (!options.theme && parser.isSet(QStringLiteral("theme"))) {
            refuse(tr("--theme: '%1' is none of %2.")
                       .arg(name, themeForms().replace(u'|', QStringLiteral(", "))));
        }
    }

    /// A time of up to a day; nothing where the option is not given.
    std::optional<double> readSeconds(const QString& option) {
        constexpr double kMostSeconds = 86'400;
        if (!parser.isSet(option)) {
            return std::nullopt;
        }
        bool isNumber = true;
        const QString text = parser.value(option);
        const double seconds = text.toDouble(&isNumber);
        if (!isNumber || !(seconds >= 0 && seconds <= kMostSeconds)) {
            refuse(tr("--%1: '%2' is not a number of seconds from 0 to 86400.").arg(option, text));
        }
        return seconds;
    }

    void readTimes() {
        options.screenshotAfterSeconds =
            readSeconds(QStringLiteral("after")).value_or(options.screenshotAfterSeconds);
        options.seekSeconds = readSeconds(QStringLiteral("seek"));
        if (options.seekSeconds && parser.positionalArguments().isEmpty()) {
            refuse(tr("--seek needs a FILE."));
        }
    }

    void readNumbers() {
        if (parser.isSet(QStringLiteral("demo"))) {
            const QString text = parser.value(QStringLiteral("demo"));
            options.demoCharacters = text.toInt();
            if (options.demoCharacters < 1 || options.demoCharacters > kMaxDemoCharacters) {
                refuse(tr("--demo: '%1' is not a number from 1 to %2.").arg(text).arg(kMaxDemoCharacters));
            }
        }
        if (parser.isSet(QStringLiteral("size"))) {
            const QString text = parser.value(QStringLiteral("size"));
            const QStringList sides = text.split(QLatin1Char('x'));
            const QSize size = sides.size() == 2 ? QSize(sides[0].toInt(), sides[1].toInt()) : QSize();
            if (size.width() < 1 || size.height() < 1 || size.width() > 16'384 || size.height() > 16'384) {
                refuse(tr("--size: '%1' is not a size such as 1600x1000, up to 16384x16384.").arg(text));
            }
            options.size = size;
        }
    }

    /// Nothing that is read is written.
    void checkOutputs() {
        const auto encoded = [](const QString& path) { return QFile::encodeName(path).toStdString(); };
        const std::vector<std::string> inUse{encoded(options.file), encoded(options.comparedFile)};
        const auto check = [&](const QString& path, bool mayReplace) {
            const auto checked = log::checkOutput(encoded(path), {mayReplace, inUse});
            if (!path.isEmpty() && !checked) {
                refuse(QString::fromStdString(checked.error().text));
            }
        };
        check(options.screenshotFile, options.replaces || isPicture(options.screenshotFile));
        if (QFile::exists(options.settingsFile)) {
            check(options.settingsFile, true);
        }
    }

    void readFiles() {
        const QStringList files = parser.positionalArguments();
        if (files.size() > 1) {
            refuse(tr("one file at a time; '%1' is one too many.").arg(files[1]));
        }
        options.file = files.value(0);
        options.comparedFile = parser.value(QStringLiteral("compare"));
        options.layout = parser.value(QStringLiteral("layout"));
        options.resetsLayout = parser.isSet(QStringLiteral("reset-layout"));
        options.settingsFile = parser.value(QStringLiteral("settings"));
        options.screenshotFile = parser.value(QStringLiteral("screenshot"));
        options.screenshotPart = parser.value(QStringLiteral("part"));
        options.hasTour = !parser.isSet(QStringLiteral("no-tour"));
        options.replaces = parser.isSet(QStringLiteral("force"));
        checkOutputs();
        options.printsStartupTime = parser.isSet(QStringLiteral("startup-time"));
        options.isVerbose = parser.isSet(QStringLiteral("verbose"));
    }
};

} // namespace

usage::Program programUsage() {
    usage::Program program{"posewire", descriptionText().toStdString(), {}, {}};
    usage::Option file;
    file.form = "FILE";
    file.text = fileText().toStdString();
    program.options.push_back(file);
    for (const QCommandLineOption& declared : optionTable()) {
        usage::Option option;
        for (const QString& name : declared.names()) {
            option.names.push_back((name.size() == 1 ? "-" : "--") + name.toStdString());
        }
        option.form = declared.valueName().toStdString();
        option.text = declared.description().toStdString();
        option.isRepeatable = kRepeatable.contains(declared.names().front());
        program.options.push_back(option);
    }
    return program;
}

QString themeName(ThemeChoice choice) {
    return QLatin1String(
        std::ranges::find(kThemes, choice, &std::pair<ThemeChoice, const char*>::first)->second);
}

std::optional<ThemeChoice> themeNamed(const QString& name) {
    for (const auto& [choice, text] : kThemes) {
        if (name == QLatin1String(text)) {
            return choice;
        }
    }
    return std::nullopt;
}

std::vector<InputAddress> inputsToOpen(const Options& options, const InputChoices& choices) {
    std::vector<InputAddress> inputs = options.udpPorts;
    inputs.insert(inputs.end(), options.tcpInputs.begin(), options.tcpInputs.end());
    const bool isAsked = !inputs.empty() || !options.file.isEmpty();
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

/// QCommandLineParser knows no optional values: "--demo" alone, or before a file, is completed. A number that
/// follows it is its value.
QStringList withDemoCompleted(QStringList arguments) {
    for (qsizetype i = 0; i < arguments.size(); ++i) {
        if (arguments[i] == QLatin1String("--demo")) {
            bool hasNumber = false;
            static_cast<void>(arguments.value(i + 1).toInt(&hasNumber));
            const QString number = hasNumber ? arguments.takeAt(i + 1) : QStringLiteral("2");
            arguments[i] += QLatin1Char('=') + number;
        }
    }
    return arguments;
}

tl::expected<Options, EarlyExit> parseOptions(const QStringList& arguments) {
    QCommandLineParser parser;
    describe(parser);
    if (!parser.parse(withDemoCompleted(arguments))) {
        return wrong(parser.errorText());
    }
    if (parser.isSet(QStringLiteral("help"))) {
        return tl::unexpected(EarlyExit{0, parser.helpText(), false});
    }
    if (parser.isSet(QStringLiteral("version"))) {
        return tl::unexpected(
            EarlyExit{0,
                      QStringLiteral("posewire %1\nQt %2\n")
                          .arg(QCoreApplication::applicationVersion(), QLatin1String(qVersion())),
                      true});
    }
    Reader reader{parser};
    reader.readAllInputs();
    reader.readAllowed();
    reader.readTheme();
    reader.readTimes();
    reader.readNumbers();
    reader.readFiles();
    if (!reader.problem.isEmpty()) {
        return wrong(reader.problem);
    }
    return reader.options;
}

} // namespace posewire::gui
