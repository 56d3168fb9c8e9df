// SPDX-License-Identifier: MIT
#include "core/model/accounting/probation.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace posewire::model {
namespace {

// After this many advances of the expected place, what came from elsewhere was no restart.
constexpr std::size_t kAdvances = 3;
// This many in a row settle it however far apart they are: half a second at 60 Hz without any sign of the
// expected place.
constexpr std::size_t kAgreeingAnyhow = 32;

/// True if datagrams with these counters may have been on their way for long.
bool mayBeLate(const SampleLedger& ledger, std::uint32_t low, std::uint32_t high, log::Stamp stamp) {
    constexpr std::int32_t kNear = 100;
    return ledger.present().overlaps(low, high, Probation::kMostLate, 0) ||
           (ledger.hasBefore(stamp) && ledger.before().overlaps(low, high, kNear, kNear));
}

bool isMissing(const SampleSequence& sequence, const SampleLedger::Datagram& datagram) {
    if (!sequence.overlaps(datagram.sample, datagram.sample, 0, 0)) {
        return false;
    }
    const auto place = sequence.window().find(datagram.sample);
    return !place.isThere || !sequence.window().contains(place.index, datagram.index);
}

/// How far ahead a counter is taken for loss at once; further ahead, only if the next datagrams agree.
std::int32_t forwardLimit(const SampleLedger& ledger, const SampleLedger::Datagram& datagram) {
    const std::uint32_t step = ledger.present().step();
    const bool isStraggling = ledger.hasBefore(datagram.stamp) && isMissing(ledger.before(), datagram);
    if (step == 0 && !isStraggling) {
        return Probation::kMostForward;
    }
    const std::uint32_t limit =
        std::max(step, 1U) * (isStraggling ? Probation::kStepsInDoubt : Probation::kSteps);
    return static_cast<std::int32_t>(std::min(limit, static_cast<std::uint32_t>(Probation::kMostForward)));
}

} // namespace

bool Probation::isExpected(const SampleLedger& ledger, const SampleLedger::Datagram& datagram) {
    if (ledger.present().empty()) {
        return true;
    }
    const std::int32_t moved = distance(datagram.sample, ledger.present().highest());
    return moved >= -kMostBack && moved <= forwardLimit(ledger, datagram);
}

void Probation::add(const Waiting& waiting) {
    if (m_waiting.capacity() < kMost) {
        m_waiting.reserve(kMost);
    }
    m_waiting.push_back(waiting);
    m_waiting.back().isRepeat =
        std::any_of(m_waiting.begin(), m_waiting.end() - 1, [&](const Waiting& other) {
            return other.datagram.sample == waiting.datagram.sample &&
                   other.datagram.index == waiting.datagram.index;
        });
}

void Probation::drop(std::size_t decided) {
    m_waiting.erase(m_waiting.begin(), m_waiting.begin() + static_cast<std::ptrdiff_t>(decided));
}

void Probation::takeUnexpected(const Waiting& waiting, std::size_t near, const SampleLedger& ledger,
                               Scan& scan) {
    const std::uint32_t sample = waiting.datagram.sample;
    if (near == scan.groupCount) {
        if (scan.groupCount == kGroups) {
            std::move(scan.groups.begin() + 1, scan.groups.end(), scan.groups.begin());
            for (std::uint8_t& label : scan.labels) {
                // The first group is given up; its members are of none from now on.
                if (label == 0) {
                    label = kNoGroup;
                } else if (label < kGroups) {
                    --label;
                }
            }
            --near;
        } else {
            ++scan.groupCount;
        }
        scan.groups[near] = {sample, sample, sample, 0, 0};
    }
    Group& group = scan.groups[near];
    if (group.count == 0) {
        group.low = group.high = sample;
    }
    group.highest = distance(sample, group.highest) > 0 ? sample : group.highest;
    group.low = distance(sample, group.low) < 0 ? sample : group.low;
    group.high = distance(sample, group.high) > 0 ? sample : group.high;
    if (!waiting.isRepeat) {
        ++group.count;
        group.filling += isMissing(ledger.present(), waiting.datagram) ? 1 : 0;
    }
    scan.advances = 0;
    scan.newest = static_cast<std::uint8_t>(near);
}

