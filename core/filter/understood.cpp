// SPDX-License-Identifier: MIT
#include "core/filter/program.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>

namespace posewire::filter {
namespace {

using Failure = tl::unexpected<FilterError>;

FilterError errorAt(const Token& token, std::string text) {
    return {token.offset, token.length, std::move(text)};
}

Failure failure(const Token& token, std::string text) {
    return Failure(errorAt(token, std::move(text)));
}

bool isNan(const Constant& constant) {
    return !constant.isQuoted && (constant.text == "NaN" || constant.text == "nan");
}

std::optional<double> typeNumber(const Constant& constant) {
    const auto named = std::ranges::find(wire::typeTable(), constant.text, &wire::TypeInfo::name);
    return named != wire::typeTable().end() ? std::optional<double>(named->type) : numberOf(constant.text);
}

/// Reads a number of that many digits, after `before` unless that is 0.
bool take(std::string_view& text, char before, std::size_t digits, int& value) {
    const std::size_t skipped = before != 0 ? 1 : 0;
    if (text.size() < skipped + digits || (before != 0 && text.front() != before)) {
        return false;
    }
    const char* begin = text.data() + skipped;
    const bool isNumber =
        std::from_chars(begin, begin + digits, value).ptr == begin + digits && *begin != '-';
    text.remove_prefix(skipped + digits);
    return isNumber;
}

/// Seconds of "12:00", "12:00:00" or "12:00:00.25".
std::optional<double> timeOfDay(std::string_view text) {
    int hour = 0;
    int minute = 0;
    int second = 0;
    double fraction = 0;
    if (!take(text, 0, 2, hour) || !take(text, ':', 2, minute) || hour > 24 || minute > 59) {
        return std::nullopt;
    }
    if (!text.empty() && (!take(text, ':', 2, second) || second > 60)) {
        return std::nullopt;
    }
    if (text.starts_with('.') && text.size() > 1) {
        const char* end = text.data() + text.size();
        const auto format = std::chars_format::fixed;
        text.remove_prefix(std::from_chars(text.data(), end, fraction, format).ptr == end ? text.size() : 0);
    }
    if (hour == 24 && minute + second + fraction > 0) {
        return std::nullopt;
    }
    return text.empty() ? std::optional(hour * 3600.0 + minute * 60.0 + second + fraction) : std::nullopt;
}

/// Seconds since 1970 of "2026-01-31", "2026-01-31T12:00", "2026-01-31 12:00:00.25Z"; empty for other
/// texts.
std::optional<double> utcSeconds(std::string_view text) {
    int year = 0;
    int month = 0;
    int day = 0;
    if (!take(text, 0, 4, year) || !take(text, '-', 2, month) || !take(text, '-', 2, day)) {
        return std::nullopt;
    }
    const std::chrono::year_month_day date{std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) {
        return std::nullopt;
    }
    const double midnight =
        static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count()) * 86400.0;
    if (text.ends_with('Z')) {
        text.remove_suffix(1);
    }
    if (text.empty()) {
        return midnight;
    }
    const bool isSeparated = text.front() == 'T' || text.front() == ' ';
    const auto seconds = isSeparated ? timeOfDay(text.substr(1)) : std::nullopt;
    return seconds ? std::optional(midnight + *seconds) : std::nullopt;
}

} // namespace

std::optional<Amount> amountOf(const Constant& constant) {
    const std::string_view text = constant.text;
    if (const auto number = constant.isQuoted ? std::nullopt : numberOf(text)) {
        return Amount{*number, constant.unitText, constant.unit.value_or(constant.token)};
    }
    const std::size_t begin = text.find_first_not_of("+-");
    const std::size_t end = text.find_first_not_of("+-.0123456789");
    if (constant.isQuoted || begin == std::string_view::npos || end == std::string_view::npos ||
        end == begin) {
        return std::nullopt;
    }
    const auto number = numberOf(text.substr(0, end));
    const Token place{TokenKind::Word, constant.token.offset + end, text.size() - end};
    return number ? std::optional(Amount{*number, text.substr(end), place}) : std::nullopt;
}

namespace {

/// What a field is compared with, of the fields of a name.
struct Asked {
    const FieldInfo& field;
    bool hasComponent = false;
    bool isAsSent = false;

