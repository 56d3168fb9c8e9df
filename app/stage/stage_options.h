// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/stage/server.h"
#include "app/usage/command_line.h"
#include "core/log/byte_io.h"
#include "core/log/time.h"

#include <memory>
#include <optional>
#include <string>

namespace posewire::stage {

/// Servers of a stage as they were typed, for every program.
struct StageOptions {
    ServerChoice servers; ///< without addresses: none
    std::string site;
    std::string since; ///< time of day, or with its day; empty: from now on
    std::string until; ///< empty: goes on

    /// A time that is over: it is read as a file is.
    [[nodiscard]] bool isPast() const { return !until.empty(); }
    /// As a file is named.
    [[nodiscard]] std::string pastName() const {
        return site + " from " + since + (until.empty() ? "" : " to " + until);
    }
    [[nodiscard]] bool isAsked() const { return !servers.addresses.empty(); }
    /// What is wrong with it; nothing if it can be tried.
    [[nodiscard]] std::optional<std::string> problem() const;
};

/// Adds `--nats`, which it returns, `--site` and what servers may ask for.
usage::DeclaredOption addStage(usage::Arguments arguments, StageOptions& options);
/// Adds `--since` as well.
usage::DeclaredOption addStageSince(usage::Arguments arguments, StageOptions& options);

/// When that was, or the newest time of that day that is over: "10:30", "10:30:15.5", "2026-11-26T10:30".
[[nodiscard]] std::optional<log::WallTime> wallTimeOf(const std::string& text);
/// What the probes of the site received from `since` to `until`, or now.
[[nodiscard]] tl::expected<std::unique_ptr<log::ByteSource>, log::FileError>
openPast(const StageOptions& options, log::IsCancelled isCancelled);

} // namespace posewire::stage
