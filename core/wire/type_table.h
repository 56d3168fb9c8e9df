// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace posewire::wire {

/// Axes and hand of a type's coordinates.
enum class Frame : std::uint8_t {
    None,
    ZUp,   ///< Z-up, right-handed
    YUp,   ///< Y-up, right-handed
    Unity, ///< Y-up, left-handed
    Isb,   ///< ISB axes of a joint
};

/// "Z-up, right-handed"; empty for none.
[[nodiscard]] std::string_view frameName(Frame frame);

/// What people call a message type, and what the specification says about it as a whole.
struct TypeInfo {
    std::uint8_t type;
    std::string_view name; ///< "Pose, quaternion"
    Frame frame;
    std::string_view revisions; ///< "E–N": of the specification, the first and the last that have it
    std::string_view section;
    std::string_view remark; ///< where real senders and the text differ
    bool isSampled;          ///< carries a sample counter that counts frames (not types 10 to 13)

    [[nodiscard]] constexpr char firstRevision() const { return revisions.front(); }
    [[nodiscard]] constexpr bool isInOneRevision() const { return revisions.size() == 1; }
};

/// The row of a message type, specialised for each of wire::Messages.
template <class Message>
inline constexpr TypeInfo kRow = Message::needsARowInTheTypeTable;

/// All message types, in order.
[[nodiscard]] std::span<const TypeInfo> typeTable();

/// The row of a type; null where the type is not known.
[[nodiscard]] const TypeInfo* findType(std::uint8_t type);

/// The type as the two digits on the wire, "02".
[[nodiscard]] std::string typeDigits(std::uint8_t type);

/// "02 Pose, quaternion", or "77 unknown type".
[[nodiscard]] std::string typeTitle(std::uint8_t type);

/// True for types whose sample counter counts frames; unknown types are taken to.
[[nodiscard]] bool isSampled(std::uint8_t type);

} // namespace posewire::wire
