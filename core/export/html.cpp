// SPDX-License-Identifier: MIT
#include "core/export/html.h"

#include "core/wire/utf8.h"

#include <array>
#include <charconv>
#include <cmath>

namespace posewire::exporting {
namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";

/// Length of the well-formed character of UTF-8 at the front, 0 where there is none.
std::size_t characterLength(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    return text.size() >= length && wire::firstInvalidUtf8(text.substr(0, length)) == length ? length : 0;
}

std::string_view entityOf(char character) {
    switch (character) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return {};
    }
}

} // namespace

std::string escaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = characterLength(text);
        const auto first = static_cast<unsigned char>(text.front());
        const bool isControl = first == 0x7f || (first < 0x20 && first != '\n' && first != '\t');
        if (length == 0 || isControl) {
            result += kReplacement;
            text.remove_prefix(1);
            continue;
        }
        const std::string_view entity = entityOf(text.front());
        result += entity.empty() ? text.substr(0, length) : entity;
        text.remove_prefix(length);
    }
    return result;
}

std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t place = digits.size(); place > 3; place -= 3) {
        digits.insert(place - 3, ",");
    }
    return digits;
}

std::string fixed(double number, int places) {
    if (!std::isfinite(number)) {
        return "–";
    }
    std::array<char, 64> digits{};
    const auto [end, error] =
        std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, places);
    return error == std::errc() ? std::string(digits.data(), end) : "–";
}

void HtmlTable::add(const std::vector<std::string>& cells, std::string_view kind) {
    m_rows += kind.empty() ? std::string("<tr>") : "<tr class=\"" + escaped(kind) + "\">";
    for (std::size_t i = 0; i < cells.size() && i < m_columns.size(); ++i) {
        m_rows += m_columns[i].isNumber ? "<td class=\"n\">" : "<td>";
        m_rows += cells[i] + "</td>";
    }
    m_rows += "</tr>\n";
}

std::string HtmlTable::html() const {
    std::string text = "<div class=\"scroll\"><table>\n<thead><tr>";
    for (const Column& column : m_columns) {
        text += column.isNumber ? "<th scope=\"col\" class=\"n\"" : "<th scope=\"col\"";
        text += column.explanation.empty() ? ">" : " title=\"" + escaped(column.explanation) + "\">";
        text += escaped(column.title) + "</th>";
    }
    return text + "</tr></thead>\n<tbody>\n" + m_rows + "</tbody>\n</table></div>\n";
}

} // namespace posewire::exporting
