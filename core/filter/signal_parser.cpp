// SPDX-License-Identifier: MIT
#include "core/filter/signal_tree.h"

#include <algorithm>

namespace posewire::filter {
namespace {

constexpr std::size_t kOrientation = 4;

/// A part of a signal: its node, what its values are, and where it is written.
struct Operand {
    std::uint32_t node = 0;
    Quantity quantity{};
    Token place{};
};
using ParsedOperand = tl::expected<Operand, FilterError>;

tl::unexpected<FilterError> wrong(const Token& at, std::string text) {
    return tl::unexpected(FilterError{at.offset, at.length, std::move(text)});
}

/// From one to another.
Token placeFrom(const Token& first, const Token& last) {
    const std::size_t begin = std::min(first.offset, last.offset);
    return {TokenKind::Word, begin, std::max(first.end(), last.end()) - begin};
}

/// "a length", "a number in %".
std::string nameOf(const Quantity& quantity) {
    return quantity.dimension != Dimension::None ? std::string(dimensionName(quantity.dimension))
           : quantity.isPlain()                  ? "a plain number"
                                                 : "a number in " + quantity.unit;
}

Quantity measured(Dimension dimension, std::size_t components = 1) {
    return {dimension, std::string(unitsOf(dimension).front().symbol), components};
}

/// The quantity that changes by `quantity` each second.
Quantity perSecond(const Quantity& quantity) {
    using enum Dimension;
    constexpr std::array kRates{std::pair{Length, Velocity}, std::pair{Velocity, Acceleration},
                                std::pair{Angle, AngularVelocity},
                                std::pair{AngularVelocity, AngularAcceleration}};
    const auto* rate =
        std::ranges::find(kRates, quantity.dimension, [](const auto& pair) { return pair.first; });
    if (rate != kRates.end()) {
        return measured(rate->second, quantity.components);
    }
    const std::string unit = quantity.dimension == Time ? ""
                             : quantity.isPlain()       ? "1/s"
                                                        : quantity.unit + "/s";
    return {None, unit, quantity.components};
}

class SignalParser {
public:
    explicit SignalParser(std::string_view text) : m_text(text), m_tokens(signalTokens(text)) {}

    tl::expected<SignalTree, FilterError> run() {
        const auto root = sum(0);
        if (!root) {
            return tl::unexpected(root.error());
        }
        if (root->quantity.components != 1) {
            const bool isTurn = root->quantity.components == kOrientation;
            return wrong(root->place, "A signal is one number: write a component, such as `" +
                                          std::string(isTurn ? "orientation.w" : "position.z") + "`, or `" +
                                          (isTurn ? "angle(a, b)`." : "norm(…)`."));
        }
        m_tree.text = m_text.substr(root->place.offset, root->place.length);
        m_tree.quantity = root->quantity;
        if (auto taken = condition(); !taken) {
            return tl::unexpected(taken.error());
        }
        for (const SignalSource& source : m_tree.sources) {
            m_tree.types.insert(m_tree.types.end(), source.types.begin(), source.types.end());
        }
        std::ranges::sort(m_tree.types);
        m_tree.types.erase(std::unique(m_tree.types.begin(), m_tree.types.end()), m_tree.types.end());
        if (m_tree.sources.empty()) {
            return wrong(root->place,
                         "This reads nothing from packets: write a field, such as `position.z`.");
        }
        const SignalSource& first = m_tree.sources.front();
        if (m_tree.types.empty() && m_tree.memories != 0) {
            return wrong(first.token, "Packets of all types have this: write of which, such as `2." +
                                          std::string(first.token.in(m_text)) + "`.");
        }
        return std::move(m_tree);
    }

private:
    [[nodiscard]] const Token& here() const { return m_tokens[m_at]; }
    [[nodiscard]] bool isSign(std::string_view signs) const {
        return here().kind == TokenKind::Unknown && here().length == 1 &&
               signs.find(here().in(m_text)) != std::string_view::npos;
    }
    [[nodiscard]] tl::unexpected<FilterError> unexpected(const std::string& wanted) const {
        const TokenKind kind = here().kind;
        return wrong(here(), kind == TokenKind::End ? "The signal ends early: " + wanted + " is missing."
                             : kind == TokenKind::Unfinished ? std::string("This text has no closing quote.")
                                                             : "Expected " + wanted + " here.");
    }
    Operand add(SignalNode node, Quantity quantity, const Token& place) {
        const bool remembers = node.step == SignalStep::Speed || node.step == SignalStep::Derivative;
        node.memory = remembers ? m_tree.memories++ : 0;
        m_tree.nodes.push_back(node);
        return {static_cast<std::uint32_t>(m_tree.nodes.size() - 1), std::move(quantity), place};
    }

