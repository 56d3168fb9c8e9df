// SPDX-License-Identifier: MIT
#include "core/model/accounting/thresholds.h"

#include <algorithm>
#include <cmath>

namespace posewire::model {

void ThresholdWatch::check(const std::deque<Stream>& streams, std::int64_t stampNs, Events& events) {
    m_habits.resize(streams.size());
    for (std::size_t i = 0; i < streams.size(); ++i) {
        if (countsSamples(streams[i].key.type)) {
            check(streams[i], m_habits[i], stampNs, events);
        }
    }
}

void ThresholdWatch::check(const Stream& stream, Habit& habit, std::int64_t stampNs, Events& events) const {
    const StreamAccounting& accounting = stream.accounting;
    const auto windowNs = static_cast<std::int64_t>(m_thresholds.windowS * 1e9);
    const std::int64_t fromNs = stampNs - windowNs;
    const double ageS = static_cast<double>(stampNs - accounting.lastStampNs()) * 1e-9;
    hold(stream, {EventKind::AgeLimit, ageS, m_thresholds.ageS}, stampNs, events);
    const StreamCounts counts = accounting.countsBetween(fromNs, stampNs);
    if (counts.samples == 0) {
        return;
    }
    const InterArrival arrivals = accounting.interArrivalBetween(fromNs, stampNs);
    hold(stream, {EventKind::LossLimit, 100 * counts.lossRatio(), m_thresholds.lossPercent}, stampNs, events);
    hold(stream, {EventKind::JitterLimit, accounting.jitterMsAt(stampNs), m_thresholds.jitterMs}, stampNs,
         events);
    hold(stream, {EventKind::GapLimit, arrivals.mostMs, m_thresholds.gapMs}, stampNs, events);
    const bool isWholeWindow = accounting.firstStampNs() <= fromNs && ageS < m_thresholds.windowS / 2;
    if (!isWholeWindow || m_thresholds.windowS <= 0) {
        return;
    }
    const double rateHz = static_cast<double>(counts.samples) / m_thresholds.windowS;
    if (habit.rateHz > 0) {
        const double offPercent = 100 * std::abs(rateHz - habit.rateHz) / habit.rateHz;
        hold(stream, {EventKind::RateLimit, offPercent, m_thresholds.ratePercent}, stampNs, events);
    }
    // What lasts becomes usual: half of the way in about a minute of checks twice a second.
    constexpr double kShare = 1.0 / 180;
    habit.rateHz += habit.rateHz > 0 ? (rateHz - habit.rateHz) * kShare : rateHz;
}

void ThresholdWatch::hold(const Stream& stream, const Measure& measure, std::int64_t stampNs,
                          Events& events) const {
    Event event;
    event.kind = measure.kind;
    event.sender = stream.key.sender;
    event.character = stream.key.character;
    event.type = stream.key.type;
    event.firstStampNs = event.lastStampNs = stampNs;
    event.value = measure.value;
    event.limit = measure.limit;
    event.count = 1;
    const bool isKnown = events.isCurrent(event);
    if (measure.limit > 0 && measure.value > measure.limit) {
        event.count = isKnown ? 0 : 1;
        events.report(event);
    } else if (isKnown && (measure.limit <= 0 || measure.value <= measure.limit * m_thresholds.hysteresis)) {
        events.end(event, stampNs);
    }
}

} // namespace posewire::model
