// SPDX-License-Identifier: MIT
#include "core/performer/walk_clip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace posewire::performer {
namespace {

using Eigen::Vector3d;
using model::Side;

constexpr std::array<Side, 2> kSides{Side::Right, Side::Left};

/// Shares of the cycle.
constexpr double kStanceEnd = 0.62;
constexpr double kReachEarly = 0.03;
constexpr double kDipReach = 0.022;
constexpr double kRootSmoothing = 0.033; // 36 ms of a 1.08 s cycle
constexpr double kFootSmoothing = 0.006;

double phaseOf(std::size_t sample, std::size_t count) {
    return static_cast<double>(sample) / static_cast<double>(count);
}

/// Convolution with a Gaussian around the cycle; `sigma` as a share of it.
std::vector<Vector3d> smoothed(const std::vector<Vector3d>& values, double sigma) {
    const auto n = static_cast<std::ptrdiff_t>(values.size());
    const double width = sigma * static_cast<double>(n);
    const auto reach = std::min(n / 2, static_cast<std::ptrdiff_t>(std::ceil(4.0 * width)));
    std::vector<Vector3d> result(values.size());
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        Vector3d sum = Vector3d::Zero();
        double weights = 0.0;
        for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
            const double x = static_cast<double>(k) / width;
            const double weight = std::exp(-0.5 * x * x);
            sum += weight * values[static_cast<std::size_t>((i + k + n) % n)];
            weights += weight;
        }
        result[static_cast<std::size_t>(i)] = sum / weights;
    }
    return result;
}

/// The lowest value within `reach` of the cycle to both sides: what smoothing then rounds off stays low
/// enough.
std::vector<Vector3d> lowestAround(const std::vector<Vector3d>& values, double reach) {
    const auto n = static_cast<std::ptrdiff_t>(values.size());
    const auto steps = static_cast<std::ptrdiff_t>(reach * static_cast<double>(n));
    std::vector<Vector3d> result(values);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t k = -steps; k <= steps; ++k) {
            double& height = result[static_cast<std::size_t>(i)].z();
            height = std::min(height, values[static_cast<std::size_t>((i + k + n) % n)].z());
        }
    }
    return result;
}

double lowest(const std::array<Vector3d, kSolePointCount>& points) {
    return std::ranges::min(points, {}, [](const Vector3d& point) { return point.z(); }).z();
}

/// Sum of velocities (per cycle) of the points near the floor, weighted by nearness, and the sum of weights.
struct ContactVelocity {
    Vector3d sum = Vector3d::Zero();
    double weights = 1e-9;

    void add(const std::vector<SoleFrame>& soles, std::size_t sample, std::size_t foot, double floor,
             double share) {
        constexpr double kNear = 0.012;
        const std::size_t n = soles.size();
        const auto& before = soles[(sample + n - 1) % n][foot];
        const auto& after = soles[(sample + 1) % n][foot];
        for (std::size_t k = 0; k < kSolePointCount; ++k) {
            const double height = (soles[sample][foot][k].z() - floor) / kNear;
            const double weight = share * std::exp(-height * height);
            sum += weight * 0.5 * static_cast<double>(n) * (after[k] - before[k]);
            weights += weight;
        }
    }
    Vector3d mean() const { return sum / weights; }
};

/// The share of the load that a foot carries at its own phase.
double carrying(double phase) {
    return smoothStep(0.0, 0.10, phase) * (1.0 - smoothStep(0.50, 0.60, phase));
}

/// Low enough for every carrying foot to reach the floor: while both carry, the leading leg is stretched and
/// settles it, and the trailing one bends more.
double pelvisHeight(const SoleFrame& frame, double phase) {
    double floor = -std::numeric_limits<double>::infinity();
    for (std::size_t foot = 0; foot < 2; ++foot) {
        const double own = fraction(WalkClip::sidePhase(kSides[foot], phase) + kReachEarly);
        if (own < kStanceEnd + kReachEarly - 0.03) {
            floor = std::max(floor, lowest(frame[foot]));
        }
    }
    return -floor;
}

/// Sums velocities per cycle up to positions, from zero at the first sample.
std::vector<Vector3d> integrated(const std::vector<Vector3d>& velocities) {
    const std::size_t n = velocities.size();
    std::vector<Vector3d> positions(n, Vector3d::Zero());
    for (std::size_t i = 1; i < n; ++i) {
        positions[i] = positions[i - 1] + 0.5 / static_cast<double>(n) * (velocities[i - 1] + velocities[i]);
    }
    return positions;
}

Vector3d mean(const std::vector<Vector3d>& values) {
    const Vector3d sum = std::accumulate(values.begin(), values.end(), Vector3d(Vector3d::Zero()));
    return sum / static_cast<double>(values.size());
}

