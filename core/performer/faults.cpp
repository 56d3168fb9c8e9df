// SPDX-License-Identifier: MIT
#include "core/performer/faults.h"

#include "core/wire/byte_order.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <span>

namespace posewire::performer {
namespace {

constexpr double kLongestDelayMs = 10'000.0;

bool isProbability(double value) {
    return value >= 0.0 && value <= 1.0;
}

std::optional<std::string> findProbabilityProblem(const FaultSettings& settings) {
    const std::array<std::pair<const char*, double>, 5> probabilities{{{"drop", settings.drop},
                                                                       {"duplicate", settings.duplicate},
                                                                       {"reorder", settings.reorder},
                                                                       {"corrupt", settings.corrupt},
                                                                       {"truncate", settings.truncate}}};
    for (const auto& [name, value] : probabilities) {
        if (!isProbability(value)) {
            return std::string("The probability of ") + name + " must be from 0 to 1.";
        }
    }
    const auto& model = settings.gilbertElliott;
    if (model && !(isProbability(model->toBad) && isProbability(model->toGood) &&
                   isProbability(model->passesInGood) && isProbability(model->passesInBad))) {
        return "The four probabilities p, r, k, h of the Gilbert-Elliott model must be from 0 to 1.";
    }
    if (model && settings.drop > 0.0) {
        return "Choose either drop or the Gilbert-Elliott model.";
    }
    return std::nullopt;
}

/// The chance of a burst to begin where none is, so that a share `drop` of all datagrams is lost.
double burstChance(double drop, int burst) {
    if (drop >= 1.0) {
        return 1.0;
    }
    const double lost = drop / burst;
    return lost / (lost + 1.0 - drop);
}

/// Samples before and after a restart or a change of rate that reach the receiver as they are.
constexpr double kQuietSamples = 16.0;
/// Restarts further away than this leave no doubt where a straggler belongs.
constexpr std::int64_t kFarRestart = 20'000;
/// Parts of character information further apart could not be distinguished from its next repetition.
constexpr double kTogetherMs = 60.0;
/// Of the sample counter in the header (§2.4.1.2).
constexpr std::size_t kCounterOffset = 6;

/// One independent sender of chance for each kind of fault, so that one kind does not change another.
enum Chance : std::uint64_t {
    Loss,
    Duplication,
    CopyTime,
    Reordering,
    HoldKind,
    HoldTime,
    Corruption,
    CorruptedBytes,
    Truncation,
    TruncatedSize,
    Jitter,
    Parts
};

log::Duration fromSeconds(double seconds) {
    return log::Duration(std::llround(seconds * 1e9));
}

log::Duration fromMilliseconds(double milliseconds) {
    return log::Duration(std::llround(milliseconds * 1e6));
}

QuietTimes quietTimes(const FaultSettings& settings) {
    QuietTimes quiet;
    double samples = kQuietSamples;
    if (settings.restart) {
        quiet.moments.push_back(fromSeconds(settings.restart->atSeconds));
    }
    if (settings.reduction) {
        quiet.moments.push_back(fromSeconds(settings.reduction->atSeconds));
        samples *= settings.reduction->step;
    }
    quiet.width = fromSeconds(samples / settings.rateHz);
    return quiet;
}

} // namespace

std::optional<std::string> findProblem(const FaultSettings& settings) {
    if (auto problem = findProbabilityProblem(settings)) {
        return problem;
    }
    if (settings.burst < 1 || settings.burst > 1'000'000) {
        return "A burst is from 1 to 1000000 datagrams long.";
    }
    for (const double milliseconds : {settings.delayMs, settings.jitterMs}) {
        if (!(milliseconds >= 0.0 && milliseconds <= kLongestDelayMs)) {
            return "Delay and jitter must be from 0 to 10000 ms.";
        }
    }
    if (settings.restart && !(settings.restart->atSeconds >= 0.0)) {
        return "A restart needs a time after the start.";
    }
    if (settings.pause && !(settings.pause->atSeconds >= 0.0 && settings.pause->seconds >= 0.0)) {
        return "A pause needs a time after the start and a length.";
    }
    if (settings.content && !std::ranges::count(contentBreaks(), settings.content->kind)) {
        return "There is no content fault of this kind.";
    }
    if (settings.reduction && !(settings.reduction->atSeconds >= 0.0 && settings.reduction->step >= 1 &&
                                settings.reduction->step <= 100)) {
        return "A rate is reduced at a time after the start to every 1st to 100th sample.";
    }
    return std::nullopt;
}

Faults::Faults(const FaultSettings& settings)
    : m_settings(settings),
      m_random(KeyedRandom(settings.seed).fork(0xfa17)),
      m_quiet(quietTimes(settings)),
      m_delivery(log::Duration(static_cast<std::int64_t>(1e9 / settings.rateHz)), m_quiet,
                 !settings.isRecorded) {
    if (settings.content) {
        m_content.emplace(*settings.content);
    }
}

bool Faults::isPaused(log::Duration due) const {
    const auto& pause = m_settings.pause;
    return pause && due >= fromSeconds(pause->atSeconds) &&
           due < fromSeconds(pause->atSeconds + pause->seconds);
}

bool Faults::isReduced(std::uint32_t sample, log::Duration due) {
    const auto& reduction = m_settings.reduction;
    if (!reduction || due < fromSeconds(reduction->atSeconds)) {
        return false;
    }
    if (!m_reductionSample) {
        m_reductionSample = sample;
    }
    return true;
}

void Faults::offer(std::vector<std::byte> datagram, log::Duration due) {
    m_delivery.take(due, m_ready);
    const auto header = wire::decodeHeader(datagram);
    Sending sending{std::move(datagram), due, {}, header.has_value()};
    if (header) {
        sending.origin = {header->sampleCounter, header->type(), header->character};
    }
    if (header && wire::isSampled(header->type())) {
        if (isReduced(header->sampleCounter, due)) {
            sending.origin.regime = 1;
            sending.origin.step = m_settings.reduction->step;
            if ((header->sampleCounter - *m_reductionSample) % sending.origin.step != 0) {
                ++m_tally.withheld;
                return;
            }
        }
        if (const auto& restart = m_settings.restart;
            m_epoch == 0 && restart && due >= fromSeconds(restart->atSeconds)) {
            m_epoch = 1;
            m_shift = sending.origin.sample - restart->firstSample;
            m_delivery.keepStragglers(std::abs(distance(sending.origin.sample, restart->firstSample)) >
                                      kFarRestart);
        }
        sending.origin.epoch = m_epoch;
        sending.origin.sample -= m_shift;
        wire::store32(sending.bytes.data() + kCounterOffset, sending.origin.sample);
    }
    if (isPaused(due)) {
        ++m_tally.withheld;
        return;
    }
    send(std::move(sending));
}

void Faults::send(Sending sending) {
    if (!m_settings.splits) {
        deliver(std::move(sending));
        return;
    }
    // A sample that is sent again after a short restart has the same parts again.
    const Origin& origin = sending.origin;
    const KeyedRandom random = m_random.fork(Parts).fork(256U * origin.type + origin.character);
    const std::size_t parts = 2 + random.bits(origin.sample) % 3;
    for (auto& part : splitSample(sending.bytes, parts)) {
        deliver({std::move(part), sending.due, sending.origin, sending.isReadable});
    }
}

void Faults::damage(Sending& sending, std::uint64_t key) {
    if (happens(m_settings.corrupt, m_random.fork(Corruption), key)) {
        ++m_tally.corrupted;
        const bool isPlain = !m_settings.splits || sending.origin.type == 24 || sending.origin.type == 25;
        corrupt(sending, {1000.0 / m_settings.rateHz, isPlain, !m_settings.splits},
                m_random.fork(CorruptedBytes), key);
    }
    if (happens(m_settings.truncate, m_random.fork(Truncation), key)) {
        ++m_tally.truncated;
        truncate(sending, m_random.fork(TruncatedSize), key);
    }
}

/// Less than the time of a few samples, clearly late, or so long that more than 100 samples overtake it.
double Faults::holdMs(std::uint64_t key) const {
    const double chance = m_random.fork(HoldKind).uniform(key);
    const KeyedRandom time = m_random.fork(HoldTime);
    if (chance < 0.6) {
        return time.uniform(key, 4.0, 24.0);
    }
    if (chance < 0.9) {
        return time.uniform(key, 120.0, 400.0);
    }
    const double periodMs = 1000.0 / m_settings.rateHz;
    return std::min(time.uniform(key, 110.0, 200.0) * periodMs, 3000.0);
}

bool Faults::loses(std::uint64_t key) {
    const KeyedRandom random = m_random.fork(Loss);
    if (const auto& model = m_settings.gilbertElliott) {
        if (random.uniform(2 * key) < (m_isBad ? model->toGood : model->toBad)) {
            m_isBad = !m_isBad;
        }
        return random.uniform(2 * key + 1) >= (m_isBad ? model->passesInBad : model->passesInGood);
    }
    if (m_leftOfBurst == 0 && random.uniform(key) < burstChance(m_settings.drop, m_settings.burst)) {
        m_leftOfBurst = m_settings.burst;
    }
    if (m_leftOfBurst == 0) {
        return false;
    }
    --m_leftOfBurst;
    return true;
}

void Faults::deliver(Sending sending) {
    const std::uint64_t key = ++m_tally.offered;
    const log::Duration passed = sending.due;
    const bool isQuiet = m_quiet.contains(passed);
    if (const bool isLost = loses(key); isLost && !isQuiet) {
        ++m_tally.dropped;
        m_delivery.notePassed(passed);
        return;
    }
    sending.due += fromMilliseconds(m_settings.delayMs);
    if (isQuiet) {
        m_delivery.push(std::move(sending));
        m_delivery.notePassed(passed);
        return;
    }
    const bool isSampled = wire::isSampled(sending.origin.type);
    const double jitterMs = isSampled ? m_settings.jitterMs : std::min(m_settings.jitterMs, kTogetherMs);
    sending.due += fromMilliseconds(jitterMs * m_random.fork(Jitter).uniform(key));
    damage(sending, key);
    if (happens(m_settings.duplicate, m_random.fork(Duplication), key)) {
        sendCopy(sending, key);
    }
    if (!happens(m_settings.reorder, m_random.fork(Reordering), key)) {
        m_delivery.push(std::move(sending));
    } else {
        ++m_tally.reordered;
        const std::uint64_t bits = m_random.fork(HoldTime).bits(key);
        if (isSampled && bits % 3 == 0) {
            m_delivery.pushAfter(std::move(sending), 1 + (bits >> 8) % 150);
        } else {
            sending.due += fromMilliseconds(isSampled ? holdMs(key) : kTogetherMs);
            m_delivery.push(std::move(sending));
        }
    }
    m_delivery.notePassed(passed);
}

/// Half of the copies follow at once, the others come some milliseconds to half a second later.
void Faults::sendCopy(const Sending& sending, std::uint64_t key) {
    ++m_tally.duplicated;
    Sending copy = sending;
    const std::uint64_t bits = m_random.fork(CopyTime).bits(key);
    if (bits % 2 == 0) {
        const bool isNear = bits % 4 == 0 || !wire::isSampled(sending.origin.type);
        const std::uint64_t milliseconds = isNear ? 1 + (bits >> 8) % 25 : 120 + (bits >> 8) % 380;
        copy.due += std::chrono::milliseconds(milliseconds);
    }
    m_delivery.push(std::move(copy));
}

void Faults::take(std::optional<log::Duration> until, std::vector<Sending>& into) {
    const std::size_t before = into.size();
    std::ranges::move(m_ready, std::back_inserter(into));
    m_ready.clear();
    m_delivery.take(until, into);
    if (m_content) {
        std::ranges::for_each(std::span(into).subspan(before),
                              [this](Sending& one) { m_content->apply(one); });
    }
}

FaultTally Faults::tally() const {
    FaultTally tally = m_tally;
    tally.dropped += m_delivery.givenUp();
    return tally;
}

} // namespace posewire::performer
