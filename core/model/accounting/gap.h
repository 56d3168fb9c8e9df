// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"
#include "core/words/fact.h"

#include <cstdint>

namespace posewire::model {

/// Samples of a stream that did not come between two that did, and whose loss that was.
struct Gap {
    /// What the cause rests on.
    enum class Evidence : std::uint8_t {
        None,         ///< nothing speaks for anybody
        Dropped,      ///< this computer dropped datagrams of the socket meanwhile
        NotListening, ///< the input of the port was closed meanwhile
        Overtaken,    ///< this computer did not look at packets of the log in time
        Damaged,      ///< one of the samples came truncated
        Partial,      ///< of a sample next to it only a part came
        OtherStream,  ///< other streams of the sender brought one of the samples
        Reliable,     ///< TCP loses nothing
        CutOff,       ///< a silence of all streams began or ended within a sample
        Paused,       ///< all streams of the sender paused together, and the time code moved with the pause
    };

    log::StreamKey stream;
    std::uint32_t fromSample = 0; ///< the samples around it, which came
    std::uint32_t toSample = 0;
    log::Stamp fromStamp{};
    log::Stamp toStamp{};
    std::uint64_t fromPacket = 0;
    std::uint64_t toPacket = 0;
    std::uint32_t lost = 0; ///< what still is; 0 if all came late or nothing was expected
    LossCause cause = LossCause::Unknown;
    Evidence evidence = Evidence::None;
    bool isJudged = false;           ///< else late arrivals are still waited for
    std::uint32_t timeCodeMoved = 0; ///< ms
    std::uint64_t figure = 0;        ///< of the evidence: datagrams, a sample, ms
    std::uint64_t incident = 0;      ///< that its loss is told in; 0 for none
    std::uint8_t otherType = 0;      ///< of the evidence OtherStream or CutOff

    [[nodiscard]] bool isAround(std::uint32_t sample) const;
    [[nodiscard]] words::Fact evidenceFact() const;
};

/// Samples of a stream that are not there yet, and not yet lost.
struct PendingLoss {
    log::StreamKey stream;
    std::uint64_t samples = 0;
    log::Stamp from{};
    log::Stamp to{};
    bool isUnderWay = false; ///< the rest of the newest sample, after which nothing came: it may just come
};

} // namespace posewire::model
