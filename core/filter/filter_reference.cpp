// SPDX-License-Identifier: MIT
#include "core/field/field.h"
#include "core/filter/signal_tree.h"

namespace posewire::filter {

using namespace field;
namespace {

constexpr std::string_view kLanguage = R"(# Display filter

A filter is a condition that a packet meets or does not meet: a field, an operator and a constant, such as
`type == 02`. The same filters work in the window and in `posewire-cli decode --filter`.

| example | matches |
|---|---|
| `type == 02 && character == 1` | poses of character 1 |
| `sample in 100..200` | samples 100 to 200, both included |
| `type in {02, 12, 20..25}` | any of these types |
| `gap > 0 \|\| duplicate` | packets after a loss, and those that came twice |
| `segment == LeftHand && position.z > 2` | poses whose left hand is above 2 m |
| `position.z of LeftHand > 2` | the same, for short |
| `20.rotation.z of RightKnee > 90` | bent knees, by the joint angles (type 20) |
| `delta > 20 ms` | packets more than 20 ms after the one before them |
| `source contains "192.168"` | packets from these addresses |
| `tag.name matches "^Ann"` | metadata of characters whose name begins with Ann |
| `error` | whatever cannot be read |
| `error == itemsTruncated` | what cannot be read for this reason |
| `!(type in {01, 02})` | everything else |

## Operators

| operator | meaning |
|---|---|
| `==` `!=` `<` `<=` `>` `>=` | comparison with a constant; text only with `==` and `!=` |
| `in` | within a range `1..5` or a set `{1, 5..7}` |
| `contains` | text contains this, in any case |
| `matches`, `~` | text matches this regular expression (RE2 syntax); `(?i)` at its start ignores case |
| `&&`, `and` | both; binds tighter than `\|\|` |
| `\|\|`, `or` | one of them or both |
| `!`, `not` | not the condition, or the parentheses, after it |

Numbers may be decimal (`02` is 2) or hexadecimal (`0x1f`). Text is written in quotes, with `\"` and `\\` for these
characters; a single word needs none.

## Units

Lengths are compared in metres, times in seconds, angles in degrees, whatever a message sends them in: `position.z > 1`
is a metre in types 01 and 02 alike, also where a sender gives its metres as centimetres, if that is known of it. The
axes stay those of the message. A number may be written with another unit, after a space or not: `position.z > 100 cm`,
`in 1..20 ms`. `wire.` before a field of a message or the header is the number as it was sent, without a unit:
`wire.position.z > 100`, `wire.timeCode == 27837`.

)";

constexpr std::string_view kRules = R"(
## Rules

* A field alone means that the packet has it: `position`, `error`, `tag.name`. `gap` and `drops` alone mean more
  than none, and fields that are true or false mean true.
* What a packet does not have makes every comparison with it false, also `!=`. `!(position.z == 1)` matches packets
  without positions, `position.z != 1` does not.
* A field of items means any item: `position.z > 2` is true if one of them is above 2. `!(position.z > 2)` is true if
  none is.
* Conditions on items that `&&` joins speak of the same item: `segment == LeftHand && position.z > 2`. So does an
  `||` in parentheses among them. Parentheses around an `&&` make a group of its own:
  `(segment == LeftHand && position.z > 2) && (segment == RightHand && position.z > 2)`.
* `of` names one item, by the name or the number that `segment`, `point` or `joint` has: `position.z of "Left Hand"`,
  `position.x of pSacrum`, `rotation.z of RightKnee`. The number of a type before a field means packets of that type only.
* A vector is asked for by its components: x, y, z; re, i, j, k for orientations, where w, x, y, z mean the
  same; 1 to 9 for matrices.
* Comparisons with a value that is not a number are false. `position == NaN` finds such values.
* A name that several messages have means each of them; `points.position.x` and `header.sample` say which.
  Where the header has a field of the same name, the constant decides by its kind.
* Segments are named in any case, in one word or in quotes (`LeftHand`, `"Left Hand"`, `Prop1`, `LeftFirstPP`), or
  numbered as on the wire. So are points (`point == pSacrum`, `child == jRightKnee`) and joints (`joint == jRightKnee`).
* `tag` means the names of the metadata tags, `tag.color` for the value of the tag `color`.
)";

