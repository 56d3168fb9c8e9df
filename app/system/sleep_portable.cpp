// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/sleep.h"

namespace posewire::system {

void preventSleep(bool /*isNeeded*/) {}

} // namespace posewire::system
