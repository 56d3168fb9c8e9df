// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/reference_body.h"
#include "core/model/body/units.h"
#include "core/wire/codec.h"

#include <array>
#include <optional>

namespace posewire::model {

/// The lengths of a performer's bones, measured on poses where no scale message came: each bone as it stands
/// in its parent, or by its length alone where no orientations were sent; markers give the size of the whole.
/// Joints open by millimetres, so it is the mean of the first poses and stays what it is from then on.
class BodyMeasure {
public:
    static constexpr int kMostPoses = 32;

    /// Of a datagram that holds a whole sample; others are left out. `unit` is what its positions are in.
    void add(const wire::Datagram& datagram, LengthUnit unit);
    [[nodiscard]] bool isSettled() const { return m_poses >= kMostPoses; }
    /// 0 without a pose, 1 with some, 2 once settled: bodies are made anew for each.
    [[nodiscard]] std::uint64_t version() const { return isSettled() ? 2 : m_poses > 0 ? 1 : 0; }

    /// Standing on z = 0; bones that were not measured are the reference body's, scaled to the others.
    /// Nothing where none was measured.
    [[nodiscard]] std::optional<BodyOrigins> body() const;

private:
    struct Bone {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        int count = 0;
    };
    void addBone(std::size_t segment, const Eigen::Vector3d& bone);
    void addWhole(const wire::Datagram& datagram, LengthUnit unit);
    void addUnity(const wire::PoseUnity& message, LengthUnit unit);
    void addPositions(const wire::Header& header, const wire::LinearKinematics& message, LengthUnit unit);
    void addMarkers(const wire::PointPositions& message, LengthUnit unit);

    std::array<Bone, kBodySegmentCount> m_bones{};
    double m_markerScales = 0; ///< sum
    int m_markerPoses = 0;
    int m_poses = 0;
};

} // namespace posewire::model
