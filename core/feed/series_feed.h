// SPDX-License-Identifier: MIT
#pragma once

#include "core/field/field.h"
#include "core/filter/filter.h"
#include "core/log/packet_log.h"
#include "core/model/accounting/packet_digest.h"

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace posewire::feed {

/// Reads a number from a packet; empty if the packet does not have it. Packets of a stream are decoded, those
/// that a filter matches may have no datagram. It may remember what it read: packets come in order.
using Signal = std::function<std::optional<double>(field::Subject& packet)>;

/// Sum of the values of some rows in order. NaN is no value.
struct SeriesColumn {
    double least = std::numeric_limits<double>::infinity(); ///< means nothing without values
    double most = -std::numeric_limits<double>::infinity();
    double sum = 0;
    std::uint64_t count = 0;
    bool hasGap = false; ///< one of its rows follows a gap

    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    void add(const SeriesColumn& later);
};

/// A packet that has a value of a signal.
struct SeriesRow {
    log::Stamp stamp{};       ///< never before that of the row before it
    std::uint64_t packet = 0; ///< its number in the log
    std::uint32_t sample = 0; ///< sample counter
    bool followsGap = false;  ///< samples are missing, or packets were not read, since the row before it
};

/// Values of some signals, row by row, and a pyramid over them: to add up any number of rows costs about as
/// much as a few hundred. Rows are numbered from the first that was appended.
class Series {
public:
    /// Keeps at least the newest `mostRows`.
    Series(std::size_t curves, std::size_t mostRows, std::shared_ptr<log::Scratch> scratch)
        : m_curves(curves), m_mostRows(mostRows), m_scratch(std::move(scratch)) {}

    /// A value for each signal, NaN if there is none.
    void append(SeriesRow row, std::span<const double> values);

    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    [[nodiscard]] std::uint64_t end() const { return m_end; }
    [[nodiscard]] const SeriesRow& row(std::uint64_t number) const {
        return (*blockOf(number).rows)[number % kBlock];
    }
    [[nodiscard]] double value(std::size_t signal, std::uint64_t row) const {
        return blockOf(row).curves[signal]->values[row % kBlock];
    }
    /// The first row from a stamp on; end() if there is none.
    [[nodiscard]] std::uint64_t rowFrom(log::Stamp stamp) const;

    /// Of the rows [from, to).
    [[nodiscard]] SeriesColumn sum(std::size_t signal, std::uint64_t from, std::uint64_t to) const;
    /// Of parts of a range that are equally long.
    [[nodiscard]] std::vector<SeriesColumn> columns(std::size_t signal, const model::TimeRange& range,
                                                    std::size_t pixels) const;

private:
    static constexpr std::size_t kFan = 16;
    static constexpr std::size_t kBlock = kFan * kFan * kFan;
    struct Values {
        std::array<double, kBlock> values;
        std::array<SeriesColumn, (kBlock - 1) / (kFan - 1)> sums; ///< of all, of each 256, of each 16
    };
    struct Block {
        std::shared_ptr<std::array<SeriesRow, kBlock>> rows;
        std::vector<std::shared_ptr<Values>> curves;
    };
    /// The place among the sums of the one of `step` rows that a row is in.
    [[nodiscard]] static std::size_t placeOf(std::uint64_t row, std::size_t step) {
        return (kBlock / step - 1) / (kFan - 1) + row % kBlock / step;
    }
    [[nodiscard]] SeriesColumn part(std::size_t curve, std::uint64_t from, std::size_t step) const;
    [[nodiscard]] const Block& blockOf(std::uint64_t row) const { return m_blocks[(row - m_begin) / kBlock]; }

    std::size_t m_curves;
    std::size_t m_mostRows;
    std::shared_ptr<log::Scratch> m_scratch;
    std::deque<Block> m_blocks; ///< all but the last are full
    std::uint64_t m_begin = 0;
    std::uint64_t m_end = 0;
};

/// Packets of these types of a character; of all its types if none is given.
struct CharacterPackets {
    log::SenderId sender{};
    std::uint8_t character = 0;
    std::vector<std::uint8_t> types;

    [[nodiscard]] bool has(log::SenderId from, const wire::Header& header) const {
        return from == sender && header.character == character &&
               (types.empty() || std::find(types.begin(), types.end(), header.type()) != types.end());
    }
};

/// Signals of the same packets.
struct SeriesSource {
    /// Of a stream or a character, or that a filter matches.
    std::variant<log::StreamKey, CharacterPackets, filter::Filter> packets;
    std::vector<Signal> curves;
    std::size_t mostRows = std::numeric_limits<std::size_t>::max();
    std::optional<model::LengthUnit> positionUnit{}; ///< of its sender; else what layouts say
};

/// Follows a log and reads a series from each source; each packet is decoded once at most. One thread, any.
class SeriesFeed {
public:
    /// Begins with packet `from`.
    SeriesFeed(const log::PacketLog& log, std::uint64_t from, std::vector<SeriesSource> sources);

    /// Reads some packets below `end`; false if there were none left for now.
    bool advance(std::uint64_t end = UINT64_MAX);

    [[nodiscard]] const Series& series(std::size_t source = 0) const { return m_parts[source].series; }
    /// Number of the next packet.
    [[nodiscard]] std::uint64_t position() const { return m_follower.position(); }
    /// Packets that the log had dropped before they were read.
    [[nodiscard]] std::uint64_t missed() const { return m_follower.overtaken(); }

private:
    struct Part {
        SeriesSource source;
        Series series;
        bool followsGap = false; ///< what is appended next
    };
    void read(const log::Packet& packet);
    void take(const field::Candidate& candidate, Part& part);

    const log::PacketLog& m_log;
    log::LogFollower m_follower;
    log::SenderFinder m_senders;
    model::PacketDigester m_digester;
    wire::Datagram m_datagram;
    std::vector<double> m_values;
    std::vector<Part> m_parts;
    std::optional<log::Stamp> m_firstStamp; ///< of the oldest packet when it began to read
};

} // namespace posewire::feed
