// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/json.h"
#include "core/wire/layouts.h"

#include <nlohmann/json.hpp>

/// What writing datagrams as JSON and reading them back have in common. Used by these two units only.
namespace posewire::exporting {

/// Keeps the order of keys and computes in 32-bit floats, so that a float is written with as few digits as
/// distinguish it from its neighbours.
using Json = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool, std::int64_t,
                                  std::uint64_t, float>;

/// A list of [name, value] pairs.
inline constexpr const char* kTagsKey = "tags";

/// The length of what follows it is not in JSON: it is known from that.
inline bool isLength(const wire::About& about) {
    return about.unit == wire::Unit::ByteCount;
}

/// The bytes of the datagram that an object describes.
[[nodiscard]] tl::expected<std::vector<std::byte>, JsonFault> datagramFromObject(const Json& object);

} // namespace posewire::exporting
