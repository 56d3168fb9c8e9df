// SPDX-License-Identifier: MIT
#include "core/feed/series_feed.h"

#include <algorithm>
#include <cmath>

namespace posewire::feed {
namespace {

constexpr std::uint64_t kReadAtOnce = 2048;

SeriesColumn columnOf(double value, bool followsGap) {
    return std::isnan(value) ? SeriesColumn{.hasGap = followsGap}
                             : SeriesColumn{value, value, value, 1, followsGap};
}

} // namespace

void SeriesColumn::add(const SeriesColumn& later) {
    least = std::min(least, later.least);
    most = std::max(most, later.most);
    sum += later.sum;
    count += later.count;
    hasGap = hasGap || later.hasGap;
}

void Series::append(SeriesRow row, std::span<const double> values) {
    if (m_end % kBlock == 0) {
        if (m_end - m_begin >= kBlock && m_end - m_begin - kBlock >= m_mostRows) {
            m_blocks.pop_front();
            m_begin += kBlock;
        }
        Block& block = m_blocks.emplace_back(Block{m_scratch->make<std::array<SeriesRow, kBlock>>(), {}});
        std::generate_n(std::back_inserter(block.curves), m_curves,
                        [this] { return m_scratch->make<Values>(); });
    }
    if (m_end != m_begin) {
        row.stamp = std::max(row.stamp, this->row(m_end - 1).stamp);
    }
    const Block& block = m_blocks.back();
    (*block.rows)[m_end % kBlock] = row;
    for (std::size_t i = 0; i < m_curves; ++i) {
        block.curves[i]->values[m_end % kBlock] = values[i];
    }
    ++m_end;
    for (std::size_t step = kFan; step <= kBlock && m_end % step == 0; step *= kFan) {
        for (std::size_t i = 0; i < m_curves; ++i) {
            SeriesColumn& whole = block.curves[i]->sums[placeOf(m_end - step, step)];
            for (std::uint64_t from = m_end - step; from != m_end; from += step / kFan) {
                whole.add(part(i, from, step / kFan));
            }
        }
    }
}

/// Of `step` rows, which are all there.
SeriesColumn Series::part(std::size_t curve, std::uint64_t from, std::size_t step) const {
    return step == 1 ? columnOf(value(curve, from), row(from).followsGap)
                     : blockOf(from).curves[curve]->sums[placeOf(from, step)];
}

std::uint64_t Series::rowFrom(log::Stamp stamp) const {
    std::uint64_t from = m_begin;
    for (std::uint64_t to = m_end; from < to;) {
        const std::uint64_t middle = from + (to - from) / 2;
        const bool isBefore = row(middle).stamp < stamp;
        from = isBefore ? middle + 1 : from;
        to = isBefore ? to : middle;
    }
    return from;
}

SeriesColumn Series::sum(std::size_t signal, std::uint64_t from, std::uint64_t to) const {
    SeriesColumn sum;
    while (from < to) {
        std::size_t step = 1; // the longest that begins here
        while (step < kBlock && from % (step * kFan) == 0 && from + step * kFan <= to) {
            step *= kFan;
        }
        sum.add(part(signal, from, step));
        from += step;
    }
    return sum;
}

std::vector<SeriesColumn> Series::columns(std::size_t signal, const model::TimeRange& range,
                                          std::size_t pixels) const {
    std::vector<SeriesColumn> columns(pixels);
    std::uint64_t from = rowFrom(range.from);
    for (std::size_t i = 0; i < pixels; ++i) {
        const double share = static_cast<double>(i + 1) / static_cast<double>(pixels);
        const std::uint64_t to =
            rowFrom(i + 1 == pixels ? range.to : range.from + log::durationOf(share * range.seconds()));
        columns[i] = sum(signal, from, to);
        from = to;
    }
    return columns;
}

SeriesFeed::SeriesFeed(const log::PacketLog& log, std::uint64_t from, std::vector<SeriesSource> sources)
    : m_log(log), m_follower(log, from), m_senders(log.senders()) {
    for (SeriesSource& source : sources) {
        m_parts.push_back({source, {source.curves.size(), source.mostRows, log.scratch()}});
    }
}

bool SeriesFeed::advance(std::uint64_t end) {
    m_follower.refresh();
    if (const auto oldest = m_firstStamp ? std::nullopt : m_follower.reader().packetFrom(0)) {
        m_firstStamp = oldest->stamp;
    }
    std::uint64_t count = 0;
    for (; count < kReadAtOnce; ++count) {
        const auto packet = m_follower.next(end);
        if (m_follower.takeOvertaken() != 0) {
            std::ranges::for_each(m_parts, [](Part& part) { part.followsGap = true; });
        }
        if (!packet) {
            break;
        }
        read(*packet);
    }
    return count != 0;
}

void SeriesFeed::read(const log::Packet& packet) {
    const auto header = wire::decodeHeader(packet.bytes);
    const auto mayBelong = [&](const Part& part) {
        const auto* stream = std::get_if<log::StreamKey>(&part.source.packets);
        const auto* character = std::get_if<CharacterPackets>(&part.source.packets);
        return stream != nullptr
                   ? header && *stream == log::StreamKey{packet.sender, header->character, header->type()}
                   : character == nullptr || (header && character->has(packet.sender, *header));
    };
    if (std::ranges::none_of(m_parts, mayBelong)) {
        return;
    }
    const bool isRead = !packet.flags.skipped && wire::decodeInto(packet.bytes, m_datagram).has_value();
    const wire::Datagram* datagram = isRead ? &m_datagram : nullptr;
    const model::PacketDigest digest = m_digester.add(packet, datagram);
    field::Candidate candidate{packet, digest, datagram, m_senders.find(packet.sender), *m_firstStamp};
    candidate.stream = m_digester.stream();
    candidate.setBy = m_log.timeline().setByAt(packet.stamp);
    for (Part& part : m_parts) {
        candidate.positionUnit = part.source.positionUnit;
        const auto* filter = std::get_if<filter::Filter>(&part.source.packets);
        if (filter != nullptr ? filter->matches(candidate) : isRead && mayBelong(part)) {
            take(candidate, part);
        }
    }
}

void SeriesFeed::take(const field::Candidate& candidate, Part& part) {
    const model::PacketDigest& digest = candidate.digest;
    part.followsGap = part.followsGap || digest.gap != 0 || digest.isRestart || digest.isInDoubt;
    field::Subject packet(candidate);
    const wire::Header* header = packet.header();
    bool hasValue = false;
    m_values.clear();
    for (const Signal& signal : part.source.curves) {
        const auto value = signal(packet);
        hasValue = hasValue || value;
        m_values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    if (hasValue) {
        part.series.append({candidate.packet.stamp, candidate.packet.number,
                            header != nullptr ? header->sampleCounter : 0,
                            std::exchange(part.followsGap, false)},
                           m_values);
    }
}

} // namespace posewire::feed
