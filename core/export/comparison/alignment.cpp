// SPDX-License-Identifier: MIT
#include "core/export/comparison/alignment.h"

#include "core/model/accounting/sample_window.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace posewire::exporting {
namespace {

double measureOf(AlignBy by, const Timetable& table, const SampleMoment& moment) {
    switch (by) {
    case AlignBy::TimeCode:
        return moment.timeCode;
    case AlignBy::Sample:
        return moment.sample;
    case AlignBy::Begin:
        break;
    }
    return table.millisecondsOf(moment);
}

/// Half the shorter of both periods: what is further away was made at another moment.
double toleranceFor(AlignBy by, const Timetable& first, const Timetable& second) {
    if (by == AlignBy::Sample) {
        return 0.5;
    }
    constexpr double kLeast = 1.0; // ms: time codes are whole ones
    const double one = first.periodMs();
    const double other = second.periodMs();
    const double shorter = one > 0 && other > 0 ? std::min(one, other) : std::max(one, other);
    return std::max(shorter / 2, kLeast / 2) + 1e-6;
}

} // namespace

double stepOf(AlignBy by, const Timetable& second) {
    constexpr double kUsual = 1000.0 / 240; // ms, where no rate is known
    if (by == AlignBy::Sample) {
        return std::max<std::uint32_t>(second.step(), 1);
    }
    return second.periodMs() > 0 ? second.periodMs() : kUsual;
}

AlignBy naturalAlignment(const Timetable& first, const Timetable& second) {
    const auto hasCommon = [&](AlignBy by) {
        const auto borrowed = [](const Timetable& table) {
            return std::shared_ptr<const Timetable>(std::shared_ptr<void>(), &table);
        };
        const Partners partners(borrowed(first), borrowed(second), {by, 0});
        return std::ranges::any_of(first.samples(),
                                   [&](const SampleMoment& one) { return partners.of(one).has_value(); });
    };
    // Senders without a time code leave it at 0.
    const auto isTelling = [](const Timetable& table) {
        return std::ranges::any_of(table.samples(), [&](const SampleMoment& one) {
            return one.timeCode != table.samples().front().timeCode;
        });
    };
    if (isTelling(first) && isTelling(second) && hasCommon(AlignBy::TimeCode)) {
        return AlignBy::TimeCode;
    }
    return hasCommon(AlignBy::Sample) ? AlignBy::Sample : AlignBy::Begin;
}

Partners::Partners(std::shared_ptr<const Timetable> first, std::shared_ptr<const Timetable> second,
                   const Alignment& alignment)
    : m_first(std::move(first)),
      m_second(std::move(second)),
      m_alignment(alignment),
      m_tolerance(toleranceFor(alignment.by, *m_first, *m_second)) {
    Places places;
    places.reserve(m_second->samples().size());
    for (const SampleMoment& moment : m_second->samples()) {
        places.emplace_back(measureOf(alignment.by, *m_second, moment),
                            static_cast<std::uint32_t>(places.size()));
    }
    if (!std::ranges::is_sorted(places)) { // counters begin again, and so do time codes of what is looped
        std::ranges::sort(places);
    }
    m_places = std::make_shared<const Places>(std::move(places));
}

Partners Partners::withOffset(double offset) const {
    Partners moved = *this;
    moved.m_alignment.offset = offset;
    return moved;
}

std::optional<std::size_t> Partners::of(const SampleMoment& moment) const {
    const Places& places = *m_places;
    const double wanted = measureOf(m_alignment.by, *m_first, moment) + m_alignment.offset;
    const auto place = [&](double from) {
        return std::ranges::lower_bound(places, std::pair(from, std::uint32_t{0}));
    };
    auto best = place(wanted);
    if (best != places.begin()) {
        const auto before = place(std::prev(best)->first); // the first of equals
        if (best == places.end() || wanted - before->first <= best->first - wanted) {
            best = before;
        }
    }
    const bool isNear = best != places.end() && std::abs(best->first - wanted) <= m_tolerance;
    return isNear ? std::optional<std::size_t>(best->second) : std::nullopt;
}

bool Partners::isCommon(const SampleMoment& moment) const {
    const Places& places = *m_places;
    const double wanted = measureOf(m_alignment.by, *m_first, moment) + m_alignment.offset;
    return !places.empty() && wanted >= places.front().first - m_tolerance &&
           wanted <= places.back().first + m_tolerance;
}

tl::expected<Timetable, log::FileError> Timetable::of(const feed::PoseSource& source,
                                                      const ExportProgress& progress) {
    Timetable table;
    const auto survey =
        surveyMotion(source, feed::PoseContent::Segments, progress, [&table](const feed::PoseSample& sample) {
            if (sample.character == 0) {
                table.add(sample.pose, sample.beginsRun);
            }
        });
    if (!survey) {
        return tl::unexpected(survey.error());
    }
    if (!survey->characters.empty()) {
        table.m_step = survey->characters.front().step;
        table.m_rateHz = survey->characters.front().rateHz;
    }
    return table;
}

void Timetable::add(const model::CharacterPose& pose, bool beginsRun) {
    if (m_samples.size() == kMost) {
        m_isCut = true;
        return;
    }
    m_samples.push_back(momentOf(pose));
    if (beginsRun || m_runs.empty()) {
        m_runs.push_back(
            {pose.packet, pose.sample, log::millisecondsOf(pose.stamp - m_samples.front().stamp)});
    }
}

double Timetable::millisecondsOf(const SampleMoment& moment) const {
    if (m_samples.empty()) {
        return 0;
    }
    if (m_step == 0 || m_rateHz <= 0) {
        return log::millisecondsOf(moment.stamp - m_samples.front().stamp);
    }
    const auto next = std::ranges::upper_bound(m_runs, moment.packet, {}, &Run::packet);
    const Run& run = next == m_runs.begin() ? *next : *std::prev(next);
    return run.milliseconds + model::distance(moment.sample, run.sample) * periodMs() / m_step;
}

std::vector<CharacterPair> pairCharacters(const model::SessionView& first, const model::SessionView& second) {
    const std::vector<const model::Character*> ours = first.atNow().roster().listed();
    std::vector<const model::Character*> theirs = second.atNow().roster().listed();
    std::map<model::CharacterKey, model::CharacterKey> partners;
    const auto pairWhere = [&](auto&& isSame) {
        for (const model::Character* one : ours) {
            const auto other = std::ranges::find_if(
                theirs, [&](const model::Character* candidate) { return isSame(one->key, candidate->key); });
            if (other != theirs.end() && !partners.contains(one->key)) {
                partners.emplace(one->key, (*other)->key);
                theirs.erase(other);
            }
        }
    };
    pairWhere([&](const model::CharacterKey& one, const model::CharacterKey& other) {
        return first.roster().displayName(one) == second.roster().displayName(other);
    });
    pairWhere([](const model::CharacterKey& one, const model::CharacterKey& other) {
        return one.character == other.character;
    });
    pairWhere([](const model::CharacterKey&, const model::CharacterKey&) { return true; });
    std::vector<CharacterPair> pairs;
    for (const model::Character* one : ours) {
        if (const auto found = partners.find(one->key); found != partners.end()) {
            pairs.emplace_back(*found);
        }
    }
    return pairs;
}

} // namespace posewire::exporting
