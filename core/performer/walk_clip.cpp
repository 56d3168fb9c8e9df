// SPDX-License-Identifier: MIT
#include "core/performer/walk_clip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using model::Side;
using namespace model::segment;

constexpr std::size_t kHarmonics = 8;

/// f = mean + sum of a_k cos(2 pi k phase) + b_k sin(2 pi k phase), degrees.
struct Harmonics {
    double mean;
    std::array<double, kHarmonics> a;
    std::array<double, kHarmonics> b;
};

constexpr Harmonics kPelvisTilt{kMeanPelvisTilt,
                                {0.016, 0.414, 0.005, 0.154, 0.006, -0.055, 0.002, -0.017},
                                {0.082, -0.719, 0.023, -0.025, 0.012, 0.056, 0.005, 0.026}};
constexpr Harmonics kPelvisObliquity{-0.014,
                                     {1.860, 0.022, -1.197, 0.008, -0.001, -0.004, 0.031, 0.005},
                                     {2.117, 0.041, 0.221, 0.021, -0.096, 0.014, -0.008, 0.002}};
constexpr Harmonics kPelvisRotation{-0.040,
                                    {3.742, 0.018, 0.331, 0.012, 0.264, 0.005, 0.035, -0.001},
                                    {2.108, 0.014, -0.386, 0.020, -0.054, 0.015, 0.059, 0.005}};
constexpr Harmonics kHipFlexion{18.442,
                                {20.877, -3.147, -0.092, -0.102, -0.267, -0.007, -0.038, 0.004},
                                {-3.197, -1.545, 1.618, -0.088, 0.264, 0.094, -0.001, 0.026}};
constexpr Harmonics kHipAdduction{-0.328,
                                  {0.483, -0.050, -1.594, 0.040, -0.168, -0.074, 0.043, -0.010},
                                  {4.942, -0.503, 0.464, 0.105, -0.159, 0.044, -0.045, -0.007}};
constexpr Harmonics kHipRotation{-1.870,
                                 {1.184, -1.059, -1.170, -0.086, 0.006, 0.017, 0.031, 0.043},
                                 {0.718, -0.665, 1.024, 0.493, 0.005, -0.088, -0.142, -0.179}};
constexpr Harmonics kKneeFlexion{22.874,
                                 {-1.905, -13.630, -0.707, -0.868, -0.545, 0.065, -0.042, 0.046},
                                 {-18.750, 7.009, 4.312, 0.627, 0.736, 0.202, 0.026, 0.036}};
constexpr Harmonics kAnkleDorsiflexion{0.748,
                                       {-2.048, 0.820, -4.602, 2.197, -0.526, 0.266, 0.523, -0.072},
                                       {7.084, -7.213, 0.848, 0.237, -1.374, 0.547, -0.494, -0.047}};

/// cos and sin of the multiples of one phase, shared by all curves.
struct Multiples {
    explicit Multiples(double phase) {
        const double angle = 2.0 * std::numbers::pi * phase;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        cosines[0] = c;
        sines[0] = s;
        for (std::size_t k = 1; k < kHarmonics; ++k) {
            cosines[k] = cosines[k - 1] * c - sines[k - 1] * s;
            sines[k] = sines[k - 1] * c + cosines[k - 1] * s;
        }
    }

    double of(const Harmonics& curve) const {
        double sum = curve.mean;
        for (std::size_t k = 0; k < kHarmonics; ++k) {
            sum += curve.a[k] * cosines[k] + curve.b[k] * sines[k];
        }
        return sum;
    }

    std::array<double, kHarmonics> cosines{};
    std::array<double, kHarmonics> sines{};
};

constexpr std::size_t kSamples = 256;
constexpr double kMeanHipFlexion = 18.442;

/// How much the foot is lifted off behind: the toes stay flat while it is.
double pushOff(double phase) {
    return smoothStep(0.30, 0.42, phase) * (1.0 - smoothStep(0.62, 0.74, phase));
}

/// More knee and ankle in the swing: the mean curves would scuff the toe of this body.
double clearing(double phase) {
    return smoothStep(0.62, 0.74, phase) * (1.0 - smoothStep(0.78, 0.92, phase));
}

/// A knee that is not quite stretched at heel strike leaves room for longer steps on the outside of a turn.
double softStrike(double phase) {
    return phase > 0.5 ? smoothStep(0.78, 0.92, phase) : 1.0 - smoothStep(0.02, 0.12, phase);
}

