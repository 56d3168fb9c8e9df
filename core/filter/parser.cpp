// SPDX-License-Identifier: MIT
#include "core/filter/program.h"

#include <algorithm>

namespace posewire::filter {
namespace {

using Failure = tl::unexpected<FilterError>;
using Parsed = tl::expected<std::uint32_t, FilterError>;
using Join = Program::Join;

class Parser {
public:
    explicit Parser(std::string_view text) : m_text(text), m_tokens(tokens(text)) {}

    tl::expected<Program, FilterError> run() {
        auto root = joined(0, TokenKind::Or);
        if (!root) {
            return Failure(root.error());
        }
        if (here().kind != TokenKind::End) {
            return Failure(unexpected("`&&` or `||`"));
        }
        m_program.root = withItems(*root);
        return std::move(m_program);
    }

private:
    [[nodiscard]] const Token& here() const { return m_tokens[m_at]; }
    bool take(TokenKind kind) {
        const bool isIt = here().kind == kind;
        m_at += isIt ? 1 : 0;
        return isIt;
    }
    [[nodiscard]] FilterError unexpected(std::string_view wanted) const {
        const Token& token = here();
        std::string text = "Expected " + std::string(wanted) + " here.";
        if (token.kind == TokenKind::End) {
            text = "The filter ends early: " + std::string(wanted) + " is missing.";
        } else if (token.kind == TokenKind::Unfinished) {
            text = "This text has no closing quote.";
        } else if (token.in(m_text) == "=") {
            text = "Compare with `==`.";
        } else if (token.in(m_text) == "&" || token.in(m_text) == "|") {
            text = "Join conditions with `" + std::string(2, token.in(m_text).front()) + "`.";
        }
        return {token.offset, token.length, std::move(text)};
    }

    /// Operands of ||, or those of && (which bind tighter).
    Parsed joined(std::size_t depth, TokenKind sign) {
        Program::Node node;
        node.join = sign == TokenKind::Or ? Join::Or : Join::And;
        node.isOfItems = true;
        bool isOfConditions = sign == TokenKind::Or;
        bool hasItems = false;
        do {
            auto operand = sign == TokenKind::Or ? joined(depth, TokenKind::And) : one(depth);
            if (!operand) {
                return operand;
            }
            const Program::Node& below = m_program.nodes[*operand];
            // An && within an && stood in parentheses: a group of its own.
            const bool isGroup = node.join == Join::And && below.join == Join::And;
            node.isOfItems = node.isOfItems && below.isOfItems && !isGroup;
            isOfConditions = isOfConditions && below.join == Join::Condition;
            hasItems = hasItems || below.isOfItems;
            node.children.push_back(*operand);
        } while (take(sign));
        node.isMixed = isOfConditions && hasItems && !node.isOfItems;
        return node.children.size() == 1 ? node.children.front() : m_program.add(std::move(node));
    }

    Parsed one(std::size_t depth) {
        if (depth > Filter::kDeepest) {
            return Failure(FilterError{here().offset, here().length, "Parentheses are nested too deeply."});
        }
        if (take(TokenKind::Not)) {
            auto operand = one(depth + 1);
            return operand ? m_program.add({Join::Not, 0, {*operand}}) : operand;
        }
        if (take(TokenKind::Open)) {
            auto inner = joined(depth + 1, TokenKind::Or);
            if (inner && !take(TokenKind::Close)) {
                return Failure(unexpected("`)`"));
            }
            return inner;
        }
        return condition();
    }

    Parsed condition() {
        if (here().kind != TokenKind::Word) {
            return Failure(unexpected("a field, such as `type`"));
        }
        WrittenCondition written;
        written.field = here();
        written.fieldName = here().in(m_text);
        ++m_at;
        if (here().in(m_text) == kOf) {
            ++m_at;
            auto item = constant();
            if (!item) {
                return Failure(item.error());
            }
            written.item = std::move(*item);
        }
        written.operatorToken = here();
        written.op = here().op;
        if (take(TokenKind::Operator)) {
            auto taken = written.op == Operator::In ? members(written) : member(written, false);
            if (!taken) {
                return Failure(taken.error());
            }
        }
        auto condition = understood(written);
        if (!condition) {
            return Failure(condition.error());
        }
        const bool isOfItems = condition->isOfItems();
        m_program.conditions.push_back(std::move(*condition));
        const auto index = static_cast<std::uint32_t>(m_program.conditions.size() - 1);
        return m_program.add({Join::Condition, index, {}, isOfItems});
    }

