// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme.h"

#include <QSize>
#include <QString>
#include <QStringList>

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::gui {

inline constexpr std::uint16_t kDefaultPort = 9763;

/// Where to listen: an address of this computer, empty for all of them.
struct UdpPort {
    QString address;
    std::uint16_t port = kDefaultPort;
    friend bool operator==(const UdpPort&, const UdpPort&) = default;
};

/// "9763", "127.0.0.1:9763", "[::1]:9763"; the error tells what is wrong.
[[nodiscard]] tl::expected<UdpPort, QString> parseUdpPort(const QString& text);

/// "UDP 9763", "UDP 127.0.0.1:9763".
[[nodiscard]] QString displayText(const UdpPort& port);

struct Options {
    QString file;
    std::vector<UdpPort> udpPorts;
    int demoCharacters = 0; ///< 0 for no demo
    QString layout;         ///< name or file; empty for the one in use when the program ended
    bool resetsLayout = false;
    QString settingsFile; ///< empty for the user's own
    QString screenshotFile;
    double screenshotAfterSeconds = 3.0;
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
