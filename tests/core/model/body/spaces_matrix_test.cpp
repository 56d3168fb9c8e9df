// SPDX-License-Identifier: MIT
#include "core/model/body/joint_angles.h"
#include "core/model/body/spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

/// Every change of space as the matrix that it is: what it does to points, to rotations, and back.
namespace posewire::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// (x, y, z)_yUp = (y, z, x)_zUp: a permutation without reflection.
Matrix3d yUpFromZUpMatrix() {
    return (Matrix3d() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished();
}

/// Unity: (-y, z, x), which reflects, since it is left-handed.
Matrix3d unityFromZUpMatrix() {
    return (Matrix3d() << 0, -1, 0, 0, 0, 1, 1, 0, 0).finished();
}

Matrix3d turnAbout(int axis, double radians) {
    return Eigen::AngleAxisd(radians, Vector3d::Unit(axis)).toRotationMatrix();
}

class Random {
public:
    double number(double from, double to) { return std::uniform_real_distribution(from, to)(m_random); }
    Vector3d vector(double most) { return {number(-most, most), number(-most, most), number(-most, most)}; }
    Quaterniond rotation() {
        return Quaterniond(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)).normalized();
    }

private:
    std::mt19937 m_random{41};
};

constexpr int kRounds = 300;

TEST(SpaceMatrices, TurnPointsAndRotationsAlikeForYUp) {
    const Matrix3d p = yUpFromZUpMatrix();
    EXPECT_NEAR(p.determinant(), 1, 1e-12);
    Random random;
    for (int round = 0; round < kRounds; ++round) {
        const Vector3d point = random.vector(10);
        const Quaterniond rotation = random.rotation();
        EXPECT_LT((yUpFromZUp(point) - p * point).norm(), 1e-12);
        EXPECT_LT((zUpFromYUp(point) - p.transpose() * point).norm(), 1e-12);
        const Matrix3d expected = p * rotation.toRotationMatrix() * p.transpose();
        EXPECT_LT((yUpFromZUp(rotation).toRotationMatrix() - expected).norm(), 1e-12);
        EXPECT_LT((zUpFromYUp(yUpFromZUp(rotation)).coeffs() - rotation.coeffs()).norm(), 1e-12);
    }
}

TEST(SpaceMatrices, TurnPointsAndRotationsAlikeForUnity) {
    const Matrix3d u = unityFromZUpMatrix();
    EXPECT_NEAR(u.determinant(), -1, 1e-12);
    Random random;
    for (int round = 0; round < kRounds; ++round) {
        const Vector3d point = random.vector(10);
        const Quaterniond rotation = random.rotation();
        EXPECT_LT((unityFromZUp(point) - u * point).norm(), 1e-12);
        EXPECT_LT((zUpFromUnity(point) - u.transpose() * point).norm(), 1e-12);
        const Matrix3d expected = u * rotation.toRotationMatrix() * u.transpose();
        EXPECT_LT((unityFromZUp(rotation).toRotationMatrix() - expected).norm(), 1e-12);
        EXPECT_LT((zUpFromUnity(unityFromZUp(rotation)).coeffs() - rotation.coeffs()).norm(), 1e-12);
    }
}

TEST(SpaceMatrices, MakeEulerAnglesRzRyRx) {
    Random random;
    for (int round = 0; round < kRounds; ++round) {
        const Vector3d angles(random.number(-std::numbers::pi, std::numbers::pi),
                              random.number(-std::numbers::pi / 2, std::numbers::pi / 2),
                              random.number(-std::numbers::pi, std::numbers::pi));
        const Matrix3d expected =
            turnAbout(2, angles.z()) * turnAbout(1, angles.y()) * turnAbout(0, angles.x());
        const Quaterniond rotation = quaternionFromEuler(angles);
        EXPECT_LT((rotation.toRotationMatrix() - expected).norm(), 1e-12);
        EXPECT_LT((eulerFromQuaternion(rotation) - angles).norm(), 1e-6);
    }
}

TEST(SpaceMatrices, FindAnglesThatGiveTheRotationBackNearGimbalLock) {
    for (const double side : {-1.0, 1.0}) {
        for (const double off : {0.0, 1e-9, 1e-7, 1e-5, 1e-3}) {
            const Vector3d angles(0.7, side * (std::numbers::pi / 2 - off), -0.4);
            const Quaterniond rotation = quaternionFromEuler(angles);
            const Quaterniond back = quaternionFromEuler(eulerFromQuaternion(rotation));
            EXPECT_LT((back.toRotationMatrix() - rotation.toRotationMatrix()).norm(), 1e-5) << off;
        }
    }
}

TEST(SpaceMatrices, SendAndReadBackAPoseOfEveryType) {
    Random random;
    for (int round = 0; round < kRounds; ++round) {
        const SegmentPose pose{random.vector(5), random.rotation()};
        for (const LengthUnit unit : {LengthUnit::Metre, LengthUnit::Centimetre}) {
            const SegmentPose euler = poseFromEuler(eulerFromPose(pose, unit), unit);
            EXPECT_LT((euler.position - pose.position).norm(), 1e-5);
            EXPECT_LT(euler.orientation.angularDistance(pose.orientation), 2e-3);
        }
        const SegmentPose unity = poseFromUnity(unityFromPose(pose));
        EXPECT_LT((unity.position - pose.position).norm(), 1e-5);
        EXPECT_LT(unity.orientation.angularDistance(pose.orientation), 2e-3);
    }
}

