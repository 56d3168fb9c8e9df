// SPDX-License-Identifier: MIT
#include "render/mesh/bone_shape.h"

#include "render/bounds.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace posewire::render {
namespace {

/// Shares of the skeleton's height.
constexpr float kMirrorTolerance = 0.04F;
constexpr float kLeastSpread = 0.02F;
constexpr float kLeastLegDrop = 0.2F;
constexpr float kLeastArmReach = 0.15F;

using Path = std::vector<std::size_t>;

/// Two branches of one bone, each along its furthest reach, and where their long bones begin.
struct LimbPair {
    std::size_t from = 0;
    std::array<Path, 2> paths;
    std::size_t upper = 0;
    float reach = 0.0F; ///< of the shorter of the two long bones
};

class Shape {
public:
    explicit Shape(std::span<const ImportedBone> bones) : m_bones(bones), m_children(bones.size()) {
        for (std::size_t i = 0; i < bones.size(); ++i) {
            if (bones[i].parent >= 0) {
                m_children[static_cast<std::size_t>(bones[i].parent)].push_back(i);
            }
        }
    }

    BoneMapping run() {
        for (const int up : {2, 1, 0}) {
            for (const float sign : {1.0F, -1.0F}) {
                m_up = glm::vec3(0.0F);
                m_up[up] = sign;
                for (const int lateral : {0, 1, 2}) {
                    m_side = glm::vec3(0.0F);
                    m_side[lateral] = 1.0F;
                    if (lateral != up && find()) {
                        return m_mapping;
                    }
                }
            }
        }
        return {};
    }

private:
    const glm::vec3& at(std::size_t bone) const { return m_bones[bone].position; }
    float height(std::size_t bone) const { return glm::dot(at(bone), m_up); }

    /// From a bone along its furthest reach to a leaf, and how far that is.
    std::pair<Path, float> furthest(std::size_t bone) const {
        std::pair<Path, float> best{{}, 0.0F};
        for (const std::size_t child : m_children[bone]) {
            auto [path, reach] = furthest(child);
            reach += glm::distance(at(bone), at(child));
            if (best.first.empty() || reach > best.second) {
                best = {std::move(path), reach};
            }
        }
        best.first.insert(best.first.begin(), bone);
        return best;
    }

    /// Finds the two longest bones of a path that follow each other: their place, and the shorter length.
    std::pair<std::size_t, float> longBones(const Path& path) const {
        std::pair<std::size_t, float> best{0, 0.0F};
        for (std::size_t i = 0; i + 2 < path.size(); ++i) {
            const float shorter = std::min(glm::distance(at(path[i]), at(path[i + 1])),
                                           glm::distance(at(path[i + 1]), at(path[i + 2])));
            best = shorter > best.second ? std::pair(i, shorter) : best;
        }
        return best;
    }

    bool areMirrored(const glm::vec3& a, const glm::vec3& b, const glm::vec3& middle) const {
        const glm::vec3 across = a + b - 2.0F * middle;
        const glm::vec3 apart = a - b;
        const float tolerance = kMirrorTolerance * m_height;
        return std::abs(glm::dot(across, m_side)) < 2.0F * tolerance &&
               glm::length(apart - glm::dot(apart, m_side) * m_side) < tolerance;
    }

    std::optional<LimbPair> pairOf(std::size_t from, std::size_t a, std::size_t b) const {
        LimbPair pair{from, {furthest(a).first, furthest(b).first}, 0, 0.0F};
        const auto [upper, reach] = longBones(pair.paths[0]);
        const auto [other, otherReach] = longBones(pair.paths[1]);
        if (upper != other || !(std::min(reach, otherReach) > 0.0F) ||
            !(std::abs(glm::dot(at(pair.paths[0][upper]) - at(pair.paths[1][upper]), m_side)) >
              kLeastSpread * m_height)) {
            return std::nullopt;
        }
        pair.upper = upper;
        pair.reach = std::min(reach, otherReach);
        for (std::size_t i = upper; i < upper + 3; ++i) {
            if (!areMirrored(at(pair.paths[0][i]), at(pair.paths[1][i]), at(from))) {
                return std::nullopt;
            }
        }
        return pair;
    }

    std::vector<LimbPair> pairs() const {
        std::vector<LimbPair> found;
        for (std::size_t bone = 0; bone < m_bones.size(); ++bone) {
            for (std::size_t i = 0; i < m_children[bone].size(); ++i) {
                for (std::size_t j = i + 1; j < m_children[bone].size(); ++j) {
                    if (auto pair = pairOf(bone, m_children[bone][i], m_children[bone][j])) {
                        found.push_back(std::move(*pair));
                    }
                }
            }
        }
        return found;
    }

