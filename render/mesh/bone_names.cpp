// SPDX-License-Identifier: MIT
#include "render/mesh/bone_mapping.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <utility>

namespace posewire::render {
namespace {

using Words = std::vector<std::string>;

bool isOneOf(std::string_view word, std::span<const std::string_view> list) {
    return std::ranges::find(list, word) != list.end();
}
bool isOneOf(std::string_view word, std::initializer_list<std::string_view> list) {
    return std::ranges::find(list, word) != list.end();
}

bool isNumber(std::string_view word) {
    return !word.empty() && std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// "mixamorig:LeftForeArm" is mixamorig, left, fore, arm; "upperarm_twist_01_l" is upperarm, twist, 1, l;
/// "T12" is t12.
Words wordsOf(std::string_view name) {
    Words words;
    std::string word;
    const auto end = [&] {
        if (!word.empty()) {
            if (isNumber(word)) {
                word.erase(0, std::min(word.find_first_not_of('0'), word.size() - 1));
            }
            words.push_back(std::exchange(word, {}));
        }
    };
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto c = static_cast<unsigned char>(name[i]);
        const auto before = static_cast<unsigned char>(i > 0 ? name[i - 1] : ' ');
        const auto after = static_cast<unsigned char>(i + 1 < name.size() ? name[i + 1] : ' ');
        if (std::isalnum(c) == 0) {
            end();
            continue;
        }
        const bool isHump = std::isupper(c) != 0 && (std::islower(before) != 0 ||
                                                     (std::isupper(before) != 0 && std::islower(after) != 0));
        const bool beginsNumber = std::isdigit(c) != 0 && std::isalpha(before) != 0 && word.size() > 1;
        const bool endsNumber = std::isalpha(c) != 0 && std::isdigit(before) != 0 && isNumber(word);
        if (isHump || beginsNumber || endsNumber) {
            end();
        }
        word += static_cast<char>(std::tolower(c));
    }
    end();
    return words;
}

/// Of exporters and of conventions, at the beginning of every name.
void dropPrefixes(Words& words) {
    static constexpr auto kPrefixes =
        std::to_array<std::string_view>({"def", "mixamorig", "bip", "bone", "jnt", "joint", "b", "j", "c",
                                         "cc", "base", "valve", "biped", "rig"});
    while (words.size() > 1 && (isOneOf(words.front(), kPrefixes) || isNumber(words.front()))) {
        words.erase(words.begin());
    }
    if (words.size() > 1 && words.front() == "armature") {
        words.erase(words.begin());
        dropPrefixes(words);
    }
}

BoneName::Side takeSide(Words& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool isLeft = isOneOf(words[i], {"left", "l", "lft"});
        if (isLeft || isOneOf(words[i], {"right", "r", "rgt"})) {
            words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
            return isLeft ? BoneName::Side::Left : BoneName::Side::Right;
        }
    }
    return BoneName::Side::None;
}

int fingerOf(const std::string& word) {
    static constexpr std::array<std::array<std::string_view, 4>, 5> kFingers{
        {{"thumb", "first"},
         {"index", "second", "fore"},
         {"middle", "mid", "third"},
         {"ring", "fourth"},
         {"pinky", "little", "fifth", "pinkie"}}};
    for (std::size_t finger = 0; finger < kFingers.size(); ++finger) {
        if (isOneOf(word, kFingers[finger])) {
            return static_cast<int>(finger);
        }
    }
    return -1;
}

/// As MVN counts; VRM calls the thumb's first bone proximal where it has an intermediate one, which the
/// mapping knows.
int phalanxOf(const std::string& word, bool isThumb) {
    if (isOneOf(word, {"mc", "metacarpal", "palm"})) {
        return 0;
    }
    if (isOneOf(word, {"pp", "proximal"})) {
        return 1;
    }
    if (isOneOf(word, {"mp", "intermediate", "medial"})) {
        return isThumb ? 1 : 2;
    }
    if (isOneOf(word, {"dp", "distal"})) {
        return isThumb ? 2 : 3;
    }
    if (isNumber(word) && word.size() == 1 && word[0] >= '1' && word[0] <= '3') {
        return word[0] - '1' + (isThumb ? 0 : 1);
    }
    return -1;
}

/// Only what is sided and says which bone of the finger it is.
void readFinger(const Words& words, BoneName& name) {
    // Rigify's metacarpals: palm.01.L to palm.04.L.
    if (words.size() == 2 && words[0] == "palm" && isNumber(words[1]) && words[1].size() == 1) {
        const int number = words[1][0] - '0';
        name.finger = number >= 1 && number <= 4 ? number : -1;
        name.phalanx = 0;
        return;
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
        const int finger = fingerOf(words[i]);
        if (finger < 0 ||
            (finger == 1 && words[i] == "fore" && i + 1 < words.size() && words[i + 1] == "arm")) {
            continue;
        }
        for (std::size_t k = i + 1; k < words.size(); ++k) {
            if (const int phalanx = phalanxOf(words[k], finger == 0); phalanx >= 0) {
                name.finger = finger;
                name.phalanx = phalanx;
                return;
            }
        }
    }
}

} // namespace

BoneName readBoneName(std::string_view name) {
    const std::size_t space = name.find_last_of(":|");
    if (space != std::string_view::npos && space + 1 < name.size()) {
        name.remove_prefix(space + 1);
    }
    Words words = wordsOf(name);
    dropPrefixes(words);
    BoneName read;
    read.isExtra = std::ranges::any_of(words, [](const std::string& word) {
        return isOneOf(word, {"twist", "roll", "ik", "pole", "target", "helper", "end", "nub", "ctrl", "org",
                              "mch", "half", "corrective", "tip", "share", "trans"});
    });
    read.side = takeSide(words);
    dropPrefixes(words);
    if (read.side != BoneName::Side::None) {
        readFinger(words, read);
    }
    for (const std::string& word : words) {
        read.key += word;
    }
    return read;
}

} // namespace posewire::render
