// SPDX-License-Identifier: MIT
#include "core/filter/filter.h"

#include "core/filter/program.h"
#include "core/wire/text.h"

#include <re2/re2.h>

#include <algorithm>
#include <cmath>

namespace posewire::filter {
namespace {

/// `part` is in lower case.
bool containsAnyCase(std::string_view text, std::string_view part) {
    return std::search(text.begin(), text.end(), part.begin(), part.end(),
                       [](char a, char b) { return wire::lower(a) == b; }) != text.end() ||
           part.empty();
}

} // namespace

bool Test::holds(const Value& value) const {
    return op == Operator::IsThere || (comparesText ? holdsText(value.text) : holdsNumber(value.number));
}

bool Test::holdsNumber(double number) const {
    if (comparesNan) {
        return std::isnan(number) == (op == Operator::Equal);
    }
    const double constant = ranges.front().first;
    switch (op) {
    case Operator::Less:
        return number < constant;
    case Operator::LessEqual:
        return number <= constant;
    case Operator::Greater:
        return number > constant;
    case Operator::GreaterEqual:
        return number >= constant;
    case Operator::NotEqual:
        return number < constant || number > constant;
    default:
        return std::ranges::any_of(
            ranges, [&](const Range& range) { return number >= range.first && number <= range.second; });
    }
}

std::string Test::setPattern(const std::string& text) {
    constexpr std::int64_t kMostMemory = 1 << 20;
    re2::RE2::Options options;
    options.set_log_errors(false);
    options.set_max_mem(kMostMemory);
    pattern = std::make_shared<const re2::RE2>(text, options);
    return pattern->ok() ? std::string() : pattern->error();
}

bool Test::holdsText(std::string_view text) const {
    switch (op) {
    case Operator::NotEqual:
        return text != texts.front();
    case Operator::Contains:
        return containsAnyCase(text, texts.front());
    case Operator::Matches:
        return re2::RE2::PartialMatch(re2::StringPiece(text.data(), text.size()), *pattern);
    default:
        return std::ranges::find(texts, text) != texts.end();
    }
}

bool Condition::holds(Subject& subject) const {
    const wire::Header* header = type ? subject.header() : nullptr;
    if (type && (header == nullptr || header->type() != *type)) {
        return false;
    }
    if (isTag) {
        return holdsForTags(subject.candidate.datagram);
    }
    std::optional<Value> value;
    for (std::size_t index = 0; (value = readPacket(subject, index)); ++index) {
        if (test.holds(*value)) {
            return true;
        }
    }
    return false;
}

bool Condition::holdsFor(const ItemAt& at) const {
    const Place& place = places[at.shape][at.list];
    if (place.read == nullptr || (item && !item->spots[at.shape][at.list].is(at.datagram, at.item))) {
        return false;
    }
    const auto unit = place.length ? at.positionUnit.value_or(*place.length) : model::LengthUnit::Metre;
    const Test& suited = unit == model::LengthUnit::Centimetre   ? testInCentimetres
                         : unit == model::LengthUnit::Millimetre ? testInMillimetres
                                                                 : test;
    for (std::size_t i = firstComponent; i < firstComponent + components; ++i) {
        if (suited.holds(place.read(at.datagram, at.item, i))) {
            return true;
        }
    }
    return false;
}

bool Condition::holdsForTags(const wire::Datagram* datagram) const {
    const auto* metaData = datagram != nullptr ? std::get_if<wire::MetaData>(&datagram->body) : nullptr;
    if (metaData == nullptr) {
        return false;
    }
    for (const wire::Tag& sent : wire::parseTags(metaData->text).tags) {
        if ((tag.empty() || sent.name == tag) && test.holds({0, tag.empty() ? sent.name : sent.value})) {
            return true;
        }
    }
    return false;
}

tl::expected<Filter, FilterError> Filter::compile(std::string_view text) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        return Filter();
    }
    if (text.size() > kLongestText) {
        return tl::unexpected(
            FilterError{kLongestText, text.size() - kLongestText,
                        "A filter has at most " + std::to_string(kLongestText) + " bytes."});
    }
    auto program = parsed(text);
    if (!program) {
        return tl::unexpected(program.error());
    }
    Filter filter;
    filter.m_program = std::make_shared<const Program>(std::move(*program));
    return filter;
}

bool Filter::matches(const Candidate& candidate) const {
    if (m_program == nullptr) {
        return true;
    }
    Subject subject(candidate);
    return m_program->holds(subject, m_program->root);
}

bool Filter::comparesLengths() const {
    return m_program != nullptr && std::ranges::any_of(m_program->conditions, &Condition::comparesLengths);
}

bool Filter::comparesJudged() const {
    return m_program != nullptr && std::ranges::any_of(m_program->conditions, &Condition::comparesJudged);
}

bool Program::holds(Subject& subject, std::uint32_t index) const {
    const Node& node = nodes[index];
    const auto isTrue = [&](std::uint32_t child) { return holds(subject, child); };
    switch (node.join) {
    case Join::Condition:
        return conditions[node.condition].holds(subject);
    case Join::And:
        return std::ranges::all_of(node.children, isTrue);
    case Join::Or:
        return std::ranges::any_of(node.children, isTrue);
    case Join::Not:
        return !isTrue(node.children.front());
    case Join::AnyItem:
        return holdsForAnyItem(subject, node.children.front());
    }
    return false;
}

bool Program::holdsForAnyItem(Subject& subject, std::uint32_t node) const {
    if (!nodes[node].isOfItems && holdsForItem(subject, nullptr, node)) {
        return true;
    }
    const wire::Datagram* datagram = subject.candidate.datagram;
    if (datagram == nullptr) {
        return false;
    }
    const std::size_t shape = shapeOf(*datagram);
    for (std::size_t list = 0; list < kLists; ++list) {
        const std::size_t count = itemCount(*datagram, shape, list);
        for (std::size_t item = 0; item < count; ++item) {
            const ItemAt at{*datagram, shape, list, item, subject.candidate.positionUnit};
            if (holdsForItem(subject, &at, node)) {
                return true;
            }
        }
    }
    return false;
}

bool Program::holdsForItem(Subject& subject, const ItemAt* at, std::uint32_t index) const {
    const Node& node = nodes[index];
    const auto isTrue = [&](std::uint32_t child) { return holdsForItem(subject, at, child); };
    switch (node.join) {
    case Join::Condition: {
        const Condition& condition = conditions[node.condition];
        if (!condition.isOfItems()) {
            return condition.holds(subject);
        }
        return at != nullptr && condition.holdsFor(*at);
    }
    case Join::And:
        return std::ranges::all_of(node.children, isTrue);
    default:
        return std::ranges::any_of(node.children, isTrue);
    }
}

} // namespace posewire::filter
