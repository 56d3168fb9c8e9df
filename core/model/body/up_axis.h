// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/units.h"
#include "core/wire/messages.h"

#include <algorithm>
#include <cstddef>
#include <variant>

/// The two right-handed frames that types 02, 21 and 22 may come in: (x, y, z) of Y-up is (y, z, x) of Z-up.
namespace posewire::model {

/// To a frame from the other one. A rotation has its axis last.
template <class... Vectors>
void permute(UpAxis to, Vectors&... vectors) {
    const std::ptrdiff_t places = to == UpAxis::Z ? 2 : 1;
    (std::rotate(vectors.end() - 3, vectors.end() - 3 + places, vectors.end()), ...);
}

inline void turnTo(UpAxis up, wire::PoseQuaternion& message) {
    for (wire::SegmentQuaternion& item : message.segments) {
        permute(up, item.position, item.orientation);
    }
}

inline void turnTo(UpAxis up, wire::LinearKinematics& message) {
    for (wire::LinearSegment& item : message.segments) {
        permute(up, item.position, item.velocity, item.acceleration);
    }
}

inline void turnTo(UpAxis up, wire::AngularKinematics& message) {
    for (wire::AngularSegment& item : message.segments) {
        permute(up, item.orientation, item.angularVelocity, item.angularAcceleration);
    }
}

/// Other types stay as they are.
template <class Body>
void turnBodyTo(UpAxis up, Body& body) {
    std::visit(
        [up](auto& message) {
            if constexpr (requires { turnTo(up, message); }) {
                turnTo(up, message);
            }
        },
        body);
}

} // namespace posewire::model
