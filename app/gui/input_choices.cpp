// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/input_choices.h"

#include <QJsonArray>

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::gui {

namespace {

using Kind = InputAddress::Kind;

constexpr std::array kKinds{std::pair{Kind::Udp, "udp"}, std::pair{Kind::TcpListen, "tcp-listen"},
                            std::pair{Kind::TcpConnect, "tcp"}};

QString nameOf(Kind kind) {
    return QLatin1String(std::ranges::find(kKinds, kind, &std::pair<Kind, const char*>::first)->second);
}

std::optional<Kind> kindOf(const QString& name) {
    for (const auto& [kind, text] : kKinds) {
        if (name == QLatin1String(text)) {
            return kind;
        }
    }
    return std::nullopt;
}

std::optional<std::uint16_t> portOf(const QJsonValue& value) {
    const int port = value.toInt();
    return port >= 1 && port <= 65'535 ? std::optional(static_cast<std::uint16_t>(port)) : std::nullopt;
}

std::optional<InputAddress> inputOf(const QJsonObject& object) {
    const auto kind = kindOf(object["protocol"].toString());
    const auto port = portOf(object["port"]);
    const QString host = object["host"].toString();
    if (!kind || !port || (*kind == Kind::TcpConnect && host.isEmpty())) {
        return std::nullopt;
    }
    InputAddress input{host, *port, *kind};
    for (const QJsonValue& group : object["groups"].toArray()) {
        input.groups += group.toString();
    }
    return input;
}

QJsonObject jsonOf(const InputAddress& input) {
    QJsonObject object{{"protocol", nameOf(input.kind)}, {"host", input.address}, {"port", input.port}};
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
            inputs.append(jsonOf(input));
        }
        object["inputs"] = inputs;
    }
    QJsonArray relays;
    for (const RelayChoice& relay : choices.relays) {
        relays.append(QJsonObject{{"host", relay.host}, {"port", relay.port}, {"on", relay.isOn}});
    }
    object["relays"] = relays;
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
        const QJsonObject relay = value.toObject();
        const auto port = portOf(relay["port"]);
        if (port && !relay["host"].toString().isEmpty()) {
            choices.relays.push_back({relay["host"].toString(), *port, relay["on"].toBool(true)});
        }
    }
    return choices;
}

std::vector<InputAddress> inputsToOpen(const Options& options, const InputChoices& choices) {
    std::vector<InputAddress> inputs = options.udpPorts;
    inputs.insert(inputs.end(), options.tcpInputs.begin(), options.tcpInputs.end());
    const bool isTold = !inputs.empty() || !options.file.isEmpty();
    if (!isTold && choices.inputs) {
        return *choices.inputs;
    }
    if (options.udpPorts.empty() && (!isTold || options.demoCharacters > 0)) {
        inputs.insert(inputs.begin(), InputAddress{});
    }
    return inputs;
}

QString displayText(const RelayChoice& relay) {
    const bool isIpv6 = relay.host.contains(QLatin1Char(':'));
    return (isIpv6 ? QStringLiteral("[%1]:%2") : QStringLiteral("%1:%2")).arg(relay.host).arg(relay.port);
}

} // namespace posewire::gui
