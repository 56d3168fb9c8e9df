// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_search.h"

#include "app/gui/theme/words.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <QRegularExpression>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

/// After this many packets a thread hands over what it found and lets go of what the log has dropped.
constexpr std::uint64_t kPacketsAtATime = 8192;

std::byte folded(std::byte byte) {
    return static_cast<std::byte>(wire::lower(std::to_integer<char>(byte)));
}

} // namespace

tl::expected<BytePattern, QString> parsePattern(const QString& text, bool isHexadecimal) {
    if (!isHexadecimal) {
        const std::string small = wire::lowered(text.toStdString());
        const auto bytes = std::as_bytes(std::span(small));
        return BytePattern{{bytes.begin(), bytes.end()}, true};
    }
    static const QRegularExpression between(QStringLiteral("0[xX]|[\\s,;:]"));
    QString digits = text;
    digits.remove(between);
    auto bytes = wire::fromHexadecimal(digits.toStdString());
    if (!bytes) {
        return tl::unexpected(tr("Write whole bytes, two digits 0–9 and a–f each, such as 4d 58 54 50."));
    }
    return BytePattern{std::move(*bytes), false};
}

std::optional<std::size_t> findPattern(const BytePattern& pattern, wire::Bytes bytes) {
    if (pattern.bytes.empty()) {
        return std::nullopt;
    }
    const auto place = std::search(bytes.begin(), bytes.end(), pattern.bytes.begin(), pattern.bytes.end(),
                                   [&](std::byte byte, std::byte wanted) {
                                       return (pattern.ignoresCase ? folded(byte) : byte) == wanted;
                                   });
    return place == bytes.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(place - bytes.begin()));
}

PacketSearch::PacketSearch(const log::PacketLog& log, Request request)
    : m_log(log),
      m_request(std::move(request)),
      m_thread([this](const std::stop_token& stop) { run(stop); }) {}

std::optional<PacketSearch::Result> PacketSearch::result() const {
    return m_isDone.load(std::memory_order_acquire) ? std::optional(m_result) : std::nullopt;
}

PacketSearch::Result PacketSearch::wait() {
    m_thread.join();
    return m_result;
}

void PacketSearch::run(const std::stop_token& stop) {
    log::LogReader reader(m_log);
    const PacketNumbers& among = m_request.among;
    const std::uint64_t base = among.empty() ? reader.begin() : 0;
    const std::uint64_t count = among.empty() ? reader.end() - base : among.size();
    const auto numberAt = [&](std::uint64_t place) { return among.empty() ? base + place : among[place]; };
    // Places of the packets before the start, and of those up to and with it.
    const auto placeOf = [&](std::uint64_t number) {
        return among.empty() ? std::clamp(number, base, base + count) - base
                             : std::uint64_t{among.placeOf(number)};
    };
    const std::uint64_t start = m_request.isForward ? placeOf(m_request.from + 1) : placeOf(m_request.from);
    for (std::uint64_t i = 0; i < count && !stop.stop_requested(); ++i) {
        const std::uint64_t place =
            m_request.isForward ? (start + i) % count : (start + 2 * count - 1 - i) % count;
        if (i % kPacketsAtATime == kPacketsAtATime - 1) {
            reader.refresh();
        }
        const auto packet = reader.packet(numberAt(place));
        m_result.gone += packet ? 0 : 1;
        const auto offset = packet ? findPattern(m_request.pattern, packet->bytes) : std::nullopt;
        if (offset) {
            m_result.packet = packet->number;
            m_result.offset = *offset;
            m_result.size = m_request.pattern.bytes.size();
            m_result.isWrapped = m_request.isForward ? place < start : place >= start;
            break;
        }
    }
    m_isDone.store(true, std::memory_order_release);
}

PacketFilterRun::PacketFilterRun(const model::SessionView& view, filter::Filter filter, PositionUnits units)
    : m_log(view.log()),
      m_filter(std::move(filter)),
      m_firstStamp(view.firstStamp()),
      m_units(std::move(units)),
      m_begin(view.accounts().digests().begin()),
      m_next(m_begin),
      m_end(m_begin),
      m_thread([this](const std::stop_token& stop) { run(stop); }) {
    static_cast<void>(take(view));
}

