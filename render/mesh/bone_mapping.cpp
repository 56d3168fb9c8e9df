// SPDX-License-Identifier: MIT
#include "render/mesh/bone_mapping.h"

#include "render/mesh/bone_shape.h"
#include "render/mesh/bone_words.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace posewire::render {
namespace {

/// What names are about beside the mappable segments: the bones of a trunk, from below.
constexpr std::size_t kFirstOfSpine = kMappableCount;

/// A name for a segment, as the naming writes it.
struct Alias {
    std::size_t place = 0;
    std::string name;
};

bool isRequired(std::size_t mappable) {
    constexpr std::array kRequired{Pelvis,       Head,          LeftUpperArm,  LeftForeArm,   LeftHand,
                                   LeftUpperLeg, LeftLowerLeg,  LeftFoot,      RightUpperArm, RightForeArm,
                                   RightHand,    RightUpperLeg, RightLowerLeg, RightFoot};
    return std::ranges::find(kRequired, mappable) != kRequired.end();
}

/// Letters and digits alone, in lower case: "mixamorig:LeftArm" is "mixamorigleftarm".
std::string plain(std::string_view name) {
    std::string letters;
    for (const char letter : name) {
        const auto c = static_cast<unsigned char>(letter);
        letters += std::isalnum(c) == 0 ? std::string() : std::string{static_cast<char>(std::tolower(c))};
    }
    return letters;
}

std::string filled(std::string_view pattern, std::string_view side, std::string_view finger, char number) {
    std::string name;
    for (const char letter : pattern) {
        name += letter == '$'   ? std::string(side)
                : letter == '%' ? std::string(finger)
                                : std::string{letter == '#' ? number : letter};
    }
    return name;
}

/// All names of a naming, those that count first before others of the same segment.
class Aliases {
public:
    explicit Aliases(const BoneNaming& naming) {
        add(Pelvis, naming.pelvis);
        add(Neck, naming.neck);
        add(Head, naming.head);
        for (std::size_t i = 0; i < naming.spine.size(); ++i) {
            add(kFirstOfSpine + i, naming.spine[i]);
        }
        addSide(naming, naming.left, LeftShoulder, LeftUpperLeg, kSegmentCount);
        addSide(naming, naming.right, RightShoulder, RightUpperLeg, kSegmentCount + kHandSegmentCount);
    }
    const std::vector<Alias>& all() const { return m_all; }

private:
    void addSide(const BoneNaming& naming, std::string_view side, std::size_t arm, std::size_t leg,
                 std::size_t hand) {
        for (std::size_t i = 0; i < naming.limbs.size(); ++i) {
            add(i < 4 ? arm + i : leg + i - 4, naming.limbs[i], side);
        }
        add(hand, naming.carpus, side);
        for (std::size_t i = 0; i < naming.thumb.size(); ++i) {
            add(hand + 1 + i, naming.thumb[i], side);
        }
        for (std::size_t finger = 0; finger < naming.fingers.size(); ++finger) {
            for (std::size_t i = 0; i < naming.phalanges.size(); ++i) {
                add(hand + 4 * (finger + 1) + i, naming.phalanges[i], side, naming.fingers[finger],
                    static_cast<char>('1' + finger));
            }
        }
    }

    void add(std::size_t place, std::string_view patterns, std::string_view side = {},
             std::string_view finger = {}, char number = '0') {
        while (!patterns.empty()) {
            const std::size_t end = std::min(patterns.find('|'), patterns.size());
            m_all.push_back({place, filled(patterns.substr(0, end), side, finger, number)});
            patterns.remove_prefix(std::min(end + 1, patterns.size()));
        }
    }

