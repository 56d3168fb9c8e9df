// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_choice.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/session/accounts.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/wire/messages.h"
#include "core/wire/type_table.h"

#include <QDateTime>
#include <QRegularExpression>

#include <algorithm>
#include <iterator>
#include <vector>

namespace posewire::gui {

namespace {

/// The newest packet of the first of these types that has one: the preferred type, unless a segment is
/// wanted; poses; what else lists segments; whatever there is.
std::optional<std::uint64_t> newestOf(model::SessionView& view, const model::CharacterKey& key,
                                      std::uint8_t preferredType, bool wantsSegment) {
    std::vector<std::uint8_t> types{wire::PoseQuaternion::kType};
    if (!wantsSegment && preferredType != 0) {
        types.insert(types.begin(), preferredType);
    }
    for (const wire::TypeInfo& info : wire::typeTable()) {
        if (info.isSampled && wire::listsSegments(info.type)) {
            types.push_back(info.type);
        }
    }
    std::ranges::transform(wire::typeTable(), std::back_inserter(types), &wire::TypeInfo::type);
    for (const std::uint8_t type : types) {
        if (const model::Message* message = view.messages().message(key, type)) {
            return message->packet;
        }
    }
    return std::nullopt;
}

using std::chrono::milliseconds;
using Target = tl::expected<std::uint64_t, QString>;

constexpr double kMostSeconds = 1e9;

Target atStamp(model::SessionView& view, log::Stamp stamp, const QString& text) {
    const std::uint64_t number = view.packetFrom(stamp);
    if (number == view.end()) {
        return tl::unexpected(tr("No packet has come at %1 or later.").arg(text));
    }
    return number;
}

QString withoutSpaces(QString text) {
    static const QRegularExpression spaces(QStringLiteral("\\s"));
    return text.remove(spaces);
}

Target bounded(model::SessionView& view, std::uint64_t number) {
    if (number < view.begin() || number >= view.end()) {
        return tl::unexpected(
            tr("The log has packets %1 to %2.").arg(grouped(view.begin()), grouped(view.end() - 1)));
    }
    return number;
}

Target relative(model::SessionView& view, const QString& digits, bool isForward) {
    bool isNumber = false;
    const std::uint64_t distance = digits.toULongLong(&isNumber);
    const std::uint64_t from = view.choices().selection.packet.value_or(view.end() - 1);
    if (!isNumber || (!isForward && distance > from)) {
        return bounded(view, view.end());
    }
    return bounded(view, isForward ? from + std::min(distance, view.end()) : from - distance);
}

struct Neighbour {
    std::optional<std::uint64_t> packet;
    bool isFar = false; ///< there may be one, but farther away than a walk may go
};

/// The first packet of the stream of one among those that `next` gives.
template <class Next>
Neighbour walkStream(model::SessionView& view, std::uint64_t packet, Next next) {
    const model::PacketDigest* own = view.accounts().digests().find(packet);
    const auto ownPacket = view.packet(packet);
    if (own == nullptr || !ownPacket) {
        return {};
    }
    WalkBounds bounds;
    while (const std::optional<std::uint64_t> at = next()) {
        const model::PacketDigest* digest = view.accounts().digests().find(*at);
        const bool isAlike = digest != nullptr && digest->type == own->type;
        const bool mayBe =
            isAlike && (own->type != 0 ? digest->character == own->character : digest->kind == own->kind);
        if (!bounds.look() || (mayBe && !bounds.read())) {
            return {{}, true};
        }
        const auto found = mayBe && *at != packet ? view.packet(*at) : std::nullopt;
        if (found && found->sender == ownPacket->sender) {
            return {at};
        }
    }
    return {};
}

Target nearestInStream(model::SessionView& view, const PacketModel& list, bool isForward) {
    const auto from = view.choices().selection.packet;
    const std::uint64_t packet = from.value_or(view.end() - 1);
    if (!view.packet(packet)) {
        return tl::unexpected(tr("No packet is selected."));
    }
    const int end = list.rowCount();
    int row = isForward ? (from ? list.rowFrom(packet + 1) : 0) - 1 : from ? list.rowFrom(packet) : end;
    const Neighbour found = walkStream(view, packet, [&] {
        row += isForward ? 1 : -1;
        return row >= 0 && row < end ? std::optional(list.packetAt(row)) : std::nullopt;
    });
    if (found.packet) {
        return *found.packet;
    }
    return tl::unexpected(found.isFar ? (isForward ? tr("No later packet of this stream is near this one.")
                                                   : tr("No earlier packet of this stream is near this one."))
                          : isForward ? tr("No later packet of this stream.")
                                      : tr("No earlier packet of this stream."));
}

/// True if a packet was sent for a character, under any port that its sender had.
bool isOf(model::SessionView& view, const model::CharacterKey& key, std::uint64_t packet) {
    const model::PacketDigest* digest = view.accounts().digests().find(packet);
    const bool mayBe = digest != nullptr && digest->type != 0 && digest->character == key.character;
    const auto read = mayBe ? view.packet(packet) : std::nullopt;
    return read && std::ranges::any_of(view.roster().lineage(key), [&read](const model::Character* one) {
               return one->key.sender == read->sender;
           });
}

Target nearestProblem(model::SessionView& view, const PacketModel& list, bool isForward, bool isOfSelected) {
    const model::PacketDigests& digests = view.accounts().digests();
    const auto& character = view.choices().selection.character;
    const bool isOfOne = isOfSelected && character && !list.isFiltered();
    const auto step = [&](std::uint64_t from) {
        return isForward ? digests.nextProblem(from) : digests.previousProblem(from);
    };
    const model::Cursor& cursor = view.choices().cursor;
    const bool isAmidst = cursor.mode == model::Cursor::Mode::Paused && cursor.packet + 1 < digests.end();
    // The first packet comes after the one before it.
    const std::uint64_t from = isAmidst ? cursor.packet : isForward ? digests.begin() - 1 : digests.end();
    auto found = step(view.choices().selection.packet.value_or(from));
    for (WalkBounds bounds; found && bounds.look(); found = step(*found)) {
        if (list.rowOf(*found) >= 0 && (!isOfOne || isOf(view, *character, *found))) {
            return *found;
        }
    }
    const QString whose = isOfOne ? tr(" of %1").arg(characterName(view, *character)) : QString();
    return tl::unexpected(isForward ? tr("No problem%1 after this packet.").arg(whose)
                                    : tr("No problem%1 before this packet.").arg(whose));
}

Target nearestMark(model::SessionView& view, const PacketModel& list, bool isForward) {
    const auto& marks = view.choices().annotations.marks;
    const auto isListed = [&](std::uint64_t number) { return list.rowOf(number) >= 0; };
    const auto from = view.choices().selection.packet;
    const auto after = from && isForward ? marks.upper_bound(*from) : marks.lower_bound(from.value_or(0));
    if (isForward) {
        if (const auto found = std::find_if(after, marks.end(), isListed); found != marks.end()) {
            return *found;
        }
        return tl::unexpected(tr("No mark after this packet."));
    }
    const auto last = std::make_reverse_iterator(from ? after : marks.end());
    if (const auto found = std::find_if(last, marks.rend(), isListed); found != marks.rend()) {
        return *found;
    }
    return tl::unexpected(tr("No mark before this packet."));
}

} // namespace

std::optional<std::uint64_t> inspectedPacket(model::SessionView& view, std::uint8_t preferredType) {
    const model::Selection& selection = view.choices().selection;
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
                                               Direction direction) {
    const std::uint64_t step = direction == Direction::Forward ? 1 : -1;
    return walkStream(view, packet,
                      [&, at = packet]() mutable {
                          at += step;
                          return view.accounts().digests().find(at) != nullptr ? std::optional(at)
                                                                               : std::nullopt;
                      })
        .packet;
}

tl::expected<std::uint64_t, QString> nearestListed(model::SessionView& view, const PacketModel& list,
                                                   Landmark landmark, Direction direction) {
    switch (landmark) {
    case Landmark::SameStream:
        return nearestInStream(view, list, direction == Direction::Forward);
    case Landmark::First:
        if (list.rowCount() == 0) {
            return tl::unexpected(tr("No packet is listed."));
        }
        return list.packetAt(0);
    case Landmark::Mark:
        return nearestMark(view, list, direction == Direction::Forward);
    default:
        return nearestProblem(view, list, direction == Direction::Forward,
                              landmark == Landmark::ProblemOfSelected);
    }
}

std::optional<std::uint64_t> comparableBefore(model::SessionView& view, std::uint64_t packet) {
    constexpr int kFarthest = 128; // as many parts as a sample can have
    const auto partOf = [&view](std::uint64_t number) {
        const auto found = view.packet(number);
        const auto header = found ? wire::decodeHeader(found->bytes) : tl::unexpected(wire::WireError{});
        return header ? std::optional(header->datagramIndex()) : std::nullopt;
    };
    const auto part = partOf(packet);
    std::optional<std::uint64_t> before = packet;
    for (int i = 0; i < kFarthest && before; ++i) {
        before = neighbourInStream(view, *before, Direction::Backward);
        if (before && partOf(*before) == part) {
            return before;
        }
    }
    return std::nullopt;
}

std::optional<log::Stamp> timeTarget(model::SessionView& view, const QString& text) {
    const QString compact = withoutSpaces(text);
    for (const char* format : {"H:m:s.z", "H:m:s", "H:m"}) {
        if (const QTime time = QTime::fromString(compact, QLatin1String(format)); time.isValid()) {
            const auto newest = view.packet(view.end() - 1);
            const log::Stamp stamp = newest ? newest->stamp : view.now();
            const auto stampOn = [&](const QDate& day) {
                const log::WallTime wanted(milliseconds(QDateTime(day, time).toMSecsSinceEpoch()));
                return view.log().timeline().stampOf(wanted);
            };
            const QDate day = dateTimeOf(view.wallOf(stamp)).date();
            const log::Stamp before = stampOn(day.addDays(-1));
            const log::Stamp wanted = stampOn(day);
            return wanted > stamp && before >= view.firstStamp() ? before : wanted;
        }
    }
    if (!compact.endsWith(QLatin1Char('s'))) {
        return std::nullopt;
    }
    bool isNumber = false;
    const double seconds = compact.chopped(1).toDouble(&isNumber);
    return isNumber && std::abs(seconds) < kMostSeconds
               ? std::optional(view.firstStamp() + log::durationOf(seconds))
               : std::nullopt;
}

tl::expected<std::uint64_t, QString> packetTarget(model::SessionView& view, const QString& text) {
    const QString compact = withoutSpaces(text);
    if (view.begin() == view.end()) {
        return tl::unexpected(tr("There are no packets."));
    }
    if (compact.startsWith(QLatin1Char('+')) || compact.startsWith(QLatin1Char('-')) ||
        compact.startsWith(QChar(0x2212))) {
        return relative(view, compact.mid(1), compact.startsWith(QLatin1Char('+')));
    }
    if (const auto time = timeTarget(view, text)) {
        return atStamp(view, *time, text.trimmed());
    }
    if (compact.contains(QLatin1Char(':'))) {
        return tl::unexpected(tr("%1 is not a time of day such as 10:42:17.508.").arg(compact));
    }
    bool isNumber = false;
    const std::uint64_t number = compact.toULongLong(&isNumber);
    if (!isNumber) {
        return tl::unexpected(tr("Write a number, +n or -n, a time since the first packet such as 12.5 s, "
                                 "or a time of day such as 10:42:17.508."));
    }
    return bounded(view, number);
}

} // namespace posewire::gui