constexpr std::string_view kSignals = R"(
## Signals

Plots and `posewire-cli query` read numbers over time, written in the same language: a field (`size`, `position.z of
Pelvis`, `20.rotation.z of RightKnee`), a figure of a stream (`2.jitter`), a function of them, or arithmetic. Without `of` a
field of items is that of the first one. `where` and a filter after all of it choose packets: `2.rate where character == 1`.

| example | is |
|---|---|
| `norm(velocity of LeftFoot)` | how fast the foot moves as the sender says (type 21) |
| `distance(position of LeftHand, position of RightHand)` | between the hands, in metres |
| `angle(orientation of Pelvis, orientation of Head)` | between two orientations |
| `speed(2.position of Pelvis) - norm(21.velocity of Pelvis)` | computed against sent |
| `derivative(20.rotation.z of RightKnee)` | °/s |
| `(position.z of Head - position.z of Pelvis) / 2 + 10 cm` | with units |

* `+` and `-` take two numbers of one unit; a plain number takes the unit of the other side. `*` and `/` take a plain
  number; two numbers of one unit divide to a plain one.
* Values of several message types belong together if character and sample counter are the same. A field that several
  types have is read from one of them as long as that goes on; `2.position` says from which. In functions positions are all
  Z up; a component is that of the message's own axes. Type 05 is read whole only as `5.position`, `5.orientation`.
* `speed` and `derivative` compare a sample with the one before it, in the sender's time: samples by the rate at which its
  time code advances with the sample counter (by the time code alone in the first half second). After a missing sample,
  or a restart of the counter, they have no value. Angles go the short way round.

)";

std::string kindOf(const FieldInfo& field) {
    if (field.kind != Kind::Vector) {
        return std::string(field.kind == Kind::Type ? "type" : kindWords(field.kind).name);
    }
    return field.components == 9 ? "1 … 9" : componentsText(field);
}

void writeRow(std::string& out, const FieldInfo& field, bool isOfPayload) {
    const std::string name =
        isOfPayload && !field.qualifier.empty() ? field.qualifier + '.' + field.name : field.name;
    out.append("| `").append(name).append("` | ").append(kindOf(field)).append(" | ");
    out.append(field.unit).append(" | ").append(field.unitSent).append(" | ").append(field.text);
    out.append(isOfPayload ? " | " + typesText(field) : "").append(" |\n");
}

} // namespace

std::string filterReference() {
    std::string out(kLanguage);
    out += "| measures | units |\n|---|---|\n";
    for (const UnitInfo& unit : unitTable()) {
        if (&unit == &unitsOf(unit.dimension).front()) { // a dimension's units on one line
            out.append("| ").append(dimensionName(unit.dimension)).append(" | ");
            out.append(unitsText(unit.dimension)).append(" |\n");
        }
    }
    out += kRules;
    out += "\n## Fields of every packet\n\n| field | kind | unit | on the wire | meaning "
           "|\n|---|---|---|---|---|\n";
    for (const FieldInfo& field : fieldTable()) {
        if (!field.isOfItems()) {
            writeRow(out, field, false);
        }
    }
    out += "\n## Fields of the messages\n\nThe name before the dot may be left out.\n\n"
           "| field | kind | unit | on the wire | meaning | types |\n|---|---|---|---|---|---|\n";
    for (const FieldInfo& field : fieldTable()) {
        if (field.isOfItems()) {
            writeRow(out, field, true);
        }
    }
    out += "| `tag` | text |  |  | names of the metadata tags | 12 |\n"
           "| `tag.…` | text |  |  | value of the tag of that name | 12 |\n";
    out += kSignals;
    out += "| function | is |\n|---|---|\n";
    for (const SignalFunction& function : signalFunctions()) {
        out.append("| `").append(function.name).append(function.operands == 1 ? "(a)` | " : "(a, b)` | ");
        out.append(function.about).append(" |\n");
    }
    out += "\n| figure of a stream | unit | is |\n|---|---|---|\n";
    for (const SignalFigure& figure : signalFigures()) {
        out.append("| `2.").append(figure.name).append("` | ").append(figure.unit).append(" | ");
        out.append(figure.about).append(" |\n");
    }
    return out;
}

} // namespace posewire::filter
