// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::cli {

/// The whole of `posewire-cli`; returns its exit status.
[[nodiscard]] int runProgram(int argumentCount, const char* const* arguments);

} // namespace posewire::cli