    /// The filter after `where`.
    tl::expected<void, FilterError> condition() {
        if (here().kind == TokenKind::End) {
            return {};
        }
        if (here().in(m_text) != kWhere) {
            return unexpected("`+`, `-`, `*`, `/` or `where`");
        }
        const std::size_t begin = here().end();
        if (m_tokens[++m_at].kind == TokenKind::End) {
            return unexpected("a filter, such as `character == 1`");
        }
        auto filter = Filter::compile(m_text.substr(begin));
        if (!filter) {
            filter.error().offset += begin;
            return tl::unexpected(filter.error());
        }
        m_tree.where = *std::move(filter);
        m_tree.text =
            m_text.substr(m_tokens.front().offset, m_tokens.back().offset - m_tokens.front().offset);
        m_tree.text.erase(m_tree.text.find_last_not_of(" \t\r\n") + 1);
        return {};
    }

    ParsedOperand sum(std::size_t depth) {
        ParsedOperand left = product(depth);
        while (left && isSign("+-")) {
            const Token sign = m_tokens[m_at++];
            const ParsedOperand right = product(depth);
            left = right ? added(*left, sign, *right) : right;
        }
        return left;
    }

    ParsedOperand product(std::size_t depth) {
        ParsedOperand left = one(depth);
        while (left && isSign("*/")) {
            const Token sign = m_tokens[m_at++];
            const ParsedOperand right = one(depth);
            left = right ? multiplied(*left, sign, *right) : right;
        }
        return left;
    }

    ParsedOperand added(const Operand& left, const Token& sign, const Operand& right) {
        const Quantity& a = left.quantity;
        const Quantity& b = right.quantity;
        const bool isSum = sign.in(m_text) == "+";
        const Token whole = placeFrom(left.place, right.place);
        if (a.components == kOrientation || b.components == kOrientation) {
            return wrong(whole, "Orientations have no sum or difference: write `angle(a, b)`.");
        }
        if (a.components != b.components) {
            return wrong(right.place, "One side of `" + std::string(sign.in(m_text)) +
                                          "` is a vector and the other a number.");
        }
        if (!a.hasUnitOf(b) && !a.isConstant && !b.isConstant) {
            return wrong(right.place, std::string(isSum ? "Added to " : "Subtracted from ") + nameOf(a) +
                                          ", this must be one as well: it is " + nameOf(b) + ".");
        }
        return add({isSum ? SignalStep::Add : SignalStep::Subtract, a.components, 0, left.node, right.node},
                   a.isConstant ? b : a, whole);
    }

    ParsedOperand multiplied(const Operand& left, const Token& sign, const Operand& right) {
        const Quantity& a = left.quantity;
        const Quantity& b = right.quantity;
        const bool isProduct = sign.in(m_text) == "*";
        const Token whole = placeFrom(left.place, right.place);
        if (isProduct && a.components == 1 && b.components == 3) {
            return multiplied(right, sign, left);
        }
        if (std::max(a.components, b.components) == kOrientation || b.components != 1) {
            return wrong(right.place, "Vectors are multiplied and divided by numbers only.");
        }
        if (isProduct && !a.isPlain() && !b.isPlain()) {
            return wrong(right.place, "One side of `*` must be a plain number: these are " + nameOf(a) +
                                          " and " + nameOf(b) + ".");
        }
        if (!isProduct && !b.isPlain() && !a.hasUnitOf(b)) {
            return wrong(right.place, "Here must be a plain number, or " + nameOf(a) +
                                          " as on the left: this is " + nameOf(b) + ".");
        }
        Quantity quantity = a.isPlain() && isProduct ? b : a;
        quantity.components = a.components;
        quantity.isConstant = a.isConstant && b.isConstant;
        if (!isProduct && !b.isPlain()) {
            quantity = {Dimension::None, "", a.components};
        }
        return add(
            {isProduct ? SignalStep::Multiply : SignalStep::Divide, a.components, 0, left.node, right.node},
            std::move(quantity), whole);
    }

