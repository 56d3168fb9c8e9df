// SPDX-License-Identifier: MIT
#include "core/filter/lexer.h"

#include <algorithm>
#include <array>

namespace posewire::filter {
namespace {

struct Spelling {
    std::string_view text;
    TokenKind kind = TokenKind::Operator;
    Operator op = Operator::IsThere;

    constexpr Spelling(std::string_view text_, TokenKind kind_) : text(text_), kind(kind_) {}
    constexpr Spelling(std::string_view text_, Operator op_) : text(text_), op(op_) {}
};

/// Longer ones first.
constexpr std::array kSigns{
    Spelling{"&&", TokenKind::And},      Spelling{"||", TokenKind::Or},
    Spelling{"==", Operator::Equal},     Spelling{"!=", Operator::NotEqual},
    Spelling{"<=", Operator::LessEqual}, Spelling{">=", Operator::GreaterEqual},
    Spelling{"..", TokenKind::Range},    Spelling{"<", Operator::Less},
    Spelling{">", Operator::Greater},    Spelling{"!", TokenKind::Not},
    Spelling{"(", TokenKind::Open},      Spelling{")", TokenKind::Close},
    Spelling{"{", TokenKind::OpenSet},   Spelling{"}", TokenKind::CloseSet},
    Spelling{",", TokenKind::Comma},     Spelling{"~", Operator::Matches},
};

constexpr std::array kWords{
    Spelling{"and", TokenKind::And},          Spelling{"or", TokenKind::Or},
    Spelling{"not", TokenKind::Not},          Spelling{"in", Operator::In},
    Spelling{"contains", Operator::Contains}, Spelling{"matches", Operator::Matches},
};

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
        const bool isJoint = (isPlain(next) && (character == '.' ||
                                                ((character == ':' || character == '/') && at != start))) ||
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
        const auto word = std::ranges::find(kWords, rest.substr(0, length), &Spelling::text);
        return word != kWords.end() ? Token{word->kind, offset, length, word->op}
                                    : Token{TokenKind::Word, offset, length};
    }
    const auto sign = std::ranges::find_if(
        kSigns, [&](const Spelling& spelling) { return rest.starts_with(spelling.text); });
    return sign != kSigns.end() ? Token{sign->kind, offset, sign->text.size(), sign->op}
                                : Token{TokenKind::Unknown, offset, 1};
}

} // namespace

std::vector<Token> tokens(std::string_view text) {
    std::vector<Token> all;
    std::size_t offset = 0;
    while ((offset = text.find_first_not_of(" \t\n\r", offset)) != std::string_view::npos) {
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
