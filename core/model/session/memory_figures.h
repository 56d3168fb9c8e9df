// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace posewire::model {

class Ingest;

/// About, and at most whatever comes.
struct MemoryFigures {
    struct Part {
        std::string_view key; ///< in JSON
        const char* name;     ///< as people read it
        std::size_t bytes = 0;
        std::size_t most = 0; ///< 0 if that is within the limit of the part before
    };
    std::vector<Part> parts;

    [[nodiscard]] std::size_t sum() const;
    [[nodiscard]] std::size_t budget() const;
};

/// `decodedBytes`: what readers keep of decoded messages.
[[nodiscard]] MemoryFigures memoryOf(const Ingest& ingest, std::size_t decodedBytes);

} // namespace posewire::model
