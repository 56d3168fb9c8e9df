// SPDX-License-Identifier: MIT
#include "core/field/field.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/points.h"
#include "core/model/body/segments.h"
#include "core/wire/form.h"
#include "core/wire/layouts.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <utility>

namespace posewire::field {
namespace {

using wire::Datagram;
using wire::Form;

constexpr std::size_t kBodies = std::variant_size_v<wire::Body>;

/// The place of a message among the alternatives of Body. Those in another form than the standard one come
/// after all standard ones.
template <class T, Form F>
constexpr std::size_t shapeOf() {
    std::size_t shape = 1;
    bool isFound = false;
    wire::Messages::forEach([&]<class Other>() {
        isFound = isFound || std::is_same_v<Other, T>;
        shape += isFound ? 0 : 1;
    });
    return F == Form::Standard ? shape : kBodies + shape;
}

template <class V>
constexpr bool kIsFloat = wire::kScalar<V> == wire::Scalar::Float32;

template <class V>
constexpr Kind kKindOf = std::is_arithmetic_v<V>     ? Kind::Number
                         : wire::kComponents<V> != 1 ? Kind::Vector
                                                     : Kind::Text;

template <class V>
Value valueOf(const V& value, std::size_t component) {
    if constexpr (kKindOf<V> == Kind::Vector) {
        return {value[component], {}};
    } else if constexpr (std::is_arithmetic_v<V>) {
        return {static_cast<double>(value), {}};
    } else {
        return {0, {value.data(), value.size()}};
    }
}

template <class T>
const T& bodyOf(const Datagram& datagram) {
    return *std::get_if<T>(&datagram.body);
}

template <class T, auto Member>
Value readOwn(const Datagram& datagram, std::size_t, std::size_t component) {
    return valueOf(bodyOf<T>(datagram).*Member, component);
}
template <class T, auto List>
Value readCount(const Datagram& datagram, std::size_t, std::size_t) {
    return {static_cast<double>((bodyOf<T>(datagram).*List).size()), {}};
}
template <class T, auto List, auto Member>
Value readListed(const Datagram& datagram, std::size_t item, std::size_t component) {
    return valueOf((bodyOf<T>(datagram).*List)[item].*Member, component);
}

constexpr model::SegmentLayout kAll{model::kBodySegmentCount, model::kMaxPropCount,
                                    model::kFingerSegmentCount};

int numberAt(const model::SegmentPlace& place) {
    constexpr std::array<int, 4> kBefore{0, kAll.body, kAll.body + kAll.props,
                                         kAll.body + kAll.props + model::kHandSegmentCount};
    return kBefore[static_cast<std::size_t>(place.kind)] + place.index + 1;
}

/// The numbers of an item that have to do with segments.
struct ItemIds {
    std::optional<std::uint32_t> segment{}; ///< as on the wire; of a joint that of its child
    std::optional<std::uint32_t> point{};
    std::optional<std::string_view> name{}; ///< of an item without a number
    bool isUnityOrder = false;
    bool isJoint = false;
};

template <Form F, class Item>
ItemIds idsOf(const Item& item) {
    ItemIds ids;
    wire::forEachField<Item, F>([&]<class FieldType>(const FieldType& field) {
        using enum wire::RefersTo;
        using Member = wire::MemberValue<FieldType::kMember>;
        if constexpr (std::is_unsigned_v<Member>) {
            const std::uint32_t id = item.*FieldType::kMember;
            switch (field.about.refersTo) {
            case UnitySegment:
                ids.isUnityOrder = true;
                [[fallthrough]];
            case Segment:
            case Tracker:
            case Prop:
                ids.segment = id;
                break;
            case JointEnd:
                ids.segment = id >> 8;
                ids.isJoint = true;
                break;
            case Point:
                ids.point = id;
                break;
            default:
                break;
            }
        } else if constexpr (std::is_same_v<Member, std::string>) {
            ids.name = item.*FieldType::kMember;
        }
    });
    return ids;
}

/// Points are numbered 256 × segment + point, in revision E 100 × segment + point. The few ids that could be
/// either are taken as the first point of the datagram is.
double pointSegment(std::uint32_t id, std::uint32_t firstId) {
    using enum model::PointIdCoding;
    const auto by256 = model::knownPoint(By256, id);
    const auto by100 = model::knownPoint(By100, id);
    const bool isOld = by256 && by100 ? !model::knownPoint(By256, firstId) : by100.has_value();
    return isOld ? by100->segmentId : id >> 8;
}

/// The number that a name means (see segmentNumber), since the ids of props and fingers differ between
/// revisions; 0 if the item has no name. `item`: its place in the datagram.
double namedSegment(const ItemIds& ids, const model::ItemPlaces& places, std::size_t item) {
    if (!ids.segment) {
        return ids.name ? segmentNumber(*ids.name).value_or(0) : 0;
    }
    const std::uint32_t id = *ids.segment;
    const bool isOfBody = id >= 1 && id <= model::kBodySegmentCount;
    if (ids.isUnityOrder) {
        return isOfBody ? model::unityOrder()[id - 1] + 1 : 0;
    }
    if (ids.isJoint) {
        return isOfBody ? id : 0;
    }
    const int position = places.positionOf(item, id);
    const auto at = model::placeOf(isOfBody ? model::SegmentLayout() : places.layout, position);
    return at ? numberAt(*at) : 0;
}

/// The wire's own number; items without one count from 1.
template <Form F, class Item>
double segmentNumberOf(const std::vector<Item>& items, std::size_t item) {
    const ItemIds ids = idsOf<F>(items[item]);
    if (ids.point) {
        return pointSegment(*ids.point, *idsOf<F>(items.front()).point);
    }
    return ids.segment ? *ids.segment : static_cast<double>(item + 1);
}

template <Form F, class Item>
double namedSegment(const wire::Header& header, const std::vector<Item>& items, std::size_t item) {
    const ItemIds ids = idsOf<F>(items[item]);
    if (ids.point) {
        return segmentNumberOf<F>(items, item);
    }
    const auto places = model::itemPlaces(header, items.size(), idsOf<F>(items.front()).segment);
    return namedSegment(ids, places, item);
}

template <class T, Form ItemForm, auto List>
Value readSegment(const Datagram& datagram, std::size_t item, std::size_t) {
    return {segmentNumberOf<ItemForm>(bodyOf<T>(datagram).*List, item), {}};
}
template <class T, Form ItemForm, auto List>
Value readNamedSegment(const Datagram& datagram, std::size_t item, std::size_t) {
    return {namedSegment<ItemForm>(datagram.header, bodyOf<T>(datagram).*List, item), {}};
}
template <auto Member>
std::optional<Value> readHeader(Subject& subject, std::size_t index) {
    const wire::Header* header = index == 0 ? subject.header() : nullptr;
    return header != nullptr ? std::optional(valueOf(header->*Member, 0)) : std::nullopt;
}

using CountItems = std::size_t (*)(const Datagram&);
using Counts = std::array<std::array<CountItems, kLists>, kShapes>;

/// A field as it is found, with what each of its types says about it.
struct Draft {
    FieldInfo field;
    std::vector<wire::About> said{};
};

struct Found {
    std::vector<Draft> drafts;
    Counts counts{};
};

struct Spot {
    std::size_t shape = 0;
    std::size_t list = 0;
    std::uint8_t type = 0;
    std::string_view qualifier;
};

struct Reading {
    Kind kind;
    std::size_t components;
    ReadItem read;
    ReadItem readNamed = nullptr;
    bool isFloat = false;
};

const UnitInfo* unitOf(const wire::About& about) {
    return findUnit(wire::unitSymbol(about.unit));
}

Dimension dimensionOf(const wire::About& about) {
    const UnitInfo* unit = unitOf(about);
    return unit != nullptr ? unit->dimension : Dimension::None;
}

std::optional<model::LengthUnit> lengthOf(const wire::About& about) {
    return dimensionOf(about) != Dimension::Length ? std::nullopt
           : about.unit == wire::Unit::Centimetres ? std::optional(model::LengthUnit::Centimetre)
                                                   : std::optional(model::LengthUnit::Metre);
}

void add(Found& found, const Spot& spot, const wire::About& about, const Reading& reading) {
    const auto isSame = [&](const FieldInfo& field) {
        return field.name == about.name && field.qualifier == spot.qualifier && field.kind == reading.kind &&
               field.components == reading.components && field.dimension == dimensionOf(about);
    };
    auto draft = std::ranges::find_if(found.drafts, isSame, &Draft::field);
    if (draft == found.drafts.end()) {
        FieldInfo field{std::string(about.name), std::string(spot.qualifier), reading.kind,
                        reading.components, reading.isFloat};
        field.dimension = dimensionOf(about);
        field.read = unitOf(about);
        draft = found.drafts.insert(draft, Draft{std::move(field)});
    }
    FieldInfo& field = draft->field;
    if (field.types.empty() || field.types.back() != spot.type) {
        field.types.push_back(spot.type);
        draft->said.push_back(about);
    }
    field.places[spot.shape][spot.list] = {reading.read, lengthOf(about)};
    if (reading.readNamed != nullptr) {
        field.named = field.named.value_or(Places{});
        (*field.named)[spot.shape][spot.list] = {reading.readNamed};
    }
}

/// A value of T, or of the items in a list of T.
template <class V>
Reading readingOf(ReadItem read) {
    return {kKindOf<V>, wire::kComponents<V>, read, nullptr, kIsFloat<V>};
}

/// True for items with a field "segment" of their own.
template <class List>
constexpr bool namesItsSegment() {
    bool names = false;
    wire::forEachValue<typename List::Item, List::kItemForm>(
        [&](const auto& field) { names = names || field.about.refersTo == wire::RefersTo::Carrier; });
    return names;
}

/// The fields of the items in a list of T, and the segment that each is about.
template <class T, class List>
void addItems(Found& found, const Spot& spot) {
    found.counts[spot.shape][spot.list] = [](const Datagram& datagram) {
        return (bodyOf<T>(datagram).*List::kMember).size();
    };
    wire::forEachField<typename List::Item, List::kItemForm>([&]<class FieldType>(const FieldType& field) {
        constexpr ReadItem read = &readListed<T, List::kMember, FieldType::kMember>;
        const bool isSegment = field.about.refersTo == wire::RefersTo::Carrier;
        add(found, spot, field.about,
            isSegment ? Reading{Kind::Segment, 1, read, read}
                      : readingOf<wire::MemberValue<FieldType::kMember>>(read));
    });
    if (!namesItsSegment<List>()) {
        constexpr wire::About segment{"segment", wire::Unit::Identifier,
                                      "the segment that the item is about, by id or name", ""};
        add(found, spot, segment,
            {Kind::Segment, 1, &readSegment<T, List::kItemForm, List::kMember>,
             &readNamedSegment<T, List::kItemForm, List::kMember>});
    }
}

template <class T, Form F>
void walkForm(Found& found) {
    Spot own{shapeOf<T, F>(), 0, T::kType, {}};
    found.counts[own.shape][0] = [](const Datagram&) -> std::size_t { return 1; };
    std::size_t lists = 0;
    wire::forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        if constexpr (requires { FieldType::kItemForm; }) {
            const Reading count{Kind::Number, 1, &readCount<T, FieldType::kMember>};
            add(found, own, field.about, count);
            Spot spot = own;
            spot.qualifier = field.about.name;
            add(found, spot, {"count", wire::Unit::Count, "number of items in the list", ""}, count);
            spot.list = ++lists;
            addItems<T, FieldType>(found, spot);
        } else {
            add(found, own, field.about,
                readingOf<wire::MemberValue<FieldType::kMember>>(&readOwn<T, FieldType::kMember>));
        }
    });
}

