// SPDX-License-Identifier: MIT
#include "tests/core/filter/filter_fixture.h"

#include <algorithm>
#include <functional>
#include <random>
#include <span>

// Generated conditions on generated poses, against the rules of filterReference() written out a second time.
namespace posewire::filter::test {
namespace {

constexpr std::size_t kFilters = 3'000;
constexpr std::size_t kPackets = 24;

/// What a pose says, and what stands around it.
struct Facts {
    std::vector<wire::Vec3> positions; ///< of segments 1, 2, …
    std::uint32_t sample = 0;
};

Case packetOf(const Facts& facts) {
    wire::Datagram datagram = pose(facts.positions).datagram;
    datagram.header.sampleCounter = facts.sample;
    return Case(datagram);
}

/// One comparison. Of a segment (by its id), of a component of its position, or of the sample counter.
struct Comparison {
    enum class Of : std::uint8_t { Segment, X, Y, Z, Sample };
    Of of = Of::Segment;
    std::string sign;
    int constant = 0;

    [[nodiscard]] bool isOfItem() const { return of != Of::Sample; }
    [[nodiscard]] std::string text() const {
        constexpr std::array names{"segment", "position.x", "position.y", "position.z", "sample"};
        return std::string(names[static_cast<std::size_t>(of)]) + ' ' + sign + ' ' + std::to_string(constant);
    }
    [[nodiscard]] bool holds(const Facts& facts, std::size_t item) const {
        const double value = valueOf(facts, item);
        return (sign == "==" && value == constant) || (sign == "!=" && value != constant) ||
               (sign == "<" && value < constant) || (sign == "<=" && value <= constant) ||
               (sign == ">" && value > constant) || (sign == ">=" && value >= constant);
    }

private:
    [[nodiscard]] double valueOf(const Facts& facts, std::size_t item) const {
        switch (of) {
        case Of::Segment:
            return static_cast<double>(item + 1);
        case Of::Sample:
            return facts.sample;
        case Of::X:
            return facts.positions[item][0];
        case Of::Y:
            return facts.positions[item][1];
        case Of::Z:
            return facts.positions[item][2];
        }
        return 0;
    }
};

/// A condition as a tree. `Group` is a pair of parentheses around an And, `Any` one around an Or among the
/// conditions of an And, so that it speaks of the same item as they do.
struct Condition {
    enum class Kind : std::uint8_t { Comparison, Not, And, Or, Group, Any };
    Kind kind = Kind::Comparison;
    Comparison comparison;
    std::vector<Condition> parts;
};

std::string joined(const std::vector<Condition>& parts, std::string_view between);

std::string textOf(const Condition& condition) {
    switch (condition.kind) {
    case Condition::Kind::Comparison:
        return condition.comparison.text();
    case Condition::Kind::Not:
        return "!(" + textOf(condition.parts.front()) + ')';
    case Condition::Kind::And:
        return joined(condition.parts, " && ");
    case Condition::Kind::Or:
        return joined(condition.parts, " or ");
    case Condition::Kind::Group:
        return '(' + joined(condition.parts, " and ") + ')';
    case Condition::Kind::Any:
        return '(' + joined(condition.parts, " || ") + ')';
    }
    return {};
}

std::string joined(const std::vector<Condition>& parts, std::string_view between) {
    std::string text;
    for (const Condition& part : parts) {
        text.append(text.empty() ? "" : between).append(textOf(part));
    }
    return text;
}

bool isOfItem(const Condition& condition) {
    return condition.kind == Condition::Kind::Comparison
               ? condition.comparison.isOfItem()
               : condition.kind == Condition::Kind::Any && std::ranges::any_of(condition.parts, isOfItem);
}

bool holds(const Condition& condition, const Facts& facts);

/// Whether a part of an And holds where all of its parts speak of one item.
bool holdsAt(const Condition& condition, const Facts& facts, std::size_t item) {
    const bool canHold = !isOfItem(condition) || item < facts.positions.size();
    switch (condition.kind) {
    case Condition::Kind::Comparison:
        return canHold && condition.comparison.holds(facts, item);
    case Condition::Kind::Any:
        return std::ranges::any_of(condition.parts,
                                   [&](const Condition& part) { return holdsAt(part, facts, item); });
    default:
        return holds(condition, facts);
    }
}

bool holds(const Condition& condition, const Facts& facts) {
    switch (condition.kind) {
    case Condition::Kind::Not:
        return !holds(condition.parts.front(), facts);
    case Condition::Kind::Or:
        return std::ranges::any_of(condition.parts,
                                   [&](const Condition& part) { return holds(part, facts); });
    default:
        break;
    }
    const bool isAlone =
        condition.kind == Condition::Kind::Comparison || condition.kind == Condition::Kind::Any;
    const std::span<const Condition> parts = isAlone ? std::span(&condition, 1) : std::span(condition.parts);
    // At least one round, for conditions on the header alone.
    for (std::size_t item = 0; item < std::max<std::size_t>(facts.positions.size(), 1); ++item) {
        if (std::ranges::all_of(parts, [&](const Condition& part) { return holdsAt(part, facts, item); })) {
            return true;
        }
    }
    return false;
}

class Generator {
public:
    Facts facts() {
        Facts facts;
        facts.positions.resize(pick(5));
        for (wire::Vec3& position : facts.positions) {
            for (float& component : position) {
                component = static_cast<float>(pick(4));
            }
        }
        facts.sample = static_cast<std::uint32_t>(pick(4));
        return facts;
    }

