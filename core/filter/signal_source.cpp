// SPDX-License-Identifier: MIT
#include "core/filter/signal_tree.h"

#include <algorithm>

namespace posewire::filter {
namespace {

using model::Stream;

constexpr log::Duration kLossTime = std::chrono::seconds(10);
constexpr log::Duration kSkewTime = std::chrono::seconds(60);

std::optional<double> rateOf(const Stream& stream, log::Stamp) {
    const double hz = stream.statistics.rateHz();
    return hz > 0 ? std::optional(hz) : std::nullopt;
}
std::optional<double> lossOf(const Stream& stream, log::Stamp now) {
    return 100 * stream.accounting.countsBetween(now - kLossTime, now + log::Duration(1)).lossRatio();
}
std::optional<double> jitterOf(const Stream& stream, log::Stamp) {
    return stream.accounting.senderClock().jitterMs() / 1000;
}
std::optional<double> skewOf(const Stream& stream, log::Stamp now) {
    const auto skew = stream.accounting.history().skewBetween(now - kSkewTime, now + log::Duration(1));
    return skew.isKnown() ? std::optional(skew.skewPpm) : std::nullopt;
}
std::optional<double> delayOf(const Stream& stream, log::Stamp) {
    const model::SenderClock& clock = stream.accounting.senderClock();
    return clock.isFromTimeCode() ? std::optional(clock.differenceMs() / 1000) : std::nullopt;
}

constexpr std::array kFunctions{
    SignalFunction{"norm", SignalStep::Norm, 1, "length of a vector"},
    SignalFunction{"distance", SignalStep::Distance, 2, "between two positions"},
    SignalFunction{"angle", SignalStep::Angle, 2, "between two orientations, or two vectors, in degrees"},
    SignalFunction{"speed", SignalStep::Speed, 1, "of a position in m/s, of an orientation in °/s"},
    SignalFunction{"derivative", SignalStep::Derivative, 1, "change per second"},
};

constexpr std::array kFigures{
    SignalFigure{"rate", Dimension::None, "Hz", "samples per second by arrival, over the newest 2 s", rateOf},
    SignalFigure{"loss", Dimension::None, "%", "samples lost or incomplete, of the newest 10 s", lossOf},
    SignalFigure{"jitter", Dimension::Time, "s", "interarrival jitter (RFC 3550 section 6.4.1)", jitterOf},
    SignalFigure{"skew", Dimension::None, "ppm", "how much faster the sender's clock runs, over 60 s",
                 skewOf},
    SignalFigure{"delay", Dimension::Time, "s",
                 "how much later it came than its time code says, against the first sample", delayOf},
};

/// A number as it was sent in the unit that it is compared in.
double compared(double number, const FieldInfo& field, const Place& place, const Candidate& packet) {
    if (place.length) {
        return number * model::metresPer(packet.positionUnit.value_or(*place.length));
    }
    const bool isMeasured = field.read != nullptr && field.dimension != Dimension::None;
    return isMeasured ? converted(number, *field.read, unitsOf(field.dimension).front()) : number;
}

} // namespace

std::span<const SignalFunction> signalFunctions() {
    return kFunctions;
}

std::span<const SignalFigure> signalFigures() {
    return kFigures;
}

const SignalFigure* findFigure(std::string_view name) {
    const auto* found = std::ranges::find(kFigures, name, &SignalFigure::name);
    return found != kFigures.end() ? found : nullptr;
}

std::optional<SignalValue> SignalSource::read(Subject& packet, std::size_t& last) const {
    const Candidate& candidate = packet.candidate;
    if (figure != nullptr) {
        const auto number = candidate.stream != nullptr
                                ? figure->read(*candidate.stream, candidate.packet.stamp)
                                : std::nullopt;
        return number ? std::optional(SignalValue{*number}) : std::nullopt;
    }
    for (const FieldInfo* field : ofPacket) {
        if (const auto value = field->readPacket(packet, 0)) {
            return SignalValue{isAsSent ? value->number : compared(value->number, *field, {}, candidate)};
        }
    }
    if (candidate.datagram == nullptr) {
        return std::nullopt;
    }
    const wire::Datagram& datagram = *candidate.datagram;
    for (const Spot& spot : spots[packet.shape()]) {
        const std::size_t count = itemCount(datagram, packet.shape(), spot.list);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t item = spot.item.read != nullptr ? (last + i) % count : i;
            if (spot.item.read != nullptr && !spot.item.is(datagram, item)) {
                continue;
            }
            last = item;
            SignalValue value{};
            for (std::size_t at = 0; at < quantity.components; ++at) {
                const double number = spot.place.read(datagram, item, component.value_or(at)).number;
                value[at] = isAsSent ? number : compared(number, *spot.field, spot.place, candidate);
            }
            if (spot.isYUp) {
                std::rotate(value.begin(), value.begin() + 2, value.begin() + 3);
            }
            return value;
        }
    }
    return std::nullopt;
}

} // namespace posewire::filter
