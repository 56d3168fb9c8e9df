// SPDX-License-Identifier: MIT
#pragma once

#include "core/field/field.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

/// The display filter: a small typed language over every field that core/wire declares, and over what is
/// known about a packet besides its bytes. filterReference() describes the language.
namespace posewire::filter {

/// What is wrong with a filter and how to fix it; the place is in bytes of the UTF-8 text.
struct FilterError {
    std::size_t offset = 0;
    std::size_t length = 0;
    std::string text; ///< one sentence

    friend bool operator==(const FilterError&, const FilterError&) = default;
};

using field::Candidate;

struct Program;

/// A compiled filter. Cheap to copy; several threads may use copies at once.
class Filter {
public:
    /// Longer texts and deeper parentheses are rejected.
    static constexpr std::size_t kLongestText = 4096;
    static constexpr std::size_t kDeepest = 64;

    /// Matches everything.
    Filter() = default;

    /// An empty text matches everything.
    [[nodiscard]] static tl::expected<Filter, FilterError> compile(std::string_view text);

    /// Does not allocate, except inside the regular expressions of `matches`, whose memory is bounded.
    [[nodiscard]] bool matches(const Candidate& candidate) const;

    [[nodiscard]] bool matchesEverything() const { return m_program == nullptr; }
    [[nodiscard]] bool comparesLengths() const;
    /// Whether what comes after a packet may change the answer: gaps, restarts and the like are judged later.
    [[nodiscard]] bool comparesJudged() const;

private:
    std::shared_ptr<const Program> m_program;
};

/// The language of the display filter on one page, in Markdown; its field tables come from the layouts that
/// decode the datagrams.
[[nodiscard]] std::string filterReference();

} // namespace posewire::filter
