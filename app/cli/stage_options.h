// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/command.h"
#include "app/stage/server.h"

#include <optional>
#include <string>

namespace posewire::cli {

/// Servers of a stage, as they were typed.
struct StageOptions {
    stage::ServerChoice servers; ///< without addresses: none
    std::string site;

    [[nodiscard]] bool isAsked() const { return !servers.addresses.empty(); }
    /// What is wrong with it; nothing if it can be tried.
    [[nodiscard]] std::optional<std::string> problem() const;
};

/// Adds `--nats`, which it returns, `--site` and what servers may ask for.
DeclaredOption addStage(Arguments arguments, StageOptions& options);

Command addProbeCommand(CommandLine& program);
Command addStageCommand(CommandLine& program);

} // namespace posewire::cli
