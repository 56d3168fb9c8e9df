// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_reader.h"

#include "core/model/accounting/sample_window.h"

#include <algorithm>

namespace posewire::exporting {
namespace {

using model::distance;

/// Puts gaps between the samples of a character, and times to all.
class Framing {
public:
    Framing(std::size_t character, const CharacterSurvey& survey, log::Stamp first,
            const std::function<void(const MotionFrame&)>& visit)
        : m_survey(&survey), m_first(first), m_visit(&visit) {
        m_frame.character = character;
    }

    void add(const feed::PoseSample& sample) {
        const std::uint32_t step = m_survey->step;
        const double received = log::secondsOf(sample.pose.stamp - m_first);
        if (!sample.beginsRun && step != 0) {
            const auto steps =
                static_cast<std::uint32_t>(distance(sample.pose.sample, m_frame.sample)) / step;
            for (std::uint32_t i = 1; i < steps; ++i) {
                tell(m_frame.sample + step, m_frame.seconds + period(), {});
            }
        }
        double seconds = received;
        if (!sample.beginsRun && step != 0 && m_survey->rateHz > 0) {
            seconds = m_runBegin + distance(sample.pose.sample, m_runSample) * period() / step;
        }
        seconds = m_isFirst ? seconds : std::max(seconds, m_frame.seconds + kLeast);
        if (sample.beginsRun) {
            m_runBegin = seconds;
            m_runSample = sample.pose.sample;
        }
        m_isFirst = false;
        m_frame.beginsRun = sample.beginsRun;
        m_frame.markers = sample.markers;
        tell(sample.pose.sample, seconds, &sample.pose);
        m_frame.beginsRun = false;
        m_frame.markers = {};
    }

private:
    static constexpr double kLeast = 1e-4; ///< between two samples

    [[nodiscard]] double period() const { return m_survey->rateHz > 0 ? 1 / m_survey->rateHz : kLeast; }

    void tell(std::uint32_t sample, double seconds, const model::CharacterPose* pose) {
        m_frame.sample = sample;
        m_frame.seconds = seconds;
        m_frame.pose = pose;
        (*m_visit)(m_frame);
    }

    const CharacterSurvey* m_survey;
    log::Stamp m_first;
    const std::function<void(const MotionFrame&)>* m_visit;
    MotionFrame m_frame; ///< the newest
    double m_runBegin = 0;
    std::uint32_t m_runSample = 0;
    bool m_isFirst = true;
};

} // namespace

tl::expected<std::uint64_t, log::FileError> walkMotion(const feed::PoseSource& source,
                                                       feed::PoseContent content, const feed::TakePose& take,
                                                       const ExportProgress& progress) {
    feed::PoseFeed poses(source, content);
    do {
        if (progress && !progress(poses.share())) {
            return tl::unexpected(log::FileError{"cancelled", log::FileError::Kind::Cancelled});
        }
    } while (poses.advance(take));
    return poses.missed();
}

tl::expected<void, log::FileError> readMotion(const feed::PoseSource& source, feed::PoseContent content,
                                              const MotionSurvey& survey,
                                              const std::function<void(const MotionFrame&)>& visit,
                                              const ExportProgress& progress) {
    std::vector<Framing> framings;
    for (std::size_t i = 0; i < survey.characters.size(); ++i) {
        framings.emplace_back(i, survey.characters[i], survey.first, visit);
    }
    const auto walked = walkMotion(
        source, content, [&](const feed::PoseSample& sample) { framings[sample.character].add(sample); },
        progress);
    return walked ? tl::expected<void, log::FileError>() : tl::unexpected(walked.error());
}

} // namespace posewire::exporting
