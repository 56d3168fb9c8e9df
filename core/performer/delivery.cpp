// SPDX-License-Identifier: MIT
#include "core/performer/delivery.h"

#include "core/wire/header.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cstdlib>

namespace posewire::performer {
namespace {

constexpr log::Duration kDoubtfulFrom = std::chrono::milliseconds(25);
constexpr log::Duration kDoubtfulTo = std::chrono::milliseconds(100);
constexpr log::Duration kClearlyLate = std::chrono::milliseconds(110);
/// A stream advances by this many samples between two that are far behind.
constexpr std::uint64_t kAdvancesBetween = 4;
constexpr std::uint64_t kSettled = 16;
constexpr std::size_t kRecent = 4096;

constexpr auto kIsLater = [](const auto& a, const auto& b) {
    return std::pair(a.sending.due, a.order) > std::pair(b.sending.due, b.order);
};

} // namespace

bool QuietTimes::contains(log::Duration time) const {
    return std::ranges::any_of(
        moments, [&](log::Duration moment) { return time >= moment - width && time <= moment + width; });
}

Delivery::Delivery(log::Duration period, QuietTimes quiet, bool makesClear)
    : m_period(std::max(period, log::Duration(1))), m_quiet(std::move(quiet)), m_makesClear(makesClear) {}

void Delivery::push(Sending sending) {
    m_heap.push_back({std::move(sending), m_pushed++});
    std::ranges::push_heap(m_heap, kIsLater);
}

void Delivery::pushAfter(Sending sending, std::uint64_t count) {
    m_counted.push_back({std::move(sending), count});
}

void Delivery::notePassed(log::Duration time) {
    for (Counted& counted : m_counted) {
        if (counted.left > 0) {
            --counted.left;
        } else {
            counted.sending.due = std::max(time, counted.sending.due);
            push(std::move(counted.sending));
            counted.sending.bytes.clear();
        }
    }
    std::erase_if(m_counted, [](const Counted& counted) { return counted.sending.bytes.empty(); });
}

void Delivery::advance(Front& front, std::uint32_t sample, log::Duration time) {
    front.highest = sample;
    ++front.advances;
    front.recent.push_back({sample, time});
    if (front.recent.size() > kRecent) {
        front.recent.pop_front();
    }
}

Delivery::Judgement Delivery::judgeFar(Sending& sending, Front& front, bool isAtEnd) const {
    if (isAtEnd || front.advances < kSettled) {
        return Judgement::GiveUp;
    }
    if (front.advances < front.advancesAtFar + kAdvancesBetween || m_quiet.contains(sending.due)) {
        sending.due += m_period;
        return Judgement::Wait;
    }
    front.advancesAtFar = front.advances;
    return Judgement::Deliver;
}

Delivery::Judgement Delivery::judgeBehind(Sending& sending, Front& front, std::uint32_t sample,
                                          bool isAtEnd) const {
    const auto after = std::ranges::partition_point(
        front.recent, [&](const Advance& advance) { return distance(advance.sample, sample) <= 0; });
    if (after != front.recent.end()) {
        const log::Duration late = sending.due - after->time;
        if (late > kDoubtfulFrom && late < kDoubtfulTo) {
            sending.due = after->time + kClearlyLate;
            return Judgement::Wait;
        }
    }
    return distance(sample, front.highest) < -kMostBack ? judgeFar(sending, front, isAtEnd)
                                                        : Judgement::Deliver;
}

Delivery::Judgement Delivery::begin(Front& front, const Sending& sending, std::uint32_t sample) {
    if (sample != sending.origin.sample) {
        return Judgement::GiveUp;
    }
    front = {front.isNative, sending.origin.epoch, sending.origin.regime, sample};
    advance(front, sample, sending.due);
    return Judgement::Deliver;
}

Delivery::Judgement Delivery::judge(Sending& sending, bool isAtEnd) {
    const auto header = wire::decodeHeader(sending.bytes);
    if (!m_makesClear || !sending.isReadable || !header || !wire::isSampled(header->type())) {
        return Judgement::Deliver;
    }
    const Origin& origin = sending.origin;
    const std::uint32_t sample = header->sampleCounter;
    Front& front = m_fronts[{header->type(), header->character}];
    const bool isNative = header->type() == origin.type && header->character == origin.character;
    const bool wasNative = std::exchange(front.isNative, front.isNative || isNative);
    const std::int64_t moved = distance(sample, front.highest);
    const bool isRestart = origin.epoch > front.epoch && (moved < -kMostBack || moved > kMostForward);
    if (front.advances == 0 || isRestart || (isNative && !wasNative)) {
        return begin(front, sending, sample);
    }
    if (!front.isNative) {
        // The step of such a stream is not defined.
        return moved == 0 ? Judgement::Deliver : Judgement::GiveUp;
    }
    front.epoch = std::max(front.epoch, origin.epoch);
    return judgeNative(sending, front, sample, isAtEnd);
}

Delivery::Judgement Delivery::judgeNative(Sending& sending, Front& front, std::uint32_t sample,
                                          bool isAtEnd) const {
    const Origin& origin = sending.origin;
    const bool isIntact = sample == origin.sample;
    const bool isElsewhere = !isIntact && std::abs(distance(sample, origin.sample)) > kMostForward;
    if (front.epoch != origin.epoch && !m_keepsStragglers) {
        return Judgement::GiveUp;
    }
    if (front.epoch != origin.epoch || isElsewhere) {
        return judgeFar(sending, front, isAtEnd);
    }
    if (!isIntact && (distance(sample, front.first) < 0 || m_quiet.contains(sending.due))) {
        return Judgement::GiveUp;
    }
    const std::int64_t moved = distance(sample, front.highest);
    if (moved > 0) {
        if (std::exchange(front.regime, origin.regime) != origin.regime) {
            front.first = sample;
        }
        advance(front, sample, sending.due);
    }
    return moved >= 0 ? Judgement::Deliver : judgeBehind(sending, front, sample, isAtEnd);
}

void Delivery::take(std::optional<log::Duration> until, std::vector<Sending>& into) {
    if (!until) {
        for (Counted& counted : m_counted) {
            counted.sending.due = std::max(counted.sending.due, m_latest);
            push(std::move(counted.sending));
        }
        m_counted.clear();
    }
    while (!m_heap.empty() && (!until || m_heap.front().sending.due < *until)) {
        std::ranges::pop_heap(m_heap, kIsLater);
        Entry entry = std::move(m_heap.back());
        m_heap.pop_back();
        switch (judge(entry.sending, !until.has_value())) {
        case Judgement::Deliver:
            m_latest = entry.sending.due;
            into.push_back(std::move(entry.sending));
            break;
        case Judgement::Wait:
            push(std::move(entry.sending));
            break;
        case Judgement::GiveUp:
            ++m_givenUp;
            break;
        }
    }
}

} // namespace posewire::performer
