// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/wire/types.h"

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Datagrams as JSON Lines and back. Keys, units and order come from the wire's field tables: the values are
/// the wire's own, floats are written so that they read back to the same 32 bits.
namespace posewire::exporting {

struct DatagramPlace {
    std::uint64_t index = 0;  ///< of the object in the output, from 0
    std::uint64_t offset = 0; ///< of its first byte in the file
    std::optional<log::WallTime> time;
    std::optional<std::string> sender;
    std::uint8_t shared = 0; ///< datagrams in its packet; 0 if it came alone
};

/// Chooses what is written of a datagram.
struct JsonChoice {
    /// Items that have a name in the tables of segments, points and joints say it beside their ids.
    bool hasNames = false;
    std::vector<std::string> fields{}; ///< those of jsonFields(), in the order that is wanted; none: all
};

/// One object without a newline. A datagram with a fault has the header fields that could be read and
/// "error" instead of "body". Where the values alone would not give back the same bytes (reserved bytes in
/// use, trailing bytes …), "bytes" holds the whole datagram in hexadecimal.
[[nodiscard]] std::string datagramJson(const DatagramPlace& place, wire::Bytes bytes,
                                       const JsonChoice& choice = {});

/// The object for `size` bytes that belong to no datagram.
[[nodiscard]] std::string skippedJson(const DatagramPlace& place, std::uint64_t size,
                                      const JsonChoice& choice = {});

/// The names of all fields that an object may have, and "body.segments" and the like for those of its body.
[[nodiscard]] std::vector<std::string> jsonFields();

/// Why a line gives no datagram.
struct JsonFault {
    enum class Kind : std::uint8_t {
        NotJson,     ///< not an object, or no JSON at all
        NotDatagram, ///< an object for skipped bytes or for a datagram with a fault
        BadField,    ///< a field is missing, has the wrong type or does not fit on the wire
    };
    Kind kind = Kind::NotJson;
    std::string text; ///< one line: where in the object, and what is needed
};

/// The inverse. "bytes" wins where it is there. Only "type" and "body" are needed: a header field that is
/// left out gets what a single datagram of that body has. The variant of types 12 and 25 follows from "size".
[[nodiscard]] tl::expected<std::vector<std::byte>, JsonFault> datagramFromJson(std::string_view line);

} // namespace posewire::exporting
