// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/tracker_history.h"

#include "core/model/body/spaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace posewire::gui {

namespace {

constexpr std::size_t kMostMessages = 5'000;
constexpr log::Duration kNormSpacing = std::chrono::milliseconds(50);
constexpr std::size_t kLeastNorms = 20;
constexpr std::size_t kMostTrackers = wire::kMaxItems;
/// A pause this long is a gap whatever the counter says.
constexpr log::Duration kGap = std::chrono::milliseconds(250);

bool reaches(const wire::Vec3& vector, float limit) {
    return std::ranges::any_of(vector, [limit](float value) { return std::abs(value) > limit; });
}

} // namespace

float norm(const wire::Vec3& vector) {
    return std::hypot(vector[0], vector[1], vector[2]);
}

double dipDegrees(const wire::Tracker& tracker) {
    const Eigen::Quaterniond worldFromTracker =
        model::normalizedOrIdentity(model::toQuaternion(tracker.orientation));
    const Eigen::Vector3d field = worldFromTracker * model::toVector(tracker.magneticField);
    return std::atan2(-field.z(), field.head<2>().norm()) * model::kDegreesPerRadian;
}

void TrackerHistory::follow(model::SessionView& view, const std::optional<model::CharacterKey>& key,
                            std::uint32_t trackerId) {
    const auto* newest = key ? view.message(*key, wire::TrackerKinematics::kType) : nullptr;
    const bool wentBack = newest != nullptr && newest->stamp < m_lastStamp;
    if (key != m_key || wentBack) {
        *this = {};
        m_key = key;
    }
    if (trackerId != m_trackerId) {
        m_trackerId = trackerId;
        m_points.clear();
        m_lastStamp = {};
        m_lastSample = 0;
    }
    if (newest == nullptr) {
        return;
    }
    const log::StreamKey stream{key->sender, key->character, wire::TrackerKinematics::kType};
    const model::Stream* figures = view.find(stream);
    const std::uint32_t step = figures == nullptr ? 0 : figures->accounting.step();
    const log::Stamp from = std::max(newest->stamp - kPlot, m_lastStamp + log::Duration(1));
    const std::size_t added =
        view.visit(stream, from, kMostMessages, [&](const auto& message) { add(message, step); });
    if (added != 0) {
        computeMedians();
    }
}

void TrackerHistory::add(const model::Message& message, std::uint32_t step) {
    const auto* body = std::get_if<wire::TrackerKinematics>(&message.datagram.body);
    if (body == nullptr) {
        return;
    }
    const std::uint32_t advanced = message.datagram.header.sampleCounter - m_lastSample;
    const bool followsGap = m_lastStamp != log::Stamp() &&
                            (message.stamp - m_lastStamp > kGap || (step != 0 && advanced > step + step / 2));
    for (const wire::Tracker& tracker : body->trackers) {
        if (m_trackers.size() >= kMostTrackers && !m_trackers.contains(tracker.id)) {
            continue;
        }
        Lately& lately = m_trackers[tracker.id];
        addNorm(lately, message.stamp, norm(tracker.magneticField));
        if (reaches(tracker.acceleration, kSaturatedAcceleration) ||
            reaches(tracker.angularVelocity, kSaturatedAngularVelocity)) {
            lately.saturated = message.stamp;
        }
        if (tracker.id == m_trackerId) {
            addPoint(tracker, message.stamp, followsGap);
        }
    }
    m_lastStamp = message.stamp;
    m_lastSample = message.datagram.header.sampleCounter;
}

void TrackerHistory::addPoint(const wire::Tracker& tracker, log::Stamp stamp, bool followsGap) {
    m_points.push_back({stamp, tracker.freeAcceleration, norm(tracker.magneticField), followsGap});
    while (stamp - m_points.front().stamp > kPlot || m_points.size() > kMostMessages) {
        m_points.pop_front();
    }
}

void TrackerHistory::addNorm(Lately& lately, log::Stamp stamp, float norm) const {
    if (!std::isfinite(norm) || (!lately.norms.empty() && stamp - lately.norms.back().stamp < kNormSpacing)) {
        return;
    }
    lately.norms.push_back({stamp, norm});
    while (stamp - lately.norms.front().stamp > kMedian) {
        lately.norms.pop_front();
    }
}

void TrackerHistory::computeMedians() {
    std::vector<float> sorted;
    for (auto& [id, lately] : m_trackers) {
        sorted.clear();
        for (const Norm& norm : lately.norms) {
            sorted.push_back(norm.norm);
        }
        lately.hasMedian = sorted.size() >= kLeastNorms;
        if (lately.hasMedian) {
            const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
            std::nth_element(sorted.begin(), middle, sorted.end());
            lately.median = *middle;
        }
    }
}

std::optional<float> TrackerHistory::magneticMedian(std::uint32_t trackerId) const {
    const auto found = m_trackers.find(trackerId);
    return found != m_trackers.end() && found->second.hasMedian ? std::optional(found->second.median)
                                                                : std::nullopt;
}

bool TrackerHistory::isDisturbed(const wire::Tracker& tracker) const {
    const auto median = magneticMedian(tracker.id);
    return median && std::abs(norm(tracker.magneticField) - *median) > kDisturbedShare * *median;
}

bool TrackerHistory::isSaturated(std::uint32_t trackerId) const {
    const auto found = m_trackers.find(trackerId);
    return found != m_trackers.end() && found->second.saturated &&
           m_lastStamp - *found->second.saturated < kPlot;
}

} // namespace posewire::gui