template <class T>
void walkMessage(Found& found) {
    walkForm<T, Form::Standard>(found);
    if constexpr (wire::kOtherForm<T> != Form::Standard) {
        walkForm<T, wire::kOtherForm<T>>(found);
    }
}

/// `sent`: the units on the wire, in words.
void setUnits(FieldInfo& field, std::string sent) {
    const bool isMeasured = field.dimension != Dimension::None;
    field.unit = isMeasured ? std::string(unitsOf(field.dimension).front().symbol) : sent;
    field.unitSent = field.unit == sent ? std::string() : std::move(sent);
}

std::vector<FieldInfo> headerFields() {
    std::vector<FieldInfo> fields;
    wire::forEachField<wire::Header, Form::Standard>([&]<auto Member>(const wire::Field<Member>& field) {
        FieldInfo info;
        info.name = field.about.name;
        info.qualifier = "header";
        info.kind = kKindOf<wire::MemberValue<Member>>;
        info.read = unitOf(field.about);
        info.dimension = dimensionOf(field.about);
        setUnits(info, std::string(wire::unitSymbol(field.about.unit)));
        info.text = field.about.text;
        info.readPacket = &readHeader<Member>;
        fields.push_back(std::move(info));
    });
    return fields;
}

/// What the types say, each thing once: "m", or "cm (01), m (02 21)" where they differ.
template <class Read>
std::string together(const Draft& draft, Read read) {
    std::vector<std::pair<std::string_view, std::string>> said; // with the types that say it
    for (std::size_t i = 0; i < draft.said.size(); ++i) {
        const std::string_view text = read(draft.said[i]);
        auto place = std::ranges::find(said, text, &std::pair<std::string_view, std::string>::first);
        place = place == said.end() ? said.insert(place, {text, ""}) : place;
        place->second += (place->second.empty() ? "" : " ") + wire::typeDigits(draft.field.types[i]);
    }
    std::erase_if(said, [](const auto& one) { return one.first.empty(); });
    std::string all;
    for (const auto& [text, types] : said) {
        all.append(all.empty() ? "" : ", ").append(text);
        all += types == typesText(draft.field) ? "" : " (" + types + ')';
    }
    return all;
}

