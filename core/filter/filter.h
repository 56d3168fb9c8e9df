// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/model/accounting/packet_digest.h"
#include "core/wire/codec.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

/// The display filter: a small typed language over every field that the tables of core/wire declare, and over
/// what is known about a packet besides its bytes. filterReference() describes the language.
namespace posewire::filter {

/// What is wrong with a filter, and what would be right; the place is in bytes of the UTF-8 text.
struct FilterError {
    std::size_t offset = 0;
    std::size_t length = 0;
    std::string text; ///< one sentence

    friend bool operator==(const FilterError&, const FilterError&) = default;
};

/// One packet as a filter sees it.
struct Candidate {
    const log::Packet& packet;
    const model::PacketDigest& digest;
    const wire::Datagram* datagram = nullptr; ///< null where it was not decoded; see needsDatagram
    const log::SenderInfo* sender = nullptr;  ///< null where it is not known
    std::int64_t firstStampNs = 0;            ///< of the first packet: where `time` begins
    const wire::WireError* fault = nullptr;   ///< why it could not be decoded; found out anew where null
};

struct Program;

/// A filter that was understood. Cheap to copy; copies may be used by several threads at a time.
class Filter {
public:
    /// Longer texts and deeper parentheses are refused.
    static constexpr std::size_t kLongestText = 4096;
    static constexpr std::size_t kDeepest = 64;

    /// Matches everything.
    Filter() = default;

    /// An empty text matches everything.
    [[nodiscard]] static tl::expected<Filter, FilterError> compile(std::string_view text);

    /// Does not allocate, except within the regular expressions of `matches`, whose memory is bounded.
    [[nodiscard]] bool matches(const Candidate& candidate) const;

    [[nodiscard]] bool matchesEverything() const { return m_program == nullptr; }

    /// Whether it asks for fields of the payload: without them a candidate needs no datagram, which spares
    /// decoding it. Fields of the header are read from the bytes then.
    [[nodiscard]] bool needsDatagram() const;

private:
    std::shared_ptr<const Program> m_program;
};

} // namespace posewire::filter
