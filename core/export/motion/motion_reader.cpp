// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_reader.h"

#include "core/log/log_reader.h"
#include "core/model/accounting/probation.h"
#include "core/model/accounting/sample_window.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace posewire::exporting {
namespace {

using model::distance;

/// Of counters of one run that follow one another: see feed::SampleOrder.
constexpr std::size_t kMostDifference = model::Probation::kMostBack + model::Probation::kMostForward;

/// Sums of one character while it is surveyed.
class Surveying {
public:
    explicit Surveying(CharacterSurvey& survey) : m_survey(survey) {}

    void add(const feed::PoseSample& sample) {
        const model::CharacterPose& pose = sample.pose;
        if (m_samples++ == 0) {
            m_survey.first = pose.stamp;
            m_survey.firstPose = pose;
        } else if (sample.beginsRun) {
            ++m_survey.restarts;
            endRun();
        } else {
            const auto difference = static_cast<std::size_t>(distance(pose.sample, m_newest.sample));
            ++m_differences[std::min(difference, kMostDifference)];
        }
        if (sample.beginsRun) {
            m_begin = momentOf(pose);
        }
        m_newest = momentOf(pose);
        m_survey.last = std::max(m_survey.last, pose.stamp);
        widen(pose.layout);
        note(sample.markers);
    }

    void conclude() {
        endRun();
        m_survey.step = step();
        m_survey.frames = m_samples;
        for (std::size_t i = 1; m_survey.step != 0 && i < m_differences.size(); ++i) {
            m_survey.gaps += m_differences[i] * (std::max<std::size_t>(i / m_survey.step, 1) - 1);
        }
        m_survey.frames += m_survey.gaps;
        m_survey.rateHz = rate();
    }

private:
    void endRun() {
        m_counted += distance(m_newest.sample, m_begin.sample);
        m_received += log::secondsOf(m_newest.stamp - m_begin.stamp);
        m_coded += 1e-3 * distance(m_newest.timeCode, m_begin.timeCode);
    }

    void widen(const model::SegmentLayout& layout) {
        model::SegmentLayout& all = m_survey.layout;
        all.body = std::max(all.body, std::min(layout.body, model::kBodySegmentCount));
        all.props = std::max(all.props, std::min(layout.props, model::kMaxPropCount));
        all.fingers = std::max(all.fingers, std::min(layout.fingers, model::kFingerSegmentCount));
    }

    void note(const std::vector<feed::Marker>& markers) {
        std::vector<std::uint32_t>& known = m_survey.markerIds;
        for (std::size_t i = 0; i < markers.size(); ++i) {
            const bool isInPlace = i < known.size() && known[i] == markers[i].id;
            if (!isInPlace && known.size() < CharacterSurvey::kMostMarkers &&
                std::ranges::find(known, markers[i].id) == known.end()) {
                known.push_back(markers[i].id);
            }
        }
    }

    /// By the rule of model::findStep(), over the whole range.
    [[nodiscard]] std::uint32_t step() const {
        std::uint64_t all = 0;
        std::size_t best = 0;
        for (std::size_t i = 1; i < m_differences.size(); ++i) {
            all += m_differences[i];
            best = m_differences[i] > m_differences[best] ? i : best;
        }
        std::uint64_t multiples = 0;
        for (std::size_t i = best; best != 0 && i < m_differences.size(); i += best) {
            multiples += m_differences[i];
        }
        const bool isStep = m_differences[best] * 10 >= all * 4 && multiples * 10 >= all * 9;
        return isStep ? static_cast<std::uint32_t>(best) : 0;
    }

    /// By time codes where they run as the clock does, since these know no jitter.
    [[nodiscard]] double rate() const {
        constexpr double kNear = 0.02;
        constexpr double kWhole = 0.005;
        if (m_counted <= 0 || (m_received <= 0 && m_coded <= 0)) {
            return 0;
        }
        const bool isCoded = m_coded > 0.5 && (m_received <= 0 ||
                                               std::abs(m_coded / m_received - 1) < kNear || m_received < 1);
        const double seconds = isCoded || m_received <= 0 ? m_coded : m_received;
        const double frames = m_survey.step != 0 ? static_cast<double>(m_counted) / m_survey.step
                                                 : static_cast<double>(m_samples - 1 - m_survey.restarts);
        const double hz = frames / seconds;
        const double whole = std::round(hz);
        return whole >= 1 && std::abs(hz / whole - 1) < kWhole ? whole : hz;
    }

    CharacterSurvey& m_survey;
    std::uint64_t m_samples = 0;
    SampleMoment m_begin; ///< of the run
    SampleMoment m_newest;
    std::int64_t m_counted = 0; ///< counters from the first to the last of each run
    double m_received = 0;      ///< seconds, likewise
    double m_coded = 0;
    std::vector<std::uint64_t> m_differences = std::vector<std::uint64_t>(kMostDifference + 1); ///< how often
};

/// Puts gaps between the samples of a character, and times to all.
class Framing {
public:
    Framing(std::size_t character, const CharacterSurvey& survey, log::Stamp first,
            const std::function<void(const MotionFrame&)>& visit)
        : m_survey(&survey), m_first(first), m_visit(&visit) {
        m_frame.character = character;
    }

