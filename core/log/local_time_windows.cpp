// SPDX-License-Identifier: MIT
#include "core/log/local_time.h"

#include <time.h>

namespace posewire::log {

std::tm localTime(std::time_t time) {
    std::tm local{};
    ::localtime_s(&local, &time);
    return local;
}

} // namespace posewire::log
