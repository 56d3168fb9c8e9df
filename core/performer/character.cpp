// SPDX-License-Identifier: MIT
#include "core/performer/character.h"

#include "core/performer/centre_of_mass.h"

#include <cmath>
#include <numbers>

namespace posewire::performer {
namespace {

using Eigen::Vector3d;

struct Person {
    const char* name;
    const char* colour;
    double stature;
};
constexpr std::array<Person, 8> kPersons{{
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

std::string hexadecimal(std::uint32_t value) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string text(8, '0');
    for (std::size_t place = text.size(); place-- > 0; value >>= 4) {
        text[place] = kDigits[value & 0xfU];
    }
    return text;
}

} // namespace

Identity identityOf(int character) {
    const auto index = static_cast<std::size_t>(character);
    const Person& person = kPersons[index % kPersons.size()];
    const std::size_t round = index / kPersons.size();
    Identity identity{person.name, person.colour,
                      hexadecimal(0x00342B10U + static_cast<std::uint32_t>(index)), person.stature};
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
      m_extra{settings.layout},
      m_trackers(m_body, randomOf(settings).fork(kTrackers), KeyedRandom(settings.seed).fork(kSession)) {
    m_moment.segments.resize(static_cast<std::size_t>(settings.layout.count()));
}

void Character::fill(Poses& poses, double seconds) const {
    const BodyPose body = m_motion->sample(seconds);
    poses.assign(body.begin(), body.end());
    const double curl = 0.35 + 0.2 * std::sin(2.0 * std::numbers::pi * 0.3 * seconds + m_settings.id);
    m_extra.append(m_body, curl, poses);
}

const Character::Poses& Character::sampleAt(std::int64_t key) {
    Sample& sample = m_samples[static_cast<std::size_t>((key + 4) & 3)];
    if (!sample.isFilled || sample.key != key) {
        sample.key = key;
        sample.isFilled = true;
        fill(sample.poses, static_cast<double>(key) / (m_rateHz * m_stepsPerFrame));
    }
    return sample.poses;
}

const CharacterMoment& Character::at(std::uint64_t frame) {
    const std::int64_t key = static_cast<std::int64_t>(frame) * m_stepsPerFrame;
    TrackerMoment moment;
    moment.before = sampleAt(key - 1);
    moment.now = sampleAt(key);
    moment.after = sampleAt(key + 1);
    moment.states = m_moment.segments;
    moment.step = 1.0 / (m_rateHz * m_stepsPerFrame);
    moment.seconds = static_cast<double>(frame) / m_rateHz;
    moment.frame = frame;
    moment.sinceHeelStrike = {m_motion->sinceHeelStrike(model::Side::Right, moment.seconds),
                              m_motion->sinceHeelStrike(model::Side::Left, moment.seconds)};
    update(moment);
    return m_moment;
}

void Character::update(const TrackerMoment& samples) {
    KinematicsJob{samples.before, samples.now, samples.after, samples.step, m_moment.segments}.run();
    m_moment.centreOfMass =
        differentiated(centreOfMass(m_body, samples.before), centreOfMass(m_body, samples.now),
                       centreOfMass(m_body, samples.after), samples.step);
    m_moment.trackers = m_trackers.read(samples);
}

std::vector<Vector3d> Character::nullPose() const {
    std::vector<Vector3d> origins;
    origins.reserve(static_cast<std::size_t>(m_settings.layout.count()));
    for (int index = 0; index < model::kBodySegmentCount; ++index) {
        origins.push_back(m_body.nullPoseOrigin(index));
    }
    m_extra.appendNullPose(m_body, origins);
    return origins;
}

} // namespace posewire::performer
