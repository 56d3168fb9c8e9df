// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/messages.h"

#include <variant>

/// The segments of poses (types 01, 02, 05, 21 and 22), whatever the message.
namespace posewire::wire {

/// Calls f(segments) for the segments of a body that holds a pose; const or not as the body is.
template <class BodyType, class F>
void forSegments(BodyType& body, F&& f) {
    std::visit(
        [&](auto& message) {
            if constexpr (
                requires { message.segments.front().id; } && !requires { message.segments.front().matrix; }) {
                f(message.segments);
            }
        },
        body);
}

/// Calls f(numbers) for the position and the orientation of a segment, whichever it has.
template <class Item, class F>
void forNumbers(Item& item, F&& f) {
    if constexpr (requires { item.position; }) {
        f(item.position);
    }
    if constexpr (requires { item.orientation; }) {
        f(item.orientation);
    }
}

} // namespace posewire::wire
