// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/sleep.h"

#include <windows.h>

namespace posewire::system {

void preventSleep(bool isNeeded) {
    ::SetThreadExecutionState(ES_CONTINUOUS | (isNeeded ? ES_SYSTEM_REQUIRED : 0U));
}

} // namespace posewire::system
