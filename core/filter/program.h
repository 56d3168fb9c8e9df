// SPDX-License-Identifier: MIT
#pragma once

#include "core/filter/filter.h"
#include "core/filter/lexer.h"

#include <utility>

namespace re2 {
class RE2;
}

/// A filter as it is written and as it is compiled: conditions, and the tree that joins them.
namespace posewire::filter {

using namespace field; // of which all conditions are made

struct Test {
    using Range = std::pair<double, double>;

    Operator op = Operator::IsThere;
    bool comparesText = false;
    bool comparesNan = false;  ///< Equal and NotEqual: is it a number at all?
    std::vector<Range> ranges; ///< both ends belong; a single number is a range of one
    std::vector<std::string> texts;
    std::shared_ptr<const re2::RE2> pattern;

    [[nodiscard]] bool holds(const Value& value) const;
    /// Empty if the regular expression is right.
    [[nodiscard]] std::string setPattern(const std::string& text);

private:
    [[nodiscard]] bool holdsNumber(double number) const;
    [[nodiscard]] bool holdsText(std::string_view text) const;
};

/// An item of a list of a datagram, or the message itself.
struct ItemAt {
    const wire::Datagram& datagram;
    std::size_t shape;
    std::size_t list;
    std::size_t item;
    std::optional<model::LengthUnit> positionUnit; ///< what is known about the sender
};

/// The items that `of` names: in each list, the field that tells its items apart and the number it has then.
struct NamedItem {
    struct Spot {
        ReadItem read = nullptr; ///< null if the list has no such item
        double number = 0;

        [[nodiscard]] bool is(const wire::Datagram& datagram, std::size_t item) const {
            return read != nullptr && read(datagram, item, 0).number == number;
        }
    };
    std::array<std::array<Spot, kLists>, kShapes> spots{};
};

/// A test of one field: of the packet, of the items of the payload, or of a metadata tag.
struct Condition {
    ReadPacket readPacket = nullptr;
    Places places{}; ///< where readPacket is null and it is no tag
    std::size_t firstComponent = 0;
    std::size_t components = 1; ///< any of them will do
    bool isTag = false;
    std::string tag; ///< its value is tested; the names of all tags where empty
    Test test;
    bool comparesLengths = false;
    bool comparesJudged = false;
    std::optional<std::uint8_t> type{};      ///< of the message; of items `places` say it
    std::shared_ptr<const NamedItem> item{}; ///< null: of any item
    Test testInCentimetres;                  ///< the same where a length comes in centimetres
    Test testInMillimetres;                  ///< the same where it comes in millimetres

    [[nodiscard]] bool isOfItems() const { return readPacket == nullptr && !isTag; }
    [[nodiscard]] bool holds(Subject& subject) const;
    [[nodiscard]] bool holdsFor(const ItemAt& at) const;

private:
    [[nodiscard]] bool holdsForTags(const wire::Datagram* datagram) const;
};

/// A constant as written: `text` is what is in the quotes, or the word.
struct Constant {
    Token token;
    std::string text;
    bool isQuoted = false;
    std::optional<Token> unit{}; ///< the word after a number
    std::string unitText{};
};

/// A number and the unit that is written with it, perhaps in one word: "100 cm", "100cm".
struct Amount {
    double number = 0;
    std::string_view unit;
    Token place; ///< of the unit
};
/// Empty if it is none. The unit lies in the constant.
[[nodiscard]] std::optional<Amount> amountOf(const Constant& constant);

/// A field as written.
struct WrittenField {
    Token field;
    std::string_view fieldName;
    std::optional<Constant> item{}; ///< after `of`
};

/// The fields that are meant, which are some unless it is a tag.
[[nodiscard]] tl::expected<FieldMatch, FilterError> fieldsOf(const WrittenField& written);
/// The item that is meant; null if none is written.
[[nodiscard]] tl::expected<std::shared_ptr<const NamedItem>, FilterError> itemOf(const WrittenField& written,
                                                                                 const FieldMatch& match);

/// The kinds of names that the items of these fields have.
[[nodiscard]] std::vector<Kind> itemKinds(const FieldMatch& match);

/// A condition as written.
struct WrittenCondition : WrittenField {
    Operator op = Operator::IsThere;
    Token operatorToken;
    std::vector<std::pair<Constant, Constant>> constants; ///< pairs of the same where it is no range
};

/// Finds the field and makes the constants fit it.
[[nodiscard]] tl::expected<Condition, FilterError> understood(const WrittenCondition& written);

/// A compiled filter: a tree of nodes.
struct Program {
    enum class Join : std::uint8_t {
        Condition,
        And,
        Or,
        Not,
        AnyItem, ///< its one child holds for one item of one list
    };
    struct Node {
        Join join = Join::Condition;
        std::uint32_t condition = 0;
        std::vector<std::uint32_t> children;
        bool isOfItems = false; ///< only conditions on items below, and no Not
        bool isMixed = false;   ///< an Or of conditions, some on items and some on the packet
    };

    std::vector<Condition> conditions;
    std::vector<Node> nodes;
    std::uint32_t root = 0;

    [[nodiscard]] bool holds(Subject& subject, std::uint32_t node) const;

    std::uint32_t add(Node node) {
        nodes.push_back(std::move(node));
        return static_cast<std::uint32_t>(nodes.size() - 1);
    }

private:
    [[nodiscard]] bool holdsForAnyItem(Subject& subject, std::uint32_t node) const;
    /// Without an item no condition on items holds.
    [[nodiscard]] bool holdsForItem(Subject& subject, const ItemAt* at, std::uint32_t node) const;
};

/// The tree of a text, with its conditions on items gathered under AnyItem.
[[nodiscard]] tl::expected<Program, FilterError> parsed(std::string_view text);

} // namespace posewire::filter