TEST(SpaceMatrices, ReadEulerItemsInTheUnitOfTheirSender) {
    const wire::SegmentEuler item{1, {10.0F, 105.0F, -20.0F}, {}}; // Y-up: x is the y of Z-up
    const SegmentPose centimetres = poseFromEuler(item, LengthUnit::Centimetre);
    EXPECT_LT((centimetres.position - Vector3d(-0.2, 0.1, 1.05)).norm(), 1e-6);
    const SegmentPose metres = poseFromEuler(item, LengthUnit::Metre);
    EXPECT_LT((metres.position - Vector3d(-20, 10, 105)).norm(), 1e-6);
}

TEST(SpaceMatrices, ComposePosesAsHomogeneousMatrices) {
    const auto matrixOf = [](const SegmentPose& pose) {
        Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
        matrix.topLeftCorner<3, 3>() = pose.orientation.toRotationMatrix();
        matrix.topRightCorner<3, 1>() = pose.position;
        return matrix;
    };
    Random random;
    for (int round = 0; round < kRounds; ++round) {
        const SegmentPose parent{random.vector(3), random.rotation()};
        const SegmentPose local{random.vector(3), random.rotation()};
        const SegmentPose world = composed(parent, local);
        EXPECT_LT((matrixOf(world) - matrixOf(parent) * matrixOf(local)).norm(), 1e-12);
        EXPECT_LT((matrixOf(relativeTo(parent, world)) - matrixOf(local)).norm(), 1e-12);
    }
}

TEST(SpaceMatrices, NormalizeWhatCanBeNormalized) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const Quaterniond& unusable :
         {Quaterniond(0, 0, 0, 0), Quaterniond(nan, 0, 0, 1), Quaterniond(1, infinite, 0, 0)}) {
        EXPECT_EQ(normalizedOrIdentity(unusable).coeffs(), Quaterniond::Identity().coeffs());
    }
    const Quaterniond stretched(0, 0, 0, 7);
    EXPECT_LT((normalizedOrIdentity(stretched).coeffs() - Quaterniond(0, 0, 0, 1).coeffs()).norm(), 1e-12);
}

/// q = conj(q_p · O_p) · (q_c · O_c) decomposed as Ry(b) · Rx(a) · Rz(c), by matrices; radians, with signs.
Vector3d referenceAngle(const JointDefinition& joint, const Matrix3d& parent, const Matrix3d& child) {
    const auto isbFrame = [](int segment) -> Matrix3d {
        const double h = std::numbers::sqrt2 / 2;
        switch (segment + 1) {
        case 9: // right upper arm
            return Quaterniond(h, -h, 0, 0).toRotationMatrix();
        case 13:
            return Quaterniond(h, h, 0, 0).toRotationMatrix();
        case 10: // right forearm and hand
        case 11:
            return Quaterniond(0.5, -0.5, 0.5, 0.5).toRotationMatrix();
        case 14:
        case 15:
            return Quaterniond(0.5, 0.5, 0.5, -0.5).toRotationMatrix();
        default:
            return Matrix3d::Identity();
        }
    };
    const Matrix3d r =
        (parent * isbFrame(joint.parentSegment())).transpose() * child * isbFrame(joint.childSegment());
    const double a = std::asin(std::clamp(-r(1, 2), -1.0, 1.0));
    const double b = std::atan2(r(0, 2), r(2, 2));
    const double c = std::atan2(r(1, 0), r(1, 1));
    return {joint.signs[0] * a, joint.signs[1] * c, joint.signs[2] * b};
}

TEST(JointAngleMatrices, AreThePublishedDecompositionForEveryJoint) {
    Random random;
    for (const JointDefinition& joint : jointDefinitions()) {
        if (joint.isVertical) {
            continue;
        }
        for (int round = 0; round < 40; ++round) {
            const Quaterniond parent = random.rotation();
            const Quaterniond child = random.rotation();
            const Vector3d expected =
                referenceAngle(joint, parent.toRotationMatrix(), child.toRotationMatrix());
            EXPECT_LT((jointAngle(joint, parent, child) - expected).norm(), 1e-9) << joint.name;
        }
    }
}

TEST(JointAngleMatrices, HaveTheSignsOfEachSide) {
    // Spine, neck, head (+,+,+); right (-,+,-), its knee (-,+,+); left (+,-,-), its knee (+,-,+).
    for (const JointDefinition& joint : jointDefinitions()) {
        const std::array<double, 3>& signs = joint.signs;
        const bool isKnee = joint.name.find("Knee") != std::string_view::npos;
        if (joint.name.starts_with("jRight")) {
            EXPECT_EQ(signs, (std::array{-1.0, 1.0, isKnee ? 1.0 : -1.0})) << joint.name;
        } else if (joint.name.starts_with("jLeft")) {
            EXPECT_EQ(signs, (std::array{1.0, -1.0, isKnee ? 1.0 : -1.0})) << joint.name;
        } else if (joint.name.starts_with("j")) {
            EXPECT_EQ(signs, (std::array{1.0, 1.0, 1.0})) << joint.name;
        }
    }
}

TEST(JointAngleMatrices, DoNotChangeWhereTheWholeBodyIsTurned) {
    Random random;
    std::vector<Quaterniond> orientations(23);
    for (Quaterniond& orientation : orientations) {
        orientation = random.rotation();
    }
    std::vector<Vector3d> angles(22);
    jointAngles(orientations, angles);
    const std::vector<Vector3d> before = angles;
    const Quaterniond turn = random.rotation();
    for (Quaterniond& orientation : orientations) {
        orientation = turn * orientation;
    }
    jointAngles(orientations, angles);
    for (std::size_t i = 0; i < angles.size(); ++i) {
        EXPECT_LT((angles[i] - before[i]).norm(), 1e-9) << jointDefinitions()[i].name;
    }
}

} // namespace
} // namespace posewire::model
