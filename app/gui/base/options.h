// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/input_choices.h"
#include "app/gui/theme/theme.h"
#include "app/stage/stage_options.h"
#include "app/usage/command_line.h"

#include <QSize>
#include <QString>
#include <QStringList>

#include <tl/expected.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace posewire::gui {

struct Options {
    QString file;
    QString comparedFile;
    std::vector<InputAddress> udpPorts;  ///< multicast groups are joined at each
    std::vector<InputAddress> tcpInputs; ///< listening first
    QStringList allowed;                 ///< hosts and nets to listen to; none: as kept in the settings
    stage::StageOptions stage;           ///< probes to be read
    std::string up;                      ///< "y", "z"; others: as detected
    int demoCharacters = 0;              ///< 0 for no demo
    QString layout;                      ///< name or file; empty for the one in use when the program ended
    bool resetsLayout = false;
    QString settingsFile; ///< empty for the user's own
    QString screenshotFile;
    bool replaces = false; ///< that file, where it exists
    double screenshotAfterSeconds = 3.0;
    std::optional<double> seekSeconds; ///< from the beginning of the file
    QString metrics;  ///< where figures are served: empty: nowhere; else see outlets::Metrics
    QString language; ///< empty for the system's
    QSize size;
    std::optional<ThemeChoice> theme;
    QString screenshotPart; ///< name of the dock or bar that the picture is of; empty for the window
    bool skipsTour = false;
    bool forgetsHistory = false; ///< at the end, also that of earlier runs
    bool printsStartupTime = false;
    bool isVerbose = false;
};

/// `arguments` with the program's name first; `libraries` makes the further lines of --version. Needs no
/// display.
[[nodiscard]] tl::expected<Options, usage::EarlyExit>
parseOptions(const QStringList& arguments, const std::function<std::string()>& libraries);

/// The command line as it is declared, for the manual page and completions.
[[nodiscard]] usage::Program programUsage();

/// What to open at the start: what was asked for on the command line; where nothing was, what was open last,
/// else the port that MVN sends to.
[[nodiscard]] std::vector<InputAddress> inputsToOpen(const Options& options, const InputChoices& choices);

[[nodiscard]] QStringList allowedAtStart(const Options& options, const InputChoices& choices);

/// "dark", "light", "system": on the command line and in files.
[[nodiscard]] QString themeName(ThemeChoice choice);
/// Nothing if no theme has this name.
[[nodiscard]] std::optional<ThemeChoice> themeNamed(const QString& name);

} // namespace posewire::gui
