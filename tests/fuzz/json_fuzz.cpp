// SPDX-License-Identifier: MIT
#include "core/export/json.h"
#include "core/wire/codec.h"

#include <algorithm>
#include <cstdlib>
#include <span>

// Whatever the bytes: as a datagram they come back from JSON bit for bit if they can be decoded, and as a
// line of JSON they give a datagram or a fault.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace posewire;
    const wire::Bytes bytes = std::as_bytes(std::span(data, size));
    const auto again = exporting::datagramFromJson(exporting::datagramJson({}, bytes));
    if (wire::decode(bytes)) {
        const bool isSame = again && std::equal(again->begin(), again->end(), bytes.begin(), bytes.end());
        if (!isSame) {
            std::abort();
        }
    }
    static_cast<void>(exporting::datagramFromJson({reinterpret_cast<const char*>(data), size}));
    return 0;
}
