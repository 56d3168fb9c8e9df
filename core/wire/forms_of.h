// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/form.h"

#include <type_traits>

namespace posewire::wire {

/// Calls f.template operator()<F>() with the form as a constant, for the forms that the message type T has.
template <class T, class Function>
decltype(auto) withForm(Form form, Function&& f) {
    if constexpr (std::is_same_v<T, MetaData> || std::is_same_v<T, TimeCode>) {
        if (form == Form::Bare) {
            return f.template operator()<Form::Bare>();
        }
    } else if constexpr (std::is_same_v<T, TrackerKinematics> || std::is_same_v<T, CentreOfMass>) {
        if (form == Form::Short) {
            return f.template operator()<Form::Short>();
        }
    }
    return f.template operator()<Form::Standard>();
}

/// Notes in the value which form it is about to be read in; members that the form leaves out lose what an
/// earlier datagram left in them.
template <class T>
void setForm(T& value, Form form) {
    if constexpr (std::is_same_v<T, MetaData>) {
        value.hasLengthPrefix = form == Form::Standard;
    } else if constexpr (std::is_same_v<T, TimeCode>) {
        value.hasLengthPrefix = form == Form::Standard;
        value.length = T{}.length;
    } else if constexpr (std::is_same_v<T, TrackerKinematics>) {
        if (value.hasInertialData && form == Form::Short) {
            value.trackers.clear();
        }
        value.hasInertialData = form == Form::Standard;
    } else if constexpr (std::is_same_v<T, CentreOfMass>) {
        value.velocity = value.acceleration = Vec3{};
        value.hasDerivatives = form == Form::Standard;
    }
}

/// Calls f(T&) with `body` holding a value of the message type that belongs to `type`, reusing its memory
/// where it already does; false where the type is not known.
template <class Function>
bool withMessage(Body& body, std::uint8_t type, Function&& f) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        const auto tryOne = [&]<class T>(std::type_identity<T>) {
            if constexpr (std::is_same_v<T, RawBody>) {
                return false;
            } else {
                if (T::kType != type) {
                    return false;
                }
                T* value = std::get_if<T>(&body);
                f(value != nullptr ? *value : body.emplace<T>());
                return true;
            }
        };
        return (tryOne(std::type_identity<std::variant_alternative_t<I, Body>>{}) || ...);
    }
    (std::make_index_sequence<std::variant_size_v<Body>>{});
}

} // namespace posewire::wire
