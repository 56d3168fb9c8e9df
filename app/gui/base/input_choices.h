// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/input.h"

#include <QJsonObject>
#include <QString>
#include <QStringList>

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::gui {

using net::kDefaultPort;

struct InputAddress {
    using Kind = net::InputKind;
    QString address; ///< of this computer, empty for all of them; where to connect, that of the sender
    std::uint16_t port = kDefaultPort;
    Kind kind = Kind::Udp;
    QStringList groups{}; ///< UDP: multicast groups to join
    friend bool operator==(const InputAddress&, const InputAddress&) = default;
};

/// A target that received data is handed on to, and its form.
struct WayOut {
    QString host; ///< empty: all who connect to that port of this computer
    std::uint16_t port = kDefaultPort;
    bool isOn = true;
    QString kind = QStringLiteral("datagrams"); ///< of outlets::outletKinds()
    QString character{};                        ///< of those that take one: a name or ID

    /// Returns true if both are the same, on or off.
    [[nodiscard]] bool isLike(const WayOut& other) const {
        return host == other.host && port == other.port && kind == other.kind && character == other.character;
    }
    friend bool operator==(const WayOut&, const WayOut&) = default;
};

/// "9763", "127.0.0.1:9763", "[::1]:9763"; the error says what is wrong, and begins with the option's name.
[[nodiscard]] tl::expected<InputAddress, QString>
parseInputAddress(const QString& text, InputAddress::Kind kind = InputAddress::Kind::Udp);

/// "::1" for "[::1]"; anything else as it is.
[[nodiscard]] QString withoutBrackets(const QString& host);

/// "UDP 9763", "UDP 127.0.0.1:9763", "TCP 9763", "TCP to studio:9763".
[[nodiscard]] QString displayText(const InputAddress& input);
/// "studio:9763", "[::1]:9763"; "9800" without a host.
[[nodiscard]] QString displayText(const WayOut& way);

/// "udp", "tcp-listen", "tcp": the option of the command line, and the protocol in files.
[[nodiscard]] QString kindName(InputAddress::Kind kind);

/// Inputs and ways out of the operator, kept from one run to the next.
struct InputChoices {
    std::optional<std::vector<InputAddress>> inputs{}; ///< nothing where nobody has chosen yet
    std::vector<WayOut> waysOut{};
    QStringList allowed{}; ///< hosts and nets to listen to; none: all
    friend bool operator==(const InputChoices&, const InputChoices&) = default;
};

/// "192.168.1.0/24, studio" as its parts, which may be separated by commas, semicolons or blanks; the error
/// says in a sentence what is neither a host nor a net. Nothing is looked up.
[[nodiscard]] tl::expected<QStringList, QString> parseAllowed(const QString& text);

[[nodiscard]] QJsonObject jsonOf(const InputChoices& choices);

/// Leaves out what makes no sense.
[[nodiscard]] InputChoices inputChoicesOf(const QJsonObject& object);

} // namespace posewire::gui
