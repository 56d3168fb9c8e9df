// SPDX-License-Identifier: MIT
#include "core/export/comparison/pose_comparison.h"

#include <deque>
#include <memory>

namespace posewire::exporting {
namespace {

/// The samples of the second recording by their place in its timetable. They are read once in their order;
/// where the first recording goes back, further than what is kept, from the beginning again.
class SecondSamples {
public:
    explicit SecondSamples(const feed::PoseSource& source) : m_source(source) { restart(); }

    /// Null where it cannot be read any more. Valid until the next call.
    const model::CharacterPose* at(std::size_t place) {
        if (place < m_first) {
            if (m_restarts++ == kMostRestarts) {
                return nullptr;
            }
            restart();
        }
        while (place >= m_first + m_kept.size()) {
            forget(place);
            if (!m_poses->advance(m_keep)) {
                return nullptr;
            }
        }
        forget(place);
        return place < m_first + m_kept.size() ? &m_kept[place - m_first] : nullptr;
    }

private:
    static constexpr std::size_t kBack = 256; ///< samples that are kept behind the one that is asked for
    static constexpr int kMostRestarts = 1000;

    void restart() {
        m_first = 0;
        m_kept.clear();
        m_poses = std::make_unique<feed::PoseFeed>(m_source, feed::PoseContent::Segments);
    }

    void forget(std::size_t place) {
        while (!m_kept.empty() && m_first + kBack < place) {
            m_kept.pop_front();
            ++m_first;
        }
    }

    const feed::PoseSource& m_source;
    std::unique_ptr<feed::PoseFeed> m_poses;
    const feed::TakePose m_keep = [this](const feed::PoseSample& sample) {
        if (sample.character == 0) {
            m_kept.push_back(sample.pose);
        }
    };
    std::deque<model::CharacterPose> m_kept;
    std::size_t m_first = 0; ///< place of the oldest that is kept
    int m_restarts = 0;
};

SampleMoment momentOf(const model::CharacterPose& pose) {
    return {pose.sample, pose.timeCode, pose.stamp, pose.packet};
}

} // namespace

tl::expected<std::uint64_t, log::FileError> walkPairs(const ComparisonTask& task,
                                                      const std::function<void(const ComparedPair&)>& visit,
                                                      const ExportProgress& progress) {
    SecondSamples second(task.second);
    model::PoseDifference difference;
    return walkMotion(
        task.first, feed::PoseContent::Segments,
        [&](const feed::PoseSample& sample) {
            if (sample.character != 0) {
                return;
            }
            ComparedPair pair{&sample.pose};
            if (const auto partner = task.partners.of(momentOf(sample.pose))) {
                pair.second = second.at(*partner);
            }
            const bool isCompared =
                pair.second != nullptr && differenceOf(sample.pose, *pair.second, task.frame, difference);
            pair.difference = isCompared ? &difference : nullptr;
            visit(pair);
        },
        progress);
}

} // namespace posewire::exporting
