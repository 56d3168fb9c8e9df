// SPDX-License-Identifier: MIT
#include "core/wire/checks.h"

#include "core/wire/byte_order.h"
#include "core/wire/form.h"
#include "core/wire/metadata_text.h"

#include <cmath>

namespace posewire::wire {
namespace {

constexpr float kNormTolerance = 0.02F; ///< of the squared length: 0.01 of the length

struct Tally {
    std::uint32_t count = 0;
    std::uint32_t first = 0;

    void add(bool isOdd, std::size_t offset) {
        if (isOdd) {
            first = count == 0 ? static_cast<std::uint32_t>(offset) : first;
            ++count;
        }
    }
};

void report(Datagram& datagram, NoticeCode code, const Tally& tally) {
    if (tally.count != 0) {
        datagram.notices.push_back({code, tally.first, tally.count});
    }
}

bool isNotFinite(std::uint32_t bits) {
    return (bits & 0x7f800000U) == 0x7f800000U;
}

template <std::size_t N>
unsigned nonFinite(const std::array<float, N>& values) {
    unsigned count = 0;
    for (const float value : values) {
        count += isNotFinite(std::bit_cast<std::uint32_t>(value));
    }
    return count;
}

float squaredNorm(const Quat& q) {
    return (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
}

template <class Item>
concept HasId = requires(const Item& item) {
    item.id;
};
template <class Item>
constexpr bool kHasSegmentId = HasId<Item> && !std::is_same_v<Item, Point> && !std::is_same_v<Item, Prop>;

/// Finds out what is odd in items of which something is.
struct ItemChecks {
    Tally infinite;
    Tally quaternion;
    Tally segment;

    template <class Item, Form F>
    void check(const Item& item, std::size_t offset) {
        unsigned bad = 0;
        bool isOffUnit = false;
        forEachField<Item, F>([&](const auto& field) { checkField(item, field, bad, isOffUnit); });
        if (bad != 0) {
            infinite.first = infinite.count == 0 ? static_cast<std::uint32_t>(offset) : infinite.first;
            infinite.count += bad;
        }
        quaternion.add(isOffUnit && bad == 0, offset);
        if constexpr (kHasSegmentId<Item>) {
            segment.add(item.id - 1U >= kMaxSegments, offset);
        }
    }

private:
    template <class Item, auto Member>
    static void checkField(const Item& item, const Field<Member>&, unsigned& bad, bool& isOffUnit) {
        using Value = MemberValue<Member>;
        if constexpr (std::is_same_v<Value, Vec3> || std::is_same_v<Value, Mat3>) {
            bad += nonFinite(item.*Member);
        } else if constexpr (std::is_same_v<Value, Quat>) {
            const Quat& q = item.*Member;
            bad += nonFinite(q);
            isOffUnit = isOffUnit || !(std::abs(squaredNorm(q) - 1.0F) <= kNormTolerance);
        }
    }
    template <class Item, auto Member, TextKind Kind>
    static void checkField(const Item&, const Text<Member, Kind>&, unsigned&, bool&) {}
};

/// Zero for finite numbers, NaN where there is anything else.
template <std::size_t N>
float zeroIfFinite(const std::array<float, N>& values) {
    float sum = 0.0F;
    for (const float value : values) {
        sum += value * 0.0F;
    }
    return sum;
}

/// Tells as cheaply as possible that nothing in an item is odd; NaN fails every comparison.
struct Soundness {
    float zero = 0.0F;
    bool isSound = true;

    template <class Item, Form F>
    void look(const Item& item) {
        forEachField<Item, F>([&](const auto& field) { lookAt(item, field); });
        if constexpr (kHasSegmentId<Item>) {
            isSound &= item.id - 1U < kMaxSegments;
        }
    }

private:
    template <class Item, auto Member>
    void lookAt(const Item& item, const Field<Member>&) {
        using Value = MemberValue<Member>;
        if constexpr (std::is_same_v<Value, Vec3> || std::is_same_v<Value, Mat3>) {
            zero += zeroIfFinite(item.*Member);
        } else if constexpr (std::is_same_v<Value, Quat>) {
            isSound &= std::abs(squaredNorm(item.*Member) - 1.0F) <= kNormTolerance;
        }
    }
    template <class Item, auto Member, TextKind Kind>
    void lookAt(const Item&, const Text<Member, Kind>&) {}
};

template <Form F, class Item>
void checkItems(ItemChecks& checks, const std::vector<Item>& items, std::size_t offset) {
    Soundness all;
    for (const Item& item : items) {
        all.look<Item, F>(item);
    }
    if (all.isSound && all.zero == 0.0F) {
        return;
    }
    for (const Item& item : items) {
        checks.check<Item, F>(item, offset);
        offset += kIsFixed<Item, F> ? kWireSize<Item, F> : 0;
    }
}

void checkTags(Datagram& datagram, const MetaData& message) {
    const std::size_t start = kHeaderSize + (message.hasLengthPrefix ? 4 : 0);
    const TagList list = parseTags(message.text);
    Tally unknown;
    for (const Tag& tag : list.tags) {
        const auto place = static_cast<std::size_t>(tag.name.data() - message.text.data());
        unknown.add(!isKnownTag(tag.name), start + place);
    }
    report(datagram, NoticeCode::UnknownTag, unknown);
    report(datagram, NoticeCode::LineWithoutTag,
           {list.strayLines, static_cast<std::uint32_t>(start + list.firstStray)});
}

bool isTimeCode(std::string_view text) {
    constexpr std::string_view pattern = "00:00:00.000";
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (pattern[i] == '0' ? (text[i] < '0' || text[i] > '9') : text[i] != pattern[i]) {
            return false;
        }
    }
    return text.substr(0, 2) < "24" && text[3] < '6' && text[6] < '6';
}

void checkTimeCode(Datagram& datagram, const TimeCode& message) {
    if (message.hasLengthPrefix && message.length != 12) {
        datagram.notices.push_back({NoticeCode::LengthDisagrees, kHeaderSize, 1});
    }
    if (!isTimeCode(message.view())) {
        const std::uint32_t offset = kHeaderSize + (message.hasLengthPrefix ? 4U : 0U);
        datagram.notices.push_back({NoticeCode::NotATimeCode, offset, 1});
    }
}

struct BodyChecks {
    Datagram& datagram;
    ItemChecks items;

