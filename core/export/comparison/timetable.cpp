// SPDX-License-Identifier: MIT
#include "core/export/comparison/timetable.h"

#include "core/model/accounting/sample_window.h"

#include <algorithm>

namespace posewire::exporting {

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
    m_samples.push_back({pose.sample, pose.timeCode, pose.stamp, pose.packet});
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

} // namespace posewire::exporting
