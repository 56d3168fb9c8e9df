// SPDX-License-Identifier: MIT
#include "core/model/content/pose_checks.h"

#include "core/model/body/character_pose.h"
#include "core/model/body/segments.h"
#include "core/wire/pose_items.h"
#include "core/wire/tags.h"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cmath>
#include <span>
#include <utility>

namespace posewire::model {
namespace {

/// Beyond this a position is absurd in any unit: 10 km in millimetres.
constexpr float kAbsurd = 1e7F;

enum class Number : std::uint8_t { Usable, NotFinite, Zero, Off };

Number judge(const std::array<float, 3>& position) {
    const auto isFinite = [](float value) { return std::isfinite(value); };
    const auto isFar = [](float value) { return std::abs(value) > kAbsurd; };
    return !std::ranges::all_of(position, isFinite) ? Number::NotFinite
           : std::ranges::any_of(position, isFar)   ? Number::Off
                                                    : Number::Usable;
}

Number judge(const std::array<float, 4>& orientation) {
    constexpr float kLeast = 0.5F * 0.5F;
    constexpr float kMost = 1.5F * 1.5F;
    constexpr float kNone = 1e-12F;
    float square = 0;
    for (const float value : orientation) {
        square += value * value;
    }
    return !std::isfinite(square)              ? Number::NotFinite
           : square < kNone                    ? Number::Zero
           : square < kLeast || square > kMost ? Number::Off
                                               : Number::Usable;
}

template <std::size_t N>
std::array<float, N> swapped(std::array<float, N> values) {
    for (float& value : values) {
        value = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
    }
    return values;
}

/// How many segments have a position or orientation of each kind.
struct Tally {
    std::array<std::uint16_t, 4> positions{};
    std::array<std::uint16_t, 4> orientations{};
    std::size_t bad = 0; ///< items

