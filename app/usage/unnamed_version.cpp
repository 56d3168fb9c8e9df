// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/usage.h"

std::string_view posewire::usage::version() {
    return POSEWIRE_VERSION;
}
