// SPDX-License-Identifier: MIT
#include "core/filter/completion.h"

#include "core/filter/field_lookup.h"
#include "core/filter/lexer.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::filter {
namespace {

/// What a text goes on with.
enum class Next : std::uint8_t { Field, Operator, Value, SetMember, AfterMember, Join };

struct Context {
    Next next = Next::Field;
    std::string_view field; ///< the newest
    bool isSet = false;     ///< after `in`
};

bool isComparison(TokenKind kind) {
    return kind >= TokenKind::Equal && kind <= TokenKind::Matches;
}

void advance(Context& context, const Token& token, std::string_view text) {
    const bool isValue = token.kind == TokenKind::Word || token.kind == TokenKind::Quoted;
    if (token.kind == TokenKind::And || token.kind == TokenKind::Or) {
        context.next = Next::Field;
    } else if (context.next == Next::Field && token.kind == TokenKind::Word) {
        context.next = Next::Operator;
        context.field = token.in(text);
    } else if (isComparison(token.kind)) {
        context.next = Next::Value;
        context.isSet = token.kind == TokenKind::In;
    } else if (token.kind == TokenKind::OpenSet || token.kind == TokenKind::Comma) {
        context.next = Next::SetMember;
    } else if (token.kind == TokenKind::Range) {
        context.next = context.next == Next::AfterMember ? Next::SetMember : Next::Value;
        context.isSet = false;
    } else if (isValue) {
        context.next = context.next == Next::SetMember ? Next::AfterMember : Next::Join;
    } else if (token.kind == TokenKind::CloseSet || token.kind == TokenKind::Close) {
        context.next = Next::Join;
    }
}

/// Whether a token may be in the middle of being written.
bool isOpenEnded(const Token& token, std::string_view text) {
    const char last = text[token.end() - 1];
    return token.kind == TokenKind::Word || token.kind == TokenKind::Quoted ||
           token.kind == TokenKind::Unfinished || token.kind == TokenKind::Unknown ||
           (last >= 'a' && last <= 'z');
}

char lower(char character) {
    return character >= 'A' && character <= 'Z' ? static_cast<char>(character - 'A' + 'a') : character;
}

std::string lowered(std::string_view text) {
    std::string all(text);
    std::transform(all.begin(), all.end(), all.begin(), lower);
    return all;
}

/// Collects what fits the word that is being written.
class Collector {
public:
    Collector(Token replaced, std::string_view written) : m_replaced(replaced), m_written(lowered(written)) {
        if (m_written.starts_with('"')) {
            m_written.erase(0, 1);
        }
    }

    void offer(std::string_view text, std::string about) {
        const std::string known = lowered(text);
        const bool begins = known.starts_with(m_written) || known.starts_with('"' + m_written);
        const bool isWithin = m_written.size() > 1 && (known.find(m_written) != std::string::npos ||
                                                       lowered(about).find(m_written) != std::string::npos);
        if (begins || isWithin) {
            (begins ? m_first : m_then)
                .push_back({m_replaced.offset, m_replaced.length, std::string(text), std::move(about)});
        }
    }

    [[nodiscard]] const std::string& written() const { return m_written; }

    std::vector<Completion> take() {
        std::move(m_then.begin(), m_then.end(), std::back_inserter(m_first));
        return std::move(m_first);
    }

private:
    Token m_replaced;
    std::string m_written;
    std::vector<Completion> m_first;
    std::vector<Completion> m_then;
};

std::string aboutField(const FieldInfo& field) {
    std::string about(kindWords(field.kind).name);
    about.append(field.unit.empty() ? "" : ", ").append(field.unit).append(": ").append(field.text);
    for (std::size_t i = 0; i < field.types.size(); ++i) {
        about.append(i == 0 ? " (" : " ").append(wire::typeDigits(field.types[i]));
    }
    return about + (field.types.empty() ? "" : ")");
}

void offerComponents(const FieldInfo& field, const std::string& name, Collector& into) {
    for (std::size_t i = 0; i < field.components; ++i) {
        into.offer(name + '.' + std::string(componentName(field.components, i)), aboutField(field));
    }
}

void offerFields(Collector& into) {
    const bool isQualified = into.written().find('.') != std::string::npos;
    std::vector<std::string> seen;
    for (const FieldInfo& field : fieldTable()) {
        const std::string name = isQualified && into.written().starts_with(lowered(field.qualifier) + '.')
                                     ? field.qualifier + '.' + field.name
                                     : askedName(field);
        if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
            continue;
        }
        seen.push_back(name);
        into.offer(name, aboutField(field));
        const std::string base = lowered(name);
        if (field.kind == Kind::Vector &&
            (into.written() == base || into.written().starts_with(base + '.'))) {
            offerComponents(field, name, into);
        }
    }
    into.offer("tag", "text: names of the metadata tags (12)");
    for (const std::string_view tag : {"name", "xmid", "color"}) {
        into.offer("tag." + std::string(tag), "text: value of the metadata tag (12)");
    }
}

