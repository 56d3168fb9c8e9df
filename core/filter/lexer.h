// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::filter {

enum class Operator : std::uint8_t {
    IsThere, ///< the field alone
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    In,
    Contains,
    Matches,
};

enum class TokenKind : std::uint8_t {
    End,
    Word,   ///< a name, a number, a unit, or any other word: 0x1f, m/s, 192.168.1.20:4001
    Quoted, ///< text in double quotes
    Open,
    Close,
    OpenSet,
    CloseSet,
    Comma,
    Range, ///< ..
    And,
    Or,
    Not,
    Operator,   ///< between a field and a constant
    Unfinished, ///< text without a closing quote
    Unknown,    ///< a character without a meaning here
};

/// Between a field and an item, as in `position.z of LeftHand`.
inline constexpr std::string_view kOf = "of";

/// A piece of a filter's text; the place is in bytes.
struct Token {
    TokenKind kind = TokenKind::End;
    std::size_t offset = 0;
    std::size_t length = 0;
    Operator op = Operator::IsThere; ///< of TokenKind::Operator

    [[nodiscard]] std::size_t end() const { return offset + length; }
    [[nodiscard]] std::string_view in(std::string_view text) const { return text.substr(offset, length); }
};

/// Splits a text; the last token is End. Never fails: meaningless characters become Unknown.
[[nodiscard]] std::vector<Token> tokens(std::string_view text);

/// The text between the quotes of a Quoted token, with \" and \\ resolved.
[[nodiscard]] std::string unquoted(std::string_view quoted);

/// The text in quotes.
[[nodiscard]] std::string quoted(std::string_view text);

} // namespace posewire::filter
