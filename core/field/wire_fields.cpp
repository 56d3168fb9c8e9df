// SPDX-License-Identifier: MIT
#include "core/field/field.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/item_names.h"
#include "core/model/body/joint_angles.h"
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

/// See numberNamed; 0 if it has no name.
double numberOf(const model::PointReference& reference) {
    const model::AnatomicalPoint* point = model::findPoint(reference.segmentId - 1, reference.localId);
    return point != nullptr ? *numberNamed(Kind::Point, point->name) : 0;
}

/// The wire's own number, of a joint that of its child; items without one count from 1.
template <class T, Form ItemForm, auto List>
Value readSegment(const Datagram& datagram, std::size_t item, std::size_t) {
    const auto& items = bodyOf<T>(datagram).*List;
    double number = static_cast<double>(item + 1);
    wire::forEachField<std::decay_t<decltype(items[0])>, ItemForm>(
        [&]<class FieldType>(const FieldType& field) {
            using enum wire::RefersTo;
            constexpr auto kMember = FieldType::kMember;
            if constexpr (std::is_unsigned_v<wire::MemberValue<kMember>>) {
                const std::uint32_t id = items[item].*kMember;
                const wire::RefersTo what = field.about.refersTo;
                if (what == Point) {
                    number = model::pointReference(id, items.front().*kMember).segmentId;
                } else if (what == JointEnd) {
                    number = id >> 8;
                } else if (what == Segment || what == UnitySegment || what == Tracker || what == Prop) {
                    number = id;
                }
            }
        });
    return {number, {}};
}
template <class T, auto List>
Value readNamedSegment(const Datagram& datagram, std::size_t item, std::size_t) {
    const auto& one = (bodyOf<T>(datagram).*List)[item];
    if constexpr (requires { one.name; }) {
        return {numberNamed(Kind::Segment, one.name).value_or(0), {}};
    }
    return {static_cast<double>(model::segmentOfItem(datagram, item)), {}};
}
template <class T, auto List>
Value readNamedPoint(const Datagram& datagram, std::size_t item, std::size_t) {
    const auto& items = bodyOf<T>(datagram).*List;
    if constexpr (requires { items[item].id; }) {
        return {numberOf(model::pointReference(items[item].id, items.front().id)), {}};
    } else if constexpr (requires { items[item].name; }) {
        return {numberNamed(Kind::Point, items[item].name).value_or(0), {}};
    }
    return {};
}
template <class T, auto List, auto Member>
Value readNamedEnd(const Datagram& datagram, std::size_t item, std::size_t) {
    return {numberOf(*model::decodePointId(model::PointIdCoding::By256,
                                           (bodyOf<T>(datagram).*List)[item].*Member)),
            {}};
}
Value readPlace(const Datagram&, std::size_t item, std::size_t) {
    return {static_cast<double>(item + 1), {}};
}
Value readNamedJoint(const Datagram& datagram, std::size_t item, std::size_t) {
    return {numberNamed(Kind::Joint, model::itemName(datagram, item)).value_or(0), {}};
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
void addItems(Found& found, const Spot& spot, const List& list) {
    found.counts[spot.shape][spot.list] = [](const Datagram& datagram) {
        return (bodyOf<T>(datagram).*List::kMember).size();
    };
    wire::forEachField<typename List::Item, List::kItemForm>([&]<class FieldType>(const FieldType& field) {
        constexpr ReadItem read = &readListed<T, List::kMember, FieldType::kMember>;
        Reading reading = readingOf<wire::MemberValue<FieldType::kMember>>(read);
        if (field.about.refersTo == wire::RefersTo::Carrier) {
            reading = {Kind::Segment, 1, read, read};
        } else if (field.about.refersTo == wire::RefersTo::LocalPoint) {
            reading = {Kind::Point, 1, read, &readNamedPoint<T, List::kMember>};
        }
        if constexpr (std::is_unsigned_v<wire::MemberValue<FieldType::kMember>>) {
            if (field.about.refersTo == wire::RefersTo::JointEnd) {
                reading = {Kind::Point, 1, read, &readNamedEnd<T, List::kMember, FieldType::kMember>};
            } else if (field.about.refersTo == wire::RefersTo::Point) {
                add(found, spot, {"point", wire::Unit::Identifier, "the marker, by id or name", ""},
                    {Kind::Point, 1, read, &readNamedPoint<T, List::kMember>});
            }
        }
        add(found, spot, field.about, reading);
    });
    if (list.about.refersTo == wire::RefersTo::Joint) {
        add(found, spot, {"joint", wire::Unit::Identifier, "the joint, by place or name", ""},
            {Kind::Joint, 1, &readPlace, &readNamedJoint});
    }
    if (!namesItsSegment<List>()) {
        constexpr bool isFurther = T::kType > wire::TimeCode::kType; // only the wire knows its items
        constexpr ReadItem read = &readSegment<T, List::kItemForm, List::kMember>;
        constexpr wire::About segment{"segment", wire::Unit::Identifier,
                                      "the segment that the item is about, by id or name", ""};
        add(found, spot, segment,
            {Kind::Segment, 1, read, isFurther ? read : &readNamedSegment<T, List::kMember>});
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
            addItems<T>(found, spot, field);
        } else {
            add(found, own, field.about,
                readingOf<wire::MemberValue<FieldType::kMember>>(&readOwn<T, FieldType::kMember>));
        }
    });
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
        wire::Messages::forEach([&]<class T>() {
            walkForm<T, Form::Standard>(all);
            if constexpr (wire::kOtherForm<T> != Form::Standard) {
                walkForm<T, wire::kOtherForm<T>>(all);
            }
        });
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

std::size_t Subject::shape() {
    if (!m_shape) {
        m_shape = shapeOf(*candidate.datagram);
    }
    return *m_shape;
}

std::uint8_t typeOfShape(std::size_t shape) {
    std::uint8_t type = 0;
    std::size_t at = 0;
    wire::Messages::forEach([&]<class T>() { type = ++at == shape % kBodies ? T::kType : type; });
    return type;
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

std::span<const std::string_view> namesOf(Kind kind) {
    static const auto segments = [] {
        std::vector<std::string_view> all;
        for (int i = 0; i < model::kAllSegments.count(); ++i) {
            all.push_back(model::segmentName(model::kAllSegments, i));
        }
        return all;
    }();
    static const auto points = [] {
        std::vector<std::string_view> all; // several segments have one of the same name
        for (const model::AnatomicalPoint& point : model::anatomicalPoints()) {
            if (std::ranges::find(all, point.name) == all.end()) {
                all.push_back(point.name);
            }
        }
        return all;
    }();
    static const auto joints = [] {
        std::vector<std::string_view> all;
        std::ranges::transform(model::jointDefinitions(), std::back_inserter(all),
                               &model::JointDefinition::name);
        return all;
    }();
    return kind == Kind::Segment ? std::span(segments)
           : kind == Kind::Point ? std::span(points)
           : kind == Kind::Joint ? std::span(joints)
                                 : std::span<const std::string_view>();
}

std::optional<double> numberNamed(Kind kind, std::string_view name) {
    const auto names = namesOf(kind);
    const auto found =
        std::ranges::find_if(names, [&](std::string_view known) { return isSpelled(known, name); });
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<double>(found - names.begin() + 1));
}

} // namespace posewire::field
