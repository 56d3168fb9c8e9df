// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/sender_table.h"
#include "core/log/time.h"
#include "core/model/accounting/count_history.h"
#include "core/model/accounting/stream.h"
#include "core/model/body/body_measure.h"
#include "core/model/body/pose_solver.h"
#include "core/model/content/content_watch.h"
#include "core/model/keys.h"
#include "core/model/session/detection.h"
#include "core/model/session/metadata.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace posewire::model {

struct Character;
class NullPoseHistory;

/// One sender.
struct Sender {
    explicit Sender(log::SenderId senderId) : id(senderId) {}

    log::SenderId id;
    log::SenderInfo info;
    log::SenderTable::Held held; ///< so that the log knows it by the same number as long as it is listed
    std::vector<const Character*> characters{}; ///< in order of first appearance
    std::uint64_t datagrams = 0;
    std::uint64_t bytes = 0;
    std::uint64_t malformed = 0; ///< begins with MXTP and cannot be decoded
    std::uint64_t foreign = 0;   ///< does not begin with MXTP
    std::uint64_t foreignBytes = 0;
    std::uint64_t skippedBytes = 0;
    std::uint64_t kernelDrops = 0;
    bool hasUncountedDrops = false; ///< see PacketFlags::dropsUncounted
    log::Stamp lastStamp{};
    CountHistory history; ///< of malformed datagrams alone, also those without a header
    /// What the newest foreign datagram begins with, or the skipped bytes that it began with.
    std::vector<std::byte> foreignHead;
    Detector detector;
    SenderOverride overrides{};
    /// See Content.
    struct Clock {
        std::int32_t aheadMs = 0;          ///< of this computer's, as the time of day
        std::int32_t lookMs = 0;           ///< the same at the last look
        std::uint64_t packet = UINT64_MAX; ///< of that
        std::int32_t toldMs = 0;           ///< by which it is apart from the others'
        int looks = 0;
    } clock{};

    void takeMalformed(log::Stamp stamp);
    void takeForeign(wire::Bytes datagram);
    void takeSkipped(wire::Bytes between);
    [[nodiscard]] ForeignText address() const { return info.place(); }
    /// The host with the transport; nothing for a file.
    [[nodiscard]] std::optional<std::string> host() const;
    /// "7b 22 61": the first 16 bytes of foreignHead in hexadecimal.
    [[nodiscard]] std::string foreignText() const;
    /// A format that it resembles; nothing if there is none.
    [[nodiscard]] words::Fact foreignFormat() const;
    /// All that came of it and is not MXTP.
    [[nodiscard]] words::Fact foreignFact() const;

    /// As declared, else as detected.
    [[nodiscard]] Revision revision() const {
        return overrides.revision.value_or(detector.result().revision);
    }
    /// Of types 02, 05, 21 and 24: the one rule for all who convert.
    [[nodiscard]] LengthUnit positionUnit() const {
        return overrides.positionUnit.value_or(detector.result().positionUnit);
    }
    /// Of any type. Those with Y up have a unit of their own, usually centimetres, and what describes the
    /// body (13) is in metres by definition.
    [[nodiscard]] LengthUnit positionUnit(std::uint8_t type) const;
    /// Of types 02, 21 and 22; other types have one of their own.
    [[nodiscard]] UpAxis up() const { return overrides.up.value_or(detector.up()); }
    [[nodiscard]] bool isYUp(std::uint8_t type) const {
        return up() == UpAxis::Y && (type == 2 || type == 21 || type == 22);
    }
    [[nodiscard]] std::vector<words::Fact> contradictions() const {
        return detector.contradictions(overrides);
    }
    [[nodiscard]] bool isPerforming() const { return !characters.empty(); }
};

/// One character of a sender.
struct Character {
    explicit Character(const CharacterKey& characterKey) : key(characterKey) {}

    CharacterKey key;
    std::vector<const Stream*> streams{}; ///< in order of first appearance
    std::size_t ordinal = 0;              ///< for default colours alone; that of `before`, where there is one
    Metadata metadata;
    std::shared_ptr<NullPoseHistory> nullPoses; ///< null until a scale message has come
    /// When the null pose first came that was last looked at for contradictions.
    std::optional<log::Stamp> judgedNullPose{};
    bool isNullPoseUsable = false; ///< the newest is whole, and does not contradict itself
    ContentWatch content;
    BodyMeasure measuredBody; ///< for as long as no scale message has come
    BendMeasure bends;
    log::Stamp lastStamp{};
    bool isConfirmed = true; ///< else its datagrams are counted, and it is on no list of performers
    std::uint64_t firstPacket = 0;
    std::uint64_t lastPacket = 0;
    std::optional<CharacterKey> before; ///< see Roster::predecessor
    std::optional<CharacterKey> after;  ///< who has this one as `before`
    /// Of those before it that are not listed any more: their restarts, and when the first of them appeared.
    std::uint64_t formerRestarts = 0;
    std::optional<std::uint64_t> formerFirstPacket;

    [[nodiscard]] std::uint64_t counterRestarts() const;
};

} // namespace posewire::model
