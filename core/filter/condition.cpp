// SPDX-License-Identifier: MIT
#include "core/filter/condition.h"

#include <re2/re2.h>

#include <algorithm>
#include <cmath>

namespace posewire::filter {
namespace {

char lower(char character) {
    return character >= 'A' && character <= 'Z' ? static_cast<char>(character - 'A' + 'a') : character;
}

/// `part` is in lower case.
bool containsAnyCase(std::string_view text, std::string_view part) {
    return std::search(text.begin(), text.end(), part.begin(), part.end(),
                       [](char a, char b) { return lower(a) == b; }) != text.end() ||
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
        return std::any_of(ranges.begin(), ranges.end(), [&](const Range& range) {
            return number >= range.first && number <= range.second;
        });
    }
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
        return std::find(texts.begin(), texts.end(), text) != texts.end();
    }
}

bool Condition::holds(Subject& subject) const {
    if (isTag) {
        return holdsForTags(subject.candidate.datagram);
    }
    Value value;
    for (std::size_t index = 0; readPacket(subject, index, value); ++index) {
        if (test.holds(value)) {
            return true;
        }
    }
    return false;
}

bool Condition::holdsFor(const wire::Datagram& datagram, std::size_t shape, std::size_t list,
                         std::size_t item) const {
    const ReadItem read = places[shape][list];
    if (read == nullptr) {
        return false;
    }
    for (std::size_t i = firstComponent; i < firstComponent + components; ++i) {
        if (test.holds(read(datagram, item, i))) {
            return true;
        }
    }
    return false;
}

bool Condition::holdsForTags(const wire::Datagram* datagram) const {
    const auto* metaData = datagram != nullptr ? std::get_if<wire::MetaData>(&datagram->body) : nullptr;
    std::string_view text = metaData != nullptr ? std::string_view(metaData->text) : std::string_view();
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        const std::size_t colon = line.find(':');
        const bool isAsked = colon != std::string_view::npos && (tag.empty() || line.substr(0, colon) == tag);
        if (isAsked && test.holds({0, tag.empty() ? line.substr(0, colon) : line.substr(colon + 1)})) {
            return true;
        }
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return false;
}

} // namespace posewire::filter
