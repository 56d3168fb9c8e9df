// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/field_document.h"

namespace posewire::gui {

/// "Segment 7 · Head", "Free acceleration".
[[nodiscard]] QString fieldTitle(const FieldDocument& document, std::int32_t node);

/// Names: "Segment 7 · Head", "Point 1.13 · pSacrum", "Tracker 11 · Right Hand".
[[nodiscard]] QString itemTitle(const FieldDocument& document, std::int32_t item);
/// "7 · Head", "1.13 · pSacrum".
[[nodiscard]] QString identifierText(const FieldDocument& document, std::int32_t node);

/// What the wire says: shortest digits that read back the same, with the wire's unit.
[[nodiscard]] QString wireValue(const FieldDocument& document, std::int32_t node);

/// What it means: Z-up metres, degrees, clocks, names.
[[nodiscard]] QString convertedValue(const FieldDocument& document, std::int32_t node);

/// One line of documentation.
[[nodiscard]] QString fieldMeaning(const FieldDocument& document, std::int32_t node);
[[nodiscard]] QString fieldSection(const FieldDocument& document, std::int32_t node);

/// "float32 at byte 232", "3 × float32 at bytes 228 to 239".
[[nodiscard]] QString fieldPlace(const FieldDocument& document, std::int32_t node);

/// "02 Pose, quaternion"; for what is no datagram, what it is.
[[nodiscard]] QString documentTitle(const FieldDocument& document);

/// What there is to say about the packet as a whole: size and place in its stream; frame of its values and
/// where real senders and the specification differ; revisions and section.
[[nodiscard]] QStringList documentLines(const FieldDocument& document);

/// `node` of `document` less `otherNode` of `other`, with unit; "" where both are the same, "differs" where
/// there is no difference to take.
[[nodiscard]] QString difference(const FieldDocument& document, std::int32_t node, const FieldDocument& other,
                                 std::int32_t otherNode);

} // namespace posewire::gui