    tl::expected<Constant, FilterError> constant() {
        const Token token = here();
        if (token.kind != TokenKind::Word && token.kind != TokenKind::Quoted) {
            return Failure(unexpected("a value, such as 2 or \"text\""));
        }
        ++m_at;
        const bool isQuoted = token.kind == TokenKind::Quoted;
        Constant constant{token, isQuoted ? unquoted(token.in(m_text)) : std::string(token.in(m_text)),
                          isQuoted};
        if (!isQuoted && numberOf(constant.text) && isUnit()) {
            constant.unit = here();
            constant.unitText = here().in(m_text);
            ++m_at;
        }
        return constant;
    }

    /// After a number: a word that is neither the next field nor compared with something.
    [[nodiscard]] bool isUnit() const {
        const std::string_view word = here().in(m_text);
        return here().kind == TokenKind::Word &&
               (findUnit(word) != nullptr ||
                (m_tokens[m_at + 1].kind != TokenKind::Operator && findFields(word).fields.empty()));
    }

    /// One value, or a range.
    tl::expected<void, FilterError> member(WrittenCondition& written, bool mayBeRange) {
        auto from = constant();
        if (!from) {
            return Failure(from.error());
        }
        auto to = mayBeRange && take(TokenKind::Range) ? constant() : from;
        if (!to) {
            return Failure(to.error());
        }
        written.constants.emplace_back(std::move(*from), std::move(*to));
        return {};
    }

    /// A range, or members in braces.
    tl::expected<void, FilterError> members(WrittenCondition& written) {
        if (!take(TokenKind::OpenSet)) {
            if (here().kind != TokenKind::Word && here().kind != TokenKind::Quoted) {
                return Failure(unexpected("a set such as {1, 2}, or a range such as 1..5"));
            }
            return member(written, true);
        }
        do {
            if (auto taken = member(written, true); !taken) {
                return taken;
            }
        } while (take(TokenKind::Comma));
        return take(TokenKind::CloseSet) ? tl::expected<void, FilterError>()
                                         : Failure(unexpected("`,` or `}`"));
    }

    /// Puts conditions on items under AnyItem: those joined by && are about one and the same item, and so is
    /// an || among them; an && in parentheses, or a negation, is about an item of its own.
    std::uint32_t withItems(std::uint32_t index) {
        Program::Node node = m_program.nodes[index];
        const bool isAnd = node.join == Join::And;
        if (node.isOfItems && !isAnd) {
            return m_program.add({Join::AnyItem, 0, {index}});
        }
        Program::Node gathered{Join::And, 0, {}, true};
        std::vector<std::uint32_t> children;
        for (const std::uint32_t child : node.children) {
            const Program::Node& below = m_program.nodes[child];
            if (isAnd && ((below.isOfItems && below.join != Join::And) || below.isMixed)) {
                gathered.isOfItems = gathered.isOfItems && below.isOfItems;
                gathered.children.push_back(child);
            } else {
                children.push_back(withItems(child));
            }
        }
        if (!gathered.children.empty()) {
            const std::uint32_t all = m_program.add(std::move(gathered));
            children.push_back(m_program.add({Join::AnyItem, 0, {all}}));
        }
        m_program.nodes[index].children = std::move(children);
        return index;
    }

    std::string_view m_text;
    std::vector<Token> m_tokens;
    std::size_t m_at = 0;
    Program m_program;
};

} // namespace

tl::expected<Program, FilterError> parsed(std::string_view text) {
    return Parser(text).run();
}

} // namespace posewire::filter
