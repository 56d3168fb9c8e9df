// SPDX-License-Identifier: MIT
#include "render/mesh/linear_body.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace posewire::render {
namespace {

constexpr std::size_t twistOf(Segment segment) {
    std::size_t i = 0;
    while (kTwistJoints[i].segment != segment) {
        ++i;
    }
    return kSegmentCount + i;
}

constexpr std::size_t halfOf(Segment segment) {
    std::size_t i = 0;
    while (kHalfJoints[i] != segment) {
        ++i;
    }
    return kFirstHalfJoint + i;
}

/// Joints of the palette between which vertices blend over large angles, with `count` joints more in even
/// steps between them.
struct Bend {
    std::size_t from;
    std::size_t to;
    std::size_t count;
    const char* word;
};

void addLimbs(bool isLeft, std::vector<Bend>& bends) {
    const auto of = [isLeft](Segment right, Segment left) { return isLeft ? left : right; };
    const Segment shoulder = of(RightShoulder, LeftShoulder);
    const Segment upperArm = of(RightUpperArm, LeftUpperArm);
    const Segment foreArm = of(RightForeArm, LeftForeArm);
    const Segment upperLeg = of(RightUpperLeg, LeftUpperLeg);
    const Segment lowerLeg = of(RightLowerLeg, LeftLowerLeg);
    // So many that no step is above a sixth of half a turn at the ends of human motion.
    bends.push_back({upperArm, twistOf(foreArm), 3, "bend"});
    bends.push_back({twistOf(foreArm), foreArm, 3, "turn"});
    bends.push_back({foreArm, of(RightHand, LeftHand), 2, "bend"});
    bends.push_back({twistOf(upperArm), upperArm, 2, "turn"});
    bends.push_back({shoulder, halfOf(upperArm), 1, "swing in"});
    bends.push_back({halfOf(upperArm), twistOf(upperArm), 1, "swing out"});
    bends.push_back({upperLeg, lowerLeg, 3, "bend"});
    bends.push_back({lowerLeg, of(RightFoot, LeftFoot), 1, "bend"});
    bends.push_back({twistOf(upperLeg), upperLeg, 1, "turn"});
    bends.push_back({Pelvis, halfOf(upperLeg), 1, "swing in"});
    bends.push_back({halfOf(upperLeg), twistOf(upperLeg), 1, "swing out"});
}

const std::vector<Bend>& allBends() {
    static const std::vector<Bend> kBends = [] {
        std::vector<Bend> bends{{Neck, Head, 1, "bend"},
                                {halfOf(RightUpperLeg), halfOf(LeftUpperLeg), 1, "swing across"}};
        addLimbs(false, bends);
        addLimbs(true, bends);
        for (std::size_t joint = kFirstFingerJoint; joint < kJointCount; ++joint) {
            const int parent = jointParent(joint);
            if (parent > static_cast<int>(kFirstFingerJoint) &&
                kJointNames[joint].find("MC") == kJointNames[joint].npos) {
                bends.push_back({static_cast<std::size_t>(parent), joint, 1, "bend"});
            }
        }
        return bends;
    }();
    return kBends;
}

bool isHelper(std::size_t joint) {
    return joint >= kSegmentCount && joint < kFirstFingerJoint;
}

bool isHalf(std::size_t joint) {
    return joint >= kFirstHalfJoint && joint < kFirstFingerJoint;
}

bool isArmsHalf(std::size_t joint) {
    return isHalf(joint) && (jointSegment(joint) == RightUpperArm || jointSegment(joint) == LeftUpperArm);
}

/// Joints of a bend turn about a place of their own if not all of it turns about the place of `to`.
bool isShifted(const Bend& bend) {
    return isArmsHalf(bend.from) || isArmsHalf(bend.to) || (isHalf(bend.from) && isHalf(bend.to));
}

std::size_t carrierOf(std::size_t joint) {
    return isHelper(joint) ? static_cast<std::size_t>(jointSegment(joint)) : joint;
}

/// Those of the palette, then those of all bends.
std::vector<LinearJoint> allJoints(const BodyFit& fit) {
    const auto originOf = [&fit](std::size_t joint) {
        return joint < kFirstFingerJoint ? fit.origins[jointSegment(joint)]
                                         : fit.fingerOrigins[joint - kFirstFingerJoint];
    };
    std::vector<LinearJoint> joints;
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
        const std::size_t carrier = carrierOf(joint);
        std::string name(kJointNames[carrier]);
        if (isHelper(joint)) {
            name += joint < kFirstHalfJoint ? " twist" : " swing";
        }
        joints.push_back({std::move(name), carrier, carrier == joint, isArmsHalf(joint), originOf(joint),
                          joint, joint, 0.0F});
    }
    for (const Bend& bend : allBends()) {
        for (std::size_t step = 1; step <= bend.count; ++step) {
            const std::size_t carrier = carrierOf(bend.to);
            std::string name = std::string(kJointNames[carrier]) + ' ' + bend.word;
            if (bend.count > 1) {
                name += ' ' + std::to_string(step);
            }
            joints.push_back({std::move(name), carrier, false, isShifted(bend), originOf(bend.to), bend.from,
                              bend.to, static_cast<float>(step) / static_cast<float>(bend.count + 1)});
        }
    }
    return joints;
}