    ParsedOperand one(std::size_t depth) {
        const Token first = here();
        if (depth > Filter::kDeepest) {
            return wrong(first, "Parentheses are nested too deeply.");
        }
        if (isSign("-")) {
            ++m_at;
            const ParsedOperand operand = one(depth + 1);
            if (operand && operand->quantity.components == kOrientation) {
                return wrong(operand->place, "An orientation has no sign.");
            }
            return operand ? add({SignalStep::Negate, operand->quantity.components, 0, operand->node},
                                 operand->quantity, placeFrom(first, operand->place))
                           : operand;
        }
        if (first.kind == TokenKind::Open) {
            ++m_at;
            ParsedOperand inner = sum(depth + 1);
            if (inner && here().kind != TokenKind::Close) {
                return unexpected("`)`");
            }
            return inner ? Operand{inner->node, inner->quantity, placeFrom(first, m_tokens[m_at++])} : inner;
        }
        if (first.kind != TokenKind::Word) {
            return unexpected("a field, such as `position.z`");
        }
        if (m_tokens[m_at + 1].kind == TokenKind::Open) {
            return call(depth);
        }
        std::string_view name = first.in(m_text);
        const bool isNumber = !takeType(name) && amountOf({first, std::string(name)});
        return isNumber ? constant() : source();
    }

    ParsedOperand constant() {
        Constant written{m_tokens[m_at++], {}};
        written.text = written.token.in(m_text);
        if (here().kind == TokenKind::Word && numberOf(written.text) &&
            findUnit(here().in(m_text)) != nullptr) {
            written.unit = m_tokens[m_at++];
            written.unitText = written.unit->in(m_text);
        }
        const Token place = placeFrom(written.token, written.unit.value_or(written.token));
        const Amount amount = *amountOf(written);
        const UnitInfo* unit = findUnit(amount.unit);
        if (!amount.unit.empty() && unit == nullptr) {
            return wrong(amount.place, "There is no unit `" + std::string(amount.unit) + "`.");
        }
        if (unit == nullptr) {
            return add({SignalStep::Constant, 1, amount.number}, {.isConstant = true}, place);
        }
        const double number = converted(amount.number, *unit, unitsOf(unit->dimension).front());
        return add({SignalStep::Constant, 1, number}, measured(unit->dimension), place);
    }

    ParsedOperand call(std::size_t depth) {
        const Token name = m_tokens[m_at];
        m_at += 2;
        const auto functions = signalFunctions();
        const auto function =
            std::find_if(functions.begin(), functions.end(),
                         [&](const SignalFunction& one) { return one.name == name.in(m_text); });
        if (function == functions.end()) {
            std::vector<std::string_view> names;
            std::ranges::transform(functions, std::back_inserter(names), &SignalFunction::name);
            const std::string near = nearestOf(name.in(m_text), names);
            return wrong(name, "There is no function `" + std::string(name.in(m_text)) + "`" +
                                   (near.empty() ? "." : "; did you mean `" + near + "`?"));
        }
        std::array<Operand, 2> operands;
        for (std::size_t i = 0; i < function->operands; ++i) {
            if (i != 0 && here().kind != TokenKind::Comma) {
                return unexpected("`,` and a second value");
            }
            m_at += i;
            const ParsedOperand operand = sum(depth + 1);
            if (!operand) {
                return operand;
            }
            operands[i] = *operand;
        }
        if (here().kind != TokenKind::Close) {
            return unexpected("`)`");
        }
        return applied(*function, operands, placeFrom(name, m_tokens[m_at++]));
    }

