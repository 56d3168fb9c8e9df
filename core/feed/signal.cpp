// SPDX-License-Identifier: MIT
#include "core/feed/signal.h"

#include "core/filter/lexer.h"

#include <algorithm>

namespace posewire::feed {
namespace {

using filter::FilterError;
using filter::Token;
using filter::TokenKind;

tl::unexpected<FilterError> failure(const Token& token, std::string text) {
    return tl::unexpected(FilterError{token.offset, token.length, std::move(text)});
}

std::optional<ItemNumber> itemNamed(std::string_view name) {
    using enum field::Kind;
    for (const auto& [kind, fieldName] :
         {std::pair{Segment, "segment"}, {Point, "point"}, {Joint, "joint"}}) {
        if (const auto number = field::numberNamed(kind, name)) {
            return ItemNumber{fieldName, *number};
        }
    }
    const auto number = field::numberOf(name);
    return number ? std::optional(ItemNumber{"segment", *number}) : std::nullopt;
}

} // namespace

tl::expected<Expression, FilterError> parseSignal(std::string_view text) {
    const auto tokens = filter::tokens(text);
    const Token& first = tokens.front();
    if (first.kind != TokenKind::Word) {
        return failure(first, "Expected a field, such as `position.z`.");
    }
    const field::FieldMatch match = field::findFields(first.in(text));
    if (match.fields.empty()) {
        const std::string near = field::nearestField(first.in(text));
        return failure(first, "There is no field `" + std::string(first.in(text)) + "`" +
                                  (near.empty() ? "." : "; did you mean `" + near + "`?"));
    }
    std::optional<ItemNumber> item;
    std::size_t at = 1;
    if (tokens[at].in(text) == "of") {
        const Token& name = tokens[++at];
        item = itemNamed(name.kind == TokenKind::Quoted ? filter::unquoted(name.in(text)) : name.in(text));
        if (!item) {
            return failure(name, "Expected a segment, point or joint, such as LeftHand.");
        }
        ++at;
    }
    if (tokens[at].kind != TokenKind::End) {
        return failure(tokens[at], "The signal ends before this.");
    }
    Expression expression;
    const std::size_t end = tokens[at - 1].end();
    expression.text = text.substr(first.offset, end - first.offset);
    expression.dimension = match.isAsSent ? field::Dimension::None : match.fields.front()->dimension;
    expression.unit = match.isAsSent ? std::string() : match.fields.front()->unit;
    for (const field::FieldInfo* field : match.fields) {
        expression.types.insert(expression.types.end(), field->types.begin(), field->types.end());
    }
    std::ranges::sort(expression.types);
    expression.types.erase(std::unique(expression.types.begin(), expression.types.end()),
                           expression.types.end());
    expression.signal = fieldSignal(match, item);
    return expression;
}

} // namespace posewire::feed
