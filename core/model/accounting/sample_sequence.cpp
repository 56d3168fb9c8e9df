// SPDX-License-Identifier: MIT
#include "core/model/accounting/sample_sequence.h"

namespace posewire::model {
namespace {

std::uint32_t lostWithin(std::int64_t difference, std::uint32_t step) {
    return step == 0 || difference <= step ? 0 : static_cast<std::uint32_t>(difference / step - 1);
}

/// The newest differences between successive samples of a window, oldest first.
struct NewestDifferences {
    std::array<std::uint32_t, kStepHistory> values{};
    std::size_t size = 0;
    [[nodiscard]] std::span<const std::uint32_t> all() const { return {values.data(), size}; }
};

std::size_t firstOfHistory(const SampleWindow& window) {
    return window.size() > kStepHistory + 1 ? window.size() - kStepHistory - 1 : 0;
}

/// Those behind the entry `first`, which is one of the last kStepHistory + 1.
NewestDifferences differencesFrom(const SampleWindow& window, std::size_t first) {
    NewestDifferences result;
    for (std::size_t i = first + 1; i < window.size(); ++i) {
        result.values[result.size++] = window[i].sample - window[i - 1].sample;
    }
    return result;
}

/// Fewer differences than these are no spacing of their own: they are loss, or too few to know better.
constexpr std::size_t kLeastOfRun = 8;

void noteBurst(const std::optional<LossBursts::Burst>& burst, CountHistory* history) {
    if (burst && history != nullptr) {
        history->add(burst->end, {.bursts = 1,
                                  .burstLost = static_cast<std::uint32_t>(burst->lost),
                                  .burstSamples = static_cast<std::uint32_t>(burst->samples)});
    }
}

} // namespace

std::int64_t SampleSequence::Run::lost() const {
    return step == 0 ? 0 : std::max<std::int64_t>(0, (last - first) / step + 1 - samples - incomplete);
}

std::int64_t SampleSequence::position(std::uint32_t sample) const {
    return m_highest + static_cast<std::int32_t>(sample - m_window.back().sample);
}

std::int64_t SampleSequence::lostNow() const {
    std::int64_t lost = m_pastLost;
    for (std::size_t i = 0; i < m_runCount; ++i) {
        lost += m_runs[i].lost();
    }
    return lost;
}

void SampleSequence::addTo(StreamCounts& counts) const {
    std::int64_t samples = m_past.samples;
    std::int64_t incomplete = m_past.incomplete;
    for (std::size_t i = 0; i < m_runCount; ++i) {
        samples += m_runs[i].samples;
        incomplete += m_runs[i].incomplete;
    }
    counts.samples += static_cast<std::uint64_t>(samples);
    counts.incomplete += static_cast<std::uint64_t>(incomplete);
    counts.lost += static_cast<std::uint64_t>(lostNow());
}

/// The run that a sample is counted in, extended if it lies outside: the first that it would extend if it
/// lies between two.
SampleSequence::Run& SampleSequence::runFor(std::int64_t position) {
    for (std::size_t i = m_runCount; i-- > 0;) {
        Run& run = m_runs[i];
        if (position >= run.first) {
            run.last = std::max(run.last, position);
            return run;
        }
        const bool isBetween = i > 0 && position > m_runs[i - 1].last;
        if (i == 0 ? !m_hasPast : isBetween && run.step != 0 && (run.first - position) % run.step == 0) {
            run.first = position;
            return run;
        }
    }
    return m_past;
}

bool SampleSequence::overlaps(std::uint32_t low, std::uint32_t high, std::int32_t below,
                              std::int32_t above) const {
    return !empty() && distance(high, m_window[0].sample) >= -below && distance(low, highest()) <= above;
}

Placement SampleSequence::place(const Datagram& datagram, CountHistory* history) {
    if (m_window.empty()) {
        m_window.insert(0, datagram.sample, datagram.stamp);
        m_highest = m_first = datagram.sample;
        m_runs[0] = {m_highest, m_highest, 0, 0, 0};
        m_runCount = 1;
        return mark(datagram, 0, history);
    }
    const auto place = m_window.find(datagram.sample);
    if (place.isThere) {
        return mark(datagram, place.index, history);
    }
    if (place.index == m_window.size()) {
        return advance(datagram, history);
    }
    if (place.index == 0 && (m_window.hasForgotten() || m_window.size() == m_window.most())) {
        return {};
    }
    return fill(datagram, place.index, history);
}

/// Counts the datagram of a sample that is in the window, and in its run if it is the sample's first.
/// `isSteady`: nothing is lost between it and the sample before.
Placement SampleSequence::mark(const Datagram& datagram, std::size_t index, CountHistory* history,
                               bool isSteady) {
    Placement placement;
    const bool isFirst = m_window[index].parts == SampleWindow::kUnmarked;
    const auto mark = m_window.mark(index, datagram.index, datagram.isLast);
    if (mark == SampleWindow::Mark::Duplicate) {
        placement.kind = Placement::Kind::Duplicate;
        return placement;
    }
    const bool isHighest = index + 1 == m_window.size();
    placement.kind = !isFirst    ? Placement::Kind::Part
                     : isHighest ? Placement::Kind::Advance
                                 : Placement::Kind::Filled;
    const log::Stamp due = dueStamp(index);
    if (!isHighest) {
        placement.isReordered = true;
        placement.late = datagram.stamp - dueStamp(index + 1);
    }
    const bool isCompleting = mark == SampleWindow::Mark::Completing;
    placement.isCompleting = isCompleting;
    if (!isFirst && !isCompleting) {
        return placement;
    }
    const std::int64_t place = position(datagram.sample);
    const bool mayChangeLost = isFirst && !isSteady && history != nullptr;
    const std::int64_t lostBefore = mayChangeLost ? lostNow() : 0;
    Run& run = runFor(place);
    const int incomplete = (isFirst ? 1 : 0) - (isCompleting ? 1 : 0);
    run.samples += isCompleting ? 1 : 0;
    run.incomplete += incomplete;
    if (isFirst && &run == &m_past) {
        m_pastLost = std::max<std::int64_t>(0, m_pastLost - 1);
    }
    if (history != nullptr) {
        const std::int64_t lost = mayChangeLost ? lostNow() - lostBefore : 0;
        history->add(due, {.samples = isCompleting ? 1U : 0U,
                           .lost = static_cast<std::uint32_t>(lost),
                           .incomplete = static_cast<std::uint32_t>(incomplete)});
    }
    return placement;
}

Placement SampleSequence::advance(const Datagram& datagram, CountHistory* history) {
    const std::uint32_t before = m_window.back().sample;
    const std::uint32_t difference = datagram.sample - before;
    const bool wasFull = m_window.size() == m_window.most();
    m_window.insert(m_window.size(), datagram.sample, datagram.stamp);
    m_settled -= wasFull && m_settled > 0 ? 1 : 0;
    m_highest += difference;
    const std::uint32_t step = newestRun().step;
    Placement placement = mark(datagram, m_window.size() - 1, history, difference == step);
    placement.gap = lostWithin(difference, step);
    placement.sampleBefore = before;
    const bool isIrregular = step == 0 && m_window.size() > kStepDifferences;
    const std::uint32_t shown = isIrregular ? difference : placement.gap;
    if (shown != 0 && history != nullptr) {
        history->addGap(datagram.stamp, shown);
    }
    if (difference != step) {
        reconsiderStep(history);
    }
    // This far behind the highest, losses are taken for settled.
    settle(std::max<std::size_t>(m_window.most() / 8, kStepHistory), history);
    return placement;
}

Placement SampleSequence::fill(const Datagram& datagram, std::size_t index, CountHistory* history) {
    const bool wasFull = m_window.size() == m_window.most();
    index = m_window.insert(index, datagram.sample, datagram.stamp);
    m_settled -= wasFull && m_settled > 0 ? 1 : 0;
    m_settled += index < m_settled ? 1 : 0;
    if (index == 0 && static_cast<std::int32_t>(datagram.sample - m_first) < 0) {
        m_first = datagram.sample;
    }
    Placement placement = mark(datagram, index, history);
    const std::uint32_t step = newestRun().step;
    const bool isRegular = m_window[index + 1].sample - datagram.sample == step &&
                           (index == 0 || datagram.sample - m_window[index - 1].sample == step);
    if (!isRegular) {
        reconsiderStep(history);
    }
    return placement;
}

/// When the sample at an index should have come: when it came, or when the first one above it did.
log::Stamp SampleSequence::dueStamp(std::size_t index) const {
    while (!m_window[index].isAdvance && index + 1 < m_window.size()) {
        ++index;
    }
    return m_window[index].stamp;
}

/// The first entry of a run, or the `most`th from the end if that is later.
std::size_t SampleSequence::firstOfRun(const Run& run, std::size_t most) const {
    std::size_t index = m_window.size() > most ? m_window.size() - most : 0;
    while (index + 1 < m_window.size() && position(m_window[index].sample) < run.first) {
        ++index;
    }
    return index;
}

void SampleSequence::reconsiderStep(CountHistory* history) {
    const NewestDifferences differences = differencesFrom(m_window, firstOfHistory(m_window));
    correctStep(nextStep(differences.all(), newestRun().step), history);
}

/// Recounts the newest run with this step.
void SampleSequence::correctStep(std::uint32_t step, CountHistory* history) {
    if (step == newestRun().step) {
        return;
    }
    const std::size_t first = firstOfHistory(m_window);
    const NewestDifferences differences = differencesFrom(m_window, first);
    const std::int64_t totalBefore = lostNow();
    const auto lostAfter = [this](std::size_t entry) {
        std::array<std::int64_t, kStepHistory> lost{};
        const Run* run = nullptr;
        for (std::size_t i = entry + 1; i < m_window.size(); ++i) {
            lost[i - entry - 1] = static_cast<std::int64_t>(lostBefore(i, run));
        }
        return lost;
    };
    const auto before = lostAfter(first);
    changeStep(step);
    std::int64_t rest = lostNow() - totalBefore;
    if (history == nullptr || rest == 0) {
        return;
    }
    // What seemed lost, or did not, is corrected at the time when it seemed so.
    const auto after = lostAfter(first);
    for (std::size_t i = 0; i < differences.size; ++i) {
        if (after[i] != before[i]) {
            const std::int64_t lost = after[i] - before[i];
            rest -= lost;
            history->add(dueStamp(first + 1 + i), {.lost = static_cast<std::uint32_t>(lost)});
        }
    }
    if (rest != 0) {
        history->add(m_window.back().stamp, {.lost = static_cast<std::uint32_t>(rest)});
    }
}

/// Gives the newest run another step: the whole run where that explains it, else from the place of the
/// change on.
void SampleSequence::changeStep(std::uint32_t step) {
    if (isTransitionTo(step)) {
        const Run& joined = m_runs[--m_runCount];
        newestRun().last = joined.last;
        newestRun().samples += joined.samples;
        newestRun().incomplete += joined.incomplete;
        if (newestRun().step == step) {
            return;
        }
    }
    const std::size_t first = firstOfRun(newestRun(), kStepHistory + 1);
    const NewestDifferences differences = differencesFrom(m_window, first);
    const std::size_t place = placeOfChange(differences.all(), newestRun().step, step);
    const auto front = differences.all().first(place);
    const bool isAllSeen = position(m_window[first].sample) == newestRun().first;
    if (isAllSeen && (front.size() < kLeastOfRun || (step != 0 && holdsStep(front, step)))) {
        newestRun().step = step;
        return;
    }
    splitRun(first + place + 1, step);
    Run& old = m_runs[m_runCount - 2];
    old.step = isAllSeen ? findStep(front) : old.step;
}

/// True if the newest run is irregular only because one step went over to another, or lost much for a while.
bool SampleSequence::isTransitionTo(std::uint32_t step) const {
    if (newestRun().step != 0 || step == 0 || m_runCount == 1 || m_runs[m_runCount - 2].step == 0) {
        return false;
    }
    const Run& before = m_runs[m_runCount - 2];
    const std::size_t first = firstOfRun(before, kStepHistory + 1);
    const std::size_t begin = firstOfRun(newestRun(), kStepHistory + 1) - first;
    const NewestDifferences differences = differencesFrom(m_window, first);
    if (begin == 0) {
        return false;
    }
    const std::size_t place = before.step == step
                                  ? begin + placeOfChange(differences.all().subspan(begin), 0, step)
                                  : placeOfChange(differences.all(), before.step, step);
    return place < begin + kLeastOfRun ||
           holdsStep(differences.all().subspan(begin, place - begin), before.step);
}

/// Ends the newest run before an entry of the window, which begins the next.
void SampleSequence::splitRun(std::size_t firstEntry, std::uint32_t step) {
    if (m_runCount == kRuns) {
        m_past.samples += m_runs[0].samples;
        m_past.incomplete += m_runs[0].incomplete;
        m_hasPast = true;
        m_pastLost += m_runs[0].lost();
        std::move(m_runs.begin() + 1, m_runs.end(), m_runs.begin());
        --m_runCount;
    }
    Run& old = newestRun();
    Run next{position(m_window[firstEntry].sample), old.last, step, 0, 0};
    for (std::size_t i = firstEntry; i < m_window.size(); ++i) {
        ++(m_window[i].isComplete ? next.samples : next.incomplete);
    }
    old.last = position(m_window[firstEntry - 1].sample);
    old.samples -= next.samples;
    old.incomplete -= next.incomplete;
    m_runs[m_runCount++] = next;
}

/// Samples lost between the entry at an index and the one before it. `run` is that of the entry, kept by the
/// caller from one call to the next.
std::uint64_t SampleSequence::lostBefore(std::size_t index, const Run*& run) const {
    const std::int64_t to = position(m_window[index].sample);
    const std::int64_t from = position(m_window[index - 1].sample);
    if (run == nullptr || to < run->first || to > run->last) {
        run = nullptr; // the newest that begins before it
        for (std::size_t i = m_runCount; run == nullptr && i-- > 0;) {
            run = to >= m_runs[i].first ? &m_runs[i] : nullptr;
        }
    }
    return run == nullptr || from < run->first ? 0 : lostWithin(to - from, run->step);
}

/// Adds to the history the bursts among all but the newest samples.
void SampleSequence::settle(std::size_t most, CountHistory* history) {
    const Run* run = nullptr;
    for (; m_settled + most < m_window.size(); ++m_settled) {
        const std::uint64_t lost = m_settled == 0 ? 0 : lostBefore(m_settled, run);
        m_longestGap = std::max(m_longestGap, m_settled == 0 ? 0 : gapBefore(m_settled, lost, run));
        noteBurst(m_bursts.add(lost, dueStamp(m_settled)), history);
    }
}

/// What counts as the gap between the entry at an index of a run and the one before it.
std::uint64_t SampleSequence::gapBefore(std::size_t index, std::uint64_t lost, const Run* run) const {
    const bool isIrregular =
        run != nullptr && run->step == 0 && position(m_window[index - 1].sample) >= run->first;
    return isIrregular ? m_window[index].sample - m_window[index - 1].sample : lost;
}

std::uint64_t SampleSequence::longestGap() const {
    std::uint64_t longest = m_longestGap;
    const Run* run = nullptr;
    for (std::size_t i = std::max<std::size_t>(m_settled, 1); i < m_window.size(); ++i) {
        const std::uint64_t lost = lostBefore(i, run);
        longest = std::max(longest, gapBefore(i, lost, run));
    }
    return longest;
}

void SampleSequence::addNewestBursts(const TimeRange& range, BurstCounts& into) const {
    const auto take = [&](const std::optional<LossBursts::Burst>& burst) {
        if (burst && burst->end >= range.from && burst->end < range.to) {
            into.bursts += 1;
            into.lost += burst->lost;
            into.samples += burst->samples;
        }
    };
    LossBursts bursts = m_bursts;
    const Run* run = nullptr;
    for (std::size_t i = m_settled; i < m_window.size(); ++i) {
        take(bursts.add(i == 0 ? 0 : lostBefore(i, run), dueStamp(i)));
    }
    take(bursts.endRun());
}

std::uint32_t SampleSequence::missingBetween(std::uint32_t from, std::uint32_t to) const {
    if (m_window.empty()) {
        return 0;
    }
    std::uint32_t missing = 0;
    const Run* run = nullptr;
    for (std::size_t i = m_window.find(from).index + 1; i < m_window.size(); ++i) {
        if (static_cast<std::int32_t>(m_window[i].sample - to) > 0) {
            break;
        }
        missing += static_cast<std::uint32_t>(lostBefore(i, run));
    }
    return missing;
}

void SampleSequence::setMost(std::size_t samples, CountHistory* history) {
    if (samples < m_window.size()) {
        settle(samples / 2, history);
    }
    m_settled -= std::min(m_settled, m_window.setMost(samples));
}

void SampleSequence::completeAll(CountHistory* history, const std::function<void(std::uint32_t)>& f) {
    for (std::size_t index = 0; index < m_window.size(); ++index) {
        if (m_window[index].isComplete || !m_window.contains(index, 0)) {
            continue;
        }
        m_window.complete(index);
        Run& run = runFor(position(m_window[index].sample));
        ++run.samples;
        --run.incomplete;
        history->add(dueStamp(index), {.samples = 1, .incomplete = static_cast<std::uint32_t>(-1)});
        f(m_window[index].sample);
    }
}

void SampleSequence::conclude(CountHistory* history) {
    const std::uint32_t step = this->step();
    if (step == 0) {
        return;
    }
    const NewestDifferences differences = differencesFrom(m_window, firstOfHistory(m_window));
    const auto all = differences.all();
    const std::uint32_t last = all.empty() ? 0 : all.back();
    const auto other = std::find_if(all.rbegin(), all.rend(), [last](auto one) { return one != last; });
    const bool isSpacing = std::distance(all.rbegin(), other) >= static_cast<std::ptrdiff_t>(kLeastOfRun);
    if (isSpacing && last > step && last % step == 0) {
        correctStep(last, history);
    }
}

void SampleSequence::addBursts(CountHistory* history) {
    settle(0, history);
    noteBurst(m_bursts.endRun(), history);
}

void SampleSequence::clear(CountHistory* history) {
    addBursts(history);
    SampleWindow window = std::move(m_window); // whose memory stays
    window.clear();
    *this = {};
    m_window = std::move(window);
}

} // namespace posewire::model