    /// A number may be written with a unit of it.
    [[nodiscard]] Dimension dimension() const { return isAsSent ? Dimension::None : field.dimension; }
};

bool fits(const Asked& asked, const Amount& amount) {
    const UnitInfo* unit = findUnit(amount.unit);
    return amount.unit.empty() ||
           (unit != nullptr && asked.dimension() != Dimension::None && unit->dimension == asked.dimension());
}

/// The number that a constant means for a field, in the unit that is written; empty if it does not fit.
std::optional<double> numberFor(const Asked& asked, const Constant& constant) {
    const FieldInfo& field = asked.field;
    if (field.kind == Kind::Number || field.kind == Kind::Vector) {
        const auto amount = amountOf(constant);
        return amount && fits(asked, *amount) ? std::optional(amount->number) : std::nullopt;
    }
    if (constant.unit) {
        return std::nullopt;
    }
    switch (field.kind) {
    case Kind::Flag:
        return constant.text == "true"    ? std::optional(1.0)
               : constant.text == "false" ? std::optional(0.0)
                                          : numberOf(constant.text);
    case Kind::Type:
        return typeNumber(constant);
    case Kind::Segment:
    case Kind::Point:
    case Kind::Joint: {
        const auto named = numberNamed(field.kind, constant.text);
        return named ? named : numberOf(constant.text);
    }
    case Kind::Time: {
        const auto seconds = numberOf(constant.text);
        return seconds ? seconds : utcSeconds(constant.text);
    }
    default:
        return std::nullopt;
    }
}

bool isTextKind(Kind kind) {
    return kind == Kind::Text || kind == Kind::Transport;
}

bool needsText(Operator op) {
    return op == Operator::Contains || op == Operator::Matches;
}

bool ordersOnly(Operator op) {
    return op >= Operator::Less && op <= Operator::GreaterEqual;
}

bool suits(const Asked& asked, const WrittenCondition& written) {
    const FieldInfo& field = asked.field;
    if (written.op == Operator::IsThere) {
        return true;
    }
    if (isTextKind(field.kind)) {
        const bool hasRange = std::ranges::any_of(written.constants, [](auto& pair) {
            return pair.first.token.offset != pair.second.token.offset || pair.first.unit;
        });
        const bool isKnown =
            field.kind == Kind::Text || needsText(written.op) ||
            std::ranges::all_of(written.constants, [](auto& pair) {
                return std::ranges::find(log::kTransportNames, pair.first.text) != log::kTransportNames.end();
            });
        return !ordersOnly(written.op) && !hasRange && isKnown;
    }
    const bool asksNan = (written.op == Operator::Equal || written.op == Operator::NotEqual) &&
                         isNan(written.constants.front().first);
    if (asksNan) {
        return field.kind == Kind::Number || field.kind == Kind::Vector;
    }
    const bool fit = std::ranges::all_of(written.constants, [&](const auto& pair) {
        return numberFor(asked, pair.first) && numberFor(asked, pair.second);
    });
    return !needsText(written.op) && (field.kind != Kind::Vector || asked.hasComponent) && fit;
}

std::optional<FilterError> unitComplaint(const Asked& asked, const std::string& name,
                                         const Constant& constant) {
    const auto amount = amountOf(constant);
    const bool isNumber = asked.field.kind == Kind::Number || asked.field.kind == Kind::Vector;
    if (!amount || amount->unit.empty() || (isNumber && fits(asked, *amount))) {
        return std::nullopt;
    }
    if (asked.dimension() != Dimension::None) {
        const std::string is = "` is " + std::string(dimensionName(asked.dimension())) + ": write ";
        return errorAt(amount->place, "`" + name + is + unitsText(asked.dimension()) + ".");
    }
    return errorAt(amount->place, asked.isAsSent ? "`" + name + "` is the number as sent: write no unit."
                                                 : "`" + name + "` has no unit.");
}

FilterError constantComplaint(const Asked& asked, const std::string& name, const Constant& constant) {
    if (auto complaint = unitComplaint(asked, name, constant)) {
        return *std::move(complaint);
    }
    const Kind kind = asked.field.kind;
    const std::string near = nearestOf(constant.text, namesOf(kind));
    return errorAt(constant.token, "`" + name + "` is compared with " + std::string(kindWords(kind).value) +
                                       (near.empty() ? "." : "; did you mean `" + near + "`?"));
}

/// Why none of the fields suits, judged by the first.
FilterError complaint(const FieldMatch& match, const WrittenCondition& written) {
    const FieldInfo& field = *match.fields.front();
    const std::string name(written.fieldName);
    if (field.kind == Kind::Vector && !match.hasComponent) {
        const std::string last(componentNames(field.components).back());
        return errorAt(written.field, "`" + name + "` has the components " + componentsText(field) +
                                          ": write `" + name + "." + last + "`.");
    }
    const Token& op = written.operatorToken;
    if (needsText(written.op)) {
        return errorAt(op,
                       "`" + name + "` is not text: compare it with ==, !=, <, <=, > or >=, or use `in`.");
    }
    if (isTextKind(field.kind) && ordersOnly(written.op)) {
        return errorAt(op, "`" + name + "` is text: compare it with ==, !=, `in`, `contains` or `matches`.");
    }
    const Asked asked{field, match.hasComponent, match.isAsSent};
    for (const auto& pair : written.constants) {
        for (const Constant* constant : {&pair.first, &pair.second}) {
            if (isTextKind(field.kind) || !numberFor(asked, *constant)) {
                return constantComplaint(asked, name, *constant);
            }
        }
    }
    return errorAt(op, "`" + name + "` cannot be compared like this.");
}

tl::expected<void, FilterError> setTexts(const WrittenCondition& written, Test& test) {
    test.comparesText = true;
    for (const auto& pair : written.constants) {
        test.texts.push_back(pair.first.text);
    }
    if (written.op == Operator::Contains) {
        test.texts.front() = wire::lowered(test.texts.front());
    }
    if (written.op == Operator::Matches) {
        if (const std::string problem = test.setPattern(test.texts.front()); !problem.empty()) {
            return failure(written.constants.front().first.token,
                           "This regular expression cannot be used: " + problem + ".");
        }
    }
    return {};
}

double rounded(const FieldInfo& field, double number) {
    if (!field.isFloat || std::abs(number) > static_cast<double>(std::numeric_limits<float>::max())) {
        return number;
    }
    return static_cast<double>(static_cast<float>(number));
}

/// As the values of the field are read: `read` is their unit, null for none.
double asRead(const Asked& asked, const UnitInfo* read, const Constant& constant, const Constant& rangeEnd) {
    const double number = *numberFor(asked, constant);
    if (asked.dimension() == Dimension::None || read == nullptr) {
        return rounded(asked.field, number);
    }
    // In "1..2 cm" both are centimetres.
    const std::string_view own = amountOf(constant)->unit;
    const UnitInfo* unit = findUnit(own.empty() ? amountOf(rangeEnd)->unit : own);
    unit = unit != nullptr ? unit : &unitsOf(asked.dimension()).front();
    const double inIt = converted(number, *unit, *read);
    // 27.837 s are 27,837 ms, whatever their binary fractions come to.
    constexpr double kRounding = 1e-12;
    const bool isWhole = unit != read && std::abs(inIt - std::round(inIt)) <= std::abs(inIt) * kRounding;
    return rounded(asked.field, isWhole ? std::round(inIt) : inIt);
}

tl::expected<void, FilterError> setNumbers(const Asked& asked, const UnitInfo* read,
                                           const WrittenCondition& written, Test& test) {
    test.comparesNan = written.op != Operator::In && isNan(written.constants.front().first);
    for (const auto& [from, to] : written.constants) {
        if (!test.comparesNan) {
            const Test::Range range{asRead(asked, read, from, to), asRead(asked, read, to, to)};
            if (range.first > range.second) {
                return failure({TokenKind::Word, from.token.offset, to.token.end() - from.token.offset},
                               "This range ends before it begins: write the smaller value first.");
            }
            test.ranges.push_back(range);
        }
    }
    return {};
}

/// A bare number, which is rarely meant as text.
bool isNumber(const WrittenCondition& written) {
    return !written.constants.empty() && amountOf(written.constants.front().first).has_value();
}

bool isName(const FieldInfo& field, const WrittenCondition& written) {
    return !written.constants.empty() &&
           numberNamed(field.kind, written.constants.front().first.text).has_value();
}

void setPlaces(const FieldMatch& match, const WrittenCondition& written, const FieldInfo& first,
               Condition& condition) {
    for (const FieldInfo* field : match.fields) {
        if (!field->isOfItems() || field->kind != first.kind || field->components != first.components ||
            (field->dimension != first.dimension && !match.isAsSent)) {
            continue;
        }
        const Places& places = isName(*field, written) && field->named ? *field->named : field->places;
        for (std::size_t shape = 0; shape < kShapes; ++shape) {
            const bool isAsked = !match.type || *match.type == typeOfShape(shape);
            for (std::size_t list = 0; isAsked && list < kLists; ++list) {
                if (const Place& place = places[shape][list]; place.read != nullptr) {
                    condition.places[shape][list] = {place.read,
                                                     match.isAsSent ? std::nullopt : place.length};
                }
            }
        }
    }
}

tl::expected<Condition, FilterError> tagCondition(const FieldMatch& match, const WrittenCondition& written) {
    Condition condition;
    condition.isTag = true;
    condition.tag = match.tag;
    condition.test.op = written.op;
    if (ordersOnly(written.op)) {
        return failure(written.operatorToken, "Tags are text: use ==, !=, `in`, `contains` or `matches`.");
    }
    for (const auto& [from, to] : written.constants) {
        if (from.unit || to.unit) {
            return failure(from.unit ? *from.unit : *to.unit, "Tags are text and have no unit.");
        }
    }
    if (written.op != Operator::IsThere) {
        if (auto set = setTexts(written, condition.test); !set) {
            return Failure(set.error());
        }
    }
    return condition;
}

/// The constants as the values that the condition reads are.
tl::expected<void, FilterError> setTests(const Asked& asked, const WrittenCondition& written,
                                         Condition& condition) {
    if (written.op == Operator::IsThere) {
        return {};
    }
    if (isTextKind(asked.field.kind)) {
        return setTexts(written, condition.test);
    }
    const bool isLength = asked.dimension() == Dimension::Length;
    const UnitInfo* read = isLength ? &unitsOf(Dimension::Length).front() : asked.field.read;
    auto set = setNumbers(asked, read, written, condition.test);
    if (set && isLength) {
        condition.comparesLengths = true;
        condition.testInCentimetres.op = condition.testInMillimetres.op = written.op;
        set = setNumbers(asked, findUnit("cm"), written, condition.testInCentimetres);
        return set ? setNumbers(asked, findUnit("mm"), written, condition.testInMillimetres) : set;
    }
    return set;
}

} // namespace

