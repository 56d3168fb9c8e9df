// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::filter {

/// One way to go on writing a filter.
struct Completion {
    std::size_t offset = 0; ///< of the bytes that are replaced
    std::size_t length = 0;
    std::string text;  ///< what stands there afterwards
    std::string about; ///< one line: kind, unit and meaning
};

/// What may stand at the cursor (a byte offset), best first: fields where a condition begins, then operators
/// that suit the field, then its values. Works within a word and in texts that are wrong elsewhere.
[[nodiscard]] std::vector<Completion> completions(std::string_view text, std::size_t cursor);

} // namespace posewire::filter
