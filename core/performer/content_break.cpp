// SPDX-License-Identifier: MIT
#include "core/performer/faults.h"

#include "core/wire/pose_items.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace posewire::performer {
namespace {

struct Moment {
    const wire::Datagram& first; ///< of the stream since it is broken
    double seconds = 0;          ///< since then
};

/// Calls f(numbers) for the positions and the orientations of all segments.
template <class F>
void forAllNumbers(wire::Datagram& datagram, F&& f) {
    wire::forSegments(datagram.body, [&](auto& segments) {
        for (auto& segment : segments) {
            wire::forNumbers(segment, f);
        }
    });
}

template <std::size_t N, class F>
void forEach(wire::Datagram& datagram, F&& f) {
    forAllNumbers(datagram, [&]<std::size_t M>(std::array<float, M>& numbers) {
        if constexpr (M == N) {
            f(numbers);
        }
    });
}

float swapped(float value) {
    auto bytes = std::bit_cast<std::array<std::byte, sizeof(float)>>(value);
    std::ranges::reverse(bytes);
    return std::bit_cast<float>(bytes);
}

struct Row {
    std::string_view kind;
    void (*apply)(wire::Datagram&, const Moment&);
};

constexpr std::array kRows{
    Row{"frozen",
        [](wire::Datagram& datagram, const Moment& moment) {
            wire::forSegments(datagram.body, [&](const auto&) { datagram.body = moment.first.body; });
        }},
    Row{"missing",
        [](wire::Datagram& datagram, const Moment&) {
            wire::forSegments(datagram.body, [&](auto& segments) {
                segments.resize(std::min<std::size_t>(segments.size(), 1));
                datagram.header.items = static_cast<std::uint8_t>(segments.size());
            });
        }},
    Row{"orientation",
        [](wire::Datagram& datagram, const Moment&) {
            forEach<4>(datagram, [](auto& orientation) { orientation = {}; });
        }},
    Row{"number",
        [](wire::Datagram& datagram, const Moment&) {
            forEach<3>(datagram, [](auto& place) { place[1] = std::numeric_limits<float>::quiet_NaN(); });
        }},
    Row{"byteOrder",
        [](wire::Datagram& datagram, const Moment&) {
            forAllNumbers(datagram,
                          [](auto& numbers) { std::ranges::transform(numbers, numbers.begin(), swapped); });
        }},
    Row{"counter",
        [](wire::Datagram& datagram, const Moment& moment) {
            datagram.header.sampleCounter = moment.first.header.sampleCounter;
        }},
    Row{"framing", [](wire::Datagram& datagram, const Moment&) { datagram.header.datagramCounter &= 0x7f; }},
    Row{"timeCode",
        [](wire::Datagram& datagram, const Moment& moment) {
            const std::uint32_t first = moment.first.header.timeCode;
            datagram.header.timeCode = first + 3 * (datagram.header.timeCode - first);
        }},
    Row{"header", [](wire::Datagram& datagram, const Moment&) { datagram.header.items = 0; }},
    Row{"jump",
        [](wire::Datagram& datagram, const Moment& moment) {
            const bool isAway = static_cast<int>(moment.seconds) % 2 == 1;
            forEach<3>(datagram, [isAway](auto& place) { place[0] += isAway ? 3.0F : 0.0F; });
        }},
    Row{"convention",
        [](wire::Datagram& datagram, const Moment&) {
            forEach<4>(datagram, [](auto& orientation) { // x y z w
                std::rotate(orientation.begin(), orientation.begin() + 1, orientation.end());
            });
        }},
    Row{"floor", [](wire::Datagram& datagram,
                    const Moment&) { forEach<3>(datagram, [](auto& place) { place[2] += 1.0F; }); }},
    Row{"units",
        [](wire::Datagram& datagram, const Moment&) {
            forEach<3>(datagram, [](auto& place) {
                std::ranges::transform(place, place.begin(), [](float metres) { return 1000 * metres; });
            });
        }},
    Row{"ids",
        [](wire::Datagram& datagram, const Moment&) {
            wire::forSegments(datagram.body, [](auto& segments) {
                for (auto& segment : segments) {
                    --segment.id;
                }
            });
        }},
};

const Row* find(std::string_view kind) {
    const auto* row = std::ranges::find(kRows, kind, &Row::kind);
    return row == kRows.end() ? nullptr : row;
}

} // namespace

std::vector<std::string_view> contentBreaks() {
    std::vector<std::string_view> kinds(kRows.size());
    std::ranges::transform(kRows, kinds.begin(), &Row::kind);
    return kinds;
}

void ContentBreak::apply(Sending& sending) {
    const Row* row = find(m_settings.kind);
    if (row == nullptr || !sending.isReadable || !wire::isSampled(sending.origin.type) ||
        log::secondsOf(sending.due) < m_settings.fromSeconds) {
        return;
    }
    auto datagram = wire::decode(sending.bytes);
    if (!datagram) {
        return;
    }
    const auto [found, isNew] = m_streams.try_emplace({sending.origin.character, sending.origin.type});
    Stream& stream = found->second;
    if (isNew) {
        stream = {sending.due, *datagram};
    }
    sending.origin.header = datagram->header;
    row->apply(*datagram, {stream.first, log::secondsOf(sending.due - stream.since)});
    datagram->header.payloadSize = static_cast<std::uint16_t>(wire::payloadSize(datagram->body));
    if (auto bytes = wire::encode(*datagram)) {
        sending.bytes = std::move(*bytes);
        sending.isReadable = wire::decode(sending.bytes).has_value();
    }
}

} // namespace posewire::performer
