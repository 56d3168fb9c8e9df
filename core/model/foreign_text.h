// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace posewire::model {

/// Text with the entities of HTML for & < > " and '.
[[nodiscard]] std::string htmlText(std::string_view text);
/// A text that a spreadsheet takes for no formula: after an apostrophe where it begins with = + - @, a tab or
/// a carriage return.
[[nodiscard]] std::string csvText(std::string_view text);

/// What a sender or a file wrote: names, tags, addresses, comments. It may hold anything, so nothing shows it
/// as it came: who shows it asks for the form that its place needs. All forms but exact() are made of what is
/// shown: clipped, and each character that is not seen, or that changes how others are, as a symbol. Controls
/// are control pictures (␀ to ␟ and ␡), bytes that are no UTF-8 are U+FFFD, and what else has no picture
/// (controls from U+0080 on, overrides of direction, characters without width, other line breaks) is its code
/// in brackets: ⟨U+202E⟩.
class ForeignText {
public:
    /// Of what is shown, with the ellipsis of what is clipped. The whole text is in the inspector of its
    /// packet.
    static constexpr std::size_t kMostBytes = 256;
    static constexpr std::size_t kMostFileNameBytes = 80;

    ForeignText() = default;
    template <std::convertible_to<std::string_view> Text>
    ForeignText(const Text& bytes) : ForeignText(std::string_view(bytes), nullptr) {}

    /// Plain text of one line, for widgets and terminals: no control character is left.
    [[nodiscard]] const std::string& shown() const { return m_shown; }
    /// For HTML, in text and in quoted attributes.
    [[nodiscard]] std::string html() const { return htmlText(m_shown); }
    /// For a cell of a table, before it is quoted: see csvText().
    [[nodiscard]] std::string csv() const { return csvText(m_shown); }
    /// Names one file in the folder it is put into, whatever was written: no separators, no leading dot or
    /// blank, no name that Windows keeps for a device; `otherwise` where nothing is left.
    [[nodiscard]] std::string fileName(std::string_view otherwise) const;

    /// The bytes as they came, for JSON and to look names up; what is shown, where they were forgotten.
    [[nodiscard]] std::string_view exact() const { return m_exact != nullptr ? *m_exact : m_shown; }
    /// Gives back the memory of long bytes. Equality does not suffer.
    void forgetExact() { m_exact.reset(); }
    [[nodiscard]] bool hasForgettable() const { return m_exact != nullptr; }

    [[nodiscard]] bool isEmpty() const { return m_shown.empty(); }
    /// Whether these are the bytes, also where they were forgotten.
    [[nodiscard]] bool isOf(std::string_view bytes) const;
    [[nodiscard]] std::size_t memoryBytes() const;

    friend bool operator==(const ForeignText& a, const ForeignText& b) {
        return a.m_hash == b.m_hash && a.m_shown == b.m_shown;
    }
    template <std::convertible_to<std::string_view> Text>
    friend bool operator==(const ForeignText& a, const Text& bytes) {
        return a.isOf(std::string_view(bytes));
    }

private:
    ForeignText(std::string_view bytes, std::nullptr_t);

    std::string m_shown;
    std::shared_ptr<const std::string> m_exact; ///< null if it is what is shown, or forgotten
    std::uint64_t m_hash = 0;                   ///< of the exact bytes; 0 if they are what is shown
};

[[nodiscard]] std::string shownText(std::string_view bytes);

/// The same symbols without a clip, for texts of ours that quote foreign ones; line breaks and tabs stay.
[[nodiscard]] std::string visibleText(std::string_view text);

} // namespace posewire::model
