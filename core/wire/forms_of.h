// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/form.h"
#include "core/wire/message_layouts.h"

#include <type_traits>

/// What the layouts say about the forms of each message.
namespace posewire::wire {

/// The form that a message comes in besides the standard one; Standard where there is no other.
template <class T>
inline constexpr Form kOtherForm = kHasForm<T, Form::Bare>    ? Form::Bare
                                   : kHasForm<T, Form::Short> ? Form::Short
                                                              : Form::Standard;

/// The form that a value will be written in.
template <class T>
[[nodiscard]] Form formOf(const T& value) {
    if constexpr (kOtherForm<T> != Form::Standard) {
        return value.*Layout<T, kOtherForm<T>>::isStandard ? Form::Standard : kOtherForm<T>;
    } else {
        return Form::Standard;
    }
}

/// Calls f.template operator()<F>() with the form as a constant, for the forms that the message type T has.
template <class T, class Function>
decltype(auto) withForm(Form form, Function&& f) {
    if constexpr (kOtherForm<T> != Form::Standard) {
        if (form == kOtherForm<T>) {
            return f.template operator()<kOtherForm<T>>();
        }
    }
    return f.template operator()<Form::Standard>();
}

/// Notes in the value which form it is about to be read in; members that the form leaves out lose what an
/// earlier datagram left in them.
template <class T>
void setForm(T& value, Form form) {
    if constexpr (kOtherForm<T> != Form::Standard) {
        if (kIsFixed<T> || formOf(value) != form) {
            value = T{};
        }
        value.*Layout<T, kOtherForm<T>>::isStandard = form == Form::Standard;
    }
}

namespace detail {

/// True where the number of items gives the size.
template <class T, Form F>
constexpr bool isSized() {
    bool isSized = true;
    forEachField<T, F>([&]<class FieldType>(const FieldType&) {
        if constexpr (requires { FieldType::kItemForm; }) {
            using Item = typename MemberValue<FieldType::kMember>::value_type;
            isSized = isSized && kIsFixed<Item, FieldType::kItemForm> && !requires {
                FieldType::kMax;
            };
        } else {
            isSized = isSized && FixedSize<FieldType>::isFixed;
        }
    });
    return isSized;
}

} // namespace detail

/// True where the header's number of items gives the size of the payload.
template <class T, Form F = Form::Standard>
inline constexpr bool kIsSized = detail::isSized<T, F>();

/// Bytes of the payload with that number of items; for messages that are sized.
template <class T, Form F>
constexpr std::size_t sizeWith(std::size_t items) {
    static_assert(kIsSized<T, F>);
    std::size_t size = kWireSize<T, F>;
    forEachList<T, F>([&]<Form ItemForm, class FieldType>(const FieldType&) {
        size += items * kWireSize<typename MemberValue<FieldType::kMember>::value_type, ItemForm>;
    });
    return size;
}

/// Calls f(T&) with `body` holding a value of the message type that belongs to `type`, reusing its memory
/// where it already does; false where the type is not known.
template <class Function>
bool withMessage(Body& body, std::uint8_t type, Function&& f) {
    return Messages::with(type, [&]<class T>() {
        T* value = std::get_if<T>(&body);
        f(value != nullptr ? *value : body.emplace<T>());
    });
}

} // namespace posewire::wire
