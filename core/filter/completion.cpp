// SPDX-License-Identifier: MIT
#include "core/filter/completion.h"

#include "core/field/field.h"
#include "core/filter/lexer.h"
#include "core/filter/signal_tree.h"
#include "core/model/body/segments.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::filter {

using namespace field;
namespace {

enum class Next : std::uint8_t { Field, Item, Operator, Value, SetMember, AfterMember, Join };

struct Context {
    Next next = Next::Field;
    std::string_view field; ///< the newest
    bool hasItem = false;   ///< that it is of
    bool isSet = false;     ///< after `in`
    bool isNumber = false;  ///< the newest value, and no unit came after it
};

void advance(Context& context, const Token& token, std::string_view text) {
    const bool isValue = token.kind == TokenKind::Word || token.kind == TokenKind::Quoted;
    context.isNumber = token.kind == TokenKind::Word && numberOf(token.in(text)).has_value();
    if (token.kind == TokenKind::And || token.kind == TokenKind::Or) {
        context.next = Next::Field;
    } else if (context.next == Next::Field && token.kind == TokenKind::Word) {
        context.next = Next::Operator;
        context.field = token.in(text);
        context.hasItem = false;
    } else if (context.next == Next::Operator && token.in(text) == kOf && !context.hasItem) {
        context.next = Next::Item;
    } else if (context.next == Next::Item && isValue) {
        context.next = Next::Operator;
        context.hasItem = true;
    } else if (token.kind == TokenKind::Operator) {
        context.next = Next::Value;
        context.isSet = token.op == Operator::In;
    } else if (token.kind == TokenKind::OpenSet || token.kind == TokenKind::Comma) {
        context.next = Next::SetMember;
    } else if (token.kind == TokenKind::Range) {
        context.next = context.next == Next::AfterMember ? Next::SetMember : Next::Value;
        context.isSet = false;
    } else if (isValue) {
        const bool isMember = context.next == Next::SetMember || context.next == Next::AfterMember;
        context.next = isMember ? Next::AfterMember : Next::Join;
    } else if (token.kind == TokenKind::CloseSet || token.kind == TokenKind::Close) {
        context.next = Next::Join;
    }
}

/// In a signal, Operator is all that may follow a value.
void advanceInSignal(Context& context, const Token& token, std::string_view text) {
    const bool isWord = token.kind == TokenKind::Word || token.kind == TokenKind::Quoted;
    const bool isNew = context.next == Next::Field || context.next == Next::Item;
    context.isNumber = context.next == Next::Field && isWord && numberOf(token.in(text)).has_value();
    if (isWord && context.next == Next::Operator && token.in(text) == kOf) {
        context.next = Next::Item;
    } else if (isWord) {
        context.field = context.next == Next::Field ? token.in(text) : std::string_view();
        context.next = Next::Operator;
    } else if (token.kind == TokenKind::Close && !isNew) {
        context.field = {};
    } else {
        context.next = Next::Field;
    }
}

/// Whether a token may be in the middle of being written.
bool isOpenEnded(const Token& token, std::string_view text) {
    const char last = text[token.end() - 1];
    return token.kind == TokenKind::Word || token.kind == TokenKind::Quoted ||
           token.kind == TokenKind::Unfinished || token.kind == TokenKind::Unknown ||
           (last >= 'a' && last <= 'z');
}

/// Collects what fits the word that is being written.
class Collector {
public:
    Collector(Token replaced, std::string_view written)
        : m_replaced(replaced), m_written(wire::lowered(written)) {
        if (m_written.starts_with('"')) {
            m_written.erase(0, 1);
        }
    }