    std::vector<Alias> m_all;
};

/// Bones by place, as one naming finds them behind one prefix.
using Found = std::map<std::size_t, std::size_t>;

std::map<std::string, Found> findBones(const BoneNaming& naming, std::span<const ImportedBone> bones) {
    std::map<std::string, Found> byPrefix;
    std::vector<std::string> names;
    for (const ImportedBone& bone : bones) {
        names.push_back(plain(bone.name));
    }
    const Aliases aliases(naming);
    for (const Alias& alias : aliases.all()) {
        const std::string end = plain(alias.name);
        for (std::size_t i = 0; i < bones.size(); ++i) {
            if (!names[i].ends_with(end)) {
                continue;
            }
            Found& found = byPrefix[names[i].substr(0, names[i].size() - end.size())];
            const auto [entry, isNew] = found.try_emplace(alias.place, i);
            const std::size_t before = entry->second;
            // Rigs have handles of the same name as the bone that moves vertices.
            if (!isNew && names[before] == names[i] && bones[i].hasWeights && !bones[before].hasWeights) {
                entry->second = i;
            }
        }
    }
    return byPrefix;
}

/// The last of the spine carries the shoulders, as T8 does; the others are at even distances below it.
void spread(const std::vector<int>& spine, BoneMapping& mapping) {
    constexpr std::array kSegments{L5, L3, T12, T8};
    std::array<double, kSegments.size()> nearest{};
    nearest.fill(1.0);
    for (std::size_t i = 0; i < spine.size(); ++i) {
        const double place =
            static_cast<double>(i + 1) / static_cast<double>(spine.size()) * kSegments.size() - 1.0;
        const auto segment = static_cast<std::size_t>(
            std::clamp(place + 0.5, 0.0, static_cast<double>(kSegments.size()) - 1.0));
        const double away = std::abs(place - static_cast<double>(segment));
        if (i + 1 == spine.size() || away < nearest[segment]) {
            nearest[segment] = i + 1 == spine.size() ? -1.0 : away;
            mapping.bones[kSegments[segment]] = spine[i];
        }
    }
}

BoneMapping mappingOf(const BoneNaming& naming, const Found& found) {
    BoneMapping mapping;
    mapping.naming = &naming;
    std::set<std::size_t> used;
    std::vector<int> spine;
    for (const auto& [place, bone] : found) {
        if (!used.insert(bone).second) {
            continue;
        }
        if (place >= kFirstOfSpine) {
            spine.push_back(static_cast<int>(bone));
        } else {
            mapping.bones[place] = static_cast<int>(bone);
        }
    }
    spread(spine, mapping);
    return mapping;
}

/// "Left Hand (LeftHand)", by a naming; without that the segment alone.
std::string missingText(std::size_t segment, const BoneNaming* naming) {
    std::string text = mappableTitle(segment);
    if (naming != nullptr) {
        const std::vector<Alias> all = Aliases(*naming).all();
        text += " (" + std::ranges::find(all, segment, &Alias::place)->name + ")";
    }
    return text;
}

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

std::string knownNamings() {
    std::string text;
    for (const BoneNaming& naming : kBoneNamings) {
        const bool isLast = &naming == &kBoneNamings.back();
        text += (text.empty() ? "" : isLast ? " or " : ", ") + std::string(naming.title);
    }
    return text;
}

namespace {

BoneMapping mapByNaming(std::span<const ImportedBone> bones) {
    BoneMapping best;
    auto most = std::tuple<std::ptrdiff_t, std::ptrdiff_t, std::size_t>(0, 0, 0);
    for (const BoneNaming& naming : kBoneNamings) {
        for (const auto& [prefix, found] : findBones(naming, bones)) {
            const std::tuple score{
                std::ranges::count_if(found, [](const auto& one) { return isRequired(one.first); }),
                std::ranges::count_if(found, [&](const auto& one) { return bones[one.second].hasWeights; }),
                found.size()};
            if (score > most) {
                most = score;
                best = mappingOf(naming, found);
            }
        }
    }
    // A few names that many programs share say nothing about the rest.
    const bool isKnown = 2 * missingSegments(best).size() <= missingSegments({}).size();
    return isKnown ? best : BoneMapping();
}

bool isFit(const BoneMapping& mapping, std::span<const ImportedBone> bones) {
    return checkMapping(mapping, bones).has_value();
}

/// Takes what one has and the other lacks, unless a bone would be taken twice.
BoneMapping joined(BoneMapping mapping, const BoneMapping& guess, FoundBy by) {
    for (std::size_t i = 0; i < kMappableCount; ++i) {
        const int bone = guess.bones[i];
        if (mapping.bones[i] < 0 && bone >= 0 &&
            std::ranges::find(mapping.bones, bone) == mapping.bones.end()) {
            mapping.bones[i] = bone;
            mapping.foundBy[i] = by;
        }
    }
    return mapping;
}

BoneMapping mirrored(const BoneMapping& mapping) {
    BoneMapping swapped = mapping;
    for (std::size_t i = 0; i < 4; ++i) {
        std::swap(swapped.bones[RightShoulder + i], swapped.bones[LeftShoulder + i]);
        std::swap(swapped.bones[RightUpperLeg + i], swapped.bones[LeftUpperLeg + i]);
    }
    return swapped;
}

std::vector<int> ancestry(int bone, std::span<const ImportedBone> bones) {
    std::vector<int> path;
    for (; bone >= 0; bone = bones[static_cast<std::size_t>(bone)].parent) {
        path.push_back(bone);
    }
    return path;
}

/// The nearest bone that both hang on or are, or -1.
int joining(int a, int b, std::span<const ImportedBone> bones) {
    const std::vector<int> above = ancestry(a, bones);
    for (const int bone : ancestry(b, bones)) {
        if (std::ranges::find(above, bone) != above.end()) {
            return bone;
        }
    }
    return -1;
}

/// Pelvis and spine by what hangs on them: legs on the one, arms on the other.
void mapTrunk(std::span<const ImportedBone> bones, FoundBy by, BoneMapping& mapping) {
    int& pelvis = mapping.bones[Pelvis];
    const int legs = joining(mapping.bones[LeftUpperLeg], mapping.bones[RightUpperLeg], bones);
    if (pelvis < 0 && legs >= 0) {
        pelvis = legs;
        mapping.foundBy[Pelvis] = by;
    }
    const int chest = joining(mapping.bones[LeftUpperArm], mapping.bones[RightUpperArm], bones);
    const std::vector<int> below = ancestry(pelvis, bones);
    std::vector<int> spine;
    for (const int bone : ancestry(chest, bones)) {
        if (std::ranges::find(below, bone) != below.end()) {
            break;
        }
        if (std::ranges::find(mapping.bones, bone) == mapping.bones.end()) {
            spine.insert(spine.begin(), bone);
        }
    }
    BoneMapping trunk;
    spread(spine, trunk);
    const bool hasSpine = mapping.bones[T8] >= 0;
    mapping = hasSpine ? mapping : joined(mapping, trunk, by);
}

} // namespace

BoneMapping mapBones(std::span<const ImportedBone> bones) {
    const BoneMapping named = mapByNaming(bones);
    if (isFit(named, bones)) {
        return named;
    }
    const BoneMapping words = mapBonesByWords(bones);
    const BoneMapping shape = mapBonesByShape(bones);
    BoneMapping best;
    for (const auto& [start, spoken] : {std::pair(named, words), {{}, words}, {{}, {}}}) {
        BoneMapping whole = joined(start, spoken, FoundBy::Word);
        mapTrunk(bones, FoundBy::Word, whole);
        if (isFit(whole, bones)) {
            return whole;
        }
        best = missingSegments(whole).size() < missingSegments(best).size() ? whole : best;
        for (const BoneMapping& guess : {shape, mirrored(shape)}) {
            BoneMapping filled = joined(whole, guess, FoundBy::Shape);
            mapTrunk(bones, FoundBy::Shape, filled);
            if (isFit(filled, bones)) {
                return filled;
            }
        }
    }
    // A few words that many things share say nothing about the rest.
    return 2 * missingSegments(best).size() <= missingSegments({}).size() ? best : BoneMapping();
}

std::vector<BoneCorrection> correct(BoneMapping& mapping, std::span<const ImportedBone> bones,
                                    std::span<const BoneCorrection> corrections) {
    std::vector<BoneCorrection> unfit;
    for (const BoneCorrection& correction : corrections) {
        const auto found = std::ranges::find(bones, correction.bone, &ImportedBone::name);
        if (found == bones.end() && !correction.bone.empty()) {
            unfit.push_back(correction);
            continue;
        }
        const int bone = found == bones.end() ? -1 : static_cast<int>(found - bones.begin());
        std::ranges::replace_if(
            mapping.bones, [&](int taken) { return bone >= 0 && taken == bone; }, -1);
        mapping.bones.at(correction.mappable) = bone;
        mapping.foundBy.at(correction.mappable) = FoundBy::Operator;
    }
    return unfit;
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
        missing += (missing.empty() ? "" : ", ") + missingText(segment, mapping.naming);
    }
    if (!missing.empty()) {
        return tl::make_unexpected("no bone for " + missing +
                                   (mapping.naming == nullptr
                                        ? "; known are the bone names of " + knownNamings()
                                        : ", as " + std::string(mapping.naming->title) + " names them"));
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