struct Influence {
    std::size_t joint = 0;
    float weight = 0.0F;
};
using Influences = std::array<Influence, 4>; // those that are not needed weigh nothing

void add(std::size_t joint, float weight, Influences& all) {
    for (Influence& one : all) {
        if (one.weight <= 0.0F || one.joint == joint) {
            one = {joint, std::max(one.weight, 0.0F) + weight};
            return;
        }
    }
}

Influence* find(std::size_t joint, Influences& all) {
    const auto found = std::find_if(all.begin(), all.end(), [joint](const Influence& one) {
        return one.weight > 0.0F && one.joint == joint;
    });
    return found != all.end() ? &*found : nullptr;
}

/// Gives what moves a vertex between the ends of a bend to the two joints of it that are next to the same
/// blend. True if there was a bend; the greatest first.
bool spread(Influences& all) {
    constexpr float kLeast = 0.002F;
    const Bend* greatest = nullptr;
    std::size_t firstStep = 0;
    float most = kLeast;
    std::size_t next = kJointCount;
    for (const Bend& bend : allBends()) {
        const Influence* from = find(bend.from, all);
        const Influence* to = find(bend.to, all);
        if (from != nullptr && to != nullptr && std::min(from->weight, to->weight) > most) {
            most = std::min(from->weight, to->weight);
            greatest = &bend;
            firstStep = next;
        }
        next += bend.count;
    }
    if (greatest == nullptr) {
        return false;
    }
    Influence& from = *find(greatest->from, all);
    Influence& to = *find(greatest->to, all);
    const float sum = from.weight + to.weight;
    const float at = to.weight / sum * static_cast<float>(greatest->count + 1);
    const std::size_t step = std::min(static_cast<std::size_t>(at), greatest->count);
    const float beyond = at - static_cast<float>(step);
    from = {step == 0 ? greatest->from : firstStep + step - 1, sum * (1.0F - beyond)};
    to = {step == greatest->count ? greatest->to : firstStep + step, sum * beyond};
    return true;
}

/// The pelvis and the swing of a leg blend to half of the swing, for which there is a joint.
void meetAtHips(Influences& all) {
    for (const Segment leg : {RightUpperLeg, LeftUpperLeg}) {
        Influence* pelvis = find(Pelvis, all);
        Influence* swing = find(twistOf(leg), all);
        Influence* half = find(halfOf(leg), all);
        if (pelvis != nullptr && swing != nullptr && half != nullptr) {
            const float common = std::min(pelvis->weight, swing->weight);
            pelvis->weight -= common;
            swing->weight -= common;
            half->weight += 2.0F * common;
        }
    }
}

