// SPDX-License-Identifier: MIT
#include "render/mesh/rest_pose.h"

#include "render/bounds.h"
#include "render/mesh/finite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace posewire::render {
namespace {

/// People, and characters that are meant as such.
constexpr float kLeastHeight = 0.5F;
constexpr float kMostHeight = 3.0F;
/// An axis of the file that is closer than this to the body's own is meant.
constexpr float kNearAxis = 25.0F; // degrees

const glm::quat kNoTurn{1.0F, 0.0F, 0.0F, 0.0F};

/// Where a mapped bone is; nothing where there is none.
class Places {
public:
    Places(const BoneMapping& mapping, std::span<const glm::vec3> origins)
        : m_mapping(mapping), m_origins(origins) {}

    bool has(std::size_t mappable) const { return m_mapping.bones[mappable] >= 0; }
    glm::vec3 of(std::size_t mappable) const {
        return m_origins[static_cast<std::size_t>(m_mapping.bones[mappable])];
    }

private:
    const BoneMapping& m_mapping;
    std::span<const glm::vec3> m_origins;
};

std::optional<glm::vec3> unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return std::isfinite(length) && length > 1e-6F ? std::optional(v / length) : std::nullopt;
}

/// The smallest rotation from one direction to another.
glm::quat arc(const glm::vec3& from, const glm::vec3& to) {
    const auto a = unit(from);
    const auto b = unit(to);
    if (!a || !b) {
        return kNoTurn;
    }
    const float cosine = glm::dot(*a, *b);
    if (cosine < -0.9999F) {
        const glm::vec3 aside = std::abs(a->x) < 0.7F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
        const glm::vec3 axis = glm::normalize(glm::cross(*a, aside));
        return {0.0F, axis.x, axis.y, axis.z};
    }
    const glm::vec3 axis = glm::cross(*a, *b);
    return glm::normalize(glm::quat(1.0F + cosine, axis.x, axis.y, axis.z));
}

/// The rotation from one pair of directions to another: the first of each exactly, the second as near as it
/// can be.
std::optional<glm::quat> frameTurn(const glm::vec3& along, const glm::vec3& aside, const glm::vec3& toAlong,
                                   const glm::vec3& toAside) {
    const auto frame = [](const glm::vec3& first, const glm::vec3& second) -> std::optional<glm::mat3> {
        const auto x = unit(first);
        const auto z = x ? unit(glm::cross(*x, second)) : std::nullopt;
        return z ? std::optional(glm::mat3(*x, glm::cross(*z, *x), *z)) : std::nullopt;
    };
    const auto from = frame(along, aside);
    const auto to = frame(toAlong, toAside);
    return from && to ? std::optional(glm::normalize(glm::quat_cast(*to * glm::transpose(*from))))
                      : std::nullopt;
}

/// The rotation nearest to `turn` that takes axes to axes, where that is what is meant.
glm::quat snapped(const glm::quat& turn) {
    const glm::mat3 m = glm::mat3_cast(turn);
    glm::mat3 best(0.0F);
    for (int column = 0; column < 3; ++column) {
        int axis = 0;
        for (int row = 1; row < 3; ++row) {
            axis = std::abs(m[column][row]) > std::abs(m[column][axis]) ? row : axis;
        }
        best[column][axis] = m[column][axis] < 0.0F ? -1.0F : 1.0F;
        if (std::abs(m[column][axis]) < std::cos(glm::radians(kNearAxis))) {
            return turn;
        }
    }
    return glm::normalize(glm::quat_cast(best));
}

/// Metres of a unit: the file's own where a person has that height, else what makes one.
float unitFor(float height) {
    constexpr std::array kUnits{1.0F, 0.01F, 0.001F, 100.0F, 0.1F, 10.0F};
    for (const float unit : kUnits) {
        if (height * unit >= kLeastHeight && height * unit <= kMostHeight) {
            return unit;
        }
    }
    return kReferenceStature / height;
}

std::optional<glm::quat> turnOf(const Places& places, int quarterTurns) {
    const glm::vec3 feet = 0.5F * (places.of(LeftFoot) + places.of(RightFoot));
    const auto up = unit(places.of(Head) - feet);
    const glm::vec3 left = places.of(LeftUpperLeg) - places.of(RightUpperLeg) + places.of(LeftUpperArm) -
                           places.of(RightUpperArm);
    if (!up) {
        return std::nullopt;
    }
    const auto turn = frameTurn(*up, left, {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F});
    if (!turn) {
        return std::nullopt;
    }
    const float angle = glm::radians(90.0F * static_cast<float>(quarterTurns));
    return glm::angleAxis(angle, glm::vec3(0.0F, 0.0F, 1.0F)) * snapped(*turn);
}