tl::expected<Condition, FilterError> understood(const WrittenCondition& written) {
    const auto found = fieldsOf(written);
    if (!found) {
        return Failure(found.error());
    }
    const FieldMatch& match = *found;
    auto item = itemOf(written, match);
    if (!item) {
        return Failure(item.error());
    }
    if (match.isTag) {
        return tagCondition(match, written);
    }
    const auto suiting = [&](bool mayReadNumberAsText) {
        return std::ranges::find_if(match.fields, [&](const FieldInfo* field) {
            const bool isFirstChoice = !isTextKind(field->kind) || !isNumber(written);
            return (isFirstChoice || mayReadNumberAsText) &&
                   suits({*field, match.hasComponent, match.isAsSent}, written);
        });
    };
    auto suited = suiting(false);
    suited = suited == match.fields.end() ? suiting(true) : suited;
    if (suited == match.fields.end()) {
        return Failure(complaint(match, written));
    }
    const FieldInfo& field = **suited;
    Condition condition;
    condition.test.op = written.op;
    condition.readPacket = field.readPacket;
    condition.comparesJudged = field.isJudged;
    condition.type = match.type;
    condition.item = std::move(*item);
    if (field.isOfItems()) {
        setPlaces(match, written, field, condition);
        condition.firstComponent = match.hasComponent ? match.component : 0;
        condition.components = match.hasComponent ? 1 : field.components;
    }
    if (auto set = setTests({field, match.hasComponent, match.isAsSent}, written, condition); !set) {
        return Failure(set.error());
    }
    // A flag alone, or a number that is 0 when absent, means "not 0".
    if (condition.test.op == Operator::IsThere && (field.kind == Kind::Flag || field.isTrueByValue)) {
        condition.test.op = Operator::NotEqual;
        condition.test.ranges = {{0, 0}};
    }
    return condition;
}

} // namespace posewire::filter
