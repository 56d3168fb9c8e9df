// SPDX-License-Identifier: MIT
#include "render/mesh/bone_words.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace posewire::render {
namespace {

enum class Side : std::uint8_t { None, Left, Right };

/// Right segments of arms and legs come four before their left ones, hands of the left side first.
constexpr std::size_t kLeftAfterRight = 4;
static_assert(LeftShoulder - RightShoulder == kLeftAfterRight && LeftToe - RightToe == kLeftAfterRight);

bool isListed(std::string_view word, std::string_view list) {
    return !word.empty() &&
           ('|' + std::string(list) + '|').find('|' + std::string(word) + '|') != std::string::npos;
}

bool isKnownWord(std::string_view word) {
    return std::ranges::any_of(kBoneWords, [&](const BoneWords& row) { return isListed(word, row.words); }) ||
           std::ranges::any_of(kFingerWords, [&](std::string_view words) { return isListed(word, words); });
}

/// "rig_LUpperArm1" is "rig", "l", "upper", "arm".
std::vector<std::string> split(std::string_view name) {
    std::vector<std::string> parts;
    char before = 0;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto is = [&](int (*kind)(int), std::size_t at) {
            return at < name.size() && kind(static_cast<unsigned char>(name[at])) != 0;
        };
        if (!is(std::isalpha, i)) {
            before = 0;
            continue;
        }
        const bool beginsWord =
            before == 0 || (is(std::isupper, i) && (std::islower(before) != 0 || is(std::islower, i + 1)));
        if (beginsWord) {
            parts.emplace_back();
        }
        before = name[i];
        parts.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(before)));
    }
    return parts;
}

/// Takes the side out of "left", "l", "lefthand", "lhand" or "handl".
Side takeSide(std::string& part) {
    constexpr std::array<std::tuple<std::string_view, Side, bool>, 8> kSides{{
        {"left", Side::Left, false},
        {"right", Side::Right, false},
        {"lft", Side::Left, true},
        {"rgt", Side::Right, true},
        {"lf", Side::Left, true},
        {"rt", Side::Right, true},
        {"l", Side::Left, true},
        {"r", Side::Right, true},
    }};
    for (const auto& [word, side, needsKnownRest] : kSides) {
        for (const bool isFirst : {true, false}) {
            if (isFirst ? !part.starts_with(word) : !part.ends_with(word)) {
                continue;
            }
            const std::string rest =
                isFirst ? part.substr(word.size()) : part.substr(0, part.size() - word.size());
            if (rest.empty() || !needsKnownRest || (!isKnownWord(part) && isKnownWord(rest))) {
                part = rest;
                return side;
            }
        }
    }
    return Side::None;
}

/// A bone by what its name says.
struct Spoken {
    std::string word; ///< one of the tables; empty for none
    Side side = Side::None;
    std::size_t others = 0; ///< parts of the name beside it
};

Spoken spokenOf(const std::vector<std::string>& parts, const std::set<std::string>& shared) {
    Spoken spoken;
    std::vector<std::string> rest;
    for (std::string part : parts) {
        if (shared.contains(part)) {
            continue;
        }
        if (isListed(part, kHelperWords)) {
            return {};
        }
        const Side side = takeSide(part);
        spoken.side = side == Side::None ? spoken.side : side;
        if (!part.empty()) {
            rest.push_back(part);
        }
    }
    for (std::size_t end = rest.size(); end > 0 && spoken.word.empty(); --end) {
        for (std::size_t first = 0; first < end && spoken.word.empty(); ++first) {
            std::string joined;
            for (std::size_t i = first; i < end; ++i) {
                joined += rest[i];
            }
            if (isKnownWord(joined)) {
                spoken.word = joined;
                spoken.others = rest.size() - (end - first);
            }
        }
    }
    return spoken;
}

/// Splits names into words, without those that nearly all names share.
std::vector<Spoken> spokenBy(std::span<const ImportedBone> bones) {
    std::vector<std::vector<std::string>> names;
    std::map<std::string, std::size_t> counts;
    for (const ImportedBone& bone : bones) {
        names.push_back(split(bone.name));
        for (const std::string& part : std::set<std::string>(names.back().begin(), names.back().end())) {
            ++counts[part];
        }
    }
    std::set<std::string> shared;
    for (const auto& [part, count] : counts) {
        if (bones.size() > 4 && 5 * count >= 4 * bones.size()) {
            shared.insert(part);
        }
    }
    std::vector<Spoken> spoken;
    for (const std::vector<std::string>& name : names) {
        spoken.push_back(spokenOf(name, shared));
    }
    return spoken;
}

