// SPDX-License-Identifier: MIT
#include "core/model/session/fault_matrix.h"

#include "core/model/session/roster.h"

#include <algorithm>
#include <numeric>

namespace posewire::model {
namespace {

FaultCounts countsOf(const Losses& losses, const Stream& stream) {
    const StreamLosses own = losses.of(stream);
    return {own.byCause, own.pending, own.expected};
}

void add(CharacterFaults& character, const log::StreamKey& key, const FaultCounts& counts) {
    const auto place = std::ranges::lower_bound(character.streams, key.type, {}, &StreamFaults::type);
    const bool isThere = place != character.streams.end() && place->type == key.type;
    StreamFaults& stream = isThere ? *place : *character.streams.insert(place, {key.type});
    stream.counts += counts;
    stream.streams.push_back(key);
    character.counts += countsSamples(key.type) ? counts : FaultCounts();
}

} // namespace

std::uint64_t FaultCounts::total() const {
    return std::accumulate(lost.begin(), lost.end(), std::uint64_t{0});
}

double FaultCounts::shareOf(std::uint64_t samples) const {
    return expected == 0 ? 0 : static_cast<double>(samples) / static_cast<double>(expected);
}

FaultCounts& FaultCounts::operator+=(const FaultCounts& other) {
    addLosses(lost, other.lost);
    pending += other.pending;
    expected += other.expected;
    return *this;
}

FaultMatrix faultMatrix(const SessionView& session, const std::optional<TimeRange>& range) {
    const Losses losses(session, range);
    FaultMatrix matrix;
    CharacterFaults unconfirmed;
    for (const Character& character : session.roster().characters()) {
        const CharacterKey current = session.roster().current(character.key);
        auto row = std::ranges::find(matrix.characters, current, &CharacterFaults::current);
        if (character.isConfirmed && row == matrix.characters.end()) {
            matrix.characters.push_back({character.key, current});
            row = matrix.characters.end() - 1;
        }
        CharacterFaults& faults = character.isConfirmed ? *row : unconfirmed;
        for (const Stream* stream : character.streams) {
            const FaultCounts counts = countsOf(losses, *stream);
            const bool isSampled = countsSamples(stream->key.type);
            if (isSampled || counts.total() != 0) {
                add(faults, stream->key, counts);
                matrix.sum += isSampled ? counts : FaultCounts();
            }
        }
    }
    if (unconfirmed.counts.expected != 0) {
        matrix.unconfirmed = std::move(unconfirmed);
    }
    return matrix;
}

} // namespace posewire::model