void subtract(std::vector<Vector3d>& values, const Vector3d& amount) {
    for (Vector3d& value : values) {
        value -= amount;
    }
}

/// Own phase at which the work on a foot begins: in the middle of the swing, so that the stance is one piece.
constexpr double kSeam = 0.80;

double ownPhase(std::size_t step, std::size_t count) {
    return kSeam - 1.0 + phaseOf(step, count);
}

/// One foot of the straight walk in the world.
struct FootTrack {
    const std::vector<SoleFrame>& soles;
    const PelvisPath& path;
    std::size_t foot;

    /// Of the lowest point.
    double height(std::size_t i) const { return lowest(soles[i][foot]) + path.roots[i].z(); }

    /// Horizontal velocity of what touches the floor, or would first, in metres per cycle.
    Vector3d slip(std::size_t i) const {
        const std::size_t n = soles.size();
        ContactVelocity contact;
        contact.add(soles, i, foot, lowest(soles[i][foot]), 1.0);
        const Vector3d root =
            0.5 * static_cast<double>(n) * (path.roots[(i + 1) % n] - path.roots[(i + n - 1) % n]);
        const Vector3d slip = contact.mean() + root;
        return {slip.x() + path.strideLength, slip.y(), 0.0};
    }
};

/// Onto the floor while the foot carries, clear of it in the swing.
double liftFor(double height, double own) {
    constexpr double kClearance = 0.008;
    const double planted = smoothWindow(0.02, kStanceEnd, 0.05, own);
    const double swing = smoothWindow(0.70, 0.76, 0.08, own) + smoothWindow(-0.24, -0.10, 0.08, own);
    const double lift = smoothPositive(kClearance * std::min(swing, 1.0) - height, 0.004);
    return -height * planted + lift * (1.0 - planted);
}

} // namespace

PelvisPath pelvisPath(const std::vector<SoleFrame>& soles) {
    const std::size_t n = soles.size();
    std::vector<Vector3d> heights(n, Vector3d::Zero());
    std::vector<Vector3d> velocities(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double phase = phaseOf(i, n);
        heights[i].z() = pelvisHeight(soles[i], phase);
        ContactVelocity contact;
        for (std::size_t foot = 0; foot < 2; ++foot) {
            contact.add(soles, i, foot, -heights[i].z(), carrying(WalkClip::sidePhase(kSides[foot], phase)));
        }
        velocities[i] = -contact.mean();
        velocities[i].z() = 0.0;
    }
    velocities = smoothed(velocities, kRootSmoothing);
    heights = smoothed(lowestAround(heights, kDipReach), kRootSmoothing);
    const Vector3d average = mean(velocities);
    // A limp would make the straight walk drift to one side; the path decides about the direction, so that is
    // dropped.
    subtract(velocities, average);
    PelvisPath path{integrated(velocities), average.x()};
    subtract(path.roots, mean(path.roots));
    for (std::size_t i = 0; i < n; ++i) {
        path.roots[i].z() = heights[i].z();
    }
    return path;
}

std::vector<Vector3d> footCorrections(const std::vector<SoleFrame>& soles, const PelvisPath& path,
                                      Side side) {
    const std::size_t n = soles.size();
    const auto first =
        static_cast<std::size_t>(fraction(kSeam + (side == Side::Left ? 0.5 : 0.0)) * static_cast<double>(n));
    const FootTrack track{soles, path, side == Side::Right ? std::size_t{0} : std::size_t{1}};
    std::vector<Vector3d> velocities(n);
    for (std::size_t step = 0; step < n; ++step) {
        const double loaded = smoothWindow(0.06, 0.57, 0.05, ownPhase(step, n));
        velocities[step] = -loaded * track.slip((first + step) % n);
    }
    std::vector<Vector3d> ways = integrated(velocities);
    const Vector3d atStrike = ways[static_cast<std::size_t>((1.0 - kSeam) * static_cast<double>(n))];
    const Vector3d atEnd = ways.back();
    std::vector<Vector3d> placed(n);
    for (std::size_t step = 0; step < n; ++step) {
        const double own = ownPhase(step, n);
        // The swing, before and after the seam, takes back what the stance moved the foot.
        const double before = 1.0 - smoothStep(kSeam - 1.0, 0.0, own);
        const double after = smoothStep(kStanceEnd, kSeam, own);
        const std::size_t i = (first + step) % n;
        placed[i] = ways[step] - (1.0 - before) * atStrike + after * (atStrike - atEnd);
        placed[i].z() = liftFor(track.height(i), own);
    }
    return smoothed(placed, kFootSmoothing);
}

} // namespace posewire::performer
