// SPDX-License-Identifier: MIT
#include "core/field/field.h"

#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <numeric>

namespace posewire::field {
namespace {

using enum Dimension;

constexpr double kPi = std::numbers::pi;
constexpr double kStandardGravity = 9.80665; // m/s²

constexpr std::array kUnits{
    UnitInfo{"m", Length, "metres"},
    UnitInfo{"cm", Length, "centimetres", 1, 100},
    UnitInfo{"mm", Length, "millimetres", 1, 1000},
    UnitInfo{"s", Time, "seconds"},
    UnitInfo{"ms", Time, "milliseconds", 1, 1000},
    UnitInfo{"us", Time, "microseconds", 1, 1e6},
    UnitInfo{"µs", Time, "microseconds", 1, 1e6},
    UnitInfo{"min", Time, "minutes", 60},
    UnitInfo{"h", Time, "hours", 3600},
    UnitInfo{"°", Angle, "degrees"},
    UnitInfo{"deg", Angle, "degrees"},
    UnitInfo{"rad", Angle, "radians", 180, kPi},
    UnitInfo{"m/s", Velocity, "metres per second"},
    UnitInfo{"cm/s", Velocity, "centimetres per second", 1, 100},
    UnitInfo{"mm/s", Velocity, "millimetres per second", 1, 1000},
    UnitInfo{"km/h", Velocity, "kilometres per hour", 10, 36},
    UnitInfo{"m/s²", Acceleration, "metres per second squared"},
    UnitInfo{"m/s2", Acceleration, "metres per second squared"},
    UnitInfo{"cm/s²", Acceleration, "centimetres per second squared", 1, 100},
    UnitInfo{"cm/s2", Acceleration, "centimetres per second squared", 1, 100},
    UnitInfo{"g", Acceleration, "9.80665 m/s²", kStandardGravity},
    UnitInfo{"°/s", AngularVelocity, "degrees per second"},
    UnitInfo{"deg/s", AngularVelocity, "degrees per second"},
    UnitInfo{"rad/s", AngularVelocity, "radians per second", 180, kPi},
    UnitInfo{"°/s²", AngularAcceleration, "degrees per second squared"},
    UnitInfo{"deg/s2", AngularAcceleration, "degrees per second squared"},
    UnitInfo{"rad/s²", AngularAcceleration, "radians per second squared", 180, kPi},
    UnitInfo{"rad/s2", AngularAcceleration, "radians per second squared", 180, kPi},
    UnitInfo{"bytes", Bytes, "bytes"},
    UnitInfo{"kB", Bytes, "1,000 bytes", 1000},
    UnitInfo{"KiB", Bytes, "1,024 bytes", 1024},
};

constexpr std::array<std::string_view, 9> kDimensions{"",
                                                      "a length",
                                                      "a time",
                                                      "an angle",
                                                      "a velocity",
                                                      "an acceleration",
                                                      "a velocity of turning",
                                                      "an acceleration of turning",
                                                      "a size"};

/// The component of that name; of a quaternion also by the letters that mathematics has for it.
std::optional<std::size_t> componentAt(std::size_t components, std::string_view name) {
    static constexpr std::array<std::string_view, 4> kLetters{"w", "x", "y", "z"};
    for (const auto names : {componentNames(components), std::span<const std::string_view>(kLetters)}) {
        const auto found = std::ranges::find(names, name);
        if (names.size() == components && found != names.end()) {
            return static_cast<std::size_t>(found - names.begin());
        }
    }
    return std::nullopt;
}

bool isNamed(const FieldInfo& field, std::string_view name) {
    const std::size_t qualifier = field.qualifier.size();
    return name == field.name ||
           (qualifier != 0 && name.size() == qualifier + 1 + field.name.size() &&
            name.starts_with(field.qualifier) && name[qualifier] == '.' && name.ends_with(field.name));
}

void collect(std::string_view name, std::optional<std::string_view> component, FieldMatch& match) {
    for (const FieldInfo& field : fieldTable()) {
        const bool isComputed = !field.isOfItems() && field.qualifier.empty(); // it was never sent
        const bool isElsewhere = match.type && field.isOfItems() &&
                                 std::ranges::find(field.types, *match.type) == field.types.end();
        if (!isNamed(field, name) || (match.isAsSent && isComputed) || isElsewhere) {
            continue;
        }
        if (!component) {
            match.fields.push_back(&field);
            continue;
        }
        const auto place = componentAt(field.components, *component);
        // Vectors and quaternions number their components differently, so only fields of one length combine.
        if (place && (match.fields.empty() || match.fields.front()->components == field.components)) {
            match.fields.push_back(&field);
            match.component = *place;
            match.hasComponent = true;
        }
    }
}

/// Levenshtein, without case.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = diagonal + (wire::lower(a[i - 1]) == wire::lower(b[j - 1]) ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({change, row[j] + 1, row[j - 1] + 1}));
        }
    }
    return row.back();
}

