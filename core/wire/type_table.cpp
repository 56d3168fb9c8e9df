// SPDX-License-Identifier: MIT
#include "core/wire/type_table.h"

#include "core/wire/form.h"

#include <algorithm>

namespace posewire::wire {

template <>
constexpr TypeInfo kRow<PoseEuler>{
    "Pose, Euler", Frame::YUp, "E–N", "2.5.1",
    "Centimetres and degrees. The same data as type 02: (x, y, z) is 100 · (y, z, x) of it. "
    "Since N the fingers of both hands follow body and props."};
template <>
constexpr TypeInfo kRow<PoseQuaternion>{"Pose, quaternion", Frame::ZUp, "E–N", "2.5.2",
                                        "Metres on the wire, although the specification says centimetres. It "
                                        "also allows Y-up: the sender's body shows which."};
template <>
constexpr TypeInfo kRow<PointPositions>{
    "Point positions", Frame::YUp, "E–N", "2.5.3",
    "Point IDs are 256 × segment + point, in older revisions 100 × segment + point. The "
    "specification says 38 to 46 points; the usual set has 64."};
template <>
constexpr TypeInfo kRow<TagPositions>{"Tag positions", Frame::YUp, "E", "E 2.5",
                                      "Only tags that were updated are sent. Deprecated since J. Newer "
                                      "programs use the number for a layout that is not published."};
template <>
constexpr TypeInfo kRow<PoseUnity>{"Pose, Unity3D", Frame::Unity, "F–N", "2.5.5",
                                   "The pelvis is global, all others are relative to their parents, in an "
                                   "order of their own. N says of props both that they are global and that "
                                   "they are not supported: here they are neither named nor drawn."};
template <>
constexpr TypeInfo kRow<ScaleInformation>{"Scale (deprecated)",   Frame::ZUp, "E", "E 2.6",
                                          "Replaced by type 13.", false};
template <>
constexpr TypeInfo kRow<PropInformation>{"Props (deprecated)",
                                         Frame::None,
                                         "E",
                                         "E 2.6",
                                         "Names end with a zero byte. Replaced by type 13.",
                                         false};
template <>
constexpr TypeInfo kRow<MetaData>{"Metadata",
                                  Frame::None,
                                  "E–N",
                                  "2.6.3",
                                  "Real senders put a length before the text; revision E has the bare text. "
                                  "The tags count and timeOffset are not documented.",
                                  false};
template <>
constexpr TypeInfo kRow<NullPose>{
    "Null pose",
    Frame::ZUp,
    "J–N",
    "2.6.4",
    "Comes in several datagrams with sample counter 0: segments first, then points. Metres.",
    false};
template <>
constexpr TypeInfo kRow<JointAngles>{
    "Joint angles", Frame::Isb, "J–N", "2.7.1",
    "22 joints in the specification; real senders add 4 or 6 ergonomic angles (26 or 28 items), two "
    "of which have the same pair of IDs. Angles are about the ISB axes of the joint, "
    "although the specification names the axes of the segment."};
template <>
constexpr TypeInfo kRow<LinearKinematics>{"Linear kinematics", Frame::ZUp, "J–N", "2.7.2"};
template <>
constexpr TypeInfo kRow<AngularKinematics>{"Angular kinematics", Frame::ZUp, "J–N", "2.7.3",
                                           "Radians per second."};
template <>
constexpr TypeInfo kRow<TrackerKinematics>{
    "Trackers", Frame::ZUp, "J–N", "2.7.4",
    "68 bytes an item on the wire; 44 in the specification since M. The payload size shows which."};
template <>
constexpr TypeInfo kRow<CentreOfMass>{"Centre of mass", Frame::ZUp, "J–N", "2.7.5",
                                      "Recent senders add velocity and acceleration (36 bytes)."};
template <>
constexpr TypeInfo kRow<TimeCode>{"Time code", Frame::None, "J–N", "2.7.6",
                                  "Real senders put the length 12 before the text."};

namespace {

template <class T, Form F>
constexpr auto rowsOf();

template <class T, Form F>
constexpr auto kRows = rowsOf<T, F>();

template <auto Member>
constexpr FieldRow rowOf(const Field<Member>& field) {
    using Value = MemberValue<Member>;
    FieldRow row{field.about};
    row.scalar = kScalar<Value>;
    row.components = kComponents<Value>;
    row.size = sizeof(Value);
    return row;
}
template <auto Member, TextKind Kind>
constexpr FieldRow rowOf(const Text<Member, Kind>& field) {
    FieldRow row{field.about, FieldRow::Kind::Text};
    row.textKind = Kind;
    return row;
}
template <auto Member, Form ItemForm, std::size_t Max>
constexpr FieldRow rowOf(const Items<Member, ItemForm, Max>& field) {
    using Item = typename MemberValue<Member>::value_type;
    FieldRow row{field.about, field.kIsCounted ? FieldRow::Kind::CountedItems : FieldRow::Kind::Items};
    row.least = kWireSize<Item, ItemForm>;
    row.size = kIsFixed<Item, ItemForm> ? row.least : 0;
    row.max = Max;
    row.items = kRows<Item, ItemForm>;
    return row;
}

template <class T, Form F>
constexpr auto rowsOf() {
    return std::apply([](const auto&... field) { return std::array{rowOf(field)...}; }, kLayout<T, F>);
}

template <class T, Form F>
constexpr FormRow kForm{F, kIsFixed<T, F> ? kWireSize<T, F> : 0, kRows<T, F>};

template <class T>
constexpr auto formsOf() {
    if constexpr (kOtherForm<T> != Form::Standard) {
        return std::array{kForm<T, Form::Standard>, kForm<T, kOtherForm<T>>};
    } else {
        return std::array{kForm<T, Form::Standard>};
    }
}
template <class T>
constexpr auto kForms = formsOf<T>();

template <class Message>
constexpr TypeInfo typeOf() {
    TypeInfo row = kRow<Message>;
    row.type = Message::kType;
    row.forms = kForms<Message>;
    return row;
}
template <class... Message>
constexpr auto typesOf(MessageList<Message...>) {
    return std::array{typeOf<Message>()...};
}
constexpr auto kTypes = typesOf(Messages{});

constexpr bool identifiersReferToSomething(std::span<const FieldRow> rows) {
    return std::ranges::all_of(rows, [](const FieldRow& row) {
        const bool refers = row.about.refersTo != RefersTo::Nothing;
        return (refers || row.about.unit != Unit::Identifier) && identifiersReferToSomething(row.items);
    });
}
static_assert(std::ranges::all_of(kTypes,
                                  [](const TypeInfo& row) {
                                      return std::ranges::all_of(row.forms, [](const FormRow& form) {
                                          return identifiersReferToSomething(form.fields);
                                      });
                                  }),
              "an identifier has to say what it refers to");

bool hasList(std::uint8_t type, bool (*isWanted)(const FieldRow&)) {
    const TypeInfo* row = findType(type);
    return row != nullptr && std::ranges::any_of(row->fields(), isWanted);
}

} // namespace

std::span<const TypeInfo> typeTable() {
    return kTypes;
}

const TypeInfo* findType(std::uint8_t type) {
    const auto found = std::ranges::find(kTypes, type, &TypeInfo::type);
    return found == kTypes.end() ? nullptr : &*found;
}

std::string_view frameName(Frame frame) {
    constexpr std::array<std::string_view, 5> names{"", "Z-up, right-handed", "Y-up, right-handed",
                                                    "Y-up, left-handed", "ISB axes"};
    return names[static_cast<std::size_t>(frame)];
}

std::string typeDigits(std::uint8_t type) {
    return {static_cast<char>('0' + type / 10 % 10), static_cast<char>('0' + type % 10)};
}

std::string typeTitle(std::uint8_t type) {
    const TypeInfo* row = findType(type);
    return typeDigits(type) + ' ' + std::string(row != nullptr ? row->name : "unknown type");
}

/// Asked several times of every packet.
bool isSampled(std::uint8_t type) {
    static constexpr auto kSampled = [] {
        std::array<bool, 256> all{};
        all.fill(true);
        for (const TypeInfo& row : kTypes) {
            all[row.type] = row.isSampled;
        }
        return all;
    }();
    return kSampled[type];
}

std::string_view unitSymbol(Unit unit) {
    constexpr std::array<std::string_view, 17> kSymbols{
        "", "", "", "bytes", "", "ms", "m", "cm", "°", "m/s", "m/s²", "rad/s", "rad/s²", "a.u.", "", "", ""};
    return kSymbols[static_cast<std::size_t>(unit)];
}

std::string_view scalarName(Scalar scalar) {
    constexpr std::array<std::string_view, 7> names{"uint8",   "uint16",     "uint32", "int32",
                                                    "float32", "characters", "text"};
    return names[static_cast<std::size_t>(scalar)];
}

std::span<const std::string_view> componentNames(std::size_t components) {
    static constexpr std::array<std::string_view, 3> vector{"x", "y", "z"};
    static constexpr std::array<std::string_view, 4> quaternion{"re", "i", "j", "k"};
    static constexpr std::array<std::string_view, 9> matrix{"1,1", "1,2", "1,3", "2,1", "2,2",
                                                            "2,3", "3,1", "3,2", "3,3"};
    switch (components) {
    case vector.size():
        return vector;
    case quaternion.size():
        return quaternion;
    case matrix.size():
        return matrix;
    default:
        return {};
    }
}

std::span<const FieldRow> headerRows() {
    return kRows<Header, Form::Standard>;
}

bool listsSegments(std::uint8_t type) {
    return hasList(type, [](const FieldRow& row) {
        return row.kind == FieldRow::Kind::Items &&
               (row.about.refersTo == RefersTo::Segment || row.about.refersTo == RefersTo::UnitySegment);
    });
}

bool countsSegments(std::uint8_t type) {
    return isSampled(type) && hasList(type, [](const FieldRow& row) {
               return row.kind == FieldRow::Kind::Items && row.about.refersTo == RefersTo::Segment;
           });
}

} // namespace posewire::wire