    void offer(std::string_view text, std::string about) {
        const std::string known = wire::lowered(text);
        const bool begins = known.starts_with(m_written) || known.starts_with('"' + m_written);
        const bool isWithin =
            m_written.size() > 1 && (known.find(m_written) != std::string::npos ||
                                     wire::lowered(about).find(m_written) != std::string::npos);
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
    return field.types.empty() ? about : about + " (" + typesText(field) + ')';
}

std::string aboutSent(const FieldInfo& field) {
    const std::string unit = field.unitSent.empty() ? field.unit : field.unitSent;
    return "as sent, " + unit + ": " + field.text;
}

void offerField(const std::string& name, const FieldInfo& field, const std::string& about, Collector& into) {
    into.offer(name, about);
    const std::string base = wire::lowered(name);
    if (field.kind == Kind::Vector && (into.written() == base || into.written().starts_with(base + '.'))) {
        for (const std::string_view component : componentNames(field.components)) {
            into.offer(name + '.' + std::string(component), about);
        }
    }
}

bool isText(const FieldInfo& field) {
    return field.kind == Kind::Text || field.kind == Kind::Transport;
}

/// All fields, those of a type if the word begins with one; of a signal only numbers.
void offerFields(Collector& into, bool isOfSignal = false) {
    std::string_view asked = into.written();
    const auto type = takeType(asked);
    const std::string prefix = into.written().substr(0, into.written().size() - asked.size());
    const bool asksSent = asked.starts_with(kAsSent);
    const std::string_view unprefixed = asked.substr(asksSent ? kAsSent.size() : 0);
    const bool isQualified = unprefixed.find('.') != std::string_view::npos;
    std::vector<std::string> seen;
    for (const FieldInfo& field : fieldTable()) {
        const std::string name = isQualified && unprefixed.starts_with(wire::lowered(field.qualifier) + '.')
                                     ? field.qualifier + '.' + field.name
                                     : askedName(field);
        const bool isElsewhere = type && std::ranges::find(field.types, *type) == field.types.end();
        if (std::ranges::find(seen, name) != seen.end() || isElsewhere || (isOfSignal && isText(field))) {
            continue;
        }
        seen.push_back(name);
        offerField(prefix + name, field, aboutField(field), into);
        if (field.isConverted() && !asked.empty()) {
            offerField(prefix + std::string(kAsSent) + name, field, aboutSent(field), into);
        }
    }
    if (isOfSignal) {
        for (const SignalFunction& function : signalFunctions()) {
            into.offer(std::string(function.name) + "(", std::string(function.about));
        }
        for (const SignalFigure& figure : signalFigures()) {
            const std::string about = std::string(figure.unit) + ": " + std::string(figure.about);
            into.offer((type ? prefix : "2.") + std::string(figure.name), about);
        }
        return;
    }
    into.offer("tag", "text: names of the metadata tags (12)");
    for (const std::string_view tag : {"name", "xmid", "color"}) {
        into.offer("tag." + std::string(tag), "text: value of the metadata tag (12)");
    }
}

void offerNames(Kind kind, Collector& into) {
    for (const std::string_view name : namesOf(kind)) {
        into.offer(name,
                   std::string(kind == Kind::Segment ? model::segmentTitle(name) : kindWords(kind).name));
    }
}

void offerItems(std::string_view field, Collector& into) {
    for (const Kind kind : itemKinds(findFields(field))) {
        offerNames(kind, into);
    }
}

void offerOf(std::string_view field, Collector& into) {
    if (!itemKinds(findFields(field)).empty()) {
        into.offer(kOf, "the item, such as LeftHand");
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

/// After a number.
void offerUnits(std::string_view asked, Collector& into) {
    const FieldMatch match = findFields(asked);
    const auto measured = std::ranges::find_if(
        match.fields, [](const FieldInfo* field) { return field->dimension != Dimension::None; });
    if (measured != match.fields.end() && !match.isAsSent) {
        for (const UnitInfo& unit : unitsOf((*measured)->dimension)) {
            into.offer(unit.symbol, std::string(unit.text));
        }
    }
}

void offerValues(std::string_view asked, Collector& into) {
    const FieldMatch match = findFields(asked);
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
        for (const wire::TypeInfo& info : wire::typeTable()) {
            into.offer(wire::typeDigits(info.type), std::string(info.name));
        }
    }
    offerNames(field.kind, into);
    if (field.kind == Kind::Vector && !match.hasComponent) {
        into.offer("NaN", "one of its components is not a number");
    }
    for (const std::string_view word : field.words) {
        into.offer(word, std::string(kindWords(field.kind).name));
    }
}

/// A number as a constant; empty if it is none.
std::string numeral(std::string_view value) {
    if (value == "nan" || value == "-nan" || value == "NaN") {
        return "NaN";
    }
    return numberOf(value) ? std::string(value) : std::string();
}

std::string compared(std::string_view field, const std::string& constant) {
    return constant.empty() ? std::string() : std::string(field) + " == " + constant;
}

/// Each component of a vector, as the field tree writes it: "1  2  3".
std::string vectorExpression(std::string_view name, const FieldInfo& field, std::string_view value) {
    std::string all;
    for (const std::string_view component : componentNames(field.components)) {
        value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
        const std::string number = numeral(value.substr(0, value.find(' ')));
        value.remove_prefix(std::min(value.find(' '), value.size()));
        if (number.empty()) {
            return {};
        }
        all.append(all.empty() ? "" : " && ").append(name).append(".");
        all.append(component).append(" == ").append(number);
    }
    return all;
}

std::string segmentExpression(std::string_view name, std::string_view value) {
    constexpr double kBodySegments = 23;
    const auto id = numberOf(value);
    if (id && *id >= 1 && *id <= kBodySegments) {
        return compared(name, std::string(namesOf(Kind::Segment)[static_cast<std::size_t>(*id) - 1]));
    }
    return compared(name, numberNamed(Kind::Segment, value) ? std::string(value) : numeral(value));
}

const FieldInfo* findField(std::string_view qualifier, std::string_view name) {
    const auto found = std::ranges::find_if(fieldTable(), [&](const FieldInfo& field) {
        return field.name == name && field.qualifier == qualifier;
    });
    return found != fieldTable().end() ? &*found : nullptr;
}

/// Type 05 numbers the segments in an order of its own.
bool isUnityOrdered(const wire::FieldTree& tree) {
    return std::ranges::any_of(
        tree.nodes, [](const wire::FieldNode& node) { return node.name == "id" && node.value == "MXTP05"; });
}

bool isNumeral(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string expressionOf(const FieldInfo& field, bool hasComponent, std::string_view name,
                         std::string_view value) {
    switch (field.kind) {
    case Kind::Text:
        return compared(name, quoted(value));
    case Kind::Vector:
        return hasComponent ? compared(name, numeral(value)) : vectorExpression(name, field, value);
    case Kind::Flag:
        return value == "true" || value == "1" ? std::string(name) : '!' + std::string(name);
    case Kind::Type:
        return compared(name, numeral(value.substr(0, value.find(' '))));
    case Kind::Segment:
        return segmentExpression(name, value);
    case Kind::Transport:
        return compared(name, std::string(value));
    case Kind::Time:
        return compared(name, numberOf(value) ? std::string(value) : quoted(value));
    case Kind::Number:
    case Kind::Point:
    case Kind::Joint:
        break;
    }
    return compared(name, numeral(value));
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
    case Next::Item:
        offerItems(context.field, into);
        break;
    case Next::Operator:
        offerOperators(context.field, into);
        if (!context.hasItem) {
            offerOf(context.field, into);
        }
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
        if (context.isNumber) {
            offerUnits(context.field, into);
        }
        into.offer(",", "another one");
        into.offer("}", "ends the set");
        break;
    case Next::Join:
        if (context.isNumber) {
            offerUnits(context.field, into);
        }
        into.offer("&&", "and");
        into.offer("||", "or");
        break;
    }
    return into.take();
}

std::vector<Completion> signalCompletions(std::string_view text, std::size_t cursor) {
    cursor = std::min(cursor, text.size());
    Context context;
    Token replaced{TokenKind::End, cursor, 0};
    for (const Token& token : signalTokens(text)) {
        if (token.kind == TokenKind::End || token.offset >= cursor) {
            break;
        }
        if (token.end() >= cursor && isOpenEnded(token, text) && token.kind != TokenKind::Unknown) {
            replaced = token;
            break;
        }
        if (context.next == Next::Operator && token.in(text) == kWhere) {
            auto all = completions(text.substr(token.end()), cursor - token.end());
            std::ranges::for_each(all, [&](Completion& one) { one.offset += token.end(); });
            return all;
        }
        advanceInSignal(context, token, text);
    }
    Collector into(replaced, text.substr(replaced.offset, cursor - replaced.offset));
    if (context.next == Next::Field) {
        offerFields(into, true);
    } else if (context.next == Next::Item) {
        offerItems(context.field, into);
    } else {
        for (const UnitInfo& unit : context.isNumber ? unitTable() : std::span<const UnitInfo>()) {
            into.offer(unit.symbol, std::string(unit.text));
        }
        offerOf(context.field, into);
        for (const std::string_view sign : {"+", "-", "*", "/"}) {
            into.offer(sign, "arithmetic");
        }
        into.offer(kWhere, "only of packets that a filter matches");
    }
    return into.take();
}

std::string expressionFor(std::string_view name, std::string_view value) {
    const FieldMatch match = findFields(name);
    if (match.isTag) {
        return compared(name, quoted(value));
    }
    // Where fields of several kinds have the name, a number is rarely meant as text.
    for (const bool mayBeText : {false, true}) {
        for (const FieldInfo* field : match.fields) {
            const bool isText = field->kind == Kind::Text;
            const std::string text =
                isText == mayBeText ? expressionOf(*field, match.hasComponent, name, value) : std::string();
            if (!text.empty()) {
                return text;
            }
        }
    }
    return {};
}

std::string expressionFor(const wire::FieldTree& tree, std::int32_t index) {
    if (index < 0 || static_cast<std::size_t>(index) >= tree.nodes.size()) {
        return {};
    }
    const auto at = [&](std::int32_t place) -> const wire::FieldNode* {
        return place >= 0 ? &tree.nodes[static_cast<std::size_t>(place)] : nullptr;
    };
    const wire::FieldNode& node = *at(index);
    const wire::FieldNode* parent = at(node.parent);
    constexpr std::string_view kCount = " count";
    if (node.name.ends_with(kCount)) {
        return expressionFor(node.name.substr(0, node.name.size() - kCount.size()), node.value);
    }
    if (isNumeral(node.name) && parent != nullptr) {
        const auto first = static_cast<std::size_t>(index) + 1;
        return first < tree.nodes.size() && tree.nodes[first].parent == index ? expressionFor(tree, index + 1)
                                                                              : std::string();
    }
    // An item is in its list; the header's fields and the message's own are at the top.
    const bool isInItem = parent != nullptr && isNumeral(parent->name);
    const wire::FieldNode* group = isInItem ? at(parent->parent) : parent;
    const std::string_view qualifier = group != nullptr ? std::string_view(group->name) : std::string_view();
    const FieldInfo* field = findField(qualifier, node.name);
    if (field == nullptr) {
        return {};
    }
    const std::string name =
        (field->isConverted() ? std::string(kAsSent) : std::string()) + askedName(*field);
    const bool isList = field->isOfItems() && node.value.empty() && field->kind == Kind::Number;
    const FieldInfo* segment = isInItem && node.name == "id" ? findField(qualifier, "segment") : nullptr;
    if (segment != nullptr && qualifier != "points" && !isUnityOrdered(tree)) {
        return expressionOf(*segment, false, askedName(*segment), node.value);
    }
    return isList ? field->name : expressionOf(*field, false, name, node.value);
}

} // namespace posewire::filter
