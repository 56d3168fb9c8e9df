// SPDX-License-Identifier: MIT
#include "core/feed/sample_order.h"

#include "core/model/accounting/probation.h"
#include "core/model/accounting/sample_window.h"

#include <algorithm>
#include <utility>

namespace posewire::feed {
namespace {

using model::distance;
using model::Probation;

constexpr auto kAhead = static_cast<std::int32_t>(Probation::kSteps);
constexpr auto kAheadInDoubt = static_cast<std::int32_t>(Probation::kStepsInDoubt);

bool isNear(std::uint32_t number, std::uint32_t other) {
    const std::int32_t ahead = distance(number, other);
    return ahead >= -Probation::kMostBack && ahead <= kAhead;
}

bool isBefore(const HeldSample& one, std::uint32_t number) {
    return distance(one.number(), number) < 0;
}

} // namespace

void HeldSample::add(std::size_t place, const wire::Datagram& datagram, const log::Packet& packet) {
    if (m_messages[place] == nullptr) {
        m_messages[place] = std::make_unique<Joining>();
    }
    Joining& joining = *m_messages[place];
    joining.bytes += packet.bytes.size();
    if (joining.isWhole || joining.bytes > kMostBytes) {
        return;
    }
    const wire::Header& header = datagram.header;
    if (header.isLast() && header.datagramIndex() == 0) {
        joining.message.datagram = datagram;
    } else {
        joining.parts.try_emplace(header.datagramIndex(), datagram);
        if (header.isLast()) {
            joining.expected = header.datagramIndex() + std::size_t{1};
        }
        if (joining.parts.size() != joining.expected) {
            return;
        }
        auto part = joining.parts.begin();
        joining.message.datagram = std::move(part->second);
        while (++part != joining.parts.end()) {
            wire::appendPart(joining.message.datagram, part->second);
        }
        joining.parts.clear();
    }
    joining.message.stamp = packet.stamp;
    joining.message.packet = packet.number;
    joining.message.sender = packet.sender;
    joining.isWhole = true;
}

bool HeldSample::lacks(std::size_t place, const wire::Header& header) const {
    const auto& joining = m_messages[place];
    return joining == nullptr || (!joining->isWhole && !joining->parts.contains(header.datagramIndex()));
}

const model::Message* HeldSample::message(std::size_t place) const {
    return m_messages[place] != nullptr && m_messages[place]->isWhole ? &m_messages[place]->message : nullptr;
}

bool HeldSample::hasWholePose() const {
    const auto first = m_messages.begin();
    return std::any_of(first, first + model::kWholePoseTypes.size(),
                       [](const auto& one) { return one != nullptr && one->isWhole; });
}

HeldSample* SampleOrder::Run::find(std::uint32_t number) {
    const auto place = std::lower_bound(waiting.begin(), waiting.end(), number, isBefore);
    return place != waiting.end() && place->number() == number ? &*place : nullptr;
}

bool SampleOrder::Run::lacks(std::uint32_t number) {
    const bool isPast = taken && distance(number, *taken) <= 0;
    return !isPast && distance(number, highest) <= 0 && find(number) == nullptr;
}

HeldSample* SampleOrder::Run::insert(HeldSample sample) {
    const std::uint32_t number = sample.number();
    if ((taken && distance(number, *taken) <= 0) || find(number) != nullptr) {
        return nullptr;
    }
    const bool isFirst = waiting.empty() && !taken;
    highest = isFirst || distance(number, highest) > 0 ? number : highest;
    const auto place = std::lower_bound(waiting.begin(), waiting.end(), number, isBefore);
    return &*waiting.insert(place, std::move(sample));
}

/// From before a restart.
bool SampleOrder::mayStraggle(std::uint32_t number) {
    return std::any_of(m_runs.begin(), m_runs.end() - 1, [&](Run& run) { return run.lacks(number); });
}

/// The newest sample that waits for a datagram; null without one.
HeldSample* SampleOrder::findLacking(std::size_t place, const wire::Header& header) {
    for (auto run = m_runs.rbegin(); run != m_runs.rend(); ++run) {
        HeldSample* held = run->find(header.sampleCounter);
        if (held != nullptr && held->lacks(place, header)) {
            return held;
        }
    }
    return nullptr;
}

bool SampleOrder::isExpected(std::uint32_t number) {
    if (m_runs.empty()) {
        return true;
    }
    const std::int32_t ahead = distance(number, m_runs.back().highest);
    return ahead >= -Probation::kMostBack && ahead <= (mayStraggle(number) ? kAheadInDoubt : kAhead);
}

void SampleOrder::add(std::size_t place, const wire::Datagram& datagram, const log::Packet& packet) {
    const std::uint32_t number = datagram.header.sampleCounter;
    if (isExpected(number)) {
        const bool isNew = m_runs.empty();
        if (isNew) {
            m_runs.emplace_back();
        }
        Run& run = m_runs.back();
        const bool isAdvance = isNew || distance(number, run.highest) > 0;
        HeldSample* held = run.find(number);
        held = held != nullptr ? held : run.insert({number, packet.stamp});
        if (held != nullptr) {
            held->add(place, datagram, packet);
        }
        if (isAdvance) {
            advance();
        }
    } else if (HeldSample* waiting = findLacking(place, datagram.header)) {
        waiting->add(place, datagram, packet);
    } else {
        doubt(number, packet.stamp).add(place, datagram, packet);
        settle(number);
    }
    release(packet.stamp);
}

/// The run goes on, so what was doubted before is no new place: it is late, or damaged.
void SampleOrder::advance() {
    std::erase_if(m_doubted, [this](Doubted& one) {
        one.isFresh = false;
        const auto run = std::find_if(m_runs.rbegin(), m_runs.rend(),
                                      [&](Run& other) { return other.lacks(one.sample.number()); });
        if (run != m_runs.rend()) {
            run->insert(std::move(one.sample));
        }
        return run != m_runs.rend();
    });
}

HeldSample& SampleOrder::doubt(std::uint32_t number, log::Stamp stamp) {
    const auto same =
        std::ranges::find(m_doubted, number, [](const Doubted& one) { return one.sample.number(); });
    if (same != m_doubted.end()) {
        return same->sample;
    }
    if (m_doubted.size() == Probation::kMost) {
        m_doubted.erase(m_doubted.begin());
    }
    m_doubted.push_back({HeldSample(number, stamp)});
    return m_doubted.back().sample;
}

void SampleOrder::settle(std::uint32_t number) {
    const std::int32_t behind = distance(m_runs.back().highest, number);
    const bool mayBeLate = (behind > 0 && behind <= Probation::kMostLate) || mayStraggle(number);
    if (agreeing(number) >= (mayBeLate ? Probation::kAgreeingClosely : Probation::kAgreeing)) {
        believe(number);
    }
}

std::size_t SampleOrder::agreeing(std::uint32_t number) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        m_doubted, [&](const Doubted& one) { return one.isFresh && isNear(number, one.sample.number()); }));
}

