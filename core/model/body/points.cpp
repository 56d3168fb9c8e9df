// SPDX-License-Identifier: MIT
#include "core/model/body/points.h"

#include <algorithm>

namespace posewire::model {
namespace {

using namespace segment;

constexpr std::array<AnatomicalPoint, kPointCount> kPoints{{
    {kPelvis, 1, "pHipOrigin", {0.0, 0.0, 0.0}},
    {kPelvis, 2, "jL5S1", {0.0, 0.0, 0.1}},
    {kPelvis, 3, "jRightHip", {0.0, -0.084, 0.0}},
    {kPelvis, 4, "jLeftHip", {0.0, 0.084, 0.0}},
    {kPelvis, 5, "pRightSIPS", {-0.023, -0.053, 0.104}},
    {kPelvis, 6, "pLeftSIPS", {-0.023, 0.053, 0.104}},
    {kPelvis, 7, "pRightASI", {0.078, -0.129, 0.075}},
    {kPelvis, 8, "pLeftASI", {0.078, 0.129, 0.075}},
    {kPelvis, 9, "pRightCSI", {0.04, -0.105, 0.15}},
    {kPelvis, 10, "pLeftCSI", {0.04, 0.105, 0.15}},
    {kPelvis, 11, "pRightIschialTub", {-0.063, -0.053, -0.047}},
    {kPelvis, 12, "pLeftIschialTub", {-0.063, 0.053, -0.047}},
    {kPelvis, 13, "pSacrum", {-0.078, 0.0, 0.027}},
    {kPelvis, 14, "pCentralButtock", {-0.063, 0.0, -0.047}},
    {kL5, 1, "jL5S1", {0.0, 0.0, 0.0}},
    {kL5, 2, "jL4L3", {0.0, 0.0, 0.111}},
    {kL5, 3, "pL5SpinalProcess", {-0.029, 0.0, -0.005}},
    {kL3, 1, "jL4L3", {0.0, 0.0, 0.0}},
    {kL3, 2, "jL1T12", {0.0, 0.0, 0.101}},
    {kL3, 3, "pL3SpinalProcess", {-0.029, 0.0, -0.002}},
    {kT12, 1, "jL1T12", {0.0, 0.0, 0.0}},
    {kT12, 2, "jT9T8", {0.0, 0.0, 0.101}},
    {kT12, 3, "pT12SpinalProcess", {-0.029, 0.0, -0.002}},
    {kT8, 1, "jT9T8", {0.0, 0.0, 0.0}},
    {kT8, 2, "jT1C7", {0.0, 0.0, 0.141}},
    {kT8, 3, "jRightT4Shoulder", {0.0, -0.028, 0.079}},
    {kT8, 4, "jLeftT4Shoulder", {0.0, 0.028, 0.079}},
    {kT8, 5, "pC7SpinalProcess", {-0.029, 0.0, 0.143}},
    {kT8, 6, "pPX", {0.116, 0.0, -0.005}},
    {kT8, 7, "pIJ", {0.111, 0.0, 0.121}},
    {kT8, 8, "pT4SpinalProcess", {-0.029, 0.0, 0.091}},
    {kT8, 9, "pT8SpinalProcess", {-0.029, 0.0, -0.002}},
    {kNeck, 1, "jT1C7", {0.0, 0.0, 0.0}},
    {kNeck, 2, "jC1Head", {0.0, 0.0, 0.094}},
    {kNeck, 3, "pC7SpinalProcess", {-0.029, 0.0, -0.01}},
    {kNeck, 4, "pT4SpinalProcess", {-0.018, 0.0, -0.06}},
    {kHead, 1, "jC1Head", {0.0, 0.0, 0.0}},
    {kHead, 2, "pTopOfHead", {0.0, 0.0, 0.174}},
    {kHead, 3, "pRightAuricularis", {-0.006, -0.07, 0.071}},
    {kHead, 4, "pLeftAuricularis", {-0.006, 0.07, 0.071}},
    {kHead, 5, "pBackOfHead", {-0.06, 0.0, 0.058}},
    {kRightShoulder, 1, "jRightT4Shoulder", {0.0, 0.0, 0.0}},
    {kRightShoulder, 2, "jRightShoulder", {0.0, -0.137, 0.0}},
    {kRightShoulder, 3, "pIJ", {0.116, 0.03, 0.04}},
    {kRightShoulder, 4, "pRightAcromion", {0.0, -0.158, 0.05}},
    {kRightUpperArm, 1, "jRightShoulder", {0.0, 0.0, 0.0}},
    {kRightUpperArm, 2, "jRightElbow", {0.0, -0.285, 0.0}},
    {kRightUpperArm, 3, "pRightArmLatEpicondyle", {0.0, -0.286, 0.029}},
    {kRightUpperArm, 4, "pRightArmMedEpicondyle", {0.0, -0.286, -0.034}},
    {kRightForeArm, 1, "jRightElbow", {0.0, 0.0, 0.0}},
    {kRightForeArm, 2, "jRightWrist", {0.0, -0.235, 0.0}},
    {kRightForeArm, 3, "pRightUlnarStyloid", {-0.024, -0.235, 0.0}},
    {kRightForeArm, 4, "pRightRadialStyloid", {0.024, -0.237, 0.0}},
    {kRightForeArm, 5, "pRightOlecranon", {-0.024, 0.002, 0.0}},
    {kRightHand, 1, "jRightWrist", {0.0, 0.0, 0.0}},
    {kRightHand, 2, "pRightTopOfHand", {0.0, -0.186, 0.0}},
    {kRightHand, 3, "pRightPinky", {-0.039, -0.102, 0.0}},
    {kRightHand, 4, "pRightBallHand", {-0.02, -0.033, -0.01}},
    {kRightHand, 5, "pRightHandPalm", {0.019, -0.086, -0.01}},
    {kLeftShoulder, 1, "jLeftT4Shoulder", {0.0, 0.0, 0.0}},
    {kLeftShoulder, 2, "jLeftShoulder", {0.0, 0.137, 0.0}},
    {kLeftShoulder, 3, "pIJ", {0.116, -0.03, 0.04}},
    {kLeftShoulder, 4, "pLeftAcromion", {0.0, 0.158, 0.05}},
    {kLeftUpperArm, 1, "jLeftShoulder", {0.0, 0.0, 0.0}},
    {kLeftUpperArm, 2, "jLeftElbow", {0.0, 0.285, 0.0}},
    {kLeftUpperArm, 3, "pLeftArmLatEpicondyle", {0.0, 0.286, 0.029}},
    {kLeftUpperArm, 4, "pLeftArmMedEpicondyle", {0.0, 0.286, -0.034}},
    {kLeftForeArm, 1, "jLeftElbow", {0.0, 0.0, 0.0}},
    {kLeftForeArm, 2, "jLeftWrist", {0.0, 0.235, 0.0}},
    {kLeftForeArm, 3, "pLeftUlnarStyloid", {-0.024, 0.235, 0.0}},
    {kLeftForeArm, 4, "pLeftRadialStyloid", {0.024, 0.237, 0.0}},
    {kLeftForeArm, 5, "pLeftOlecranon", {-0.024, -0.002, 0.0}},
    {kLeftHand, 1, "jLeftWrist", {0.0, 0.0, 0.0}},
    {kLeftHand, 2, "pLeftTopOfHand", {0.0, 0.186, 0.0}},
    {kLeftHand, 3, "pLeftPinky", {-0.039, 0.102, 0.0}},
    {kLeftHand, 4, "pLeftBallHand", {-0.02, 0.033, -0.01}},
    {kLeftHand, 5, "pLeftHandPalm", {0.019, 0.086, -0.01}},
    {kRightUpperLeg, 1, "jRightHip", {0.0, 0.0, 0.0}},
    {kRightUpperLeg, 2, "jRightKnee", {0.0, 0.0, -0.4285}},
    {kRightUpperLeg, 3, "pRightGreaterTrochanter", {0.001, -0.071, -0.03}},
    {kRightUpperLeg, 4, "pRightKneeLatEpicondyle", {-0.007, -0.041, -0.429}},
    {kRightUpperLeg, 5, "pRightKneeMedEpicondyle", {-0.007, 0.036, -0.429}},
    {kRightUpperLeg, 6, "pRightPatella", {0.036, 0.0, -0.427}},
    {kRightLowerLeg, 1, "jRightKnee", {0.0, 0.0, 0.0}},
    {kRightLowerLeg, 2, "jRightAnkle", {0.0, 0.0, -0.419}},
    {kRightLowerLeg, 3, "pRightKneeLatEpicondyle", {-0.007, -0.043, -0.001}},
    {kRightLowerLeg, 4, "pRightKneeMedEpicondyle", {-0.007, 0.037, -0.001}},
    {kRightLowerLeg, 5, "pRightLatMalleolus", {0.0, -0.032, -0.418}},
    {kRightLowerLeg, 6, "pRightMedMalleolus", {0.0, 0.032, -0.418}},
    {kRightLowerLeg, 7, "pRightTibialTub", {0.062, 0.0, -0.032}},
    {kRightFoot, 1, "jRightAnkle", {0.0, 0.0, 0.0}},
    {kRightFoot, 2, "jRightBallFoot", {0.148, 0.0, -0.065}},
    {kRightFoot, 3, "pRightHeelFoot", {-0.039, 0.0, -0.077}},
    {kRightFoot, 4, "pRightFirstMetatarsal", {0.117, 0.037, -0.078}},
    {kRightFoot, 5, "pRightFifthMetatarsal", {0.117, -0.039, -0.078}},
    {kRightFoot, 6, "pRightPivotFoot", {0.138, 0.0, -0.078}},
    {kRightFoot, 7, "pRightHeelCenter", {0.0, 0.0, -0.078}},
    {kRightFoot, 8, "pRightTopOfFoot", {0.103, 0.01, -0.027}},
    {kRightToe, 1, "jRightBallFoot", {0.0, 0.0, 0.0}},
    {kRightToe, 2, "pRightToe", {0.063, 0.0, -0.015}},
    {kRightToe, 3, "pRightFirstMetatarsal", {-0.03, 0.035, -0.015}},
    {kRightToe, 4, "pRightFifthMetatarsal", {-0.03, -0.037, -0.015}},
    {kLeftUpperLeg, 1, "jLeftHip", {0.0, 0.0, 0.0}},
    {kLeftUpperLeg, 2, "jLeftKnee", {0.0, 0.0, -0.4285}},
    {kLeftUpperLeg, 3, "pLeftGreaterTrochanter", {0.001, 0.071, -0.03}},
    {kLeftUpperLeg, 4, "pLeftKneeLatEpicondyle", {-0.007, 0.041, -0.429}},
    {kLeftUpperLeg, 5, "pLeftKneeMedEpicondyle", {-0.007, -0.036, -0.429}},
    {kLeftUpperLeg, 6, "pLeftPatella", {0.036, 0.0, -0.427}},
    {kLeftLowerLeg, 1, "jLeftKnee", {0.0, 0.0, 0.0}},
    {kLeftLowerLeg, 2, "jLeftAnkle", {0.0, 0.0, -0.419}},
    {kLeftLowerLeg, 3, "pLeftKneeLatEpicondyle", {-0.007, 0.043, -0.001}},
    {kLeftLowerLeg, 4, "pLeftKneeMedEpicondyle", {-0.007, -0.037, -0.001}},
    {kLeftLowerLeg, 5, "pLeftLatMalleolus", {0.0, 0.032, -0.418}},
    {kLeftLowerLeg, 6, "pLeftMedMalleolus", {0.0, -0.032, -0.418}},
    {kLeftLowerLeg, 7, "pLeftTibialTub", {0.062, 0.0, -0.032}},
    {kLeftFoot, 1, "jLeftAnkle", {0.0, 0.0, 0.0}},
    {kLeftFoot, 2, "jLeftBallFoot", {0.148, 0.0, -0.065}},
    {kLeftFoot, 3, "pLeftHeelFoot", {-0.039, 0.0, -0.077}},
    {kLeftFoot, 4, "pLeftFirstMetatarsal", {0.117, -0.037, -0.078}},
    {kLeftFoot, 5, "pLeftFifthMetatarsal", {0.117, 0.039, -0.078}},
    {kLeftFoot, 6, "pLeftPivotFoot", {0.138, 0.0, -0.078}},
    {kLeftFoot, 7, "pLeftHeelCenter", {0.0, 0.0, -0.078}},
    {kLeftFoot, 8, "pLeftTopOfFoot", {0.103, -0.01, -0.027}},
    {kLeftToe, 1, "jLeftBallFoot", {0.0, 0.0, 0.0}},
    {kLeftToe, 2, "pLeftToe", {0.063, 0.0, -0.015}},
    {kLeftToe, 3, "pLeftFirstMetatarsal", {-0.03, -0.035, -0.015}},
    {kLeftToe, 4, "pLeftFifthMetatarsal", {-0.03, 0.037, -0.015}},
}};

// Pelvis to head, right arm, left arm, right leg, left leg.
constexpr std::array<int, kMarkerCount> kMarkers{
    0,  6,  7,  8,  9,  10, 11, 12,  16,  19,  22,  28,  29,  30,  31,  27,  37,  38,  39,  40, 44, 47,
    48, 51, 52, 53, 55, 56, 57, 62,  65,  66,  69,  70,  71,  73,  74,  75,  79,  80,  81,  82, 87, 88,
    89, 92, 93, 94, 95, 96, 99, 104, 105, 106, 107, 112, 113, 114, 117, 118, 119, 120, 121, 124};

constexpr std::uint32_t factorOf(PointIdCoding coding) {
    return coding == PointIdCoding::By256 ? 256U : 100U;
}

bool namesKnownPoint(const PointReference& reference, PointIdCoding coding) {
    constexpr int kMaxSegmentIdIn100 = 28;
    if (coding == PointIdCoding::By100) {
        return reference.segmentId >= 1 && reference.segmentId <= kMaxSegmentIdIn100 &&
               reference.localId <= kMaxLocalPointId;
    }
    if (reference.segmentId < 1 || reference.segmentId > kMaxSegmentCount) {
        return false;
    }
    if (reference.segmentId > kBodySegmentCount) {
        return reference.localId <= kMaxLocalPointId;
    }
    return reference.localId == 0 || findPoint(reference.segmentId - 1, reference.localId) != nullptr;
}

} // namespace

std::span<const AnatomicalPoint> anatomicalPoints() {
    return kPoints;
}

std::span<const int> markerPoints() {
    return kMarkers;
}

const AnatomicalPoint* findPoint(int segment, int localId) {
    const auto found = std::ranges::find_if(kPoints, [&](const AnatomicalPoint& point) {
        return point.segment == segment && point.localId == localId;
    });
    return found == kPoints.end() ? nullptr : &*found;
}

const AnatomicalPoint* findPoint(std::string_view name) {
    const auto found = std::ranges::find(kPoints, name, &AnatomicalPoint::name);
    return found == kPoints.end() ? nullptr : &*found;
}

std::uint32_t encodePointId(PointIdCoding coding, PointReference reference) {
    if (coding == PointIdCoding::Unknown) {
        return 0;
    }
    return factorOf(coding) * static_cast<std::uint32_t>(reference.segmentId) +
           static_cast<std::uint32_t>(reference.localId);
}

std::optional<PointReference> decodePointId(PointIdCoding coding, std::uint32_t id) {
    if (coding == PointIdCoding::Unknown) {
        return std::nullopt;
    }
    const std::uint32_t factor = factorOf(coding);
    return PointReference{static_cast<int>(id / factor), static_cast<int>(id % factor)};
}

std::optional<PointReference> knownPoint(PointIdCoding coding, std::uint32_t id) {
    const auto reference = decodePointId(coding, id);
    return reference && namesKnownPoint(*reference, coding) ? reference : std::nullopt;
}

PointIdCoding detectPointIdCoding(std::span<const std::uint32_t> ids) {
    const auto leadingRun = [&](PointIdCoding coding) {
        const auto end =
            std::ranges::find_if(ids, [coding](std::uint32_t id) { return !knownPoint(coding, id); });
        return end - ids.begin();
    };
    const auto by256 = leadingRun(PointIdCoding::By256);
    const auto by100 = leadingRun(PointIdCoding::By100);
    return by256 == 0 && by100 == 0 ? PointIdCoding::Unknown
           : by256 >= by100         ? PointIdCoding::By256
                                    : PointIdCoding::By100;
}

} // namespace posewire::model