    void add(const feed::PoseSample& sample, const std::optional<wire::TimeCode>& timeOfDay) {
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
        seconds = m_frame.run == 0 ? seconds : std::max(seconds, m_frame.seconds + kLeast);
        if (sample.beginsRun) {
            m_runBegin = seconds;
            m_runSample = sample.pose.sample;
        }
        m_frame.run += sample.beginsRun ? 1 : 0;
        m_frame.markers = sample.markers;
        m_frame.timeOfDay = timeOfDay;
        tell(sample.pose.sample, seconds, &sample.pose);
        m_frame.markers = {};
        m_frame.timeOfDay.reset();
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
};

/// Finds the time of day (type 25) of samples, which may come before the pose or after it: reads ahead in the
/// log, but no further than messages of one sample are apart.
class TimesOfDay {
public:
    explicit TimesOfDay(const feed::PoseSource& source)
        : m_follower(*source.log, source.firstPacket), m_isSent(source.characters.size()) {
        for (std::size_t i = 0; i < source.characters.size(); ++i) {
            for (const feed::PoseCharacter::Part& part : source.characters[i].parts) {
                m_places.emplace(part.key, i);
                m_isSent[i] = m_isSent[i] || part.sendsTimeOfDay;
            }
        }
    }

    /// Each is found once: counters may begin again.
    std::optional<wire::TimeCode> of(std::size_t character, const model::CharacterPose& pose) {
        if (!m_isSent[character]) {
            return std::nullopt;
        }
        const std::pair key(character, pose.sample);
        const auto isNear = [&](log::Stamp stamp) {
            return std::chrono::abs(stamp - pose.stamp) <= model::kSentTogether;
        };
        m_follower.refresh();
        auto found = m_times.find(key);
        while ((found == m_times.end() || !isNear(found->second.second)) &&
               m_newest - pose.stamp <= model::kSentTogether) {
            const auto packet = m_follower.next();
            if (!packet) {
                break;
            }
            m_newest = packet->stamp;
            take(*packet);
            found = m_times.find(key);
        }
        const auto node = m_times.extract(key);
        return node && isNear(node.mapped().second) ? std::optional(node.mapped().first) : std::nullopt;
    }

private:
    static constexpr std::size_t kMost = std::size_t{1} << 16; ///< of samples whose poses did not come

    void take(const log::Packet& packet) {
        const auto header = wire::decodeHeader(packet.bytes);
        if (!header || header->type() != wire::TimeCode::kType ||
            !wire::decodeInto(packet.bytes, m_datagram)) {
            return;
        }
        const auto place = m_places.find({packet.sender, header->character});
        const auto* timeOfDay = std::get_if<wire::TimeCode>(&m_datagram.body);
        const bool isValid = std::ranges::none_of(m_datagram.notices, [](const wire::Notice& notice) {
            return notice.code == wire::NoticeCode::NotATimeCode;
        });
        if (place != m_places.end() && timeOfDay != nullptr && isValid) {
            if (m_times.size() == kMost) {
                m_times.clear();
            }
            m_times.insert_or_assign({place->second, header->sampleCounter},
                                     std::pair(*timeOfDay, packet.stamp));
        }
    }

    log::LogFollower m_follower;
    log::Stamp m_newest{}; ///< of what was read
    std::vector<bool> m_isSent;
    std::unordered_map<model::CharacterKey, std::size_t> m_places;
    /// By character and sample counter, with the stamp.
    std::map<std::pair<std::size_t, std::uint32_t>, std::pair<wire::TimeCode, log::Stamp>> m_times;
    wire::Datagram m_datagram;
};

} // namespace

tl::expected<MotionSurvey, log::FileError> surveyMotion(const feed::PoseSource& source,
                                                        feed::PoseContent content,
                                                        const ExportProgress& progress,
                                                        const feed::TakePose& take) {
    MotionSurvey survey;
    survey.characters.resize(source.characters.size());
    std::vector<Surveying> sums(survey.characters.begin(), survey.characters.end());
    const auto walked = walkMotion(
        source, content,
        [&](const feed::PoseSample& sample) {
            sums[sample.character].add(sample);
            if (take) {
                take(sample);
            }
        },
        progress);
    if (!walked) {
        return tl::unexpected(walked.error());
    }
    std::ranges::for_each(sums, &Surveying::conclude);
    survey.first = log::Stamp::max();
    for (const CharacterSurvey& one : survey.characters) {
        survey.first = one.frames != 0 ? std::min(survey.first, one.first) : survey.first;
    }
    return survey;
}

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
    TimesOfDay times(source);
    const auto take = [&](const feed::PoseSample& sample) {
        framings[sample.character].add(sample, times.of(sample.character, sample.pose));
    };
    return walkMotion(source, content, take, progress).map([](std::uint64_t /*missed*/) {});
}

} // namespace posewire::exporting
