// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/packet_model.h"

#include <QString>

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>

/// Which packet is meant: by the selection, by a step along its stream, or by what an operator has written.
namespace posewire::gui {

/// The selected packet; where none is selected the newest one of the shown character: of poses where a
/// segment is selected, else of `preferredType`, else of what there is. Nothing where no packet came.
[[nodiscard]] std::optional<std::uint64_t> inspectedPacket(model::SessionView& view,
                                                           std::uint8_t preferredType);

/// How far a key press may walk over packets, a tenth of a second: what it looks at of a packet without
/// reading it, and what it reads.
struct WalkBounds {
    std::uint64_t looks = 4'000'000;
    std::uint64_t reads = 10'000;

    [[nodiscard]] bool look() { return looks != 0 && looks-- != 0; }
    [[nodiscard]] bool read() { return reads != 0 && reads-- != 0; }
};

enum class Direction { Backward, Forward };

/// The nearest packet of the same sender, character and type before or after one; for bytes that are no
/// datagram the nearest of their kind. Empty if there is none, or none as near as a walk may go.
[[nodiscard]] std::optional<std::uint64_t> neighbourInStream(model::SessionView& view, std::uint64_t packet,
                                                             Direction direction);

/// The kinds of packets to go to in the list.
enum class Landmark {
    Problem,
    ProblemOfSelected, ///< of the selected character, if there is one; a filter decides by itself
    SameStream,
    Mark,
    First, ///< whatever the direction
};
/// The nearest listed one before or after the selected packet. The error says that there is none.
[[nodiscard]] tl::expected<std::uint64_t, QString>
nearestListed(model::SessionView& view, const PacketModel& list, Landmark landmark, Direction direction);

/// The packet that one is compared with: the nearest before it of its stream that is the same part of its
/// sample, where parts of samples come. Nothing where there is none among as many
/// packets as a sample can have.
[[nodiscard]] std::optional<std::uint64_t> comparableBefore(model::SessionView& view, std::uint64_t packet);

/// Reads "12.5 s" as a time after the first packet and "10:42:17.508" as a time on the day of the newest one.
/// Returns nothing if the text is not a time.
[[nodiscard]] std::optional<log::Stamp> timeTarget(model::SessionView& view, const QString& text);

/// The packet that an operator means: "1204112" or "1 204 112" is a number, "+100" and "-100" count from the
/// selected packet (none: the newest one), a time means the first packet from then on. The error says what
/// may be written, or what there is.
[[nodiscard]] tl::expected<std::uint64_t, QString> packetTarget(model::SessionView& view,
                                                                const QString& text);

} // namespace posewire::gui
