// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/body/units.h"
#include "core/wire/codec.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The fields of packets by name, and how each is read: for filters, plots and whoever else asks for one.
namespace posewire::field {

enum class Dimension : std::uint8_t {
    None,
    Length,
    Time,
    Angle,
    Velocity,
    Acceleration,
    AngularVelocity,
    AngularAcceleration,
    Bytes,
};

/// A number in this unit, times `times` and divided by `per`, is in the unit that its dimension is compared
/// in. Two numbers, so that 30 ms become the double nearest to 0.03 s.
struct UnitInfo {
    std::string_view symbol;
    Dimension dimension = Dimension::None;
    std::string_view text; ///< "centimetres"
    double times = 1;
    double per = 1;
};

/// All units, each dimension's together; the first is the one it is compared in.
[[nodiscard]] std::span<const UnitInfo> unitTable();
/// Those of one dimension.
[[nodiscard]] std::span<const UnitInfo> unitsOf(Dimension dimension);
/// Null if nothing is written so.
[[nodiscard]] const UnitInfo* findUnit(std::string_view symbol);

[[nodiscard]] double converted(double number, const UnitInfo& from, const UnitInfo& into);

/// "a length".
[[nodiscard]] std::string_view dimensionName(Dimension dimension);
/// "m, cm or mm": how its units are written.
[[nodiscard]] std::string unitsText(Dimension dimension);

enum class Kind : std::uint8_t {
    Number,
    Text,
    Vector,    ///< three, four or nine numbers, asked for by component
    Flag,      ///< true or false
    Type,      ///< a message type: a number that also has a name
    Segment,   ///< a number that also has a name
    Point,     ///< the same
    Joint,     ///< the same
    Transport, ///< a word
    Time,      ///< seconds since 1970 UTC, or a date and time
};

/// One packet and what is known about it.
struct Candidate {
    const log::Packet& packet;
    const model::PacketDigest& digest;
    const wire::Datagram* datagram = nullptr; ///< null if it cannot be read
    const log::SenderInfo* sender = nullptr;  ///< null if not known
    log::Stamp firstStamp{};                  ///< of the first packet: where `time` begins
    const wire::WireError* fault = nullptr; ///< why it could not be decoded; null: decoded again to find out
    log::Duration setBy{}; ///< what the wall clock was ahead of the packet's stamp: for `utc`
    /// What positions of this type from this sender come in, where that is known; else what the layout says.
    std::optional<model::LengthUnit> positionUnit{};
    /// As counted up to and with the packet; null if its stream is not counted.
    const model::Stream* stream = nullptr;
};

/// One value as read; text lives as long as the packet.
struct Value {
    double number = 0;
    std::string_view text;
};

/// A packet while it is looked at; the header of one that cannot be decoded is read at most once.
struct Subject {
    explicit Subject(const Candidate& from) : candidate(from) {}

    /// Null if there is none.
    [[nodiscard]] const wire::Header* header();
    /// Returns the shape of the datagram, which is there.
    [[nodiscard]] std::size_t shape();

    const Candidate& candidate;

private:
    std::optional<wire::Header> m_header;
    std::optional<std::size_t> m_shape;
};

/// A datagram's layout: which message in which form. Each has its own set of fields.
inline constexpr std::size_t kShapes = 2 * std::variant_size_v<wire::Body>;
[[nodiscard]] std::size_t shapeOf(const wire::Datagram& datagram);

/// Message type of a shape; 0 of datagrams of unknown types.
[[nodiscard]] std::uint8_t typeOfShape(std::size_t shape);

/// Places of fields within a shape: the message itself, then its lists in wire order.
inline constexpr std::size_t kLists = 3;

/// Number of items of a list; the message itself is one.
[[nodiscard]] std::size_t itemCount(const wire::Datagram& datagram, std::size_t shape, std::size_t list);

/// Reads a field of the item at `item`; `component` counts the numbers of a vector.
using ReadItem = Value (*)(const wire::Datagram& datagram, std::size_t item, std::size_t component);
/// Reads the value at `index` of a packet's field, where there is one. Most have one value at most.
using ReadPacket = std::optional<Value> (*)(Subject& subject, std::size_t index);

/// Where a field of the payload is read: nowhere where `read` is null.
struct Place {
    ReadItem read = nullptr;
    /// Of a length: what the layout declares, unless something else is known about the sender.
    std::optional<model::LengthUnit> length{};
};
using Places = std::array<std::array<Place, kLists>, kShapes>;

/// A field by its name. Several layouts may have one of the same name and kind; the name means all of them.
struct FieldInfo {
    std::string name;      ///< "position"
    std::string qualifier; ///< the list it is in, "header", or empty
    Kind kind = Kind::Number;
    std::size_t components = 1;
    bool isFloat = false;                  ///< constants are rounded to 32 bits to compare with it
    bool isTrueByValue = false;            ///< alone it means "not zero" rather than "present"
    bool isJudged = false;                 ///< what comes after a packet may yet change it
    std::string unit{};                    ///< that it is compared in
    std::string unitSent{};                ///< where it is sent in another one: "cm (01), m (02)"
    Dimension dimension = Dimension::None; ///< of numbers that a unit may be written with
    const UnitInfo* read = nullptr; ///< the unit of what `readPacket` or `places` give; of lengths see Place
    std::string text{};             ///< where types differ, each with its types
    std::vector<std::string_view> words{}; ///< its possible values, if they are words
    std::vector<std::uint8_t> types{};     ///< message types that have it, in order; empty for packet fields
    ReadPacket readPacket = nullptr;       ///< of a packet field
    Places places{};                       ///< of a field of the payload
    std::optional<Places> named{};         ///< of what has names: reads the number that a name means

