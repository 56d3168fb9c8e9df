// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/batch.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

// Whatever the bytes: what comes of a batch is no more than it has, and each datagram one that can be.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::size_t bytes = 0;
    static_cast<void>(posewire::stage::readBatch(std::as_bytes(std::span(data, size)),
                                                 [&](const posewire::log::FileRecord& record) {
                                                     bytes += record.bytes.size();
                                                     if (bytes > size) {
                                                         std::abort();
                                                     }
                                                 }));
    return 0;
}