constexpr std::size_t kLongestName = 64;

} // namespace

std::span<const UnitInfo> unitTable() {
    return kUnits;
}

std::span<const UnitInfo> unitsOf(Dimension dimension) {
    const auto* first = std::ranges::lower_bound(kUnits, dimension, {}, &UnitInfo::dimension);
    const auto* last = std::ranges::upper_bound(kUnits, dimension, {}, &UnitInfo::dimension);
    return {first, last};
}

const UnitInfo* findUnit(std::string_view symbol) {
    const auto* found = std::ranges::find(kUnits, symbol, &UnitInfo::symbol);
    return found != kUnits.end() ? found : nullptr;
}

double converted(double number, const UnitInfo& from, const UnitInfo& into) {
    return number * (from.times * into.per) / (from.per * into.times);
}

std::string_view dimensionName(Dimension dimension) {
    return kDimensions[static_cast<std::size_t>(dimension)];
}

std::string unitsText(Dimension dimension) {
    std::string text;
    const auto units = unitsOf(dimension);
    for (std::size_t i = 0; i < units.size(); ++i) {
        text.append(i == 0 ? "" : i + 1 == units.size() ? " or " : ", ").append(units[i].symbol);
    }
    return text;
}

bool FieldInfo::isConverted() const {
    return dimension == Dimension::Length ||
           (dimension != Dimension::None && read != &unitsOf(dimension).front());
}

std::optional<std::uint8_t> takeType(std::string_view& name) {
    const std::size_t dot = name.find('.');
    const bool isLed =
        dot != std::string_view::npos && dot <= 2 && name.find_first_of("0123456789", dot) != dot + 1;
    const auto number = isLed ? numberOf(name.substr(0, dot)) : std::nullopt;
    const wire::TypeInfo* info =
        number && *number >= 0 ? wire::findType(static_cast<std::uint8_t>(*number)) : nullptr;
    if (info == nullptr) {
        return std::nullopt;
    }
    name.remove_prefix(dot + 1);
    return info->type;
}

FieldMatch findFields(std::string_view name) {
    FieldMatch match;
    match.type = takeType(name);
    if (name.starts_with(kAsSent)) {
        name.remove_prefix(kAsSent.size());
        match.isAsSent = true;
    }
    if (!match.isAsSent && (name == "tag" || (name.starts_with("tag.") && name.size() > 4))) {
        match.isTag = true;
        match.tag = name.substr(std::min<std::size_t>(name.size(), 4));
        return match;
    }
    collect(name, std::nullopt, match);
    const std::size_t dot = name.rfind('.');
    if (match.fields.empty() && dot != std::string_view::npos) {
        collect(name.substr(0, dot), name.substr(dot + 1), match);
    }
    return match;
}

std::span<const std::string_view> componentNames(std::size_t components) {
    static constexpr std::array<std::string_view, 9> kPlaces{"1", "2", "3", "4", "5", "6", "7", "8", "9"};
    return components == kPlaces.size() ? kPlaces : wire::componentNames(components);
}

