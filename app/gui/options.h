// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QSize>
#include <QString>
#include <QStringList>

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::gui {

inline constexpr std::uint16_t kDefaultPort = 9763;

/// Where datagrams come from, as the operator says it.
struct InputAddress {
    enum class Kind : std::uint8_t {
        Udp,
        TcpListen,  ///< MVN connects
        TcpConnect, ///< to a sender that listens
    };
    QString address; ///< of this computer, empty for all of them; where to connect, that of the sender
    std::uint16_t port = kDefaultPort;
    Kind kind = Kind::Udp;
    QStringList groups{}; ///< UDP: multicast groups to join
    friend bool operator==(const InputAddress&, const InputAddress&) = default;
};

/// "9763", "127.0.0.1:9763", "[::1]:9763"; the error says what is wrong, and begins with the option's name.
[[nodiscard]] tl::expected<InputAddress, QString>
parseInputAddress(const QString& text, InputAddress::Kind kind = InputAddress::Kind::Udp);

/// "UDP 9763", "UDP 127.0.0.1:9763", "TCP 9763", "TCP to studio:9763".
[[nodiscard]] QString displayText(const InputAddress& input);

struct Options {
    QString file;
    std::vector<InputAddress> udpPorts;  ///< multicast groups are joined at each
    std::vector<InputAddress> tcpInputs; ///< listening first
    int demoCharacters = 0;              ///< 0 for no demo
    QString layout;                      ///< name or file; empty for the one in use when the program ended
    bool resetsLayout = false;
    QString settingsFile; ///< empty for the user's own
    QString screenshotFile;
    double screenshotAfterSeconds = 3.0;
    std::optional<double> seekSeconds; ///< from the beginning of the file
    QSize size;
    std::optional<ThemeChoice> theme;
    bool printsStartupTime = false;
};

/// The program ends at once: help and version on standard output with status 0, a wrong option on standard
/// error with 2.
struct EarlyExit {
    int status = 0;
    QString text;
};

/// `arguments` with the program's name first. Needs a QCoreApplication, no display.
[[nodiscard]] tl::expected<Options, EarlyExit> parseOptions(const QStringList& arguments);

} // namespace posewire::gui
