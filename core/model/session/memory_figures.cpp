// SPDX-License-Identifier: MIT
#include "core/model/session/memory_figures.h"

#include "core/model/accounting/attribution.h"
#include "core/model/body/null_pose.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/session/ingest.h"
#include "core/model/session/messages.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace posewire::model {
namespace {

/// Of all streams, as many as there may be at the depth that they have then.
constexpr std::size_t mostStreamBytes() {
    std::size_t most = 0;
    for (std::size_t streams = AccountingDepth::kFullStreams; streams <= Roll::kMostStreams; streams *= 2) {
        const std::size_t each = sizeof(Stream) + StreamAccounting::mostBytes(AccountingDepth::of(streams));
        most = std::max(most, streams * each);
    }
    return most;
}

constexpr std::size_t kMostSenders = Roll::kMostSenders + Roll::kMostStrangers;
constexpr std::size_t kMostAccounting =
    mostStreamBytes() + kMostSenders * (sizeof(Sender) + CountHistory::mostBytes(Roll::kBucketsOfSender)) +
    Attribution::kMostBytes;
static_assert(kMostAccounting <= std::size_t{416} << 20);

/// Decoded values are not larger than twice what was sent, as long as they are items of fixed size.
constexpr std::size_t kPerSentByte = 2;
constexpr std::size_t kMostMessages =
    Roll::kMostStreams * kPerSentByte * Ingest::kMostNewestBytes + Messages::kMostDecodedBytes;

constexpr std::size_t kMostIncidents =
    Incidents::kMost * (sizeof(Incident) + Incidents::kMostDetailBytes + 128) +
    2 * Incidents::kMostParts * sizeof(Incident::Part);

} // namespace

std::size_t MemoryFigures::sum() const {
    return std::transform_reduce(parts.begin(), parts.end(), std::size_t{0}, std::plus(),
                                 [](const Part& part) { return part.bytes; });
}

std::size_t MemoryFigures::budget() const {
    return std::transform_reduce(parts.begin(), parts.end(), std::size_t{0}, std::plus(),
                                 [](const Part& part) { return part.most; });
}

MemoryFigures memoryOf(const Ingest& ingest, std::size_t decodedBytes) {
    const Counting& counting = ingest.counting();
    std::size_t accounting = counting.attribution().memoryBytes();
    std::size_t messages = decodedBytes;
    for (const Stream& stream : ingest.roll().streams()) {
        accounting += sizeof(Stream) + stream.accounting.memoryBytes();
        messages += kPerSentByte * stream.newestBytes;
    }
    for (const Sender& sender : ingest.roll().senders()) {
        accounting += sizeof(Sender) + sender.history.memoryBytes();
    }
    const log::LogFigures log = ingest.log().figures();
    const std::size_t index = counting.index().memoryBytes() + counting.digests().memoryBytes();
    return {{{"log", "packets", log.chunkBytes, log.memoryCap},
             {"index", "index", ingest.log().scratch()->hasFile() ? 0 : index, 0},
             {"accounting", "accounting", accounting, kMostAccounting},
             {"messages", "messages", messages, kMostMessages},
             {"metadata", "metadata", ingest.content().metadataBytes(), Content::kMetadataBudget},
             {"nullPoses", "null poses", ingest.content().nullPoseBytes(), Content::kNullPoseBudget},
             {"events", "incidents", ingest.incidents().incidents().memoryBytes(), kMostIncidents}}};
}

} // namespace posewire::model