    ParsedOperand applied(const SignalFunction& function, const std::array<Operand, 2>& operands,
                          const Token& place) {
        using enum SignalStep;
        const Quantity& a = operands[0].quantity;
        const Quantity& b = operands[1].quantity;
        const bool isVector = a.components == 3;
        const bool isTurn = a.components == kOrientation;
        const bool isPair = a.components == b.components && a.hasUnitOf(b);
        const SignalNode node{function.step, a.components, 0, operands[0].node, operands[1].node};
        const auto takes = [&](std::size_t operand, std::string_view what) {
            return wrong(operands[operand].place,
                         "`" + std::string(function.name) + "` takes " + std::string(what) + ".");
        };
        switch (function.step) {
        case Norm:
            return isVector || isTurn ? add(node, {a.dimension, a.unit}, place)
                                      : ParsedOperand(takes(0, "a vector, such as `position`"));
        case Distance:
            return isVector && isPair ? add(node, {a.dimension, a.unit}, place)
                                      : ParsedOperand(takes(isVector ? 1 : 0, "two vectors of one unit"));
        case Angle: {
            const bool canTurn = isTurn || (isVector && a.dimension != Dimension::Angle);
            return canTurn && isPair
                       ? add(node, measured(Dimension::Angle), place)
                       : ParsedOperand(takes(canTurn ? 1 : 0, "two orientations, or two vectors"));
        }
        case Speed:
            return isTurn ? add(node, measured(Dimension::AngularVelocity), place)
                   : isVector && a.dimension == Dimension::Length
                       ? add(node, measured(Dimension::Velocity), place)
                       : ParsedOperand(takes(0, "a position or an orientation"));
        default: {
            SignalNode derivative = node;
            derivative.isAngle = a.dimension == Dimension::Angle;
            return !isTurn ? add(derivative, perSecond(a), place)
                           : ParsedOperand(takes(0, "numbers: of an orientation write `speed`"));
        }
        }
    }

    ParsedOperand source() {
        WrittenField written{here(), here().in(m_text)};
        Token last = m_tokens[m_at++];
        std::string_view name = written.fieldName;
        const auto type = takeType(name);
        SignalSource source;
        source.token = written.field;
        source.figure = findFigure(name);
        if (source.figure != nullptr) {
            if (!type) {
                const std::string asked(name);
                return wrong(written.field, "Each stream has its `" + asked +
                                                "`: write of which type, such as `2." + asked + "`.");
            }
            source.quantity = {source.figure->dimension, std::string(source.figure->unit)};
            source.types = {*type};
        } else {
            if (here().in(m_text) == kOf) {
                last = m_tokens[++m_at];
                const bool isQuoted = last.kind == TokenKind::Quoted;
                if (!isQuoted && last.kind != TokenKind::Word) {
                    return unexpected("a segment, point or joint, such as LeftHand,");
                }
                const std::string_view item = last.in(m_text);
                written.item = Constant{last, isQuoted ? unquoted(item) : std::string(item), isQuoted};
                ++m_at;
            }
            if (auto set = setField(written, source); !set) {
                return tl::unexpected(set.error());
            }
        }
        m_tree.sources.push_back(std::move(source));
        const Quantity quantity = m_tree.sources.back().quantity;
        return add({SignalStep::Source, quantity.components, 0,
                    static_cast<std::uint32_t>(m_tree.sources.size() - 1)},
                   quantity, placeFrom(written.field, last));
    }

    tl::expected<void, FilterError> setField(const WrittenField& written, SignalSource& source) {
        const auto match = fieldsOf(written);
        if (!match) {
            return tl::unexpected(match.error());
        }
        const auto item = itemOf(written, *match);
        if (!item) {
            return tl::unexpected(item.error());
        }
        const std::string name(written.fieldName);
        const auto isText = [](const FieldInfo* field) {
            return field->kind == Kind::Text || field->kind == Kind::Transport;
        };
        const auto first = std::ranges::find_if_not(match->fields, isText);
        if (match->isTag || first == match->fields.end()) {
            return wrong(written.field, "`" + name + "` is text: signals are made of numbers.");
        }
        const FieldInfo& field = **first;
        if (!match->hasComponent && field.components > kOrientation) {
            return wrong(written.field, "`" + name + "` has the components " + componentsText(field) +
                                            ": write `" + name + "." +
                                            std::string(componentNames(field.components)[0]) + "`.");
        }
        source.isAsSent = match->isAsSent;
        source.component = match->hasComponent ? std::optional(match->component) : std::nullopt;
        source.quantity = {match->isAsSent ? Dimension::None : field.dimension,
                           match->isAsSent ? std::string() : field.unit,
                           match->hasComponent ? 1 : field.components};
        for (const FieldInfo* one : match->fields) {
            if (isText(one) || one->components != field.components || one->dimension != field.dimension) {
                continue;
            }
            if (!one->isOfItems() && !*item) {
                source.ofPacket.push_back(one);
                continue;
            }
            addSpots(*one, match->type, item->get(), source);
        }
        if (!source.ofPacket.empty()) {
            source.types.clear();
            source.types.assign(match->type ? 1 : 0, match->type.value_or(0));
        }
        return {};
    }

