// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_accounting.h"

#include "tests/core/model/accounting/arrivals.h"

#include <cstdint>
#include <cstdlib>

// Whatever counters, stamps and order: counts add up, every datagram gets one verdict or waits for it, and
// the history of a stream says the same as its sums. Each datagram is 4 bytes of input: what its counter
// does, by how much, its datagram counter, and how much time passes.
namespace {

using namespace posewire;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

void check(const model::StreamAccounting& stream, std::size_t datagrams, std::size_t verdicts) {
    const model::StreamCounts counts = stream.counts();
    require(counts.datagrams == datagrams);
    require(counts.samples + counts.incomplete + counts.duplicates <= datagrams);
    require(counts.reordered <= datagrams && counts.late <= counts.reordered);
    require(verdicts <= datagrams && datagrams - verdicts <= model::Probation::kMost);
    require(counts.step != 0 || counts.restarts != 0 || counts.lost < UINT64_MAX / 2);
    const auto range = stream.countsBetween(log::Stamp::min(), log::Stamp::max());
    require(range.datagrams == datagrams);
    if (!stream.isInDoubt()) {
        require(range.samples == counts.samples && range.incomplete == counts.incomplete);
        require(range.lost == counts.lost && range.duplicates == counts.duplicates);
        require(range.restarts == counts.restarts);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 8) {
        return 0;
    }
    model::StreamAccounting stream(data[0] % 4 == 3 ? 13 : 2);
    wire::Header header;
    log::Stamp stamp(std::chrono::seconds(1000));
    std::size_t datagrams = 0;
    std::size_t verdicts = 0;
    std::uint32_t highest = static_cast<std::uint32_t>(data[1]) << 24 | data[2];
    for (std::size_t i = 4; i + 4 <= size; i += 4) {
        const std::uint32_t amount = data[i + 1];
        switch (data[i] % 8) {
        case 0:
        case 1:
        case 2:
            header.sampleCounter = highest += 1 + (amount >= 200 ? amount - 199 : 0);
            break;
        case 3:
            header.sampleCounter = highest - amount;
            break;
        case 4:
            header.sampleCounter = highest - amount * 40;
            break;
        case 5:
            header.sampleCounter = highest += amount * 40;
            break;
        case 6:
            header.sampleCounter = highest = amount << 22;
            break;
        default:
            header.sampleCounter = highest ^ (1U << (amount % 32));
            break;
        }
        header.datagramCounter = data[i + 2] < 128 ? 0x80 : data[i + 2] & 0x83;
        header.timeCode += data[i + 3] / 8U;
        stamp += (data[i + 3] - (data[i + 3] == 255 ? 600 : 0)) * std::chrono::microseconds(100);
        verdicts += model::addTo(stream, stamp, 760, header).size();
        ++datagrams;
    }
    check(stream, datagrams, verdicts);
    return 0;
}