const Found& walked() {
    static const Found found = [] {
        Found all;
        wire::Messages::forEach([&]<class T>() { walkMessage<T>(all); });
        return all;
    }();
    return found;
}

/// In any case, and with spaces or without.
bool isSpelled(std::string_view known, std::string_view name) {
    for (const char letter : name) {
        if (letter == ' ') {
            continue;
        }
        if (known.empty() || wire::lower(known.front()) != wire::lower(letter)) {
            return false;
        }
        known.remove_prefix(1);
    }
    return known.empty();
}

} // namespace

std::size_t shapeOf(const Datagram& datagram) {
    std::size_t shape = 0;
    wire::visitMessage(datagram.body, [&]<Form F, class T>(const T&) {
        constexpr std::size_t own = shapeOf<T, F>();
        shape = own;
    });
    return shape;
}

std::size_t itemCount(const Datagram& datagram, std::size_t shape, std::size_t list) {
    const CountItems count = walked().counts[shape][list];
    return count != nullptr ? count(datagram) : 0;
}

std::vector<FieldInfo> wireFields() {
    std::vector<FieldInfo> fields = headerFields();
    for (const Draft& draft : walked().drafts) {
        FieldInfo& field = fields.emplace_back(draft.field);
        setUnits(field,
                 together(draft, [](const wire::About& about) { return wire::unitSymbol(about.unit); }));
        field.text = together(draft, [](const wire::About& about) { return about.text; });
    }
    return fields;
}

std::span<const std::string_view> segmentNames() {
    static const auto names = [] {
        std::array<std::string_view, model::kMaxSegmentCount> all;
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i] = model::segmentName(kAll, static_cast<int>(i));
        }
        return all;
    }();
    return names;
}

std::optional<double> segmentNumber(std::string_view name) {
    const auto names = segmentNames();
    const auto found =
        std::ranges::find_if(names, [&](std::string_view known) { return isSpelled(known, name); });
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<double>(found - names.begin() + 1));
}

} // namespace posewire::field
