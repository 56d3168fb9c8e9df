// SPDX-License-Identifier: MIT
#include "core/performer/character.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace posewire::performer {
namespace {

using Eigen::Vector3d;
using model::SegmentKind;
using model::SegmentPose;
using namespace model::segment;

/// Where the bones of a left hand begin, relative to the wrist on the 1.75 m body, palm down, fingers along
/// y, thumb forward.
constexpr std::array<std::array<double, 3>, model::kHandSegmentCount> kBones{{
    {0.000, 0.000, 0.000},   {0.018, 0.020, -0.006},  {0.038, 0.050, -0.012},  {0.050, 0.080, -0.016},
    {0.016, 0.022, 0.000},   {0.030, 0.090, -0.002},  {0.032, 0.128, -0.004},  {0.033, 0.152, -0.006},
    {0.004, 0.022, 0.002},   {0.009, 0.094, 0.000},   {0.009, 0.136, -0.002},  {0.009, 0.163, -0.004},
    {-0.008, 0.021, 0.001},  {-0.011, 0.088, -0.001}, {-0.013, 0.126, -0.003}, {-0.014, 0.151, -0.005},
    {-0.018, 0.020, -0.002}, {-0.029, 0.078, -0.004}, {-0.032, 0.108, -0.006}, {-0.034, 0.127, -0.008},
}};

struct PropMount {
    std::string_view name;
    int segment;
    std::array<double, 3> place; ///< on the 1.75 m body
};
constexpr std::array<PropMount, model::kMaxPropCount> kProps{{
    {"Sword", kRightHand, {0.02, -0.08, -0.02}},
    {"Crutch", kLeftHand, {0.02, 0.08, -0.02}},
    {"Generic", kT8, {-0.16, 0.0, 0.02}},
    {"Golfclub", kPelvis, {0.0, 0.17, 0.02}},
}};

Vector3d boneOrigin(int index, double side) {
    const auto& bone = kBones[static_cast<std::size_t>(index)];
    return {bone[0], side * bone[1], bone[2]};
}

/// Metacarpals stay flat; the thumb closes across the palm, the fingers bend joint by joint.
Eigen::Quaterniond boneRotation(int index, double side, double curl) {
    constexpr int kThumbEnd = 3;
    constexpr int kBonesPerFinger = 4;
    if (index == 0) {
        return Eigen::Quaterniond::Identity();
    }
    if (index <= kThumbEnd) {
        return aboutZ(side * 12.0 * curl) * aboutX(-side * 14.0 * curl);
    }
    const bool isMetacarpal = (index - kThumbEnd - 1) % kBonesPerFinger == 0;
    return isMetacarpal ? Eigen::Quaterniond::Identity() : aboutX(-side * 80.0 * curl);
}

struct Role {
    const char* name;
    const char* colour;
    double stature;
};
constexpr std::array<Role, 8> kRoles{{
    {"Mira Lindqvist", "2f72c4", 1.70},
    {"Jonas Adeyemi", "e07b28", 1.82},
    {"Hana Sato", "2f9e6b", 1.63},
    {"Tomás Rivera", "8a55c7", 1.76},
    {"Inês Duarte", "c43d5c", 1.67},
    {"Leo Novák", "1d9aaa", 1.88},
    {"Amara Okafor", "c9a227", 1.73},
    {"Finn Berger", "5b6b7f", 1.79},
}};

enum Key : std::uint64_t { kLegs, kArms, kShoulders, kHips, kTrackers = 20, kSession = 30 };

KeyedRandom randomOf(const CharacterSettings& settings) {
    return KeyedRandom(settings.seed).fork(1000 + static_cast<std::uint64_t>(settings.id));
}

model::ReferenceBody bodyFor(const CharacterSettings& settings) {
    const KeyedRandom random = randomOf(settings);
    return model::makeReferenceBody({identityOf(settings.id).stature, random.uniform(kLegs, 0.97, 1.03),
                                     random.uniform(kArms, 0.97, 1.03),
                                     random.uniform(kShoulders, 0.94, 1.06),
                                     random.uniform(kHips, 0.94, 1.06)});
}

/// Moments apart by 1/240 s or less, a whole number of them to a frame.
int stepsPerFrame(double rateHz) {
    constexpr double kLeastHz = 240.0;
    return static_cast<int>(std::ceil(kLeastHz / rateHz - 1e-9));
}

std::string suitId(std::size_t character) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string text(8, '0');
    for (std::size_t value = 0x00342B10U + character, place = text.size(); place-- > 0; value >>= 4) {
        text[place] = kDigits[value & 0xfU];
    }
    return text;
}

} // namespace