bool isPersons(float height) {
    return height >= kLeastHeight && height <= kMostHeight;
}

void remark(const Places& places, float ownHeight, RestReading& reading) {
    reading.isInOtherUnit = isPersons(reading.height) && !isPersons(ownHeight);
    if (places.has(LeftToe) && places.has(RightToe)) {
        const glm::vec3 ahead =
            places.of(LeftToe) - places.of(LeftFoot) + places.of(RightToe) - places.of(RightFoot);
        reading.pointsBackwards = ahead.x < 0.0F;
    }
}

class Straightener {
public:
    Straightener(const BoneMapping& mapping, std::span<const glm::vec3> origins)
        : m_places(mapping, origins), m_mapping(mapping), m_turns(origins.size()) {
        for (const Segment upper : {LeftUpperArm, RightUpperArm, LeftUpperLeg, RightUpperLeg}) {
            alongNext(upper);
            alongNext(upper + 1U);
        }
        for (const Segment foot : {LeftFoot, RightFoot}) {
            turnFoot(foot);
        }
        turnHand(LeftHand);
        turnHand(RightHand);
        for (const Segment segment : {Pelvis, L5, L3, T12, T8, Neck, Head, LeftShoulder, RightShoulder}) {
            set(segment, kNoTurn);
        }
    }

    const std::vector<std::optional<glm::quat>>& turns() const { return m_turns; }

private:
    void set(std::size_t mappable, const glm::quat& turn) {
        if (m_places.has(mappable)) {
            m_turns[static_cast<std::size_t>(m_mapping.bones[mappable])] = turn;
        }
    }
    std::optional<glm::quat> get(std::size_t mappable) const {
        return m_places.has(mappable) ? m_turns[static_cast<std::size_t>(m_mapping.bones[mappable])]
                                      : std::nullopt;
    }
    static glm::vec3 reference(std::size_t mappable) { return jointOrigin(mappableJoint(mappable)); }

    void alongNext(std::size_t segment) {
        set(segment, arc(m_places.of(segment + 1) - m_places.of(segment),
                         reference(segment + 1) - reference(segment)));
    }

    /// About the vertical alone: its sole stays on the floor.
    void turnFoot(Segment foot) {
        const auto toe = static_cast<std::size_t>(foot) + 1U;
        glm::vec3 ahead =
            m_places.has(toe) ? m_places.of(toe) - m_places.of(foot) : glm::vec3(1.0F, 0.0F, 0.0F);
        ahead.z = 0.0F;
        const bool isPlain = ahead.x > 0.3F * glm::length(ahead);
        const glm::quat turn = isPlain ? arc(ahead, {1.0F, 0.0F, 0.0F}) : kNoTurn;
        set(foot, turn);
        set(toe, turn);
    }

    /// Along the middle finger, palm down.
    void turnHand(Segment hand) {
        const std::size_t first = kSegmentCount + (hand == LeftHand ? 0U : kHandSegmentCount);
        const std::size_t thumb = first + 1;
        const std::size_t index = first + 5;
        const std::size_t middle = first + 9;
        const std::size_t little = first + 17;
        const std::size_t end = m_places.has(middle) ? middle : index;
        glm::quat turn = get(hand - 1U).value_or(kNoTurn);
        if (m_places.has(end)) {
            const glm::vec3 along = m_places.of(end) - m_places.of(hand);
            const glm::vec3 toAlong = reference(end) - reference(hand);
            turn = arc(turn * along, toAlong) * turn;
            const std::size_t ahead = m_places.has(index) ? index : thumb;
            const std::size_t behind =
                m_places.has(index) && m_places.has(little) ? little : std::size_t{hand};
            if (m_places.has(ahead) && ahead != behind && (behind == little || ahead == thumb)) {
                turn = frameTurn(along, m_places.of(ahead) - m_places.of(behind), toAlong,
                                 reference(ahead) - reference(behind))
                           .value_or(turn);
            }
        }
        set(hand, turn);
        for (std::size_t i = 0; i < kHandSegmentCount; ++i) {
            turnFinger(first, i, turn);
        }
    }

