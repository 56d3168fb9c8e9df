// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::system {

/// Has SIGINT, SIGTERM and SIGHUP handled so; `flags` are those of sigaction(). A SIGHUP that the program was
/// started to ignore stays so (nohup).
void handleEndings(void (*handler)(int), int flags);

} // namespace posewire::system
