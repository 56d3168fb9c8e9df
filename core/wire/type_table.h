// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace posewire::wire {

/// What people call a message type, and what the specification says about it as a whole.
struct TypeInfo {
    std::uint8_t type;
    std::string_view name;      ///< "Pose, quaternion"
    std::string_view frame;     ///< coordinate frame, or empty
    std::string_view revisions; ///< "E–N"
    std::string_view section;
    std::string_view remark; ///< where real senders and the text differ
    bool isSampled;          ///< carries a sample counter that counts frames (not types 10 to 13)
};

/// All fifteen message types, in order.
[[nodiscard]] std::span<const TypeInfo> typeTable();

/// The row of a type; null where the type is not known.
[[nodiscard]] const TypeInfo* findType(std::uint8_t type);

/// The type as the two digits on the wire, "02".
[[nodiscard]] std::array<char, 2> typeDigits(std::uint8_t type);

/// "02 Pose, quaternion", or "77 unknown type".
[[nodiscard]] std::string typeTitle(std::uint8_t type);

/// True for types whose sample counter counts frames; unknown types are taken to.
[[nodiscard]] bool isSampled(std::uint8_t type);

} // namespace posewire::wire
