// SPDX-License-Identifier: MIT
#include "core/filter/expression_for.h"

#include "core/filter/field_lookup.h"
#include "core/filter/lexer.h"

#include <algorithm>

namespace posewire::filter {
namespace {

/// A number as a constant; empty where it is none.
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
    for (std::size_t i = 0; i < field.components; ++i) {
        const std::size_t start = std::min(value.find_first_not_of(' '), value.size());
        value.remove_prefix(start);
        const std::string number = numeral(value.substr(0, value.find(' ')));
        value.remove_prefix(std::min(value.find(' '), value.size()));
        if (number.empty()) {
            return {};
        }
        all.append(i == 0 ? "" : " && ").append(name).append(".");
        all.append(componentName(field.components, i)).append(" == ").append(number);
    }
    return all;
}

std::string segmentExpression(std::string_view name, std::string_view value) {
    constexpr double kBodySegments = 23;
    const auto id = numberOf(value);
    if (id && *id >= 1 && *id <= kBodySegments) {
        return compared(name, std::string(segmentNames()[static_cast<std::size_t>(*id) - 1]));
    }
    return compared(name, segmentNumber(value) ? std::string(value) : numeral(value));
}

std::string_view firstWord(std::string_view text) {
    return text.substr(0, text.find(' '));
}

const FieldInfo* findField(std::string_view qualifier, std::string_view name) {
    const auto found = std::find_if(fieldTable().begin(), fieldTable().end(), [&](const FieldInfo& field) {
        return field.name == name && field.qualifier == qualifier;
    });
    return found != fieldTable().end() ? &*found : nullptr;
}

/// Type 05 numbers the segments in an order of its own.
bool isUnityOrdered(const wire::FieldTree& tree) {
    return std::any_of(tree.nodes.begin(), tree.nodes.end(), [](const wire::FieldNode& node) {
        return node.name == "id" && node.value == "MXTP05";
    });
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
        return compared(name, numeral(firstWord(value)));
    case Kind::Segment:
        return segmentExpression(name, value);
    case Kind::Transport:
        return compared(name, std::string(value));
    case Kind::Time:
        return compared(name, numberOf(value) ? std::string(value) : quoted(value));
    case Kind::Number:
        break;
    }
    return compared(name, numeral(value));
}

} // namespace

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
    // An item stands in its list; the header's fields and the message's own stand at the top.
    const bool isInItem = parent != nullptr && isNumeral(parent->name);
    const wire::FieldNode* group = isInItem ? at(parent->parent) : parent;
    const std::string_view qualifier = group != nullptr ? std::string_view(group->name) : std::string_view();
    const FieldInfo* field = findField(qualifier, node.name);
    if (field == nullptr) {
        return {};
    }
    const bool isList = field->isOfItems() && node.value.empty() && field->kind == Kind::Number;
    const FieldInfo* segment = isInItem && node.name == "id" ? findField(qualifier, "segment") : nullptr;
    if (segment != nullptr && qualifier != "points" && !isUnityOrdered(tree)) {
        return expressionOf(*segment, false, askedName(*segment), node.value);
    }
    return isList ? field->name : expressionOf(*field, false, askedName(*field), node.value);
}

} // namespace posewire::filter