    Condition condition(std::size_t depth) {
        Condition any{Condition::Kind::Or, {}, {}};
        for (std::size_t i = 0; i <= pick(2); ++i) {
            any.parts.push_back(conjunction(depth, Condition::Kind::And));
        }
        return any;
    }

private:
    std::size_t pick(std::size_t below) { return m_random() % below; }

    Condition conjunction(std::size_t depth, Condition::Kind kind) {
        Condition all{kind, {}, {}};
        for (std::size_t i = 0; i <= pick(3); ++i) {
            all.parts.push_back(part(depth));
        }
        if (kind == Condition::Kind::Group && all.parts.size() == 1) {
            all.parts.push_back(comparison()); // parentheses around one condition make no group
        }
        return all;
    }
    Condition part(std::size_t depth) {
        const std::size_t which = depth == 0 ? 0 : pick(6);
        if (which == 1) {
            return {Condition::Kind::Not, {}, {condition(depth - 1)}};
        }
        if (which == 2) {
            return conjunction(depth - 1, Condition::Kind::Group);
        }
        return which == 3 ? Condition{Condition::Kind::Any, {}, {comparison(), comparison()}} : comparison();
    }
    Condition comparison() {
        constexpr std::array signs{"==", "!=", "<", "<=", ">", ">="};
        Condition one;
        one.comparison = {static_cast<Comparison::Of>(pick(5)), signs[pick(signs.size())],
                          static_cast<int>(pick(4))};
        return one;
    }

    std::mt19937 m_random{20'171'123};
};

TEST(FilterSemantics, AreThoseOfTheReference) {
    Generator generator;
    std::vector<Facts> facts;
    std::vector<Case> packets;
    packets.reserve(kPackets); // a case refers to its own bytes
    for (std::size_t i = 0; i < kPackets; ++i) {
        facts.push_back(generator.facts());
        packets.push_back(packetOf(facts.back()));
    }
    std::array<std::size_t, 2> outcomes{};
    for (std::size_t i = 0; i < kFilters; ++i) {
        const Condition condition = generator.condition(2);
        const std::string text = textOf(condition);
        const auto filter = Filter::compile(text);
        ASSERT_TRUE(filter) << text << ": " << filter.error().text;
        for (std::size_t packet = 0; packet < kPackets; ++packet) {
            const bool expected = holds(condition, facts[packet]);
            ASSERT_EQ(filter->matches(packets[packet].candidate()), expected)
                << text << " on sample " << facts[packet].sample << " with " << facts[packet].positions.size()
                << " segments, " << testing::PrintToString(facts[packet].positions);
            ++outcomes[expected ? 1 : 0];
        }
    }
    EXPECT_GT(outcomes[0], kFilters);
    EXPECT_GT(outcomes[1], kFilters);
}

TEST(FilterSemantics, OfADoubleNegationAreThoseWithoutIt) {
    Generator generator;
    const Facts facts = generator.facts();
    const Case packet = packetOf(facts);
    for (std::size_t i = 0; i < 200; ++i) {
        const std::string text = textOf(generator.condition(1));
        const bool plain = matches(packet, text);
        EXPECT_EQ(matches(packet, "!(" + text + ")"), !plain) << text;
        EXPECT_EQ(matches(packet, "not not (" + text + ")"), plain) << text;
        EXPECT_EQ(matches(packet, "(" + text + ") && (" + text + ")"), plain) << text;
        EXPECT_EQ(matches(packet, "(" + text + ") || (" + text + ")"), plain) << text;
    }
}

} // namespace
} // namespace posewire::filter::test
