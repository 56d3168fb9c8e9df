// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/stage/range.h"
#include "app/stage/server.h"
#include "app/usage/command_line.h"
#include "core/log/byte_io.h"

#include <memory>
#include <optional>
#include <string>

namespace posewire::stage {

/// The options of a stage as they were typed, for both programs. Without servers, its range is that of a
/// file.
struct StageOptions : Range {
    ServerChoice servers; ///< without addresses: none
    std::string site;

    /// True if it is a range of the past, which is read as a file is.
    [[nodiscard]] bool isPast() const { return !until.empty(); }
    /// A name for the range, in place of a file's.
    [[nodiscard]] std::string pastName() const {
        return site + " from " + since + (until.empty() ? "" : " to " + until);
    }
    [[nodiscard]] bool isAsked() const { return !servers.addresses.empty(); }
    /// The mistake in it, if there is one.
    [[nodiscard]] std::optional<std::string> problem() const;
};

/// Adds `--nats`, which it returns, `--site` and what servers may ask for.
usage::DeclaredOption addStage(usage::Arguments arguments, StageOptions& options);
/// Adds `--since` as well.
usage::DeclaredOption addStageSince(usage::Arguments arguments, StageOptions& options);

/// Opens the packets that the probes of the site received from `since` to `until`, or to now.
[[nodiscard]] tl::expected<std::unique_ptr<log::ByteSource>, log::FileError>
openPast(const StageOptions& options, log::IsCancelled isCancelled);

} // namespace posewire::stage
