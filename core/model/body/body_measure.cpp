// SPDX-License-Identifier: MIT
#include "core/model/body/body_measure.h"

#include "core/model/body/character_pose.h"
#include "core/model/body/points.h"
#include "core/model/body/spaces.h"

#include <algorithm>

namespace posewire::model {
namespace {

using Eigen::Vector3d;

Vector3d referenceBone(std::size_t segment) {
    return referenceOrigins()[segment] - referenceOrigins()[parentOf(segment)];
}

} // namespace

void BodyMeasure::add(const wire::Datagram& datagram, LengthUnit unit) {
    if (isSettled() || datagram.header.datagramIndex() != 0 || !datagram.header.isLast()) {
        return;
    }
    if (const auto* unity = std::get_if<wire::PoseUnity>(&datagram.body)) {
        addUnity(*unity, unit);
    } else if (const auto* linear = std::get_if<wire::LinearKinematics>(&datagram.body)) {
        addPositions(datagram.header, *linear, unit);
    } else if (const auto* points = std::get_if<wire::PointPositions>(&datagram.body)) {
        addMarkers(*points, unit);
    } else if (hasWholePoses(datagram.header.type())) {
        addWhole(datagram, unit);
    }
}

void BodyMeasure::addBone(std::size_t segment, const Vector3d& bone) {
    constexpr double kSameWay = 0.8; // cosine: some files turn the frames of arms
    const Vector3d reference = referenceBone(segment);
    const double length = bone.norm();
    const double usual = reference.norm();
    if (!(length > 0.25 * usual && length < 3.0 * usual)) {
        return; // no person is a quarter or thrice the size of the reference body
    }
    const bool isSameWay = bone.dot(reference) > kSameWay * length * usual;
    m_bones[segment].sum += isSameWay ? bone : Vector3d(reference * (length / usual));
    ++m_bones[segment].count;
}

void BodyMeasure::addWhole(const wire::Datagram& datagram, LengthUnit unit) {
    CharacterPose pose;
    if (!poseFromMessage(datagram, referenceOrigins(), unit, pose) || pose.isObjects ||
        pose.sources.size() < kBodySegments) {
        return;
    }
    for (std::size_t i = 1; i < kBodySegments; ++i) {
        const std::size_t parent = parentOf(i);
        if (pose.isPresent(i) && pose.sources[parent].weaker() == Provenance::Sent) {
            const SegmentPose& from = pose.segments[parent];
            addBone(i, from.orientation.conjugate() * (pose.segments[i].position - from.position));
        }
    }
    ++m_poses;
}

void BodyMeasure::addUnity(const wire::PoseUnity& message, LengthUnit unit) {
    if (message.segments.size() < kBodySegments) {
        return;
    }
    for (std::size_t i = 1; i < kBodySegments; ++i) {
        addBone(i,
                poseFromUnity(message.segments[static_cast<std::size_t>(unityPlaces()[i])], unit).position);
    }
    ++m_poses;
}

/// By their IDs, as poses are read; of those with the same the first.
void BodyMeasure::addPositions(const wire::Header& header, const wire::LinearKinematics& message,
                               LengthUnit unit) {
    if (message.segments.empty()) {
        return;
    }
    const ItemPlaces items = itemPlaces(header, message.segments.size(), message.segments.front().id);
    std::array<std::optional<Vector3d>, kBodySegmentCount> places;
    for (std::size_t i = 0; i < std::min(message.segments.size(), kBodySegments); ++i) {
        const auto position = static_cast<std::size_t>(items.positionOf(i, message.segments[i].id));
        if (static_cast<int>(i) < items.layout.body && position < places.size() && !places[position]) {
            places[position] = toVector(message.segments[i].position) * metresPer(unit);
        }
    }
    if (std::ranges::any_of(places, [](const auto& place) { return !place.has_value(); })) {
        return;
    }
    for (std::size_t i = 1; i < kBodySegments; ++i) {
        addBone(i, referenceBone(i).normalized() * (*places[i] - *places[parentOf(i)]).norm());
    }
    ++m_poses;
}

/// Of each pair of neighbouring markers of a segment, how far apart they are against the reference body; the
/// median, since some may be lost or exchanged.
void BodyMeasure::addMarkers(const wire::PointPositions& message, LengthUnit unit) {
    const PointIdCoding coding = detectPointIdCoding(idsOf(message.points));
    std::vector<double> scales;
    const AnatomicalPoint* before = nullptr;
    Vector3d placeBefore = Vector3d::Zero();
    for (const wire::Point& point : message.points) {
        const auto reference = knownPoint(coding, point.id);
        const AnatomicalPoint* known =
            reference ? findPoint(reference->segmentId - 1, reference->localId) : nullptr;
        const Vector3d place = pointFromYUp(point.position, unit);
        if (known != nullptr && before != nullptr && known->segment == before->segment) {
            const double apart =
                (Vector3d(known->reference.data()) - Vector3d(before->reference.data())).norm();
            const double scale = (place - placeBefore).norm() / apart;
            if (scale > 0.25 && scale < 3.0) {
                scales.push_back(scale);
            }
        }
        before = known;
        placeBefore = place;
    }
    if (!scales.empty()) {
        const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
        std::nth_element(scales.begin(), middle, scales.end());
        m_markerScales += *middle;
        ++m_markerPoses;
        ++m_poses;
    }
}

std::optional<BodyOrigins> BodyMeasure::body() const {
    double measured = 0;
    double reference = 0;
    for (std::size_t i = 1; i < kBodySegments; ++i) {
        if (m_bones[i].count > 0) {
            measured += (m_bones[i].sum / m_bones[i].count).norm();
            reference += referenceBone(i).norm();
        }
    }
    if (reference == 0 && m_markerPoses == 0) {
        return std::nullopt;
    }
    const double scale = reference > 0 ? measured / reference : m_markerScales / m_markerPoses;
    BodyOrigins body{{}, 0, BodySource::Poses, {}};
    for (std::size_t i = 1; i < kBodySegments; ++i) {
        const Vector3d bone = m_bones[i].count > 0 ? Vector3d(m_bones[i].sum / m_bones[i].count)
                                                   : Vector3d(scale * referenceBone(i));
        body.places[i] = body.places[parentOf(i)] + bone;
    }
    // On the balls of its feet, whose height above the floor no bone tells.
    const double toes = std::min(body.places[segment::kRightToe].z(), body.places[segment::kLeftToe].z());
    for (Vector3d& place : body.places) {
        place.z() += kReferenceSoleDrop * scale - toes;
    }
    return body;
}

} // namespace posewire::model
