// SPDX-License-Identifier: MIT
#include "core/model/body/rigid_fit.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace posewire::model {
namespace {

constexpr double kUnitLength = 0.1;
/// As much as a vector of 3 mm.
constexpr double kPriorWeight = 1e-3;
/// A vector must weigh as much as one of 6 mm to be believed.
constexpr double kLeastWeight = 4e-3;
/// Markers this near to a line do not tell how it is turned.
constexpr double kLeastSpread = 0.008;

Eigen::Quaterniond rotationOf(const Eigen::Matrix3d& correlation) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
    const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    return Eigen::Quaterniond(rotation).normalized();
}

struct PlainFit {
    RigidFit fit;
    double spread = 0; ///< how far the markers are from a line, root mean square
    std::size_t farthest = 0;
};

PlainFit fitAll(std::span<const MarkerPair> markers) {
    Eigen::Vector3d local = Eigen::Vector3d::Zero();
    Eigen::Vector3d world = Eigen::Vector3d::Zero();
    for (const MarkerPair& marker : markers) {
        local += marker.local;
        world += marker.world;
    }
    const auto count = static_cast<double>(markers.size());
    local /= count;
    world /= count;
    Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const MarkerPair& marker : markers) {
        const Eigen::Vector3d from = marker.local - local;
        correlation += (marker.world - world) * from.transpose();
        spread += from * from.transpose();
    }
    PlainFit plain;
    plain.fit.rotation = rotationOf(correlation);
    plain.fit.position = world - plain.fit.rotation * local;
    const Eigen::JacobiSVD<Eigen::Matrix3d> axes(spread);
    plain.spread = std::sqrt(axes.singularValues()[1] / count);
    for (std::size_t i = 0; i < markers.size(); ++i) {
        const Eigen::Vector3d there = plain.fit.rotation * markers[i].local + plain.fit.position;
        const double left = (markers[i].world - there).norm();
        if (left > plain.fit.worst) {
            plain.fit.worst = left;
            plain.farthest = i;
        }
    }
    return plain;
}

/// The same with two that changed places, where that brings all within the tolerance.
PlainFit fitExchanged(std::vector<MarkerPair>& markers, const PlainFit& before, double tolerance) {
    PlainFit best = before;
    std::pair<std::size_t, std::size_t> exchanged{0, 0};
    for (std::size_t i = 0; i < markers.size(); ++i) {
        for (std::size_t k = i + 1; k < markers.size(); ++k) {
            std::swap(markers[i].world, markers[k].world);
            const PlainFit plain = fitAll(markers);
            if (plain.fit.worst < std::min(best.fit.worst, tolerance)) {
                best = plain;
                exchanged = {i, k};
            }
            std::swap(markers[i].world, markers[k].world);
        }
    }
    std::swap(markers[exchanged.first].world, markers[exchanged.second].world);
    return best;
}

/// Without the one whose absence leaves the least error.
PlainFit fitWithoutWorst(std::vector<MarkerPair>& markers) {
    std::optional<PlainFit> best;
    std::size_t leftOut = 0;
    std::vector<MarkerPair> others;
    for (std::size_t i = 0; i < markers.size(); ++i) {
        others = markers;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const PlainFit plain = fitAll(others);
        if (!best || plain.fit.worst < best->fit.worst) {
            best = plain;
            leftOut = i;
        }
    }
    markers.erase(markers.begin() + static_cast<std::ptrdiff_t>(leftOut));
    return *best;
}

} // namespace

FittedRotation fitRotation(std::span<const VectorPair> vectors, const Eigen::Quaterniond& prior,
                           double weight) {
    Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const VectorPair& pair : vectors) {
        const Eigen::Vector3d local = pair.local / kUnitLength;
        correlation += pair.weight * (pair.world / kUnitLength) * local.transpose();
        spread += pair.weight * local * local.transpose();
    }
    FittedRotation fitted;
    const Eigen::Vector3d known = Eigen::JacobiSVD<Eigen::Matrix3d>(spread).singularValues();
    // The less the more is known, without a step.
    const double priorWeight = weight + kPriorWeight * kLeastWeight / (kLeastWeight + known[1]);
    fitted.rotation = rotationOf(correlation + priorWeight * prior.toRotationMatrix());
    fitted.rank = known[0] < kLeastWeight   ? RotationRank::Nothing
                  : known[1] < kLeastWeight ? RotationRank::Direction
                                            : RotationRank::Whole;
    return fitted;
}

std::optional<RigidFit> fitMarkers(std::span<const MarkerPair> markers, double tolerance) {
    constexpr std::size_t kFewest = 3;
    if (markers.size() < kFewest) {
        return std::nullopt;
    }
    PlainFit plain = fitAll(markers);
    if (plain.fit.worst > tolerance) {
        std::vector<MarkerPair> kept(markers.begin(), markers.end());
        // Three that changed places would agree with their mirror image only: exchanges want a fourth.
        if (kept.size() > kFewest) {
            plain = fitExchanged(kept, plain, tolerance);
        }
        while (plain.fit.worst > tolerance && kept.size() > kFewest) {
            plain = fitWithoutWorst(kept);
        }
    }
    if (plain.fit.worst > tolerance || plain.spread < kLeastSpread) {
        return std::nullopt;
    }
    return plain.fit;
}

} // namespace posewire::model