/// All that was doubted and is near a counter is where the run is now: after a loss, or in a new run.
void SampleOrder::believe(std::uint32_t number) {
    std::vector<HeldSample> near;
    std::erase_if(m_doubted, [&](Doubted& one) {
        const bool isIts = isNear(number, one.sample.number());
        if (isIts) {
            near.push_back(std::move(one.sample));
        }
        return isIts;
    });
    std::ranges::sort(near, [](const HeldSample& a, const HeldSample& b) { return isBefore(a, b.number()); });
    const std::int32_t jump = distance(near.front().number(), m_runs.back().highest);
    if (jump <= 0 || jump > Probation::kMostForward) {
        m_runs.emplace_back();
    }
    for (HeldSample& one : near) {
        m_runs.back().insert(std::move(one));
    }
}

/// Returns whether the first that waits is the next one and has a whole pose, so that no other comes before
/// it.
bool SampleOrder::isNext(const Run& run) const {
    const HeldSample& first = run.waiting.front();
    return m_runs.size() == 1 && m_doubted.empty() && run.taken && first.hasWholePose() &&
           distance(first.number(), *run.taken) <= run.step && run.step != INT32_MAX;
}

void SampleOrder::release(log::Stamp now) {
    const auto isDue = [&](const Run& run) {
        return !run.waiting.empty() && (isNext(run) || now - run.waiting.front().stamp() > m_wait);
    };
    while (!m_runs.empty()) {
        std::size_t waiting = 0;
        for (const Run& run : m_runs) {
            waiting += run.waiting.size();
        }
        if (isDue(m_runs.front()) || (waiting > kMost && !m_runs.front().waiting.empty())) {
            takeFirst();
        } else if (m_runs.front().waiting.empty() && m_runs.size() > 1 &&
                   (isDue(m_runs[1]) || waiting > kMost)) {
            m_runs.pop_front();
        } else {
            break;
        }
    }
    std::erase_if(m_doubted, [&](const Doubted& one) { return now - one.sample.stamp() > m_wait; });
}

void SampleOrder::flush() {
    if (!m_doubted.empty() && agreeing(m_doubted.back().sample.number()) >= Probation::kAgreeing) {
        believe(m_doubted.back().sample.number());
    }
    while (!m_runs.empty()) {
        if (m_runs.front().waiting.empty()) {
            m_runs.pop_front();
        } else {
            takeFirst();
        }
    }
    m_doubted.clear();
}

void SampleOrder::takeFirst() {
    Run& run = m_runs.front();
    HeldSample first = std::move(run.waiting.front());
    run.waiting.pop_front();
    const bool beginsRun = !run.taken.has_value();
    run.step = beginsRun ? run.step : std::min(run.step, distance(first.number(), *run.taken));
    run.taken = first.number();
    m_take(std::move(first), beginsRun);
}

} // namespace posewire::feed
