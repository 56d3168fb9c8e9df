// SPDX-License-Identifier: MIT
#include "core/log/local_time.h"

#include <time.h>

namespace posewire::log {

std::tm localTime(std::time_t time) {
    std::tm local{};
    ::localtime_r(&time, &local);
    return local;
}

} // namespace posewire::log
