// SPDX-License-Identifier: MIT
#include "core/model/session/message_parts.h"

namespace posewire::model {
namespace {

template <class Item>
void append(std::vector<Item>& whole, const std::vector<Item>& part) {
    whole.insert(whole.end(), part.begin(), part.end());
}

template <class T>
void appendItems(T& whole, const T& part) {
    if constexpr (requires { whole.segments; }) {
        append(whole.segments, part.segments);
    }
    if constexpr (requires { whole.points; }) {
        append(whole.points, part.points);
    }
    if constexpr (requires { whole.joints; }) {
        append(whole.joints, part.joints);
    }
    if constexpr (requires { whole.trackers; }) {
        append(whole.trackers, part.trackers);
    }
    if constexpr (requires { whole.props; }) {
        append(whole.props, part.props);
    }
}

} // namespace

void appendPart(wire::Datagram& whole, const wire::Datagram& part) {
    std::visit(
        [&]<class T>(T& value) {
            if (const T* next = std::get_if<T>(&part.body)) {
                appendItems(value, *next);
            }
        },
        whole.body);
    whole.notices.insert(whole.notices.end(), part.notices.begin(), part.notices.end());
}

} // namespace posewire::model
