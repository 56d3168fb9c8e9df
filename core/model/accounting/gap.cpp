// SPDX-License-Identifier: MIT
#include "core/model/accounting/gap.h"

#include "core/model/text.h"
#include "core/wire/type_table.h"

namespace posewire::model {

bool Gap::isAround(std::uint32_t sample) const {
    return distance(sample, fromSample) > 0 && distance(toSample, sample) > 0;
}

std::string Gap::evidenceText() const {
    const std::int64_t lastedMs = (toStamp - fromStamp) / std::chrono::milliseconds(1);
    switch (evidence) {
    case Evidence::Dropped:
        return "This computer dropped " + counted(figure, "datagram") + " of the port between packets " +
               grouped(fromPacket) + " and " + grouped(toPacket) + ".";
    case Evidence::NotListening:
        return "This computer did not listen to the port for a while: its input was removed and added again.";
    case Evidence::Overtaken:
        return "This computer did not look at " + counted(figure, "packet") + " between packets " +
               grouped(fromPacket) + " and " + grouped(toPacket) + " in time.";
    case Evidence::Damaged:
        return "Sample " + grouped(figure) + " arrived truncated or damaged.";
    case Evidence::Partial:
        return "Only a part of sample " + grouped(figure) + ", next to the gap, arrived.";
    case Evidence::OtherStream:
        return "Type " + wire::typeDigits(otherType) + " of the same sender brought sample " +
               grouped(figure) + ", which is missing here.";
    case Evidence::Reliable:
        return "TCP loses nothing: " + counted(lost, "sample was", "samples were") + " not sent.";
    case Evidence::CutOff:
        return "The silence cut through sample " + grouped(figure) + ": it came here, and not of type " +
               wire::typeDigits(otherType) + ".";
    case Evidence::Paused:
        return (figure == 1 ? "The only stream of the sender paused for "
                            : "All " + counted(figure, "stream") + " of the sender paused together for ") +
               std::to_string(lastedMs) + " ms, and the time code moved by " + std::to_string(timeCodeMoved) +
               " ms.";
    case Evidence::None:
        break;
    }
    return isJudged ? "Nothing was dropped here, and no other stream of the sender shows where " +
                          counted(lost, "sample") + " went in " + std::to_string(lastedMs) + " ms."
                    : "Still waiting for late arrivals.";
}

} // namespace posewire::model
