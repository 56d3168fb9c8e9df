// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace posewire::model {

/// What the operator wrote on packets; kept by packet number, also where the log has dropped the packet.
struct Annotations {
    std::set<std::uint64_t> marks;
    std::map<std::uint64_t, std::string> comments; ///< UTF-8, never empty

    friend bool operator==(const Annotations&, const Annotations&) = default;
};

} // namespace posewire::model
