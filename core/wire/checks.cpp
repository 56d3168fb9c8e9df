// SPDX-License-Identifier: MIT
#include "core/wire/byte_order.h"
#include "core/wire/payload.h"
#include "core/wire/tags.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"
#include "core/wire/write.h"

#include <algorithm>
#include <cmath>

namespace posewire::wire {
namespace {

constexpr std::uint32_t kBodyItems = 23;
constexpr std::uint32_t kFingerItems = 40;
constexpr float kNormTolerance = 0.02F; ///< of the squared length: 0.01 of the length

struct Tally {
    std::uint32_t count = 0;
    std::uint32_t first = 0;

    /// `places` of them, the first at `offset`.
    void add(std::uint32_t places, std::size_t offset) {
        first = count == 0 && places != 0 ? static_cast<std::uint32_t>(offset) : first;
        count += places;
    }
};

void report(Datagram& datagram, NoticeCode code, const Tally& tally) {
    if (tally.count != 0) {
        datagram.notices.push_back({code, tally.first, tally.count});
    }
}

std::uint32_t nonFinite(float value) {
    constexpr std::uint32_t kExponent = 0x7f800000U;
    return (std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent ? 1 : 0;
}
template <std::size_t N>
std::uint32_t nonFinite(const std::array<float, N>& values) {
    std::uint32_t count = 0;
    for (const float value : values) {
        count += nonFinite(value);
    }
    return count;
}

float squaredNorm(const Quat& q) {
    return (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
}

constexpr bool namesSegment(RefersTo what) {
    return what == RefersTo::Segment || what == RefersTo::UnitySegment || what == RefersTo::Tracker;
}

/// Finds out what is odd in items of which something is.
struct ItemChecks {
    Tally infinite;
    Tally quaternion;
    Tally segment;

    template <class Item, Form F>
    void check(const Item& item, std::size_t offset, bool isTag = false) {
        std::uint32_t bad = 0;
        bool isOffUnit = false;
        forEachValue<Item, F>([&]<auto Member>(const Field<Member>& field) {
            using Value = MemberValue<Member>;
            if constexpr (std::is_same_v<Value, Quat>) {
                isOffUnit = isOffUnit || !(std::abs(squaredNorm(item.*Member) - 1.0F) <= kNormTolerance);
            }
            if constexpr (kScalar<Value> == Scalar::Float32) {
                bad += nonFinite(item.*Member);
            } else if constexpr (std::is_unsigned_v<Value>) {
                const bool isOutside =
                    namesSegment(field.about.refersTo) && item.*Member - 1U >= kMaxSegments && !isTag;
                segment.add(isOutside ? 1 : 0, offset);
            }
        });
        infinite.add(bad, offset);
        quaternion.add(isOffUnit && bad == 0 ? 1 : 0, offset);
    }
};

/// Zero for finite numbers, NaN where there is anything else.
[[maybe_unused]] float zeroIfFinite(float value) {
    return value * 0.0F;
}
template <std::size_t N>
float zeroIfFinite(const std::array<float, N>& values) {
    float product = 0.0F;
    for (const float value : values) {
        product *= value; // NaN from the first value on that is not finite
    }
    return product;
}

/// Finds out as cheaply as possible that nothing in an item is odd; NaN fails every comparison.
struct Soundness {
    float zero = 0.0F;
    bool isSound = true;

    template <class Item, Form F>
    void look(const Item& item) {
        forEachValue<Item, F>([&]<auto Member>(const Field<Member>& field) {
            using Value = MemberValue<Member>;
            if constexpr (std::is_same_v<Value, Quat>) {
                isSound &= std::abs(squaredNorm(item.*Member) - 1.0F) <= kNormTolerance;
            } else if constexpr (kScalar<Value> == Scalar::Float32) {
                zero += zeroIfFinite(item.*Member);
            } else if constexpr (std::is_unsigned_v<Value>) {
                isSound &= !namesSegment(field.about.refersTo) || item.*Member - 1U < kMaxSegments;
            }
        });
    }
};

template <Form F, class Item>
void checkItems(ItemChecks& checks, const Header& header, const std::vector<Item>& items,
                std::size_t offset) {
    Soundness all;
    for (const Item& item : items) {
        all.look<Item, F>(item);
    }
    if (all.isSound && all.zero == 0.0F) {
        return;
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
        checks.check<Item, F>(items[i], offset, isTag(header, items, i));
        offset += writtenSize<Item, F>(items[i]);
    }
}

void checkTags(Datagram& datagram, std::string_view text, std::size_t start) {
    const TagList list = parseTags(text);
    Tally unknown;
    Tally colours;
    for (const Tag& tag : list.tags) {
        const bool isHexadecimal =
            tag.value.size() == 6 &&
            tag.value.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
        if (tag.name == "color" && !isHexadecimal) {
            colours.add(1, start + static_cast<std::size_t>(tag.value.data() - text.data()));
        }
        const auto place = static_cast<std::size_t>(tag.name.data() - text.data());
        unknown.add(isKnownTag(tag.name) ? 0 : 1, start + place);
    }
    report(datagram, NoticeCode::UnknownTag, unknown);
    report(datagram, NoticeCode::BadColour, colours);
    report(datagram, NoticeCode::LineWithoutTag,
           {list.strayLines, static_cast<std::uint32_t>(start + list.firstStray)});
}

/// A time of day in "HH:MM:SS.mmm"; a leap second counts.
bool isTimeOfDay(std::string_view text) {
    constexpr std::string_view pattern = "00:00:00.000";
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (pattern[i] == '0' ? (text[i] < '0' || text[i] > '9') : text[i] != pattern[i]) {
            return false;
        }
    }
    return text.substr(0, 2) <= "23" && text.substr(3, 2) <= "59" && text.substr(6, 2) <= "60";
}

/// Checks the fields of a message that are no numbers, in wire order.
template <class T>
struct TextChecks {
    Datagram& datagram;
    const T& message;
    std::size_t offset = kHeaderSize;
    std::size_t length = 0;       ///< that a length just before the field announces
    std::size_t lengthOffset = 0; ///< 0 for none

    template <auto Member>
    void operator()(const Field<Member>& field) {
        using Value = MemberValue<Member>;
        if constexpr (kScalar<Value> == Scalar::Characters) {
            if (lengthOffset != 0 && length != sizeof(Value)) {
                notice(NoticeCode::LengthDisagrees, lengthOffset);
            }
            const std::string_view text((message.*Member).data(), sizeof(Value));
            if (field.about.unit == Unit::TimeOfDay && !isTimeOfDay(text)) {
                notice(NoticeCode::NotATimeCode, offset);
            }
        } else if constexpr (std::is_integral_v<Value>) {
            lengthOffset = field.about.unit == Unit::ByteCount ? offset : 0;
            length = static_cast<std::size_t>(message.*Member);
        }
        offset += sizeof(Value);
    }
    template <auto Member, TextKind Kind>
    void operator()(const Text<Member, Kind>& field) {
        if (field.about.unit == Unit::TagLines) {
            checkTags(datagram, message.*Member, offset + (Kind == TextKind::Prefixed ? 4 : 0));
        }
    }
    void operator()(const auto&) {}

private:
    void notice(NoticeCode code, std::size_t at) {
        datagram.notices.push_back({code, static_cast<std::uint32_t>(at), 1});
    }
};

template <class T, Form F>
void checkMessage(Datagram& datagram, ItemChecks& checks, const T& message) {
    TextChecks<T> texts{datagram, message};
    forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        if constexpr (requires { FieldType::kItemForm; }) {
            const std::size_t countSize = FieldType::kMax != 0 ? sizeof(std::uint32_t) : 0;
            checkItems<FieldType::kItemForm>(checks, datagram.header, message.*FieldType::kMember,
                                             texts.offset + countSize);
            texts.offset += detail::putField(ByteCounter{}, field, message).size;
        } else {
            texts(field);
        }
    });
    checks.check<T, F>(message, kHeaderSize);
}

void checkHeader(Datagram& datagram) {
    const Header& header = datagram.header;
    if (header.reserved != 0) {
        datagram.notices.push_back({NoticeCode::ReservedUsed, 20, 1});
    }
    const bool isWhole = header.datagramCounter == 0x80;
    if (isWhole && header.countedSegments() != 0 && header.countedSegments() != header.items &&
        countsSegments(header.type())) {
        datagram.notices.push_back({NoticeCode::CountDisagrees, 11, 1});
    }
}

/// 100 or 256 for each segment, and the point; anything else is a tag.
bool mayBeMarker(std::uint32_t id) {
    const auto isPoint = [](std::uint32_t segment, std::uint32_t point) {
        return segment - 1 < kMaxSegments && point - 1 < 14;
    };
    return isPoint(id >> 8, id & 0xff) || isPoint(id / 100, id % 100);
}

/// More than the specification allows is read all the same.
void checkLimits(Datagram& datagram) {
    constexpr std::uint32_t kMostProps = 4;
    constexpr std::uint32_t kMostMarkers = 64; // typical sets have 38 to 46 of these
    const Header& header = datagram.header;
    const auto limit = [&](NoticeCode code, std::uint32_t offset, std::uint32_t count, std::uint32_t most) {
        report(datagram, code, {count > most ? count : 0, offset});
    };
    limit(NoticeCode::TooManyProps, 18, header.props, kMostProps);
    if (const auto* unity = std::get_if<PoseUnity>(&datagram.body)) {
        limit(NoticeCode::TooManyItems, 11, static_cast<std::uint32_t>(unity->segments.size()), kBodyItems);
    } else if (const auto* points = std::get_if<PointPositions>(&datagram.body)) {
        const auto markers = std::ranges::count_if(points->points, mayBeMarker, &Point::id);
        limit(NoticeCode::TooManyPoints, 11, static_cast<std::uint32_t>(markers), kMostMarkers);
    } else if (countsSegments(header.type()) && header.countedSegments() == 0 &&
               header.items < kBodyItems + kFingerItems) {
        const std::uint32_t props = std::max<std::uint32_t>(header.items, kBodyItems) - kBodyItems;
        limit(NoticeCode::TooManyProps, 11, props, kMostProps);
    }
}

} // namespace

void checkValues(Bytes bytes, Datagram& datagram) {
    checkHeader(datagram);
    checkLimits(datagram);
    const std::size_t announced = kHeaderSize + datagram.header.payloadSize;
    if (datagram.header.payloadSize != 0 && bytes.size() > announced) {
        datagram.notices.push_back({NoticeCode::SizeDisagrees, static_cast<std::uint32_t>(announced),
                                    static_cast<std::uint32_t>(bytes.size() - announced)});
    }
    ItemChecks checks;
    visitMessage(datagram.body,
                 [&]<Form F, class T>(const T& message) { checkMessage<T, F>(datagram, checks, message); });
    report(datagram, NoticeCode::NotFinite, checks.infinite);
    report(datagram, NoticeCode::NotUnitQuaternion, checks.quaternion);
    report(datagram, NoticeCode::SegmentOutOfRange, checks.segment);
}

} // namespace posewire::wire
