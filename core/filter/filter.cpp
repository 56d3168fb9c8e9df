// SPDX-License-Identifier: MIT
#include "core/filter/filter.h"

#include "core/filter/program.h"

#include <algorithm>

namespace posewire::filter {

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

bool Filter::needsDatagram() const {
    return m_program != nullptr && m_program->needsDatagram;
}

bool Program::holds(Subject& subject, std::uint32_t index) const {
    const Node& node = nodes[index];
    const auto isTrue = [&](std::uint32_t child) { return holds(subject, child); };
    switch (node.join) {
    case Join::Condition:
        return conditions[node.condition].holds(subject);
    case Join::And:
        return std::all_of(node.children.begin(), node.children.end(), isTrue);
    case Join::Or:
        return std::any_of(node.children.begin(), node.children.end(), isTrue);
    case Join::Not:
        return !isTrue(node.children.front());
    case Join::AnyItem:
        return holdsForAnyItem(subject.candidate.datagram, node.children.front());
    }
    return false;
}

bool Program::holdsForAnyItem(const wire::Datagram* datagram, std::uint32_t node) const {
    if (datagram == nullptr) {
        return false;
    }
    const std::size_t shape = shapeOf(*datagram);
    for (std::size_t list = 0; list < kLists; ++list) {
        const std::size_t count = itemCount(*datagram, shape, list);
        for (std::size_t item = 0; item < count; ++item) {
            if (holdsForItem({*datagram, shape, list, item}, node)) {
                return true;
            }
        }
    }
    return false;
}

bool Program::holdsForItem(const ItemAt& at, std::uint32_t index) const {
    const Node& node = nodes[index];
    const auto isTrue = [&](std::uint32_t child) { return holdsForItem(at, child); };
    switch (node.join) {
    case Join::Condition:
        return conditions[node.condition].holdsFor(at.datagram, at.shape, at.list, at.item);
    case Join::And:
        return std::all_of(node.children.begin(), node.children.end(), isTrue);
    default:
        return std::any_of(node.children.begin(), node.children.end(), isTrue);
    }
}

} // namespace posewire::filter