std::string askedName(const FieldInfo& field) {
    const bool isShared = std::ranges::any_of(fieldTable(), [&](const FieldInfo& other) {
        return &other != &field && other.name == field.name && other.kind == field.kind &&
               (other.readPacket != nullptr) != (field.readPacket != nullptr);
    });
    return isShared && field.readPacket == nullptr && !field.qualifier.empty()
               ? field.qualifier + '.' + field.name
               : field.name;
}

std::string nearestOf(std::string_view word, std::span<const std::string_view> words) {
    std::string_view best;
    std::size_t least = std::min<std::size_t>(word.size() / 3 + 1, 3) + 1;
    for (const std::string_view known : words) {
        const std::size_t far = word.size() <= kLongestName ? distance(word, known) : least;
        if (far < least) {
            least = far;
            best = known;
        }
    }
    return std::string(best);
}

std::string nearestField(std::string_view name) {
    const std::string_view whole = name;
    if (takeType(name)) {
        const std::string found = nearestField(name);
        const std::string prefix(whole.substr(0, whole.size() - name.size()));
        return findFields(prefix + found).fields.empty() ? found : prefix + found;
    }
    if (name.starts_with(kAsSent)) {
        const std::string found = nearestField(name.substr(kAsSent.size()));
        const std::string asSent = std::string(kAsSent) + found;
        return findFields(asSent).fields.empty() ? found : asSent;
    }
    const std::string_view last = name.substr(name.rfind('.') + 1);
    const bool hasComponent = name.size() > last.size() && (last.size() == 1 || componentAt(4, last));
    const std::string_view base = hasComponent ? name.substr(0, name.size() - last.size() - 1) : name;
    std::vector<std::string_view> names{"tag"};
    std::ranges::transform(fieldTable(), std::back_inserter(names), &FieldInfo::name);
    const std::string found = nearestOf(base, names);
    const auto completed = found + '.' + std::string(last);
    return hasComponent && !findFields(completed).fields.empty() ? completed : found;
}

std::optional<double> numberOf(std::string_view word) {
    const bool isNegative = word.starts_with('-');
    if (isNegative || word.starts_with('+')) {
        word.remove_prefix(1);
    }
    const char* end = word.data() + word.size();
    if (word.starts_with("0x") || word.starts_with("0X")) {
        std::uint64_t value = 0;
        const auto result = std::from_chars(word.data() + 2, end, value, 16);
        const bool isNumber = result.ec == std::errc() && result.ptr == end && word.size() > 2;
        return isNumber ? std::optional(isNegative ? -static_cast<double>(value) : static_cast<double>(value))
                        : std::nullopt;
    }
    double value = 0;
    const auto result = std::from_chars(word.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end || std::isnan(value) || word.empty()) {
        return std::nullopt;
    }
    return isNegative ? -value : value;
}

std::string componentsText(const FieldInfo& field) {
    std::string text;
    for (const std::string_view name : componentNames(field.components)) {
        text.append(text.empty() ? "" : ", ").append(name);
    }
    return text;
}

std::string typesText(const FieldInfo& field) {
    std::string text;
    for (const std::uint8_t type : field.types) {
        text.append(text.empty() ? "" : " ").append(wire::typeDigits(type));
    }
    return text;
}

KindWords kindWords(Kind kind) {
    constexpr std::array<KindWords, 10> kWords{{
        {"number", "a number"},
        {"text", "text"},
        {"vector", "a number"},
        {"true or false", "true or false"},
        {"message type", "a message type such as 02"},
        {"segment", "a segment such as LeftHand or 15"},
        {"point", "a point such as pSacrum or 269"},
        {"joint", "a joint such as jRightKnee or 16"},
        {"word", "one of udp, tcp, file and performer"},
        {"UTC time", "a UTC time such as \"2026-01-31T12:00:00\""},
    }};
    return kWords[static_cast<std::size_t>(kind)];
}

} // namespace posewire::field