void offerOperators(std::string_view name, Collector& into) {
    const FieldMatch match = findFields(name);
    const FieldInfo* field = match.fields.empty() ? nullptr : match.fields.front();
    const bool isVector = field != nullptr && field->kind == Kind::Vector && !match.hasComponent;
    const bool isText = match.isTag || (field != nullptr && field->kind == Kind::Text);
    const bool isOrdered = field == nullptr || field->kind == Kind::Number || field->kind == Kind::Vector ||
                           field->kind == Kind::Time || field->kind == Kind::Type;
    into.offer("==", "is");
    into.offer("!=", "is there and is not");
    if (isOrdered && !isText && !isVector) {
        into.offer("<", "is less than");
        into.offer("<=", "is at most");
        into.offer(">", "is more than");
        into.offer(">=", "is at least");
    }
    if (isText) {
        into.offer("contains", "contains this text, in any case");
        into.offer("matches", "matches this regular expression");
    }
    if (!isVector) {
        into.offer("in {", "is one of a set");
    }
    into.offer("&&", "and");
    into.offer("||", "or");
}

void offerTypes(Collector& into) {
    for (const wire::TypeInfo& info : wire::typeTable()) {
        into.offer(wire::typeDigits(info.type), std::string(info.name));
    }
}

void offerValues(std::string_view name, Collector& into) {
    const FieldMatch match = findFields(name);
    if (match.isTag && match.tag.empty()) {
        for (const std::string_view tag : {"\"name\"", "\"xmid\"", "\"color\""}) {
            into.offer(tag, "metadata tag");
        }
    }
    if (match.fields.empty()) {
        return;
    }
    const FieldInfo& field = *match.fields.front();
    if (field.kind == Kind::Type) {
        offerTypes(into);
    }
    if (field.kind == Kind::Segment) {
        for (std::size_t i = 0; i < segmentNames().size(); ++i) {
            into.offer(segmentNames()[i], "segment");
        }
    }
    for (const std::string_view word : field.words) {
        into.offer(word, std::string(kindWords(field.kind).name));
    }
}

} // namespace

std::vector<Completion> completions(std::string_view text, std::size_t cursor) {
    cursor = std::min(cursor, text.size());
    Context context;
    Token replaced{TokenKind::End, cursor, 0};
    for (const Token& token : tokens(text)) {
        if (token.kind == TokenKind::End || token.offset >= cursor) {
            break;
        }
        if (token.end() >= cursor && isOpenEnded(token, text)) {
            replaced = token;
            break;
        }
        advance(context, token, text);
    }
    Collector into(replaced, text.substr(replaced.offset, cursor - replaced.offset));
    switch (context.next) {
    case Next::Field:
        offerFields(into);
        break;
    case Next::Operator:
        offerOperators(context.field, into);
        break;
    case Next::Value:
        if (context.isSet) {
            into.offer("{", "begins a set such as {1, 2}");
        }
        [[fallthrough]];
    case Next::SetMember:
        offerValues(context.field, into);
        break;
    case Next::AfterMember:
        into.offer(",", "another one");
        into.offer("}", "ends the set");
        break;
    case Next::Join:
        into.offer("&&", "and");
        into.offer("||", "or");
        break;
    }
    return into.take();
}

} // namespace posewire::filter
