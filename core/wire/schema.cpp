// SPDX-License-Identifier: MIT
#include "core/wire/schema.h"

#include "core/wire/forms_of.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::wire {
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
template <auto Member, Form ItemForm>
constexpr FieldRow rowOf(const Items<Member, ItemForm>& field) {
    using Item = typename MemberValue<Member>::value_type;
    FieldRow row{field.about, FieldRow::Kind::Items};
    row.least = kWireSize<Item, ItemForm>;
    row.size = kIsFixed<Item, ItemForm> ? row.least : 0;
    row.items = kRows<Item, ItemForm>;
    return row;
}
template <auto Member, std::size_t Max>
constexpr FieldRow rowOf(const CountedList<Member, Max>& field) {
    using Item = typename MemberValue<Member>::value_type;
    FieldRow row{field.about, FieldRow::Kind::CountedItems};
    row.least = kWireSize<Item>;
    row.size = kIsFixed<Item> ? row.least : 0;
    row.max = Max;
    row.items = kRows<Item, Form::Standard>;
    return row;
}

template <class T, Form F>
constexpr auto rowsOf() {
    return std::apply([](const auto&... field) { return std::array{rowOf(field)...}; }, Layout<T, F>::fields);
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

template <class... Message>
constexpr auto rowsOf(MessageList<Message...>) {
    return std::array{MessageRow{Message::kType, kForms<Message>}...};
}
constexpr auto kMessages = rowsOf(Messages{});

constexpr bool identifiersReferToSomething(std::span<const FieldRow> rows) {
    return std::ranges::all_of(rows, [](const FieldRow& row) {
        const bool refers = row.about.refersTo != RefersTo::Nothing;
        return (refers || row.about.unit != Unit::Identifier) && identifiersReferToSomething(row.items);
    });
}
static_assert(std::ranges::all_of(kMessages,
                                  [](const MessageRow& message) {
                                      return std::ranges::all_of(message.forms, [](const FormRow& form) {
                                          return identifiersReferToSomething(form.fields);
                                      });
                                  }),
              "an identifier has to say what it refers to");

bool hasList(std::uint8_t type, bool (*isWanted)(const FieldRow&)) {
    const MessageRow* message = findMessage(type);
    return message != nullptr && std::ranges::any_of(message->fields(), isWanted);
}

} // namespace

std::span<const MessageRow> messageRows() {
    return kMessages;
}

const MessageRow* findMessage(std::uint8_t type) {
    const auto found = std::ranges::find(kMessages, type, &MessageRow::type);
    return found == kMessages.end() ? nullptr : &*found;
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
