// SPDX-License-Identifier: MIT
#include "render/mesh/bone_mapping.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <set>

namespace posewire::render {
namespace {

using Side = BoneName::Side;
using Keys = std::span<const std::string_view>;

constexpr std::array kLeft{LeftShoulder, LeftUpperArm, LeftForeArm, LeftHand,
                           LeftUpperLeg, LeftLowerLeg, LeftFoot,    LeftToe};
constexpr std::array kRight{RightShoulder, RightUpperArm, RightForeArm, RightHand,
                            RightUpperLeg, RightLowerLeg, RightFoot,    RightToe};
constexpr std::array kSpine{L5, L3, T12, T8};

/// The first that there is counts. "Leg" is the lower one with Mixamo, the upper one elsewhere.
Keys keysOf(Segment left) {
    static constexpr auto kShoulder =
        std::to_array<std::string_view>({"shoulder", "clavicle", "collar", "collarbone", "clav"});
    static constexpr auto kUpperArm = std::to_array<std::string_view>({"upperarm", "uparm", "arm"});
    static constexpr auto kForeArm =
        std::to_array<std::string_view>({"forearm", "lowerarm", "lowarm", "elbow"});
    static constexpr auto kHand = std::to_array<std::string_view>({"hand", "wrist"});
    static constexpr auto kUpperLeg = std::to_array<std::string_view>({"upperleg", "upleg", "thigh", "hip"});
    static constexpr auto kLowerLeg =
        std::to_array<std::string_view>({"lowerleg", "lowleg", "calf", "shin", "knee", "leg"});
    static constexpr auto kFoot = std::to_array<std::string_view>({"foot", "ankle"});
    static constexpr auto kToe = std::to_array<std::string_view>({"toe", "toes", "toebase", "ball", "toe0"});
    switch (left) {
    case LeftShoulder:
        return kShoulder;
    case LeftUpperArm:
        return kUpperArm;
    case LeftForeArm:
        return kForeArm;
    case LeftHand:
        return kHand;
    case LeftUpperLeg:
        return kUpperLeg;
    case LeftLowerLeg:
        return kLowerLeg;
    case LeftFoot:
        return kFoot;
    default:
        return kToe;
    }
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

BoneNaming namingOf(std::span<const ImportedBone> bones) {
    std::set<std::string> names;
    for (const ImportedBone& bone : bones) {
        names.insert(lower(bone.name));
    }
    const auto has = [&names](std::string_view part) {
        return std::ranges::any_of(names,
                                   [part](const std::string& name) { return name.find(part) != name.npos; });
    };
    if (has("mixamorig") || (has("leftupleg") && has("lefttoebase"))) {
        return BoneNaming::Mixamo;
    }
    if (has("j_bip_") || (has("leftupperarm") && has("leftlowerarm"))) {
        return BoneNaming::Humanoid;
    }
    if (has("upperarm_l") && has("calf_l")) {
        return BoneNaming::Unreal;
    }
    if (has("upper_arm.l") || has("upper_arm_l")) {
        return BoneNaming::Rigify;
    }
    if (has("bip01") || has("bip001")) {
        return BoneNaming::Biped;
    }
    return has("t12") && has("leftforearm") ? BoneNaming::Mvn : BoneNaming::Unknown;
}

class Search {
public:
    explicit Search(std::span<const ImportedBone> bones) : m_bones(bones) {
        for (const ImportedBone& bone : bones) {
            m_names.push_back(readBoneName(bone.name));
        }
        m_mapping.naming = namingOf(bones);
    }

    BoneMapping run() {
        at(Pelvis) = find(std::to_array<std::string_view>({"pelvis", "hips"}), Side::None);
        at(Head) = find(std::to_array<std::string_view>({"head"}), Side::None);
        at(Neck) = find(std::to_array<std::string_view>({"neck", "neck1"}), Side::None);
        for (std::size_t i = 0; i < kLeft.size(); ++i) {
            at(kLeft[i]) = find(keysOf(kLeft[i]), Side::Left);
            at(kRight[i]) = find(keysOf(kLeft[i]), Side::Right);
        }
        useLegForUpperLeg(Side::Left);
        useLegForUpperLeg(Side::Right);
        nameRigifySpine();
        if (at(Pelvis) < 0) {
            at(Pelvis) = meeting({at(LeftUpperLeg), at(RightUpperLeg), at(Head)});
        }
        findSpine();
        findFingers();
        return m_mapping;
    }

private:
    int& at(std::size_t segment) { return m_mapping.bones[segment]; }
    int parentOf(int bone) const { return bone < 0 ? -1 : m_bones[static_cast<std::size_t>(bone)].parent; }
    const BoneName& nameOf(int bone) const { return m_names[static_cast<std::size_t>(bone)]; }

    /// Rather one that vertices follow: rigs have handles of the same name.
    int find(Keys keys, Side side) const {
        for (const std::string_view key : keys) {
            int found = -1;
            for (std::size_t i = 0; i < m_bones.size(); ++i) {
                if (m_names[i].key != key || m_names[i].side != side || m_names[i].isExtra) {
                    continue;
                }
                if (found < 0 ||
                    (m_bones[i].hasWeights && !m_bones[static_cast<std::size_t>(found)].hasWeights)) {
                    found = static_cast<int>(i);
                }
            }
            if (found >= 0) {
                return found;
            }
        }
        return -1;
    }

    bool hangsOn(int bone, int ancestor) const {
        while (bone >= 0 && bone != ancestor) {
            bone = parentOf(bone);
        }
        return bone >= 0 && ancestor >= 0;
    }

    /// The closest bone that all of them hang on.
    int meeting(std::initializer_list<int> bones) const {
        int place = *bones.begin();
        while (place >= 0 && !std::ranges::all_of(bones, [&](int bone) { return hangsOn(bone, place); })) {
            place = parentOf(place);
        }
        return place;
    }

    void useLegForUpperLeg(Side side) {
        const Segment upper = side == Side::Left ? LeftUpperLeg : RightUpperLeg;
        const int leg = find(std::to_array<std::string_view>({"leg"}), side);
        if (at(upper) < 0 && leg >= 0 && hangsOn(at(upper + 1), leg) && at(upper + 1) != leg) {
            at(upper) = leg;
        }
    }

    /// Blender's Rigify calls everything from pelvis to head a spine.
    void nameRigifySpine() {
        const int first = find(std::to_array<std::string_view>({"spine"}), Side::None);
        const int last = find(std::to_array<std::string_view>({"spine6"}), Side::None);
        if (at(Pelvis) >= 0 || at(Head) >= 0 || first < 0 || last < 0) {
            return;
        }
        at(Pelvis) = first;
        at(Head) = last;
        at(Neck) = find(std::to_array<std::string_view>({"spine4"}), Side::None);
    }

    /// From the pelvis up to the neck, by what hangs on what, since spines are named in many ways.
    std::vector<int> spineBones() const {
        const int top = m_mapping.bones[Neck] >= 0 ? m_mapping.bones[Neck] : m_mapping.bones[Head];
        const int pelvis = m_mapping.bones[Pelvis];
        std::vector<int> spine;
        if (pelvis < 0 || !hangsOn(top, meeting({pelvis, top}))) {
            return spine;
        }
        // Where the trunk hangs beside the pelvis, on what both hang on, it ends there.
        const int stop = meeting({pelvis, top});
        for (int bone = parentOf(top); bone >= 0 && bone != stop; bone = parentOf(bone)) {
            if (!nameOf(bone).key.starts_with("neck")) {
                spine.insert(spine.begin(), bone);
            }
        }
        return spine;
    }

    void findSpine() {
        const std::vector<int> spine = spineBones();
        const auto count = static_cast<double>(spine.size());
        std::array<double, kSpine.size()> nearest{};
        nearest.fill(1.0);
        for (std::size_t i = 0; i < spine.size(); ++i) {
            // The last carries the shoulders, as T8 does; the others at even distances below it.
            const double place = static_cast<double>(i + 1) / count * kSpine.size() - 1.0;
            const auto segment = static_cast<std::size_t>(
                std::clamp(place + 0.5, 0.0, static_cast<double>(kSpine.size()) - 1.0));
            const double away = std::abs(place - static_cast<double>(segment));
            if (i + 1 == spine.size() || away < nearest[segment]) {
                nearest[segment] = i + 1 == spine.size() ? -1.0 : away;
                at(kSpine[segment]) = spine[i];
            }
        }
    }

    void findFingers() {
        for (std::size_t i = 0; i < m_bones.size(); ++i) {
            const BoneName& name = m_names[i];
            const Segment hand = name.side == Side::Left ? LeftHand : RightHand;
            if (name.isExtra || !hangsOn(static_cast<int>(i), at(hand))) {
                continue;
            }
            const std::size_t first = kSegmentCount + (hand == LeftHand ? 0U : kHandSegmentCount);
            if (name.key == "carpus") {
                at(first) = static_cast<int>(i);
            } else if (name.finger >= 0 && name.phalanx >= 0) {
                const auto finger = static_cast<std::size_t>(name.finger);
                auto phalanx = static_cast<std::size_t>(name.phalanx);
                phalanx -= finger == 0 && phalanx == 1 && isFirstOfThumb(static_cast<int>(i)) ? 1U : 0U;
                const std::size_t place = first + (finger == 0 ? 1U : 4U * finger) + phalanx;
                at(place) = at(place) < 0 ? static_cast<int>(i) : at(place);
            }
        }
    }

    /// "Proximal" without a metacarpal above it is the thumb's first bone.
    bool isFirstOfThumb(int bone) const {
        const int parent = parentOf(bone);
        return parent < 0 || nameOf(parent).finger != 0;
    }

    std::span<const ImportedBone> m_bones;
    std::vector<BoneName> m_names;
    BoneMapping m_mapping;
};

} // namespace

std::string mappableTitle(std::size_t mappable) {
    std::string title;
    for (const char letter : mappableName(mappable)) {
        const bool beginsWord = letter >= 'A' && letter <= 'Z' && !title.empty() && title.back() >= 'a';
        title += beginsWord ? std::string{' ', letter} : std::string{letter};
    }
    constexpr std::string_view kForeArm = "Fore Arm"; // one word in the specification
    if (const std::size_t at = title.find(kForeArm); at != std::string::npos) {
        title.replace(at, kForeArm.size(), "Forearm");
    }
    return title;
}

bool isRequired(std::size_t mappable) {
    constexpr std::array kRequired{Pelvis,       Head,          LeftUpperArm,  LeftForeArm,   LeftHand,
                                   LeftUpperLeg, LeftLowerLeg,  LeftFoot,      RightUpperArm, RightForeArm,
                                   RightHand,    RightUpperLeg, RightLowerLeg, RightFoot};
    return std::ranges::find(kRequired, mappable) != kRequired.end();
}

std::string_view titleOf(BoneNaming naming) {
    constexpr std::array<std::string_view, 7> kTitles{
        "unknown", "MVN", "Mixamo", "Unreal", "VRM or Unity humanoid", "Blender Rigify", "3ds Max Biped"};
    return kTitles[static_cast<std::size_t>(naming)];
}

BoneMapping mapBones(std::span<const ImportedBone> bones) {
    return Search(bones).run();
}

std::vector<std::size_t> missingSegments(const BoneMapping& mapping) {
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < kMappableCount; ++i) {
        if (isRequired(i) && mapping.bones[i] < 0) {
            missing.push_back(i);
        }
    }
    return missing;
}

tl::expected<void, std::string> checkMapping(const BoneMapping& mapping,
                                             std::span<const ImportedBone> bones) {
    std::string missing;
    for (const std::size_t segment : missingSegments(mapping)) {
        missing += (missing.empty() ? "" : ", ") + mappableTitle(segment);
    }
    if (!missing.empty()) {
        return tl::make_unexpected("no bone for " + missing);
    }
    std::set<int> used;
    for (std::size_t i = 0; i < kMappableCount; ++i) {
        const int bone = mapping.bones[i];
        if (bone >= static_cast<int>(bones.size())) {
            return tl::make_unexpected("the file has no such bone for " + mappableTitle(i));
        }
        if (bone >= 0 && !used.insert(bone).second) {
            return tl::make_unexpected("the bone of " + mappableTitle(i) + " has another segment, too");
        }
    }
    for (const Segment upper : {LeftUpperArm, RightUpperArm, LeftUpperLeg, RightUpperLeg}) {
        for (const std::size_t segment : {std::size_t{upper} + 1, std::size_t{upper} + 2}) {
            int bone = mapping.bones[segment];
            while (bone >= 0 && bone != mapping.bones[segment - 1]) {
                bone = bones[static_cast<std::size_t>(bone)].parent;
            }
            if (bone < 0) {
                return tl::make_unexpected("the bone of " + mappableTitle(segment) +
                                           " does not hang on that of " + mappableTitle(segment - 1));
            }
        }
    }
    return {};
}

} // namespace posewire::render
