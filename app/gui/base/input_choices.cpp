// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/input_choices.h"

#include "app/gui/theme/words.h"
#include "app/net/allow_list.h"

#include <QJsonArray>
#include <QRegularExpression>

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::gui {

namespace {

using Kind = InputAddress::Kind;

constexpr int kMostPort = 65'535;
constexpr std::array kKinds{std::pair{Kind::Udp, "udp"}, std::pair{Kind::TcpListener, "tcp-listen"},
                            std::pair{Kind::TcpConnection, "tcp"}};

std::optional<Kind> kindOf(const QString& name) {
    const auto* found =
        std::ranges::find_if(kKinds, [&](const auto& each) { return name == QLatin1String(each.second); });
    return found != kKinds.end() ? std::optional(found->first) : std::nullopt;
}

std::optional<std::uint16_t> portOf(const QJsonValue& value) {
    const int port = value.toInt();
    return port >= 1 && port <= kMostPort ? std::optional(static_cast<std::uint16_t>(port)) : std::nullopt;
}

std::optional<InputAddress> inputOf(const QJsonObject& object) {
    const auto kind = kindOf(object["protocol"].toString());
    const auto port = portOf(object["port"]);
    const QString host = object["host"].toString();
    if (!kind || !port || (*kind == Kind::TcpConnection && host.isEmpty())) {
        return std::nullopt;
    }
    InputAddress input{host, *port, *kind};
    for (const QJsonValue& group : object["groups"].toArray()) {
        input.groups += group.toString();
    }
    return input;
}

QJsonObject inputJson(const InputAddress& input) {
    QJsonObject object{{"protocol", kindName(input.kind)}, {"host", input.address}, {"port", input.port}};
    if (!input.groups.isEmpty()) {
        object["groups"] = QJsonArray::fromStringList(input.groups);
    }
    return object;
}

} // namespace

QJsonObject jsonOf(const InputChoices& choices) {
    QJsonObject object;
    if (choices.inputs) {
        QJsonArray inputs;
        for (const InputAddress& input : *choices.inputs) {
            inputs.append(inputJson(input));
        }
        object["inputs"] = inputs;
    }
    QJsonArray waysOut;
    for (const WayOut& way : choices.waysOut) {
        waysOut.append(QJsonObject{{"host", way.host},
                                   {"port", way.port},
                                   {"on", way.isOn},
                                   {"kind", way.kind},
                                   {"character", way.character}});
    }
    object["relays"] = waysOut; // as it was called when there were only those
    if (!choices.allowed.isEmpty()) {
        object["from"] = QJsonArray::fromStringList(choices.allowed);
    }
    return object;
}

InputChoices inputChoicesOf(const QJsonObject& object) {
    InputChoices choices;
    if (object["inputs"].isArray()) {
        choices.inputs.emplace();
        for (const QJsonValue& value : object["inputs"].toArray()) {
            if (const auto input = inputOf(value.toObject())) {
                choices.inputs->push_back(*input);
            }
        }
    }
    for (const QJsonValue& value : object["relays"].toArray()) {
        const QJsonObject way = value.toObject();
        const QString host = way["host"].toString();
        const QString kind = way["kind"].toString(WayOut().kind);
        const bool isHere = host.isEmpty() && kind != WayOut().kind;
        const auto port = isHere && way["port"].toInt(-1) == 0 ? std::optional<std::uint16_t>(0) // a domain
                                                               : portOf(way["port"]);
        if (port && (isHere || !host.isEmpty())) {
            choices.waysOut.push_back(
                {host, *port, way["on"].toBool(true), kind, way["character"].toString()});
        }
    }
    QStringList unreadable;
    for (const QJsonValue& value : object["from"].toArray()) {
        const QString text = value.toVariant().toString();
        const auto allowed = parseAllowed(text);
        (allowed ? choices.allowed : unreadable) += allowed.value_or(QStringList(text));
    }
    if (choices.allowed.isEmpty()) {
        choices.allowed = unreadable; // a list of which nothing can be read is not one of everybody
    }
    return choices;
}

QString kindName(Kind kind) {
    return QLatin1String(std::ranges::find(kKinds, kind, &std::pair<Kind, const char*>::first)->second);
}

tl::expected<QStringList, QString> parseAllowed(const QString& text) {
    static const QRegularExpression separators(QStringLiteral("[,;\\s]+"));
    const QStringList entries = text.split(separators, Qt::SkipEmptyParts);
    for (const QString& entry : entries) {
        if (!net::problemWithEntry(entry.toStdString()).empty()) {
            return tl::unexpected(
                tr("'%1' is not a host or a net. Type an address, a net such as 192.168.1.0/24, or a name.")
                    .arg(entry));
        }
    }
    return entries;
}

QString withoutBrackets(const QString& host) {
    const bool isBracketed = host.startsWith(QLatin1Char('[')) && host.endsWith(QLatin1Char(']'));
    return isBracketed ? host.mid(1, host.size() - 2) : host;
}

tl::expected<InputAddress, QString> parseInputAddress(const QString& text, Kind kind) {
    const auto colon = text.lastIndexOf(QLatin1Char(':'));
    const QString host = withoutBrackets(colon < 0 ? QString() : text.left(colon));
    bool isNumber = false;
    const int port = text.mid(colon + 1).toInt(&isNumber);
    const bool needsHost = kind == Kind::TcpConnection;
    if (!isNumber || port < 1 || port > kMostPort || (needsHost && host.isEmpty())) {
        return tl::unexpected((needsHost
                                   ? tr("--%1: '%2' is not HOST:PORT with a port from 1 to 65535.")
                                   : tr("--%1: '%2' is not [ADDRESS:]PORT with a port from 1 to 65535."))
                                  .arg(kindName(kind), text));
    }
    return InputAddress{host, static_cast<std::uint16_t>(port), kind};
}

QString displayText(const InputAddress& input) {
    QString transport = input.kind == Kind::Udp ? QStringLiteral("UDP ") : QStringLiteral("TCP ");
    if (input.kind == Kind::TcpConnection) {
        transport = tr("TCP to ");
    }
    return transport + (input.address.isEmpty() ? QString::number(input.port)
                                                : displayText(WayOut{input.address, input.port}));
}

QString displayText(const WayOut& way) {
    return way.host.isEmpty() ? QString::number(way.port)
                              : QString::fromStdString(net::textOf({way.host.toStdString(), way.port}));
}

} // namespace posewire::gui
