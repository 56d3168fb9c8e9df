// SPDX-License-Identifier: MIT
#include "core/model/accounting/gap.h"

#include "core/model/accounting/sample_window.h"
#include "core/wire/type_table.h"

namespace posewire::model {

bool Gap::isAround(std::uint32_t sample) const {
    return distance(sample, fromSample) > 0 && distance(toSample, sample) > 0;
}

words::Fact Gap::evidenceFact() const {
    using K = words::Kind;
    const auto lastedMs =
        words::Number{static_cast<double>((toStamp - fromStamp) / std::chrono::milliseconds(1))};
    const words::NamedValue sample{"sample", figure};
    const words::NamedValue type{"type", wire::typeDigits(otherType)};
    const words::NamedValue from{"from", fromPacket};
    const words::NamedValue to{"to", toPacket};
    const words::NamedValue samples{"samples", words::counted(K::Samples, lost)};
    switch (evidence) {
    case Evidence::Dropped:
        return {K::DroppedHere, {{"datagrams", words::counted(K::Datagrams, figure)}, from, to}};
    case Evidence::NotListening:
        return {K::NotListening};
    case Evidence::Overtaken:
        return {K::OvertakenBetween, {{"packets", words::counted(K::Packets, figure)}, from, to}};
    case Evidence::Damaged:
        return {K::SampleDamaged, {sample}};
    case Evidence::Partial:
        return {K::PartNextToGap, {sample}};
    case Evidence::OtherStream:
        return {K::OtherStream, {type, sample}};
    case Evidence::Reliable:
        return {K::NotSentByTcp, {samples}};
    case Evidence::CutOff:
        return {K::CutOff, {sample, type}};
    case Evidence::Paused:
        return {K::Paused,
                {{"streams", words::counted(K::Streams, figure)},
                 {"lasted", lastedMs},
                 {"moved", words::Number{static_cast<double>(timeCodeMoved)}}}};
    case Evidence::None:
        break;
    }
    return isJudged ? words::Fact{K::NoEvidence, {samples, {"lasted", lastedMs}}}
                    : words::Fact{K::WaitingForLate};
}

} // namespace posewire::model
