// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_search.h"

#include "app/gui/models/display_filter.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/theme/words.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <QRegularExpression>

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

namespace posewire::gui {

namespace {

/// After this many packets a thread hands over what it found and lets go of what the log has dropped.
constexpr std::uint64_t kPacketsAtATime = 8192;

std::byte folded(std::byte byte) {
    return static_cast<std::byte>(wire::lower(std::to_integer<char>(byte)));
}

} // namespace

void PacketNumbers::append(std::uint64_t number) {
    if (m_blocks.empty()) {
        m_first = number / kNumbers * kNumbers;
    }
    const std::uint64_t place = number - m_first;
    while (place / kNumbers >= m_blocks.size()) {
        m_blocks.push_back({m_end, {}});
    }
    m_blocks.back().bits[place % kNumbers / 64] |= std::uint64_t{1} << place % 64;
    ++m_end;
}

void PacketNumbers::dropBefore(std::uint64_t number) {
    m_dropped += placeOf(number);
    while (!m_blocks.empty() && m_first + kNumbers <= number) {
        m_blocks.pop_front();
        m_first += kNumbers;
    }
}

std::uint64_t PacketNumbers::operator[](std::size_t place) const {
    const std::uint64_t wanted = m_dropped + place;
    const auto block = std::prev(std::ranges::upper_bound(m_blocks, wanted, {}, &Block::before));
    std::uint64_t left = wanted - block->before;
    std::size_t word = 0;
    for (auto count = std::popcount(block->bits[0]); left >= static_cast<std::uint64_t>(count);
         count = std::popcount(block->bits[word])) {
        left -= static_cast<std::uint64_t>(count);
        ++word;
    }
    std::uint64_t bits = block->bits[word];
    for (; left > 0; --left) {
        bits &= bits - 1;
    }
    const auto before = static_cast<std::uint64_t>(block - m_blocks.begin()) * kNumbers + word * 64;
    return m_first + before + static_cast<std::uint64_t>(std::countr_zero(bits));
}

std::size_t PacketNumbers::placeOf(std::uint64_t number) const {
    const std::uint64_t place = number > m_first ? number - m_first : 0;
    if (place / kNumbers >= m_blocks.size()) {
        return m_blocks.empty() ? 0 : size();
    }
    const Block& block = m_blocks[place / kNumbers];
    const std::size_t word = place % kNumbers / 64;
    std::uint64_t count = block.before;
    for (std::size_t i = 0; i < word; ++i) {
        count += static_cast<std::uint64_t>(std::popcount(block.bits[i]));
    }
    count +=
        static_cast<std::uint64_t>(std::popcount(block.bits[word] & ((std::uint64_t{1} << place % 64) - 1)));
    return count > m_dropped ? count - m_dropped : 0;
}

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
            const std::size_t end = *offset + m_request.pattern.bytes.size();
            m_result.found = {packet->number, static_cast<std::uint32_t>(*offset),
                              static_cast<std::uint32_t>(end)};
            m_result.isWrapped = m_request.isForward ? place < start : place >= start;
            break;
        }
    }
    m_isDone.store(true, std::memory_order_release);
}

PacketMatcher::PacketMatcher(const model::SessionView& view, filter::Filter filter)
    : m_log(view.log()),
      m_filter(std::move(filter)),
      m_firstStamp(view.firstStamp()),
      m_units(unitsOf(view)),
      m_senders(m_log.senders()) {}

PacketMatcher::Units PacketMatcher::unitsOf(const model::SessionView& view) const {
    Units units;
    if (m_filter.comparesLengths()) {
        const model::Sender usual{log::SenderId{}};
        for (const model::Sender& sender : view.roster().senders()) {
            for (const wire::TypeInfo& info : wire::typeTable()) {
                const model::LengthUnit unit = sender.positionUnit(info.type);
                if (unit != usual.positionUnit(info.type)) {
                    units.emplace(std::pair(sender.id, info.type), unit);
                }
            }
        }
    }
    return units;
}

bool PacketMatcher::matches(const log::Packet& packet, const model::PacketDigest& digest) {
    const bool isRead = !packet.flags.skipped && wire::decodeInto(packet.bytes, m_datagram).has_value();
    const auto unit = m_units.find({packet.sender, digest.type});
    return m_filter.matches({packet, digest, isRead ? &m_datagram : nullptr, m_senders.find(packet.sender),
                             m_firstStamp, nullptr, m_log.timeline().setByAt(packet.stamp),
                             unit == m_units.end() ? std::nullopt : std::optional(unit->second)});
}