class Picker {
public:
    explicit Picker(std::span<const ImportedBone> bones) : m_bones(bones), m_spoken(spokenBy(bones)) {}

    BoneMapping run() {
        for (const BoneWords& row : kBoneWords) {
            if (!row.isSided) {
                pick(row.segment, row.words, Side::None, -1);
                continue;
            }
            const bool hangs = row.segment == RightForeArm || row.segment == RightHand ||
                               row.segment == RightLowerLeg || row.segment == RightFoot ||
                               row.segment == RightToe;
            for (const auto& [side, shift] :
                 {std::pair{Side::Right, std::size_t{0}}, {Side::Left, kLeftAfterRight}}) {
                const std::size_t segment = row.segment + shift;
                pick(segment, row.words, side, hangs ? m_mapping.bones[segment - 1] : -1);
            }
        }
        pickFingers(LeftHand, Side::Left, kSegmentCount);
        pickFingers(RightHand, Side::Right, kSegmentCount + kHandSegmentCount);
        return m_mapping;
    }

private:
    bool isUnder(std::size_t bone, int ancestor) const {
        int at = static_cast<int>(bone);
        while (at >= 0 && at != ancestor) {
            at = m_bones[static_cast<std::size_t>(at)].parent;
        }
        return at == ancestor;
    }

    void pick(std::size_t segment, std::string_view words, Side side, int above) {
        // The first word, the plainest name, one that moves vertices, the highest.
        auto least = std::tuple(words.size(), std::numeric_limits<std::size_t>::max(), false);
        for (std::size_t i = 0; i < m_bones.size(); ++i) {
            const Spoken& spoken = m_spoken[i];
            if (m_used.contains(i) || spoken.side != side || !isListed(spoken.word, words) ||
                (above >= 0 && !isUnder(i, above))) {
                continue;
            }
            const std::string list = '|' + std::string(words) + '|';
            const std::tuple cost(list.find('|' + spoken.word + '|'), spoken.others, !m_bones[i].hasWeights);
            if (m_mapping.bones[segment] < 0 || cost < least) {
                least = cost;
                m_mapping.bones[segment] = static_cast<int>(i);
            }
        }
        if (m_mapping.bones[segment] >= 0) {
            m_used.insert(static_cast<std::size_t>(m_mapping.bones[segment]));
        }
    }

    /// From the hand outwards: of three bones the first is a proximal phalanx, of more a metacarpal; the
    /// thumb begins with its metacarpal.
    void pickFingers(Segment hand, Side side, std::size_t first) {
        for (std::size_t finger = 0; m_mapping.bones[hand] >= 0 && finger < kFingerWords.size(); ++finger) {
            std::vector<int> chain;
            for (std::size_t i = 0; i < m_bones.size(); ++i) {
                if (!m_used.contains(i) && m_spoken[i].side == side &&
                    isListed(m_spoken[i].word, kFingerWords.at(finger)) &&
                    isUnder(i, chain.empty() ? m_mapping.bones[hand] : chain.back())) {
                    chain.push_back(static_cast<int>(i));
                }
            }
            const std::size_t most = finger == 0 ? 3 : 4;
            const std::size_t skipped = finger == 0 || chain.size() > 3 ? 0 : 1;
            const std::size_t place = first + (finger == 0 ? 1 : 4 * finger);
            for (std::size_t i = 0; i < chain.size() && i + skipped < most; ++i) {
                m_mapping.bones[place + skipped + i] = chain[i];
            }
        }
    }

    std::span<const ImportedBone> m_bones;
    std::vector<Spoken> m_spoken;
    std::set<std::size_t> m_used;
    BoneMapping m_mapping;
};

} // namespace

BoneMapping mapBonesByWords(std::span<const ImportedBone> bones) {
    return Picker(bones).run();
}

} // namespace posewire::render