void Probation::scan(const SampleLedger& ledger, Scan& scan) const {
    scan.highest = ledger.present().highest();
    const auto reach = static_cast<std::int32_t>(kMostBack * std::clamp(ledger.present().step(), 1U, 30U));
    for (std::size_t i = 0; i < m_waiting.size(); ++i) {
        const std::uint32_t sample = m_waiting[i].datagram.sample;
        const std::int32_t fromExpected = distance(sample, scan.highest);
        const std::int32_t limit = forwardLimit(ledger, m_waiting[i].datagram);
        std::size_t near = scan.groupCount;
        std::int32_t nearest =
            fromExpected >= -kMostBack && fromExpected <= limit ? std::abs(fromExpected) : INT32_MAX;
        const bool isExplained = nearest != INT32_MAX;
        for (std::size_t g = 0; g < scan.groupCount; ++g) {
            const std::int32_t from = distance(sample, scan.groups[g].highest);
            // Late arrivals are behind the expected place, what follows a long loss is ahead of it.
            const bool isOneSide = (distance(scan.groups[g].highest, scan.highest) > 0) == (fromExpected > 0);
            // A group that an advance has emptied does not take what the expected place explains.
            const bool isRefuted = isExplained && scan.groups[g].count == 0;
            if (isOneSide && !isRefuted && from >= -kMostBack && from <= reach && std::abs(from) < nearest) {
                near = g;
                nearest = std::abs(from);
            }
        }
        if (near == scan.groupCount && nearest != INT32_MAX) {
            scan.labels[i] = kExpected;
            if (fromExpected > 0) {
                scan.highest = sample;
                ++scan.advances;
                scan.afterAdvance = i + 1;
                for (Group& group : scan.groups) {
                    group.count = group.filling = 0;
                }
            }
        } else {
            takeUnexpected(m_waiting[i], near, ledger, scan);
            scan.labels[i] = scan.newest;
        }
    }
}

/// True if a group is the new place of the counter.
bool Probation::isSettled(const Group& group, const SampleLedger& ledger, log::Stamp stamp, bool isEnd) {
    if (group.count < Probation::kAgreeing) {
        return false;
    }
    if (!mayBeLate(ledger, group.low, group.high, stamp) || group.count >= kAgreeingAnyhow) {
        return true;
    }
    const std::uint32_t step = std::max(ledger.present().step(), ledger.present().step() == 0 ? 4U : 1U);
    const bool isClose = group.high - group.low <= std::uint64_t{2} * step * group.count;
    return isClose &&
           (group.count >= Probation::kAgreeingClosely || (isEnd && 2 * group.filling <= group.count));
}

void Probation::decide(const SampleLedger& ledger, bool isEnd, Decision& decision) const {
    Scan found;
    scan(ledger, found);
    decision.decided = 0;
    const auto settle = [&](std::size_t count, std::uint8_t winner, Outcome first) {
        decision.decided = count;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint8_t label = found.labels[i];
            decision.outcomes[i] = label == kExpected ? Outcome::Expected
                                   : label != winner  ? Outcome::Alone
                                                      : std::exchange(first, Outcome::Begun);
        }
    };
    if (found.newest != kExpected) {
        const Group& group = found.groups[found.newest];
        if (isSettled(group, ledger, m_waiting.back().datagram.stamp, isEnd)) {
            const std::int32_t jump = distance(group.low, found.highest);
            settle(m_waiting.size(), found.newest,
                   jump > 0 && jump <= kMostForward ? Outcome::Begun : Outcome::Restarted);
            return;
        }
    }
    if (found.advances >= kAdvances || isEnd) {
        settle(m_waiting.size(), kExpected, Outcome::Begun);
    } else if (m_waiting.size() == kMost) {
        settle(found.afterAdvance != 0 ? found.afterAdvance : kMost / 2, kExpected, Outcome::Begun);
    }
}

} // namespace posewire::model
