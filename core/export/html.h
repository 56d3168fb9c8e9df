// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// What HTML is put together from. Texts are escaped here and nowhere else: whatever came over the wire ends
/// up as text.
namespace posewire::exporting {

/// Safe in text and in quoted attributes. Control characters and what is no UTF-8 become U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// A number as people read it: "12,345".
[[nodiscard]] std::string grouped(std::uint64_t number);
/// With so many places after the point; a dash where it is not finite.
[[nodiscard]] std::string fixed(double number, int places);

/// A table whose cells are HTML already; the first row heads it.
class HtmlTable {
public:
    struct Column {
        std::string title;       ///< plain text
        bool isNumber = false;   ///< set to the right, digits of equal width
        std::string explanation; ///< plain text, shown by the title
    };

    explicit HtmlTable(std::vector<Column> columns) : m_columns(std::move(columns)) {}

    /// One cell for each column. `kind` is a class for the row, "" for none.
    void add(const std::vector<std::string>& cells, std::string_view kind = {});
    [[nodiscard]] bool isEmpty() const { return m_rows.empty(); }
    [[nodiscard]] std::string html() const;

private:
    std::vector<Column> m_columns;
    std::string m_rows;
};

} // namespace posewire::exporting