    template <class Item>
    void add(const Item& item) {
        bool isBad = false;
        wire::forNumbers(item, [&]<std::size_t N>(const std::array<float, N>& numbers) {
            const Number number = judge(numbers);
            ++(N == 3 ? positions : orientations)[static_cast<std::size_t>(number)];
            isBad = isBad || number != Number::Usable;
        });
        bad += isBad ? 1 : 0;
    }
    [[nodiscard]] std::uint16_t positionsThatAre(Number number) const {
        return positions[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] std::uint16_t orientationsThatAre(Number number) const {
        return orientations[static_cast<std::size_t>(number)];
    }
};

void add(PoseChecks& checks, const ContentFinding& finding) {
    if (checks.count < checks.findings.size()) {
        checks.findings[checks.count++] = finding;
    }
}

/// A position of nearly zero is what a small number becomes that is read in the wrong order.
template <class Item>
bool isSaneSwapped(const Item& item) {
    bool isSane = true;
    wire::forNumbers(item, [&](const auto& numbers) {
        const auto other = swapped(numbers);
        const float largest =
            std::abs(*std::ranges::max_element(other, {}, [](float value) { return std::abs(value); }));
        isSane = isSane && judge(other) == Number::Usable && largest > 1e-6F;
    });
    return isSane;
}

template <class Item>
void checkNumbers(const std::vector<Item>& items, PoseChecks& checks) {
    Tally tally;
    for (const Item& item : items) {
        tally.add(item);
    }
    if (tally.bad == 0) {
        return;
    }
    checks.isUnusable = 2 * tally.bad >= items.size();
    const auto sane = std::ranges::count_if(items, [](const Item& item) { return isSaneSwapped(item); });
    if (checks.isUnusable && 10 * static_cast<std::size_t>(sane) >= 9 * items.size()) {
        add(checks, {ContentFault::ByteOrder, words::Kind::NumbersSwapped});
        return;
    }
    const auto ofOrientations = [&](Number number) { return tally.orientationsThatAre(number); };
    const auto notFinite =
        std::max(tally.positionsThatAre(Number::NotFinite), ofOrientations(Number::NotFinite));
    if (notFinite != 0) {
        add(checks, {ContentFault::Number, words::Kind::NumbersNotFinite, notFinite});
    } else if (const std::uint16_t far = tally.positionsThatAre(Number::Off)) {
        add(checks, {ContentFault::Number, words::Kind::PositionsAbsurd, far});
    }
    if (const std::uint16_t zero = ofOrientations(Number::Zero)) {
        add(checks, {ContentFault::Orientation, words::Kind::OrientationsZero, zero});
    } else if (const std::uint16_t off = ofOrientations(Number::Off)) {
        add(checks, {ContentFault::Orientation, words::Kind::OrientationsFar, off});
    }
}

/// Revision E gives the left foot the ID of the left toe.
template <class Item>
void checkIds(const wire::Header& header, const std::vector<Item>& items, PoseChecks& checks) {
    constexpr std::size_t kUnknown = 255;
    std::bitset<kUnknown + 1> seen;
    std::uint16_t twice = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const std::size_t id = wire::isTag(header, items, i) ? kUnknown : items[i].id;
        if (id < kUnknown && seen.test(id)) {
            ++twice;
        }
        seen.set(std::min(id, kUnknown));
    }
    const bool isFromZero = items.size() >= kBodySegments && items.front().id == 0 && items[1].id == 1;
    if (isFromZero) {
        add(checks, {ContentFault::Ids, words::Kind::IdsFromZero});
    } else if (twice > (header.countedSegments() == 0 ? 1 : 0)) {
        add(checks, {ContentFault::Ids, words::Kind::IdsRepeat, twice});
    }
}

/// Not if it lacks segments that the header announces: those are a body's.
template <class Item>
bool holdsObjects(const wire::Header& header, const std::vector<Item>& items) {
    constexpr std::size_t kMostItems = 255;
    if (items.size() > kMostItems || header.bodySegments > items.size()) {
        return false;
    }
    std::array<std::uint32_t, kMostItems> ids{};
    std::ranges::transform(items, ids.begin(), &Item::id);
    return isOfObjects(header, std::span(ids).first(items.size()));
}

/// Only of types that are known to hold all of them.
void checkMissing(const wire::Header& header, std::size_t items, std::uint8_t mostBodyItems,
                  PoseChecks& checks) {
    const bool isCounted = header.bodySegments != 0;
    if (!checks.isWhole || items == 0 || (header.type() != 1 && header.type() != 2)) {
        return;
    }
    const std::size_t body =
        isCounted ? header.bodySegments : std::max<std::size_t>(mostBodyItems, checks.bodyItems);
    const std::size_t props = isCounted ? header.props : 0;
    const std::size_t fingers = isCounted ? header.fingerSegments : 0;
    std::size_t left = items;
    const auto missingOf = [&left](std::size_t announced) {
        const std::size_t here = std::min(announced, left);
        left -= here;
        return static_cast<std::uint16_t>(announced - here);
    };
    ContentFinding finding{ContentFault::Missing, words::Kind::AnnouncedMissing};
    finding.count = missingOf(body);
    finding.props = missingOf(props);
    finding.fingers = missingOf(fingers);
    if (finding.count + finding.props + finding.fingers != 0) {
        add(checks, finding);
    }
}

} // namespace

words::Fact factOf(const ContentFinding& finding) {
    words::Fact fact{finding.says};
    if (finding.fault == ContentFault::Missing) {
        std::vector<words::Fact> missing;
        for (const auto& [kind, count] :
             {std::pair(words::Kind::Segments, finding.count), std::pair(words::Kind::Props, finding.props),
              std::pair(words::Kind::FingerSegments, finding.fingers)}) {
            if (count != 0) {
                missing.push_back(words::counted(kind, count));
            }
        }
        words::set(fact, "parts", std::move(missing));
    } else if (finding.count != 0) {
        words::set(fact, "segments", words::counted(words::Kind::Segments, finding.count));
    }
    if (finding.looks != words::Kind::Nothing) {
        words::set(fact, finding.fault == ContentFault::None ? "what" : "looks", words::Fact{finding.looks});
    }
    if (finding.value != 0 && finding.fault == ContentFault::Units) {
        words::set(fact, "factor", static_cast<std::uint64_t>(finding.value));
    } else if (finding.value != 0) {
        words::set(fact, "value", words::Number{finding.value, 1});
    }
    return fact;
}

const ContentFinding* PoseChecks::find(ContentFault fault) const {
    const auto end = findings.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found =
        std::find_if(findings.begin(), end, [fault](const auto& one) { return one.fault == fault; });
    return found == end ? nullptr : &*found;
}

PoseChecks checkPose(const wire::Datagram& datagram, std::uint8_t mostBodyItems) {
    PoseChecks checks;
    const wire::Header& header = datagram.header;
    checks.isWhole = header.datagramIndex() == 0 && header.isLast();
    wire::forSegments(datagram.body, [&](const auto& items) {
        const std::size_t body = header.bodySegments != 0 ? header.bodySegments : kBodySegments;
        checks.bodyItems = static_cast<std::uint8_t>(std::min({items.size(), body, kBodySegments}));
        checks.isOfObjects = holdsObjects(header, items);
        if (!items.empty()) {
            if constexpr (requires { items.front().position; }) {
                checks.first = items.front().position;
            }
            checkNumbers(items, checks);
            checkIds(header, items, checks);
        }
        checkMissing(header, items.size(), mostBodyItems, checks);
    });
    return checks;
}

} // namespace posewire::model
