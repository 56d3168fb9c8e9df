// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/options.h"

#include <QCommandLineParser>
#include <QCoreApplication>

namespace posewire::gui {

namespace {

constexpr int kMaxDemoCharacters = 20;

QString tr(const char* text) {
    return QCoreApplication::translate("Options", text);
}

tl::unexpected<EarlyExit> wrong(const QString& text) {
    return tl::unexpected(EarlyExit{2, QStringLiteral("posewire: ") + text +
                                           tr("\nTry 'posewire --help' for what there is.\n")});
}

void describe(QCommandLineParser& parser) {
    parser.setApplicationDescription(tr("Network monitor for MVN motion-capture streams."));
    parser.setOptionsAfterPositionalArgumentsMode(QCommandLineParser::ParseAsOptions);
    parser.addPositionalArgument(QStringLiteral("file"),
                                 tr("Recording to look at: pcap, pcapng, or datagrams back to back."),
                                 QStringLiteral("[FILE]"));
    parser.addOptions({
        {"udp", tr("Listen on a UDP port (repeatable; 9763 if nothing else is asked for)."),
         "[ADDRESS:]PORT"},
        {"multicast", tr("Join a multicast group at the UDP ports (repeatable)."), "GROUP"},
        {"tcp-listen", tr("Let senders connect by TCP, as MVN does (repeatable)."), "[ADDRESS:]PORT"},
        {"tcp", tr("Connect to a sender that listens (repeatable)."), "HOST:PORT"},
        {"demo", tr("Send walking characters to the listening port, by UDP on this computer; 2 by default."),
         "CHARACTERS"},
        {"seek", tr("Stop this many seconds after the beginning of FILE instead of at its end."), "SECONDS"},
        {"layout", tr("Begin with a layout: Check, Debug, Inspect, or a file."), "NAME|FILE"},
        {"reset-layout", tr("Forget where windows and docks were.")},
        {"settings", tr("Keep settings in this file."), "FILE"},
        {"theme", tr("Colours: dark, light or system."), "THEME"},
        {"screenshot", tr("Save a picture of the window and end."), "FILE.png"},
        {"after", tr("Seconds to wait before the screenshot; 3 by default."), "SECONDS"},
        {"size", tr("Size of the window."), "WxH"},
        {"startup-time", tr("Print how long it took until the window was on screen.")},
        {{"h", "help"}, tr("Show this text.")},
        {{"v", "version"}, tr("Show the version.")},
    });
}

/// QCommandLineParser knows no optional values: "--demo" alone is completed.
QStringList completed(QStringList arguments) {
    for (QString& argument : arguments) {
        if (argument == QLatin1String("--demo")) {
            argument = QStringLiteral("--demo=2");
        }
    }
    return arguments;
}

tl::expected<void, QString> readInputs(const QCommandLineParser& parser, const QString& option,
                                       InputAddress::Kind kind, std::vector<InputAddress>& inputs) {
    for (const QString& text : parser.values(option)) {
        const auto input = parseInputAddress(text, kind);
        if (!input) {
            return tl::unexpected(input.error());
        }
        inputs.push_back(*input);
    }
    return {};
}

tl::expected<void, QString> readPorts(const QCommandLineParser& parser, Options& options) {
    using Kind = InputAddress::Kind;
    auto result = readInputs(parser, QStringLiteral("udp"), Kind::Udp, options.udpPorts);
    if (result) {
        result = readInputs(parser, QStringLiteral("tcp-listen"), Kind::TcpListen, options.tcpInputs);
    }
    if (result) {
        result = readInputs(parser, QStringLiteral("tcp"), Kind::TcpConnect, options.tcpInputs);
    }
    const QStringList groups = parser.values(QStringLiteral("multicast"));
    if (!groups.isEmpty() && options.udpPorts.empty()) {
        options.udpPorts.push_back({});
    }
    for (InputAddress& port : options.udpPorts) {
        port.groups = groups;
    }
    return result;
}

tl::expected<void, QString> readTheme(const QCommandLineParser& parser, Options& options) {
    if (!parser.isSet(QStringLiteral("theme"))) {
        return {};
    }
    const QString name = parser.value(QStringLiteral("theme"));
    if (name == QLatin1String("dark")) {
        options.theme = ThemeChoice::Dark;
    } else if (name == QLatin1String("light")) {
        options.theme = ThemeChoice::Light;
    } else if (name == QLatin1String("system")) {
        options.theme = ThemeChoice::System;
    } else {
        return tl::unexpected(tr("--theme: '%1' is none of dark, light, system.").arg(name));
    }
    return {};
}

/// A time of up to a day; nothing where the option is not given.
tl::expected<std::optional<double>, QString> readSeconds(const QCommandLineParser& parser,
                                                         const QString& option) {
    constexpr double kMostSeconds = 86'400;
    if (!parser.isSet(option)) {
        return std::nullopt;
    }
    bool isNumber = true;
    const QString text = parser.value(option);
    const double seconds = text.toDouble(&isNumber);
    if (!isNumber || !(seconds >= 0 && seconds <= kMostSeconds)) {
        return tl::unexpected(tr("--%1: '%2' is not a number of seconds.").arg(option, text));
    }
    return seconds;
}

tl::expected<void, QString> readTimes(const QCommandLineParser& parser, Options& options) {
    const auto after = readSeconds(parser, QStringLiteral("after"));
    const auto seek = readSeconds(parser, QStringLiteral("seek"));
    if (!after || !seek) {
        return tl::unexpected(after ? seek.error() : after.error());
    }
    if (*seek && parser.positionalArguments().isEmpty()) {
        return tl::unexpected(tr("--seek needs a FILE."));
    }
    options.screenshotAfterSeconds = after->value_or(options.screenshotAfterSeconds);
    options.seekSeconds = *seek;
    return {};
}

tl::expected<void, QString> readNumbers(const QCommandLineParser& parser, Options& options) {
    bool isNumber = true;
    if (parser.isSet(QStringLiteral("demo"))) {
        const QString text = parser.value(QStringLiteral("demo"));
        options.demoCharacters = text.toInt(&isNumber);
        if (!isNumber || options.demoCharacters < 1 || options.demoCharacters > kMaxDemoCharacters) {
            return tl::unexpected(
                tr("--demo: '%1' is not a number from 1 to %2.").arg(text).arg(kMaxDemoCharacters));
        }
    }
    if (parser.isSet(QStringLiteral("size"))) {
        const QString text = parser.value(QStringLiteral("size"));
        const QStringList sides = text.split(QLatin1Char('x'));
        const QSize size = sides.size() == 2 ? QSize(sides[0].toInt(), sides[1].toInt()) : QSize();
        if (size.width() < 1 || size.height() < 1 || size.width() > 16'384 || size.height() > 16'384) {
            return tl::unexpected(tr("--size: '%1' is not a size such as 1600x1000.").arg(text));
        }
        options.size = size;
    }
    return {};
}

tl::expected<void, QString> readFiles(const QCommandLineParser& parser, Options& options) {
    const QStringList files = parser.positionalArguments();
    if (files.size() > 1) {
        return tl::unexpected(tr("one file at a time; '%1' is one too many.").arg(files[1]));
    }
    options.file = files.value(0);
    options.layout = parser.value(QStringLiteral("layout"));
    options.resetsLayout = parser.isSet(QStringLiteral("reset-layout"));
    options.settingsFile = parser.value(QStringLiteral("settings"));
    options.screenshotFile = parser.value(QStringLiteral("screenshot"));
    options.printsStartupTime = parser.isSet(QStringLiteral("startup-time"));
    return {};
}

} // namespace

tl::expected<InputAddress, QString> parseInputAddress(const QString& text, InputAddress::Kind kind) {
    const auto colon = text.lastIndexOf(QLatin1Char(':'));
    InputAddress result;
    result.kind = kind;
    result.address = colon < 0 ? QString() : text.left(colon);
    if (result.address.startsWith(QLatin1Char('[')) && result.address.endsWith(QLatin1Char(']'))) {
        result.address = result.address.mid(1, result.address.size() - 2);
    }
    bool isNumber = false;
    const int port = text.mid(colon + 1).toInt(&isNumber);
    const bool hasPort = isNumber && port >= 1 && port <= 65'535;
    if (kind == InputAddress::Kind::TcpConnect && (!hasPort || result.address.isEmpty())) {
        return tl::unexpected(tr("--tcp: '%1' is not HOST:PORT with a port from 1 to 65535.").arg(text));
    }
    if (!hasPort) {
        const QString option =
            kind == InputAddress::Kind::Udp ? QStringLiteral("--udp") : QStringLiteral("--tcp-listen");
        return tl::unexpected(
            tr("%1: '%2' is not [ADDRESS:]PORT with a port from 1 to 65535.").arg(option, text));
    }
    result.port = static_cast<std::uint16_t>(port);
    return result;
}

QString displayText(const InputAddress& input) {
    const QString transport = input.kind == InputAddress::Kind::Udp          ? QStringLiteral("UDP ")
                              : input.kind == InputAddress::Kind::TcpConnect ? tr("TCP to ")
                                                                             : QStringLiteral("TCP ");
    QString address = input.address;
    if (address.contains(QLatin1Char(':'))) {
        address = QLatin1Char('[') + address + QLatin1Char(']');
    }
    return transport + (address.isEmpty() ? address : address + QLatin1Char(':')) +
           QString::number(input.port);
}

tl::expected<Options, EarlyExit> parseOptions(const QStringList& arguments) {
    QCommandLineParser parser;
    describe(parser);
    if (!parser.parse(completed(arguments))) {
        return wrong(parser.errorText());
    }
    if (parser.isSet(QStringLiteral("help"))) {
        return tl::unexpected(EarlyExit{0, parser.helpText()});
    }
    if (parser.isSet(QStringLiteral("version"))) {
        return tl::unexpected(
            EarlyExit{0, QStringLiteral("posewire %1\n").arg(QCoreApplication::applicationVersion())});
    }
    Options options;
    for (const auto read : {readPorts, readTheme, readTimes, readNumbers, readFiles}) {
        if (const auto result = read(parser, options); !result) {
            return wrong(result.error());
        }
    }
    return options;
}

} // namespace posewire::gui