std::string_view propName(int prop) {
    return kProps[static_cast<std::size_t>(prop)].name;
}

void appendExtraSegments(const model::SegmentLayout& layout, const model::ReferenceBody& body, double curl,
                         std::vector<SegmentPose>& poses) {
    const double scale = body.stature / model::kReferenceStature;
    for (int position = layout.body; position < layout.count(); ++position) {
        const model::SegmentPlace place = *model::placeOf(layout, position);
        if (place.kind == SegmentKind::Prop) {
            const PropMount& mount = kProps[static_cast<std::size_t>(place.index)];
            const SegmentPose& carrier = poses[static_cast<std::size_t>(mount.segment)];
            poses.push_back(model::composed(
                carrier, {scale * Vector3d(mount.place.data()), Eigen::Quaterniond::Identity()}));
            continue;
        }
        const double side = place.kind == SegmentKind::LeftFinger ? 1.0 : -1.0;
        const int parentBone = model::handSegments()[static_cast<std::size_t>(place.index)].parent;
        const Vector3d from = parentBone < 0 ? Vector3d::Zero() : boneOrigin(parentBone, side);
        const auto parent = static_cast<std::size_t>(model::segmentParent(layout, position));
        poses.push_back(model::composed(poses[parent], {scale * (boneOrigin(place.index, side) - from),
                                                        boneRotation(place.index, side, curl)}));
    }
}

Identity identityOf(int character) {
    const auto index = static_cast<std::size_t>(character);
    const Role& role = kRoles[index % kRoles.size()];
    const std::size_t round = index / kRoles.size();
    Identity identity{role.name, role.colour, suitId(index), role.stature};
    if (round > 0) {
        identity.name += ' ';
        identity.name += std::to_string(round + 1);
    }
    return identity;
}

Character::Character(const CharacterSettings& settings, double rateHz)
    : m_settings(settings),
      m_rateHz(rateHz),
      m_stepsPerFrame(stepsPerFrame(rateHz)),
      m_identity(identityOf(settings.id)),
      m_body(bodyFor(settings)),
      m_motion(makeMotion(settings.motion, {m_body, settings.seed, settings.id, settings.count})),
      m_trackers(m_body, randomOf(settings).fork(kTrackers), KeyedRandom(settings.seed).fork(kSession)) {
    m_moment.segments.resize(static_cast<std::size_t>(settings.layout.count()));
}

const Character::Poses& Character::sampleAt(std::int64_t key) {
    Sample& sample = m_samples[static_cast<std::size_t>((key + 4) & 3)];
    if (sample.poses.empty() || sample.key != key) {
        const double seconds = static_cast<double>(key) / (m_rateHz * m_stepsPerFrame);
        const BodyPose body = m_motion->sample(seconds);
        const double curl = 0.35 + 0.2 * std::sin(2.0 * std::numbers::pi * 0.3 * seconds + m_settings.id);
        sample.key = key;
        sample.poses.assign(body.begin(), body.end());
        appendExtraSegments(m_settings.layout, m_body, curl, sample.poses);
    }
    return sample.poses;
}

const CharacterMoment& Character::at(std::uint64_t frame) {
    const std::int64_t key = static_cast<std::int64_t>(frame) * m_stepsPerFrame;
    TrackerMoment moment;
    const ThreeMoments& samples = moment.segments = {sampleAt(key - 1), sampleAt(key), sampleAt(key + 1),
                                                     1.0 / (m_rateHz * m_stepsPerFrame)};
    moment.states = m_moment.segments;
    moment.seconds = static_cast<double>(frame) / m_rateHz;
    moment.frame = frame;
    moment.sinceHeelStrike = {m_motion->sinceHeelStrike(model::Side::Right, moment.seconds),
                              m_motion->sinceHeelStrike(model::Side::Left, moment.seconds)};
    differentiate(samples, m_moment.segments);
    m_moment.centreOfMass =
        differentiated(centreOfMass(m_body, samples.before), centreOfMass(m_body, samples.now),
                       centreOfMass(m_body, samples.after), samples.step);
    m_moment.trackers = m_trackers.read(moment);
    return m_moment;
}

std::vector<Vector3d> Character::nullPose() const {
    Poses poses(model::kBodySegmentCount);
    for (int index = 0; index < model::kBodySegmentCount; ++index) {
        poses[static_cast<std::size_t>(index)].position = m_body.nullPoseOrigin(index);
    }
    appendExtraSegments(m_settings.layout, m_body, 0.0, poses);
    std::vector<Vector3d> origins(poses.size());
    std::ranges::transform(poses, origins.begin(), &SegmentPose::position);
    return origins;
}

} // namespace posewire::performer