    bool find() {
        Bounds box;
        for (const ImportedBone& bone : m_bones) {
            box.add(bone.position);
        }
        m_height = box.isEmpty() ? 0.0F : std::abs(glm::dot(box.max - box.min, m_up));
        if (!(m_height > 0.0F)) {
            return false;
        }
        const std::vector<LimbPair> all = pairs();
        const LimbPair* legs = nullptr;
        const auto foot = [&](const LimbPair& pair) { return height(pair.paths[0][pair.upper + 2]); };
        for (const LimbPair& pair : all) {
            const bool leadsDown = height(pair.paths[0][pair.upper]) - foot(pair) > kLeastLegDrop * m_height;
            legs = leadsDown && (legs == nullptr || foot(pair) < foot(*legs)) ? &pair : legs;
        }
        const LimbPair* arms = nullptr;
        for (const LimbPair& pair : all) {
            const bool isAbove =
                legs != nullptr && height(pair.paths[0][pair.upper]) >
                                       height(legs->paths[0][legs->upper]) + kLeastArmReach * m_height;
            arms = isAbove && 2.0F * pair.reach > kLeastArmReach * m_height &&
                           (arms == nullptr || pair.reach > arms->reach)
                       ? &pair
                       : arms;
        }
        return arms != nullptr && map(*legs, *arms);
    }

    bool map(const LimbPair& legs, const LimbPair& arms) {
        m_mapping = {};
        const auto head = headFrom(arms);
        if (head.empty()) {
            return false;
        }
        set(Head, head.back());
        if (head.size() > 1) {
            set(Neck, head.front());
        }
        set(Pelvis, legs.from);
        const glm::vec3 left = leftOf(legs);
        mapLimbs(legs, left, LeftUpperLeg, RightUpperLeg);
        mapLimbs(arms, left, LeftUpperArm, RightUpperArm);
        return true;
    }

    void set(std::size_t segment, std::size_t bone) { m_mapping.bones[segment] = static_cast<int>(bone); }

    void mapLimbs(const LimbPair& pair, const glm::vec3& left, Segment leftUpper, Segment rightUpper) {
        const glm::vec3 apart = at(pair.paths[0][pair.upper]) - at(pair.paths[1][pair.upper]);
        for (std::size_t side = 0; side < 2; ++side) {
            const Path& path = pair.paths.at(side);
            const bool isLeft = (glm::dot(apart, left) > 0.0F) == (side == 0);
            const std::size_t first = isLeft ? leftUpper : rightUpper;
            for (std::size_t i = 0; i < 3; ++i) {
                set(first + i, path[pair.upper + i]);
            }
            const bool isLeg = leftUpper == LeftUpperLeg;
            if (isLeg && pair.upper + 3 < path.size() && m_bones[path[pair.upper + 3]].hasWeights) {
                set(first + 3, path[pair.upper + 3]);
            }
            if (!isLeg && pair.upper > 0) {
                set(first - 1, path[pair.upper - 1]);
            }
        }
    }

    /// Neck and head, or the head alone: up from where the arms begin, as far as the bone that several hang
    /// on.
    Path headFrom(const LimbPair& arms) const {
        Path best;
        for (const std::size_t child : m_children[arms.from]) {
            const Path path = furthest(child).first;
            const bool isArm = path == arms.paths[0] || path == arms.paths[1];
            const bool isHigher = height(path.back()) > height(best.empty() ? arms.from : best.back());
            best = !isArm && isHigher ? path : best;
        }
        std::size_t end = best.size();
        while (end > 1 && !m_bones[best[end - 1]].hasWeights) {
            --end;
        }
        best.resize(end);
        for (std::size_t i = 1; i + 1 < best.size(); ++i) {
            if (m_children[best[i]].size() > 1) {
                best.resize(i + 1);
            }
        }
        return best;
    }

    glm::vec3 leftOf(const LimbPair& legs) const {
        glm::vec3 ahead(0.0F);
        for (const Path& path : legs.paths) {
            const glm::vec3& hip = at(path[legs.upper]);
            const glm::vec3& knee = at(path[legs.upper + 1]);
            const glm::vec3& foot = at(path[legs.upper + 2]);
            ahead +=
                legs.upper + 3 < path.size() ? at(path[legs.upper + 3]) - foot : knee - 0.5F * (hip + foot);
        }
        ahead -= glm::dot(ahead, m_up) * m_up;
        const glm::vec3 across = glm::cross(m_up, m_side);
        const float along = glm::dot(ahead, across);
        // Files of glTF look along what is −Y here.
        const bool isKnown = std::abs(along) > 0.005F * m_height;
        return glm::cross(m_up, isKnown ? along * across : glm::vec3(0.0F, -1.0F, 0.0F));
    }

    std::span<const ImportedBone> m_bones;
    std::vector<Path> m_children;
    glm::vec3 m_up{0.0F};
    glm::vec3 m_side{0.0F};
    float m_height = 0.0F;
    BoneMapping m_mapping;
};

} // namespace

BoneMapping mapBonesByShape(std::span<const ImportedBone> bones) {
    return Shape(bones).run();
}

} // namespace posewire::render
