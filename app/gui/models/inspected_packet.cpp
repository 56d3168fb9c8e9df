// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/inspected_packet.h"

#include "app/gui/models/shown_character.h"
#include "core/model/session/ingest.h"
#include "core/wire/messages.h"
#include "core/wire/type_table.h"

namespace posewire::gui {

namespace {

std::optional<std::uint64_t> newestOf(model::SessionView& view, const model::CharacterKey& key,
                                      std::uint8_t type) {
    const model::Message* message = view.message(key, type);
    return message != nullptr ? std::optional(message->packet) : std::nullopt;
}

std::optional<std::uint64_t> newestOf(model::SessionView& view, const model::CharacterKey& key,
                                      std::uint8_t preferredType, bool wantsSegment) {
    if (!wantsSegment && preferredType != 0) {
        if (const auto found = newestOf(view, key, preferredType)) {
            return found;
        }
    }
    if (const auto found = newestOf(view, key, wire::PoseQuaternion::kType)) {
        return found;
    }
    for (const wire::TypeInfo& info : wire::typeTable()) {
        const auto found =
            info.isSampled && wire::listsSegments(info.type) ? newestOf(view, key, info.type) : std::nullopt;
        if (found) {
            return found;
        }
    }
    for (const wire::TypeInfo& info : wire::typeTable()) {
        if (const auto found = newestOf(view, key, info.type)) {
            return found;
        }
    }
    return std::nullopt;
}

} // namespace

std::optional<std::uint64_t> inspectedPacket(model::SessionView& view, std::uint8_t preferredType) {
    const model::Selection& selection = view.selection();
    if (selection.packet) {
        return selection.packet;
    }
    if (const auto key = shownCharacter(view)) {
        if (const auto found = newestOf(view, *key, preferredType, selection.segment >= 0)) {
            return found;
        }
    }
    return view.end() == 0 ? std::nullopt : std::optional(newestVisiblePacket(view));
}

std::optional<std::uint64_t> neighbourInStream(model::SessionView& view, std::uint64_t packet,
                                               int direction) {
    const model::PacketDigests& digests = view.digests();
    const model::PacketDigest* own = digests.find(packet);
    const auto ownPacket = view.packet(packet);
    if (own == nullptr || !ownPacket) {
        return std::nullopt;
    }
    const bool isDatagram = own->type != 0;
    const std::uint64_t last = digests.end();
    for (std::uint64_t at = packet + static_cast<std::uint64_t>(direction);
         at >= digests.begin() && at < last; at += static_cast<std::uint64_t>(direction)) {
        const model::PacketDigest& digest = *digests.find(at);
        const bool isAlike = isDatagram ? digest.type == own->type && digest.character == own->character
                                        : digest.kind == own->kind;
        if (isAlike) {
            if (const auto found = view.packet(at); found && found->sender == ownPacket->sender) {
                return at;
            }
        }
    }
    return std::nullopt;
}

} // namespace posewire::gui
