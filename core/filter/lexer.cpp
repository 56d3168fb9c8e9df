// SPDX-License-Identifier: MIT
#include "core/filter/lexer.h"

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::filter {
namespace {

using Spelling = std::pair<std::string_view, TokenKind>;

/// Longer ones first.
constexpr std::array<Spelling, 16> kSigns{{{"&&", TokenKind::And},
                                           {"||", TokenKind::Or},
                                           {"==", TokenKind::Equal},
                                           {"!=", TokenKind::NotEqual},
                                           {"<=", TokenKind::LessEqual},
                                           {">=", TokenKind::GreaterEqual},
                                           {"..", TokenKind::Range},
                                           {"<", TokenKind::Less},
                                           {">", TokenKind::Greater},
                                           {"!", TokenKind::Not},
                                           {"(", TokenKind::Open},
                                           {")", TokenKind::Close},
                                           {"{", TokenKind::OpenSet},
                                           {"}", TokenKind::CloseSet},
                                           {",", TokenKind::Comma},
                                           {"~", TokenKind::Matches}}};

constexpr std::array<Spelling, 6> kWords{{{"and", TokenKind::And},
                                          {"or", TokenKind::Or},
                                          {"not", TokenKind::Not},
                                          {"in", TokenKind::In},
                                          {"contains", TokenKind::Contains},
                                          {"matches", TokenKind::Matches}}};

bool isSpace(char character) {
    return character == ' ' || character == '\t' || character == '\n' || character == '\r';
}

bool isDigit(char character) {
    return character >= '0' && character <= '9';
}

/// Letters, digits, and all UTF-8 beyond ASCII.
bool isPlain(char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           isDigit(character) || character == '_' || static_cast<unsigned char>(character) >= 0x80;
}

/// Bytes of the word that begins here; 0 if none does.
std::size_t wordLength(std::string_view text) {
    std::size_t at = 0;
    const bool hasSign = text.size() > 1 && (text[0] == '-' || text[0] == '+') &&
                         (isPlain(text[1]) || (text[1] == '.' && text.size() > 2 && isDigit(text[2])));
    at += hasSign ? 1 : 0;
    const std::size_t start = at;
    while (at < text.size()) {
        const char character = text[at];
        const char next = at + 1 < text.size() ? text[at + 1] : ' ';
        // A word may end with a dot while it is being typed; two dots are a range.
        const bool isJoint = (isPlain(next) && (character == '.' || (character == ':' && at != start))) ||
                             (character == '.' && next != '.' && at != start && text[at - 1] != '.');
        const bool isExponent = (character == '-' || character == '+') && at > start && isDigit(next) &&
                                (text[at - 1] == 'e' || text[at - 1] == 'E') &&
                                (isDigit(text[start]) || text[start] == '.');
        if (!isPlain(character) && !isJoint && !isExponent) {
            break;
        }
        ++at;
    }
    return at == start ? 0 : at;
}

/// The text up to and including its closing quote; Unfinished if there is none.
Token quotedToken(std::string_view text, std::size_t offset) {
    for (std::size_t at = offset + 1; at < text.size(); ++at) {
        if (text[at] == '\\') {
            ++at;
        } else if (text[at] == '"') {
            return {TokenKind::Quoted, offset, at + 1 - offset};
        }
    }
    return {TokenKind::Unfinished, offset, text.size() - offset};
}

Token tokenAt(std::string_view text, std::size_t offset) {
    const std::string_view rest = text.substr(offset);
    if (rest.front() == '"') {
        return quotedToken(text, offset);
    }
    if (const std::size_t length = wordLength(rest); length != 0) {
        const auto word = std::find_if(kWords.begin(), kWords.end(), [&](const Spelling& spelling) {
            return rest.substr(0, length) == spelling.first;
        });
        return {word != kWords.end() ? word->second : TokenKind::Word, offset, length};
    }
    const auto sign = std::find_if(kSigns.begin(), kSigns.end(), [&](const Spelling& spelling) {
        return rest.starts_with(spelling.first);
    });
    return sign != kSigns.end() ? Token{sign->second, offset, sign->first.size()}
                                : Token{TokenKind::Unknown, offset, 1};
}

} // namespace

std::vector<Token> tokens(std::string_view text) {
    std::vector<Token> all;
    std::size_t offset = 0;
    while (true) {
        while (offset < text.size() && isSpace(text[offset])) {
            ++offset;
        }
        if (offset == text.size()) {
            break;
        }
        all.push_back(tokenAt(text, offset));
        offset = all.back().end();
    }
    all.push_back({TokenKind::End, text.size(), 0});
    return all;
}

std::string unquoted(std::string_view quoted) {
    std::string text;
    for (std::size_t at = 1; at + 1 < quoted.size(); ++at) {
        const bool isEscape =
            quoted[at] == '\\' && (quoted[at + 1] == '"' || quoted[at + 1] == '\\') && at + 2 < quoted.size();
        at += isEscape ? 1 : 0;
        text += quoted[at];
    }
    return text;
}

std::string quoted(std::string_view text) {
    std::string all = "\"";
    for (const char character : text) {
        all.append(character == '"' || character == '\\' ? 1 : 0, '\\');
        all += character;
    }
    return all + '"';
}

} // namespace posewire::filter
