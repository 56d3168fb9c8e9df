// SPDX-License-Identifier: MIT
#pragma once

#include "core/filter/program.h"

#include <array>
#include <optional>
#include <span>

/// A signal as it is compiled: a number that is computed from packets.
namespace posewire::filter {

/// Between a signal and the filter that its packets must match.
inline constexpr std::string_view kWhere = "where";

/// The kind of a value.
struct Quantity {
    Dimension dimension = Dimension::None;
    std::string unit{};         ///< "m", "%"; empty for plain numbers
    std::size_t components = 1; ///< 3 of a vector, 4 of an orientation
    bool isConstant = false;    ///< a number as written: it takes the unit of what it is added to

    [[nodiscard]] bool isPlain() const { return unit.empty(); }
    [[nodiscard]] bool hasUnitOf(const Quantity& other) const {
        return dimension == other.dimension && unit == other.unit;
    }
};

using SignalValue = std::array<double, 4>;

enum class SignalStep : std::uint8_t {
    Constant,
    Source,
    Norm,
    Distance,
    Angle,
    Speed,
    Derivative,
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
};

struct SignalFunction {
    std::string_view name;
    SignalStep step;
    std::size_t operands;
    std::string_view about;
};
[[nodiscard]] std::span<const SignalFunction> signalFunctions();

/// A figure of a stream as its accounting has it.
struct SignalFigure {
    std::string_view name;
    Dimension dimension;
    std::string_view unit;
    std::string_view about;
    /// At the newest packet; empty if it is not known.
    std::optional<double> (*read)(const model::Stream& stream, log::Stamp now);
};
[[nodiscard]] std::span<const SignalFigure> signalFigures();
/// Null if no figure has that name.
[[nodiscard]] const SignalFigure* findFigure(std::string_view name);

/// A field, or a figure of the packet's stream, that a signal reads from one packet.
struct SignalSource {
    struct Spot {
        const FieldInfo* field = nullptr;
        Place place{};
        std::size_t list = 0;
        NamedItem::Spot item{}; ///< reads nothing: the first one
        bool isYUp = false;     ///< a whole position of types 01, 03, 04: it is turned to Z up, as others are
    };
    const SignalFigure* figure = nullptr;
    std::vector<const FieldInfo*> ofPacket{};
    std::array<std::vector<Spot>, kShapes> spots{};
    std::optional<std::size_t> component{};
    bool isAsSent = false;
    Quantity quantity{};
    std::vector<std::uint8_t> types{}; ///< messages that may have it, in order; empty: any packet
    Token token{};                     ///< as written

    /// In the units that filters compare in; empty if the packet does not have it. Items keep their places
    /// from packet to packet: the search begins at `last`, where the item was found before.
    [[nodiscard]] std::optional<SignalValue> read(Subject& packet, std::size_t& last) const;
};

struct SignalNode {
    SignalStep step = SignalStep::Constant;
    std::size_t components = 1; ///< of the operands
    double constant = 0;
    std::uint32_t left = 0;   ///< node; of a source its place in SignalTree::sources
    std::uint32_t right = 0;  ///< node
    std::uint32_t memory = 0; ///< of what remembers the sample before: its place among those
    bool isAngle = false;     ///< derivative: ±180° are the same
};

struct SignalTree {
    std::string text;              ///< as written, without spaces around it
    std::vector<SignalNode> nodes; ///< operands before what is made of them; the signal is the last
    std::vector<SignalSource> sources;
    std::uint32_t memories = 0; ///< nodes that remember the sample before
    Quantity quantity;
    std::vector<std::uint8_t> types; ///< messages that it reads, in order; empty: each packet for itself
    Filter where;                    ///< packets that it reads
};

/// Compiles a signal, or says where it is wrong.
[[nodiscard]] tl::expected<SignalTree, FilterError> parsedSignal(std::string_view text);

/// The tokens of a signal: those of a filter, and the signs of arithmetic, which have the kind Unknown.
[[nodiscard]] std::vector<Token> signalTokens(std::string_view text);

} // namespace posewire::filter
