// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/version.h"

namespace posewire::usage {

std::string_view version() {
    return POSEWIRE_VERSION;
}

} // namespace posewire::usage
