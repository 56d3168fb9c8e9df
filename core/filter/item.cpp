// SPDX-License-Identifier: MIT
#include "core/filter/program.h"

#include <algorithm>

namespace posewire::filter {
namespace {

/// The kinds that tell the items of a list apart, best first.
constexpr std::array kTelling{std::pair{Kind::Joint, "joint"}, std::pair{Kind::Point, "point"},
                              std::pair{Kind::Segment, "segment"}};

/// Joints may be named without their first letter.
std::optional<double> numberOfItem(Kind kind, const std::string& name) {
    const auto number = numberNamed(kind, name);
    return number || kind != Kind::Joint ? number : numberNamed(kind, "j" + name);
}

/// The field that tells the items of a list apart; null if it is not of the kind.
const FieldInfo* tellingField(std::size_t shape, std::size_t list, Kind kind, std::string_view name) {
    const auto found = std::ranges::find_if(fieldTable(), [&](const FieldInfo& field) {
        return field.kind == kind && field.name == name && field.places[shape][list].read != nullptr;
    });
    return found != fieldTable().end() ? &*found : nullptr;
}

NamedItem::Spot spotIn(std::size_t shape, std::size_t list, const Constant& item) {
    for (const auto& [kind, name] : kTelling) {
        const FieldInfo* field = tellingField(shape, list, kind, name);
        if (field == nullptr) {
            continue;
        }
        const auto named = field->named ? numberOfItem(kind, item.text) : std::nullopt;
        if (const auto number = named ? named : numberOf(item.text)) {
            return {(named ? *field->named : field->places)[shape][list].read, *number};
        }
        if (kind == Kind::Point) { // a segment has several
            break;
        }
    }
    return {};
}

/// Calls f(shape, list) for the lists that have the fields.
void forEachList(const FieldMatch& match, const auto& f) {
    for (const FieldInfo* field : match.fields) {
        for (std::size_t shape = 0; shape < kShapes; ++shape) {
            for (std::size_t list = 1; list < kLists; ++list) {
                if (field->isOfItems() && field->places[shape][list].read != nullptr &&
                    (!match.type || *match.type == typeOfShape(shape))) {
                    f(shape, list);
                }
            }
        }
    }
}

/// The closest name of anything.
std::string nearestItem(const std::string& name) {
    std::vector<std::string_view> names;
    for (const auto& [kind, field] : kTelling) {
        std::ranges::copy(namesOf(kind), std::back_inserter(names));
    }
    return nearestOf(name, names);
}

} // namespace

std::vector<Kind> itemKinds(const FieldMatch& match) {
    std::vector<Kind> kinds;
    forEachList(match, [&](std::size_t shape, std::size_t list) {
        const auto* own = std::ranges::find_if(kTelling, [&](const auto& telling) {
            return tellingField(shape, list, telling.first, telling.second) != nullptr;
        });
        if (own != kTelling.end() && std::ranges::find(kinds, own->first) == kinds.end()) {
            kinds.push_back(own->first);
        }
    });
    return kinds;
}

tl::expected<FieldMatch, FilterError> fieldsOf(const WrittenField& written) {
    FieldMatch match = findFields(written.fieldName);
    if (match.fields.empty() && !match.isTag) {
        const std::string near = nearestField(written.fieldName);
        return tl::unexpected(FilterError{written.field.offset, written.field.length,
                                          "There is no field `" + std::string(written.fieldName) + "`" +
                                              (near.empty() ? "." : "; did you mean `" + near + "`?")});
    }
    return match;
}

tl::expected<std::shared_ptr<const NamedItem>, FilterError> itemOf(const WrittenField& written,
                                                                   const FieldMatch& match) {
    if (!written.item) {
        return nullptr;
    }
    NamedItem item;
    bool isFound = false;
    bool hasItems = false;
    forEachList(match, [&](std::size_t shape, std::size_t list) {
        item.spots[shape][list] = spotIn(shape, list, *written.item);
        hasItems = true;
        isFound = isFound || item.spots[shape][list].read != nullptr;
    });
    if (!isFound) {
        const Constant& named = *written.item;
        const std::string near = hasItems ? nearestItem(named.text) : std::string();
        const bool isKnown = near.empty() || near == named.text;
        return tl::unexpected(
            FilterError{named.token.offset, named.token.length,
                        !hasItems ? "`" + std::string(written.fieldName) + "` is of no item: leave `of` out."
                                  : "`" + std::string(written.fieldName) + "` has no item `" + named.text +
                                        "`" + (isKnown ? "." : "; did you mean `" + near + "`?")});
    }
    return std::make_shared<const NamedItem>(item);
}

} // namespace posewire::filter