    [[nodiscard]] bool isOfItems() const { return readPacket == nullptr; }
    /// What is compared may be another number than what was sent.
    [[nodiscard]] bool isConverted() const;
};

/// Before a name: the number as it was sent, in the sender's unit.
inline constexpr std::string_view kAsSent = "wire.";

/// All fields: the computed ones, those of the header, those of the messages.
[[nodiscard]] const std::vector<FieldInfo>& fieldTable();

/// Those that the layouts of core/wire declare, found by walking them.
[[nodiscard]] std::vector<FieldInfo> wireFields();

/// The number that a name of a segment, point or joint means: a segment's body id, from 1, or the number of a
/// prop or finger; empty if it is not a name. Ignores case and spaces.
[[nodiscard]] std::optional<double> numberNamed(Kind kind, std::string_view name);
/// All names, in the order of their numbers, from 1; none for kinds that have no names.
[[nodiscard]] std::span<const std::string_view> namesOf(Kind kind);

/// What a name in a filter may mean: fields of that name, and one of their components.
struct FieldMatch {
    std::vector<const FieldInfo*> fields; ///< those of the packet first
    bool hasComponent = false;
    std::size_t component = 0;
    bool isTag = false;
    std::string_view tag;               ///< of "tag.name": "name"
    bool isAsSent = false;              ///< of "wire.position.z"
    std::optional<std::uint8_t> type{}; ///< of "20.rotation.z"
};

/// The message type that a name begins with, as in "20.rotation.z"; it is taken off the name.
[[nodiscard]] std::optional<std::uint8_t> takeType(std::string_view& name);

/// Understands "sample", "position.z", "segments.position.z", "header.sample", "wire.position.z",
/// "20.rotation.z", "tag", "tag.name". No fields (and no tag) if nothing has that name.
[[nodiscard]] FieldMatch findFields(std::string_view name);

/// The names of a vector's components, as the tables of core/wire have them: "x", "y" …; those of a matrix,
/// which are no words there, are its places from "1" to "9". Empty for other numbers.
[[nodiscard]] std::span<const std::string_view> componentNames(std::size_t components);

/// The name to use for `field`: with its qualifier only if another field shares the name.
[[nodiscard]] std::string askedName(const FieldInfo& field);

/// The field name closest to one that does not exist; empty if none is close.
[[nodiscard]] std::string nearestField(std::string_view name);
/// The closest of some words.
[[nodiscard]] std::string nearestOf(std::string_view word, std::span<const std::string_view> words);

/// What fields of a kind are called, and what can be compared with them, in words.
struct KindWords {
    std::string_view name;
    std::string_view value;
};
[[nodiscard]] KindWords kindWords(Kind kind);

/// "x, y, z": the components of a vector.
[[nodiscard]] std::string componentsText(const FieldInfo& field);
/// "02 20": the message types that have the field.
[[nodiscard]] std::string typesText(const FieldInfo& field);

/// The number that a word spells: decimal, 0x…, with a sign, inf; empty if it is not a number.
[[nodiscard]] std::optional<double> numberOf(std::string_view word);

} // namespace posewire::field
