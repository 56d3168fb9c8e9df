// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"
#include "core/log/time.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/session/session_view.h"
#include "core/wire/header.h"

#include <QString>
#include <QStringList>

#include <optional>

namespace posewire::gui {

/// Holds nothing of the packet's memory, so it may be kept.
struct PacketFacts {
    std::uint64_t number = 0;
    log::Stamp stamp{};
    log::SenderId sender{};
    std::size_t size = 0;
    model::PacketDigest digest;
    std::optional<wire::Header> header;
    QString findings; ///< all that is wrong or odd, in words; empty if nothing is
};

/// Nothing if the log has dropped the packet or the session has not followed so far.
[[nodiscard]] std::optional<PacketFacts> packetFacts(model::SessionView& view, std::uint64_t number);

/// True for bytes that are no datagram.
[[nodiscard]] bool isStrange(const model::PacketDigest& digest);

/// Error: cannot be read. Warning: odd, or something is missing before it. Unknown: neither.
[[nodiscard]] Health packetHealth(const PacketFacts& facts);

/// "02 Pose, quaternion", "foreign".
[[nodiscard]] QString packetType(const PacketFacts& facts);

/// Place among the datagrams of its sample, "2/3"; "2/?" where the last of them is not near it in the log.
[[nodiscard]] QString packetPart(model::SessionView& view, const PacketFacts& facts);

/// What is odd about its place in the stream, a sentence each: what is missing before it and whose loss that
/// was, with the evidence; whether it came twice or out of order.
[[nodiscard]] QStringList sequenceFindings(model::SessionView& view, std::uint64_t number);

enum class NoteFor {
    Eye, ///< with symbols: "▲ gap: 1 missing"
    Ear, ///< for screen readers: "warning, gap: 1 missing"
};
/// The column that says it in words: a mark, findings, then the operator's comment.
[[nodiscard]] QString packetNote(model::SessionView& view, const PacketFacts& facts, NoteFor reader);

} // namespace posewire::gui
