// SPDX-License-Identifier: MIT
#include "core/wire/message_parts.h"

#include "core/wire/message_layouts.h"

#include <type_traits>

namespace posewire::wire {
namespace {

/// Calls f(list, hasOwnCount) for each list of a body; const or not as the body is. Lists are the same in all
/// forms of a message.
template <class BodyType, class Function>
void forEachListOf(BodyType& body, Function&& f) {
    std::visit(
        [&]<class Value>(Value& value) {
            using T = std::remove_const_t<Value>;
            if constexpr (!std::is_same_v<T, RawBody>) {
                forEachList<T, Form::Standard>([&]<Form ItemForm, class FieldType>(const FieldType&) {
                    f(
                        value.*FieldType::kMember, requires { FieldType::kMax; });
                });
            }
        },
        body);
}

} // namespace

std::size_t announcedItems(const Body& body) {
    bool hasList = std::holds_alternative<RawBody>(body);
    forEachListOf(body, [&](const auto&, bool) { hasList = true; });
    return hasList ? dividableItems(body) : 1;
}

std::size_t dividableItems(const Body& body) {
    std::size_t items = 0;
    forEachListOf(body, [&](const auto& list, bool hasOwnCount) { items += hasOwnCount ? 0 : list.size(); });
    return items;
}

void keepItems(Body& body, std::size_t from, std::size_t to) {
    forEachListOf(body, [&](auto& list, bool hasOwnCount) {
        if (!hasOwnCount) {
            list.erase(list.begin() + static_cast<std::ptrdiff_t>(to), list.end());
            list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(from));
        }
    });
}

void appendPart(Datagram& whole, const Datagram& part) {
    std::visit(
        [&]<class T>(T& value) {
            const T* next = std::get_if<T>(&part.body);
            if constexpr (!std::is_same_v<T, RawBody>) {
                forEachList<T, Form::Standard>([&]<Form ItemForm, class FieldType>(const FieldType&) {
                    if (next != nullptr) {
                        const auto& items = next->*FieldType::kMember;
                        auto& list = value.*FieldType::kMember;
                        list.insert(list.end(), items.begin(), items.end());
                    }
                });
            }
        },
        whole.body);
    whole.notices.insert(whole.notices.end(), part.notices.begin(), part.notices.end());
}

} // namespace posewire::wire