    void operator()(const RawBody&) {}
    void operator()(const MetaData& message) { checkTags(datagram, message); }
    void operator()(const TimeCode& message) { checkTimeCode(datagram, message); }
    void operator()(const CentreOfMass& message) {
        const unsigned bad =
            nonFinite(message.position) + nonFinite(message.velocity) + nonFinite(message.acceleration);
        items.infinite = {bad, kHeaderSize};
    }
    void operator()(const NullPose& message) {
        checkItems<Form::Standard>(items, message.segments, kHeaderSize);
        checkItems<Form::Standard>(items, message.points, kHeaderSize);
    }
    void operator()(const TrackerKinematics& message) {
        if (message.hasInertialData) {
            checkItems<Form::Standard>(items, message.trackers, kHeaderSize);
        } else {
            checkItems<Form::Short>(items, message.trackers, kHeaderSize);
        }
    }
    void operator()(const PropInformation& message) {
        checkItems<Form::Standard>(items, message.props, kHeaderSize);
    }
    void operator()(const PointPositions& message) {
        checkItems<Form::Standard>(items, message.points, kHeaderSize);
    }
    void operator()(const TagPositions& message) {
        checkItems<Form::Standard>(items, message.points, kHeaderSize);
    }
    void operator()(const JointAngles& message) {
        checkItems<Form::Standard>(items, message.joints, kHeaderSize);
    }
    void operator()(const auto& message) { checkItems<Form::Standard>(items, message.segments, kHeaderSize); }
};

/// Counts of segments say something about segment messages only; others need not fill them in.
bool carriesSegments(std::uint8_t type) {
    return type == PoseEuler::kType || type == PoseQuaternion::kType || type == LinearKinematics::kType ||
           type == AngularKinematics::kType;
}

void checkHeader(Datagram& datagram) {
    const Header& header = datagram.header;
    if (header.reserved != 0) {
        datagram.notices.push_back({NoticeCode::ReservedUsed, 20, 1});
    }
    const bool isWhole = header.datagramCounter == 0x80;
    if (isWhole && carriesSegments(header.type()) && header.countedSegments() != 0 &&
        header.countedSegments() != header.items) {
        datagram.notices.push_back({NoticeCode::CountDisagrees, 11, 1});
    }
}

} // namespace

void checkValues(Bytes bytes, Datagram& datagram) {
    checkHeader(datagram);
    const std::size_t announced = kHeaderSize + datagram.header.payloadSize;
    if (datagram.header.payloadSize != 0 && bytes.size() > announced) {
        datagram.notices.push_back({NoticeCode::SizeDisagrees, static_cast<std::uint32_t>(announced),
                                    static_cast<std::uint32_t>(bytes.size() - announced)});
    }
    BodyChecks checks{datagram, {}};
    std::visit(checks, datagram.body);
    report(datagram, NoticeCode::NotFinite, checks.items.infinite);
    report(datagram, NoticeCode::NotUnitQuaternion, checks.items.quaternion);
    report(datagram, NoticeCode::SegmentOutOfRange, checks.items.segment);
}

} // namespace posewire::wire