    static void addSpots(const FieldInfo& field, std::optional<std::uint8_t> type, const NamedItem* item,
                         SignalSource& source) {
        for (std::size_t shape = 0; shape < kShapes; ++shape) {
            const std::uint8_t own = typeOfShape(shape);
            const bool isWhole = source.quantity.components != 1 && !source.isAsSent;
            if (isWhole && own == wire::PoseUnity::kType && !type) { // relative to parents, in other axes
                continue;
            }
            const bool isYUp = isWhole && field.dimension == Dimension::Length &&
                               own <= wire::TagPositions::kType && own != wire::PoseQuaternion::kType;
            for (std::size_t list = 0; list < kLists; ++list) {
                const Place& place = field.places[shape][list];
                const auto spot = item != nullptr ? item->spots[shape][list] : NamedItem::Spot{};
                if (place.read != nullptr && (item == nullptr || spot.read != nullptr) &&
                    own == type.value_or(own)) {
                    source.spots[shape].push_back({&field, place, list, spot, isYUp});
                    source.types.push_back(own);
                }
            }
        }
    }

    std::string_view m_text;
    std::vector<Token> m_tokens;
    std::size_t m_at = 0;
    SignalTree m_tree;
};

/// "m/s", "2m/s".
bool isWithUnit(std::string_view word) {
    return findUnit(word.substr(std::min(word.find_first_not_of("+-.0123456789"), word.size()))) != nullptr;
}

/// A word without the arithmetic in it, as in "position.z/2": "/" may also be in a unit.
std::size_t lengthWithoutDivision(std::string_view word) {
    std::size_t longest = word.find('/');
    for (std::size_t end = longest; end != std::string_view::npos && end < word.size();) {
        end = std::min(word.find('/', end + 1), word.size());
        longest = isWithUnit(word.substr(0, end)) ? end : longest;
    }
    return std::min(longest, word.size());
}

} // namespace

std::vector<Token> signalTokens(std::string_view text) {
    std::vector<Token> all;
    for (Token token : tokens(text)) {
        const auto take = [&](TokenKind kind, std::size_t length) {
            all.push_back({kind, token.offset, length});
            token.offset += length;
            token.length -= length;
        };
        while (token.kind == TokenKind::Word && token.length != 0) {
            const std::string_view word = token.in(text);
            const bool isSign = word[0] == '/' || ((word[0] == '-' || word[0] == '+') && word.size() > 1);
            const TokenKind before = all.empty() ? TokenKind::Open : all.back().kind;
            const bool isBetween =
                before == TokenKind::Word || before == TokenKind::Quoted || before == TokenKind::Close;
            std::string_view name = word.substr(isSign ? 1 : 0);
            if (isSign && (isBetween || takeType(name) || !amountOf({token, std::string(word)}))) {
                take(TokenKind::Unknown, 1);
            } else {
                take(TokenKind::Word, lengthWithoutDivision(word));
            }
        }
        if (token.kind != TokenKind::Word) {
            all.push_back(token);
        }
    }
    return all;
}

tl::expected<SignalTree, FilterError> parsedSignal(std::string_view text) {
    if (text.size() > Filter::kLongestText) {
        return tl::unexpected(
            FilterError{Filter::kLongestText, text.size() - Filter::kLongestText,
                        "A signal has at most " + std::to_string(Filter::kLongestText) + " bytes."});
    }
    return SignalParser(text).run();
}

} // namespace posewire::filter