    void turnFinger(std::size_t first, std::size_t finger, const glm::quat& hand) {
        const int parent = kFingerParents[finger];
        const glm::quat before =
            parent < 0 ? hand : get(first + static_cast<std::size_t>(parent)).value_or(hand);
        const std::size_t next = first + finger + 1;
        const bool hasNext = finger + 1 < kHandSegmentCount &&
                             kFingerParents[finger + 1] == static_cast<int>(finger) && finger > 0;
        if (!m_places.has(first + finger)) {
            return;
        }
        glm::quat turn = before;
        if (hasNext && m_places.has(next)) {
            const glm::vec3 along = m_places.of(next) - m_places.of(first + finger);
            turn = arc(before * along, reference(next) - reference(first + finger)) * before;
        }
        set(first + finger, turn);
    }

    Places m_places;
    const BoneMapping& m_mapping;
    std::vector<std::optional<glm::quat>> m_turns;
};

} // namespace

tl::expected<RestPose, std::string> readRestPose(const ImportedCharacter& character,
                                                 const BoneMapping& mapping, const RestChoice& choice) {
    std::vector<glm::vec3> origins;
    for (const ImportedBone& bone : character.bones) {
        if (!isFinite(bone.position)) {
            return tl::make_unexpected("the place of bone " + bone.name + " is no number");
        }
        origins.push_back(bone.position);
    }
    RestPose rest;
    const auto turn = turnOf(Places(mapping, origins), choice.quarterTurns);
    if (!turn) {
        return tl::make_unexpected("head, feet and both sides do not tell where up and left are");
    }
    rest.turn = *turn;
    Bounds bounds;
    for (const glm::vec3& position : character.mesh.positions) {
        bounds.add(rest.turn * position);
    }
    const float height = bounds.max.z - bounds.min.z;
    if (!(height > 1e-6F) || !std::isfinite(height)) {
        return tl::make_unexpected("the body has no height");
    }
    rest.reading.unit = choice.unit > 0.0F ? choice.unit : unitFor(height);
    rest.reading.height = height * rest.reading.unit;
    for (glm::vec3& origin : origins) {
        origin = rest.reading.unit * (rest.turn * origin);
    }
    rest.origins = std::move(origins);
    const Places places(mapping, rest.origins);
    const auto arm = unit(places.of(LeftForeArm) - places.of(LeftUpperArm));
    rest.reading.armsBelowLevel = arm ? glm::degrees(std::asin(std::clamp(-arm->z, -1.0F, 1.0F))) : 0.0F;
    rest.reading.turned = glm::degrees(2.0F * std::acos(std::min(std::abs(rest.turn.w), 1.0F)));
    remark(places, height * (choice.unit > 0.0F ? choice.unit : 1.0F), rest.reading);
    return rest;
}

std::vector<int> limbsBeside(std::span<const ImportedBone> bones, const BoneMapping& mapping,
                             std::span<const glm::vec3> origins) {
    constexpr float kSamePlace = 0.005F; // metres
    std::vector<int> limbs(bones.size(), -1);
    for (const Segment limb : {RightUpperArm, RightForeArm, LeftUpperArm, LeftForeArm, RightUpperLeg,
                               RightLowerLeg, LeftUpperLeg, LeftLowerLeg}) {
        const auto bone = static_cast<std::size_t>(mapping.bones[limb]);
        for (std::size_t i = 0; i < bones.size(); ++i) {
            const bool isBeside = bones[i].parent == bones[bone].parent &&
                                  glm::distance(origins[i], origins[bone]) < kSamePlace;
            if (isBeside && std::ranges::find(mapping.bones, static_cast<int>(i)) == mapping.bones.end()) {
                limbs[i] = limb;
            }
        }
    }
    return limbs;
}

std::vector<glm::quat> straightTurns(std::span<const ImportedBone> bones, const BoneMapping& mapping,
                                     std::span<const glm::vec3> origins, bool isStraightened) {
    std::vector<glm::quat> turns(bones.size(), kNoTurn);
    if (!isStraightened) {
        return turns;
    }
    const Straightener straightener(mapping, origins);
    const std::vector<int> limbs = limbsBeside(bones, mapping, origins);
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const glm::quat inherited =
            bones[i].parent < 0 ? kNoTurn : turns[static_cast<std::size_t>(bones[i].parent)];
        const std::size_t leader =
            limbs[i] < 0 ? i : static_cast<std::size_t>(mapping.bones[static_cast<std::size_t>(limbs[i])]);
        turns[i] = straightener.turns()[leader].value_or(inherited);
    }
    return turns;
}

} // namespace posewire::render