PacketFilterRun::PacketFilterRun(const model::SessionView& view, filter::Filter filter)
    : m_log(view.log()),
      m_matcher(view, std::move(filter)),
      m_begin(view.accounts().digests().begin()),
      m_next(m_begin),
      m_end(m_begin),
      m_thread([this](const std::stop_token& stop) { run(stop); }) {
    static_cast<void>(take(view));
}

std::vector<std::uint64_t> PacketFilterRun::take(const model::SessionView& view) {
    const bool isLate = m_matcher.filter().comparesJudged();
    const std::uint64_t end = isLate ? view.accounts().settledEnd() : view.accounts().digests().end();
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

void PacketFilterRun::hand(std::vector<std::uint64_t>& found, const log::LogFollower& follower) {
    const std::lock_guard lock(m_mutex);
    m_found.insert(m_found.end(), found.begin(), found.end());
    found.clear();
    m_next = std::min(follower.position(), m_end);
    m_ahead = follower.position() - m_next;
    m_gone = follower.overtaken();
    m_changed.notify_all();
}

void PacketFilterRun::lookAt(const model::PacketDigests::Excerpt& excerpt, log::LogFollower& follower,
                             const std::stop_token& stop) {
    std::vector<std::uint64_t> found;
    follower.refresh();
    follower.skipTo(excerpt.begin());
    for (std::uint64_t count = 1; !stop.stop_requested(); ++count) {
        const auto packet = follower.next(excerpt.end());
        if (!packet) {
            break;
        }
        if (m_matcher.matches(*packet, excerpt.at(packet->number))) {
            found.push_back(packet->number);
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

void ListFilter::followRange() {
    const auto chosen = m_view.choices().range.fixed;
    const auto packet = m_view.choices().selection.packet;
    if (std::exchange(m_chosenRange, chosen) != chosen) {
        m_range = chosen;
    } else if (m_range && packet && packet != m_selected) {
        const auto selected = m_view.packet(*packet);
        const bool isInside = selected && selected->stamp >= m_range->from && selected->stamp < m_range->to;
        m_range = isInside ? m_range : std::nullopt;
    }
    m_selected = packet;
}

bool ListFilter::follow() {
    followRange();
    Wanted wanted{QString::fromStdString(m_view.choices().displayFilter), m_range, m_view.firstStamp()};
    // The unit of a sender's positions turns out, or is declared, while it sends.
    const bool isOther = wanted != m_wanted || (m_run && m_run->matcher().isOutdated(m_view));
    if (isOther) {
        m_wanted = std::move(wanted);
        start();
    }
    m_isCatchingUp = m_run && m_done < m_backlog;
    if (m_run) {
        m_list.addMatches(m_run->take(m_view));
        const auto [done, total, gone] = m_run->progress();
        m_done = done;
        m_missed = gone;
    }
    return isOther;
}

/// Leaves what is listed if the filter is wrong: its line says how.
void ListFilter::start() {
    const QString condition =
        m_range ? joinedFilter(m_wanted.text, rangeFilter(m_view, *m_range), FilterJoin::And)
                : m_wanted.text.trimmed();
    auto compiled = filter::Filter::compile(condition.toStdString());
    if (!compiled) {
        return;
    }
    m_run.reset();
    m_done = 0;
    m_missed = 0;
    if (compiled->matchesEverything()) {
        m_list.endMatches();
    } else {
        m_list.beginMatches();
        m_backlog = m_view.accounts().digests().end() - m_view.accounts().digests().begin();
        m_run = std::make_unique<PacketFilterRun>(m_view, *std::move(compiled));
    }
}

void ListFilter::cancel() {
    if (m_run) {
        m_run->cancel();
    }
}

std::optional<double> ListFilter::progress() const {
    const bool isBusy = m_run && !m_run->isCancelled() && m_done < m_backlog;
    return isBusy ? std::optional(static_cast<double>(m_done) / static_cast<double>(m_backlog))
                  : std::nullopt;
}

} // namespace posewire::gui