std::uint64_t PacketFilterRun::endOf(const model::SessionView& view) const {
    return m_filter.comparesJudged() ? view.accounts().settledEnd() : view.accounts().digests().end();
}

PacketFilterRun::Found PacketFilterRun::take(const model::SessionView& view) {
    const std::uint64_t end = endOf(view);
    const std::lock_guard lock(m_mutex);
    if (end > m_end && !isCancelled()) {
        m_excerpts.push_back(view.accounts().digests().excerpt(m_end, end));
        m_end = end;
        m_changed.notify_all();
    }
    return std::exchange(m_found, {});
}

PacketFilterRun::Progress PacketFilterRun::progress() const {
    const std::lock_guard lock(m_mutex);
    return {m_next - m_begin, m_end - m_begin, m_gone - m_ahead};
}

void PacketFilterRun::wait() {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, m_thread.get_stop_token(), [this] { return m_next == m_end; });
}

/// Sleeps where there is nothing to do; nothing where the run is over.
std::optional<model::PacketDigests::Excerpt> PacketFilterRun::nextExcerpt(const std::stop_token& stop) {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, stop, [this] { return !m_excerpts.empty(); });
    if (stop.stop_requested()) {
        return std::nullopt;
    }
    model::PacketDigests::Excerpt excerpt = std::move(m_excerpts.front());
    m_excerpts.pop_front();
    return excerpt;
}

void PacketFilterRun::hand(Found& found, const log::LogFollower& follower) {
    const std::lock_guard lock(m_mutex);
    m_found.packets.insert(m_found.packets.end(), found.packets.begin(), found.packets.end());
    m_found.problems.insert(m_found.problems.end(), found.problems.begin(), found.problems.end());
    found.packets.clear();
    found.problems.clear();
    m_next = std::min(follower.position(), m_end);
    m_ahead = follower.position() - m_next;
    m_gone = follower.overtaken();
    m_changed.notify_all();
}

bool PacketFilterRun::isMatch(const log::Packet& packet, const model::PacketDigest& digest,
                              log::SenderFinder& senders) {
    const bool isRead = !packet.flags.skipped && wire::decodeInto(packet.bytes, m_datagram).has_value();
    return m_filter.matches({packet, digest, isRead ? &m_datagram : nullptr, senders.find(packet.sender),
                             m_firstStamp, nullptr, m_log.timeline().setByAt(packet.stamp),
                             unitIn(m_units, packet.sender, digest.type)});
}

void PacketFilterRun::lookAt(const model::PacketDigests::Excerpt& excerpt, log::LogFollower& follower,
                             const std::stop_token& stop) {
    Found found;
    log::SenderFinder senders(m_log.senders());
    follower.refresh();
    follower.skipTo(excerpt.begin());
    for (std::uint64_t count = 1; !stop.stop_requested(); ++count) {
        const auto packet = follower.next(excerpt.end());
        if (!packet) {
            break;
        }
        const model::PacketDigest& digest = excerpt.at(packet->number);
        if (isMatch(*packet, digest, senders)) {
            found.packets.push_back(packet->number);
            if (digest.isProblem()) {
                found.problems.push_back(packet->number);
            }
        }
        if (count % kPacketsAtATime == 0) {
            hand(found, follower);
            follower.refresh();
        }
    }
    hand(found, follower);
}

void PacketFilterRun::run(const std::stop_token& stop) {
    log::LogFollower follower(m_log, m_begin);
    while (const auto excerpt = nextExcerpt(stop)) {
        lookAt(*excerpt, follower, stop);
    }
}

PositionUnits unusualPositionUnits(const model::SessionView& view) {
    const model::Sender usual{log::SenderId{}};
    PositionUnits units;
    for (const model::Sender& sender : view.roster().senders()) {
        for (const wire::TypeInfo& info : wire::typeTable()) {
            const model::LengthUnit unit = sender.positionUnit(info.type);
            if (unit != usual.positionUnit(info.type)) {
                units.emplace(std::pair(sender.id, info.type), unit);
            }
        }
    }
    return units;
}

std::optional<model::LengthUnit> unitIn(const PositionUnits& units, log::SenderId sender, std::uint8_t type) {
    const auto found = units.find({sender, type});
    return found != units.end() ? std::optional(found->second) : std::nullopt;
}

} // namespace posewire::gui
