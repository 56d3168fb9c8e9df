// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/layouts.h"

/// The forms in which messages come: which one bytes are in, and what the layouts say about each.
namespace posewire::wire {

/// Which of its layouts the payload of a datagram is in. The specification and real senders differ for types
/// 04, 12, 23, 24 and 25; sizes and the first bytes decide. `payload` ends where the datagram (or, if that is
/// shorter, the announced payload) ends. Never fails: what fits no form is reported when it is read.
[[nodiscard]] Form formOf(const Header& header, Bytes payload);

/// Bytes of `payload` that belong to the datagram by its header: all where the payload size is left out. At
/// least one sender counts 12 bytes of a time code and sends the four bytes of its length before them too.
[[nodiscard]] std::size_t sentPayload(const Header& header, Bytes payload);

/// The form that a message comes in besides the standard one; Standard if there is no other.
template <class T>
inline constexpr Form kOtherForm = kHasForm<T, Form::Bare>    ? Form::Bare
                                   : kHasForm<T, Form::Short> ? Form::Short
                                                              : Form::Standard;

/// The form that a value will be written in.
template <class T>
[[nodiscard]] Form formOf(const T& value) {
    if constexpr (kOtherForm<T> != Form::Standard) {
        return value.*kIsStandard<T> ? Form::Standard : kOtherForm<T>;
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

/// Calls f.template operator()<F>(message) with the form that the message of a body will be written in; false
/// for raw bytes.
template <class Function>
bool visitMessage(const Body& body, Function&& f) {
    return std::visit(
        [&]<class T>(const T& message) {
            if constexpr (!std::is_same_v<T, RawBody>) {
                withForm<T>(formOf(message), [&]<Form F>() { f.template operator()<F>(message); });
            }
            return !std::is_same_v<T, RawBody>;
        },
        body);
}

/// Notes in the value which form it is about to be read in; members that the form leaves out lose what an
/// earlier datagram left in them.
template <class T>
void setForm(T& value, Form form) {
    if constexpr (kOtherForm<T> != Form::Standard) {
        if (kIsFixed<T> || formOf(value) != form) {
            value = T{};
        }
        value.*kIsStandard<T> = form == Form::Standard;
    }
}

/// True if the header's number of items gives the size of the payload.
template <class T, Form F = Form::Standard>
inline constexpr bool kIsSized = std::apply(
    []<class... FieldType>(const FieldType&...) {
        const auto isSized = []<class Any>(std::type_identity<Any>) {
            if constexpr (requires { Any::kItemForm; }) {
                return kIsFixed<typename Any::Item, Any::kItemForm> && !Any::kIsCounted;
            } else {
                return Any::kIsValue;
            }
        };
        return (isSized(std::type_identity<FieldType>{}) && ...);
    },
    kLayout<T, F>);

/// Bytes of the payload with that number of items; for messages that are sized.
template <class T, Form F>
constexpr std::size_t sizeWith(std::size_t items) {
    static_assert(kIsSized<T, F>);
    std::size_t size = kWireSize<T, F>;
    forEachList<T, F>(
        [&]<class List>(const List&) { size += items * kWireSize<typename List::Item, List::kItemForm>; });
    return size;
}

/// Calls f(T&) with `body` holding a value of the message type that belongs to `type`, reusing its memory
/// where it already does; false if the type is not known.
template <class Function>
bool withMessage(Body& body, std::uint8_t type, Function&& f) {
    return Messages::with(type, [&]<class T>() {
        T* value = std::get_if<T>(&body);
        f(value != nullptr ? *value : body.emplace<T>());
    });
}

} // namespace posewire::wire
