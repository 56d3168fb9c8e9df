// SPDX-License-Identifier: MIT
#include "core/model/foreign_text.h"

#include "core/wire/text.h"

#include <algorithm>
#include <array>
#include <functional>

namespace posewire::model {
namespace {

constexpr std::string_view kEllipsis = "…";
constexpr std::string_view kNoText = "\xef\xbf\xbd"; // U+FFFD

/// Characters above U+009F without a picture of their own: what has no width, what turns the direction of
/// others, and what breaks lines.
struct Range {
    char32_t first;
    char32_t last;
};
constexpr std::array<Range, 15> kUnseen{{{0xad, 0xad},
                                         {0x34f, 0x34f},
                                         {0x61c, 0x61c},
                                         {0x115f, 0x1160},
                                         {0x17b4, 0x17b5},
                                         {0x180b, 0x180f},
                                         {0x200b, 0x200f},
                                         {0x2028, 0x202e},
                                         {0x2060, 0x206f},
                                         {0x3164, 0x3164},
                                         {0xfeff, 0xfeff},
                                         {0xffa0, 0xffa0},
                                         {0xfff0, 0xfffb},
                                         {0x1d173, 0x1d17a},
                                         {0xe0000, 0xe0fff}}};

bool isUnseen(char32_t character) {
    return (character >= 0x80 && character < 0xa0) || std::ranges::any_of(kUnseen, [&](const Range& range) {
               return character >= range.first && character <= range.last;
           });
}

std::size_t lengthOf(char lead) {
    const auto byte = static_cast<unsigned char>(lead);
    return byte < 0x80 ? 1 : byte < 0xe0 ? 2 : byte < 0xf0 ? 3 : 4;
}

/// Of one well-formed sequence.
char32_t characterOf(std::string_view sequence) {
    constexpr std::array<unsigned, 5> kLeadBits{0, 0x7f, 0x1f, 0x0f, 0x07};
    char32_t character = static_cast<unsigned char>(sequence.front()) & kLeadBits[sequence.size()];
    for (const char byte : sequence.substr(1)) {
        character = character << 6U | (static_cast<unsigned char>(byte) & 0x3fU);
    }
    return character;
}

/// "⟨U+202E⟩".
std::string codeOf(char32_t character) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string digits;
    for (char32_t rest = character; rest != 0 || digits.size() < 4; rest >>= 4U) {
        digits.insert(digits.begin(), kDigits[rest & 15U]);
    }
    return "⟨U+" + digits + "⟩";
}

/// U+2400 and on.
std::string controlPicture(char control) {
    const auto picture = static_cast<char>(control == 0x7f ? 0x21 : control);
    return {'\xe2', '\x90', static_cast<char>(0x80 | picture)};
}

/// What is shown for the character at the beginning of a text that is not empty, and how many bytes it has.
struct Symbol {
    std::string text;
    std::size_t length;
};
Symbol symbolAt(std::string_view text) {
    const char lead = text.front();
    if (static_cast<unsigned char>(lead) < 0x80) {
        const bool isControl = static_cast<unsigned char>(lead) < 0x20 || lead == 0x7f;
        return {isControl ? controlPicture(lead) : std::string(1, lead), 1};
    }
    const std::string_view sequence = text.substr(0, lengthOf(lead));
    if (wire::firstInvalidUtf8(sequence) != sequence.size()) {
        return {std::string(kNoText), 1};
    }
    const char32_t character = characterOf(sequence);
    return {isUnseen(character) ? codeOf(character) : std::string(sequence), sequence.size()};
}

/// Names that Windows keeps for devices, with whatever suffix.
bool isDevice(std::string_view name) {
    const std::string stem = wire::lowered(name.substr(0, name.find('.')));
    constexpr std::array<std::string_view, 6> kNames{"con", "prn", "aux", "nul", "conin$", "conout$"};
    const bool isPort = stem.size() == 4 && (stem.starts_with("com") || stem.starts_with("lpt")) &&
                        stem[3] >= '0' && stem[3] <= '9';
    return isPort || std::ranges::find(kNames, stem) != kNames.end();
}

/// 0 is taken: by texts whose bytes are what is shown.
std::uint64_t hashOf(std::string_view bytes) {
    return std::hash<std::string_view>{}(bytes) | 1U;
}

} // namespace

std::string shownText(std::string_view bytes) {
    std::string shown;
    std::size_t end = 0; // up to where there is room for the ellipsis
    while (!bytes.empty()) {
        const Symbol symbol = symbolAt(bytes);
        if (shown.size() + symbol.text.size() > ForeignText::kMostBytes) {
            return shown.substr(0, end).append(kEllipsis);
        }
        shown += symbol.text;
        end = shown.size() + kEllipsis.size() <= ForeignText::kMostBytes ? shown.size() : end;
        bytes.remove_prefix(symbol.length);
    }
    return shown;
}

ForeignText::ForeignText(std::string_view bytes, std::nullptr_t) : m_shown(shownText(bytes)) {
    if (m_shown != bytes) {
        m_exact = std::make_shared<const std::string>(bytes);
        m_hash = hashOf(bytes);
    }
}

std::string ForeignText::fileName(std::string_view otherwise) const {
    constexpr std::string_view kNotInNames = "/\\:*?\"<>|";
    std::string name;
    for (std::string_view rest = m_shown; !rest.empty();) {
        const std::string_view character = rest.substr(0, lengthOf(rest.front()));
        if (name.size() + character.size() > kMostFileNameBytes) {
            break;
        }
        name += kNotInNames.find(character.front()) == std::string_view::npos ? character : "_";
        rest.remove_prefix(character.size());
    }
    name.erase(0, std::min(name.find_first_not_of(". "), name.size()));
    name.erase(name.find_last_not_of(". ") + 1);
    if (isDevice(name)) {
        name.insert(0, "_");
    }
    return name.empty() ? std::string(otherwise) : name;
}

bool ForeignText::isOf(std::string_view bytes) const {
    return m_exact != nullptr ? *m_exact == bytes
           : m_hash == 0      ? m_shown == bytes
                              : m_hash == hashOf(bytes) && m_shown == shownText(bytes);
}

std::size_t ForeignText::memoryBytes() const {
    const std::size_t own = m_shown.capacity() > std::string().capacity() ? m_shown.capacity() : 0;
    return own + (m_exact != nullptr ? sizeof(std::string) + 2 * sizeof(void*) + m_exact->capacity() : 0);
}

std::string visibleText(std::string_view text) {
    std::string shown;
    while (!text.empty()) {
        const Symbol symbol = symbolAt(text);
        const bool isLayout = text.front() == '\n' || text.front() == '\t';
        shown += isLayout ? std::string(1, text.front()) : symbol.text;
        text.remove_prefix(symbol.length);
    }
    return shown;
}

std::string htmlText(std::string_view text) {
    constexpr std::array<std::pair<char, std::string_view>, 5> kEntities{
        {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}}};
    std::string html;
    for (const char character : text) {
        const auto entity =
            std::ranges::find(kEntities, character, &std::pair<char, std::string_view>::first);
        html += entity != kEntities.end() ? entity->second : std::string_view(&character, 1);
    }
    return html;
}

std::string csvText(std::string_view text) {
    // Those of full width too: spreadsheets take them for the others.
    constexpr std::array<std::string_view, 10> kFormula{"=",  "+",  "-",  "@",  "\t",
                                                        "\r", "＝", "＋", "－", "＠"};
    const bool isFormula =
        std::ranges::any_of(kFormula, [&](std::string_view sign) { return text.starts_with(sign); });
    return (isFormula ? "'" : "") + std::string(text);
}

} // namespace posewire::model