/// The mannequin on the body, with hands at rest where no fingers are sent.
SkinnedMesh restedMesh(const SkinnedMesh& mannequin, const BodyFit& fit, bool hasLeft, bool hasRight) {
    SkinnedMesh mesh = fitted(mannequin, fit);
    const std::array<glm::quat, kSegmentCount> turns = [] {
        std::array<glm::quat, kSegmentCount> all;
        all.fill(glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
        return all;
    }();
    const std::span fingers(fit.fingerOrigins);
    const std::span straight = std::span(turns).first(kHandSegmentCount);
    std::array<DualQuaternion, kJointCount> palette;
    PaletteJob{fit.origins,
               turns,
               fit.origins,
               palette,
               hasLeft ? FingerPose{fingers.first(kHandSegmentCount), straight} : FingerPose{},
               hasRight ? FingerPose{fingers.last(kHandSegmentCount), straight} : FingerPose{},
               fingers}
        .run();
    std::vector<glm::vec3> positions(mesh.vertexCount());
    std::vector<glm::vec3> normals(mesh.vertexCount());
    SkinJob{&mesh, palette, positions, normals}.run();
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const bool moves =
            std::ranges::any_of(mesh.joints[i], [](std::size_t joint) { return joint >= kFirstFingerJoint; });
        if (moves) {
            mesh.positions[i] = positions[i];
            mesh.normals[i] = normals[i];
        }
    }
    return mesh;
}

Influences influencesOf(const JointIndices& joints, const glm::vec4& weights, bool hasLeft, bool hasRight) {
    Influences all{};
    for (std::size_t k = 0; k < joints.size(); ++k) {
        const std::size_t joint = joints[k];
        const float weight = weights[static_cast<int>(k)];
        if (weight > 0.0F) {
            const bool isFinger = joint >= kFirstFingerJoint;
            const bool isSent = jointSegment(joint) == LeftHand ? hasLeft : hasRight;
            add(isFinger && !isSent ? static_cast<std::size_t>(jointSegment(joint)) : joint, weight, all);
        }
    }
    meetAtHips(all);
    while (spread(all)) {
    }
    std::ranges::sort(all, [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
    return all;
}

} // namespace

LinearBody linearBody(const SkinnedMesh& mannequin, const BodyFit& fit, bool hasLeftFingers,
                      bool hasRightFingers) {
    LinearBody body{restedMesh(mannequin, fit, hasLeftFingers, hasRightFingers), {}};
    const std::vector<LinearJoint> all = allJoints(fit);
    std::vector<std::optional<std::size_t>> placeOfJoint(all.size());
    const auto place = [&](std::size_t joint) {
        if (!placeOfJoint[joint]) {
            placeOfJoint[joint] = body.joints.size();
            body.joints.push_back(all[joint]);
        }
        return static_cast<std::uint8_t>(*placeOfJoint[joint]);
    };
    for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
        static_cast<void>(place(segment));
    }
    for (std::size_t i = 0; i < body.mesh.vertexCount(); ++i) {
        const Influences influences =
            influencesOf(body.mesh.joints[i], body.mesh.weights[i], hasLeftFingers, hasRightFingers);
        float sum = 0.0F;
        for (const Influence& one : influences) {
            sum += one.weight;
        }
        for (std::size_t k = 0; k < influences.size(); ++k) {
            const bool moves = influences[k].weight > 0.0F;
            body.mesh.joints[i][k] = moves ? place(influences[k].joint) : std::uint8_t{0};
            body.mesh.weights[i][static_cast<int>(k)] = moves ? influences[k].weight / sum : 0.0F;
        }
    }
    return body;
}

LinearPlace placeOf(const LinearJoint& joint, std::span<const DualQuaternion> palette) {
    const DualQuaternion& from = palette[joint.from];
    const DualQuaternion& to = palette[joint.to];
    const float toShare = glm::dot(from.real, to.real) < 0.0F ? -joint.share : joint.share;
    DualQuaternion motion{(1.0F - joint.share) * from.real + toShare * to.real,
                          (1.0F - joint.share) * from.dual + toShare * to.dual};
    const float length = glm::length(motion.real);
    motion = {motion.real / length, motion.dual / length};
    return {transformPoint(motion, joint.origin),
            glm::quat(motion.real.w, motion.real.x, motion.real.y, motion.real.z)};
}

} // namespace posewire::render