void setTrunk(const GaitAngles& gait, LocalRotations& rotations) {
    const double tilt = gait.pelvisTilt - kMeanPelvisTilt;
    rotations[kPelvis] = aboutZ(gait.pelvisRotation) * aboutX(-gait.pelvisObliquity) * aboutY(tilt);
    // The spine takes back the pelvis's turn and more, so that shoulders and arms swing against the legs.
    constexpr double kShare = 0.25;
    for (const int index : {kL5, kL3, kT12, kT8}) {
        rotations[index] = aboutZ(-1.7 * kShare * gait.pelvisRotation) *
                           aboutX(1.1 * kShare * gait.pelvisObliquity) * aboutY(kShare * (3.0 - 0.8 * tilt));
    }
    rotations[kNeck] = aboutZ(0.35 * gait.pelvisRotation);
    rotations[kHead] = aboutZ(0.35 * gait.pelvisRotation) * aboutY(-2.0);
}

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

GaitAngles gaitAngles(double phase) {
    const Multiples multiples(phase);
    return {multiples.of(kPelvisTilt),  multiples.of(kPelvisObliquity),  multiples.of(kPelvisRotation),
            multiples.of(kHipFlexion),  multiples.of(kHipAdduction),     multiples.of(kHipRotation),
            multiples.of(kKneeFlexion), multiples.of(kAnkleDorsiflexion)};
}

WalkClip::WalkClip(const model::ReferenceBody& body, const WalkStyle& style) : m_body(body), m_style(style) {
    std::vector<SoleFrame> soles(kSamples);
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
        const double phase = static_cast<double>(sample) / static_cast<double>(kSamples);
        const BodyPose pose = posed(m_body, Vector3d::Zero(), rotations(phase));
        soles[sample] = {worldSolePoints(m_body, Side::Right, pose),
                         worldSolePoints(m_body, Side::Left, pose)};
    }
    PelvisPath path = pelvisPath(soles);
    m_strideLength = path.strideLength;
    for (const Side side : {Side::Right, Side::Left}) {
        m_footCorrections[side == Side::Right ? 0 : 1] =
            PeriodicSpline<Vector3d>(footCorrections(soles, path, side));
    }
    m_root = PeriodicSpline<Vector3d>(std::move(path.roots));
}

LocalRotations WalkClip::rotations(double phase) const {
    LocalRotations rotations;
    const GaitAngles right = gaitAngles(phase);
    setTrunk(right, rotations);
    for (const Side side : {Side::Right, Side::Left}) {
        const double own = sidePhase(side, phase);
        setLeg(side, side == Side::Right ? right : gaitAngles(own), own, rotations);
        setArm(side, own, rotations);
        setToe(side, own, rotations);
    }
    return rotations;
}

void WalkClip::setLeg(Side side, const GaitAngles& gait, double phase, LocalRotations& rotations) const {
    const LimbSegments& leg = limbs(side);
    const double s = sideSign(side);
    const double clear = clearing(phase);
    const double amplitude = m_style.amplitude;
    const double hipFactor = amplitude * m_style.stepFactor[side == Side::Right ? 0 : 1];
    const double hip = kMeanHipFlexion - kMeanPelvisTilt + hipFactor * (gait.hipFlexion - kMeanHipFlexion);
    const double knee = amplitude * gait.kneeFlexion + 6.0 * clear + 2.0 * softStrike(phase);
    const double ankle = amplitude * gait.ankleDorsiflexion + 5.0 * clear;
    // The published hip rotation is noisy between laboratories; a part of it is enough.
    constexpr double kHipRotationShare = 0.6;
    rotations[leg.upperLeg] =
        aboutY(-hip) * aboutX(-s * gait.hipAdduction) * aboutZ(-s * kHipRotationShare * gait.hipRotation);
    rotations[leg.lowerLeg] = aboutY(knee);
    rotations[leg.foot] = aboutZ(s * m_style.toeOut) * aboutY(-ankle);
}

void WalkClip::setArm(Side side, double phase, LocalRotations& rotations) const {
    const LimbSegments& arm = limbs(side);
    const double s = sideSign(side);
    // Behind at the own heel strike, in front at the other one.
    const double swing = m_style.armSwing * std::cos(2.0 * std::numbers::pi * phase);
    rotations[arm.shoulder] = aboutX(-5.0 * s);
    rotations[arm.upperArm] = aboutY(18.0 * swing + 4.0) * aboutX(-s * m_style.armAbduction);
    rotations[arm.foreArm] = aboutZ(-s * (24.0 - 9.0 * swing));
    rotations[arm.hand] = aboutX(-4.0 * s);
}

void WalkClip::setToe(Side side, double phase, LocalRotations& rotations) const {
    const LimbSegments& leg = limbs(side);
    const Quaterniond foot =
        rotations[kPelvis] * rotations[leg.upperLeg] * rotations[leg.lowerLeg] * rotations[leg.foot];
    const Vector3d forward = foot * Vector3d::UnitX();
    const double down =
        std::atan2(-forward.z(), std::hypot(forward.x(), forward.y())) * model::kDegreesPerRadian;
    rotations[leg.toe] = aboutY(-0.85 * pushOff(phase) * smoothPositive(down, 3.0));
}

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
