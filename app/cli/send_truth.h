// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/send_line.h"

#include <tl/expected.hpp>

namespace posewire::cli {

/// What was really sent, as JSON with the names of the report of `monitor`. Fails with one line for the user.
tl::expected<void, std::string> writeTruth(const std::string& path, const std::vector<SendLine>& lines,
                                           double durationSeconds);

} // namespace posewire::cli
