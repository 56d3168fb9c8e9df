// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

/// What is kept of senders within one budget of memory, however many of them there are.
namespace posewire::model {

/// Something that a holder can give up: what is needed less goes first, then what is older.
struct Droppable {
    int need = 0;
    log::Stamp stamp{};
    friend constexpr auto operator<=>(const Droppable&, const Droppable&) = default;
};

/// Looks after all holders of one kind. Each has memoryBytes(), oldest() (the next it can give up, nothing
/// where it holds nothing) and dropOldest() (how many bytes that freed). They are counted only where they
/// have grown by a part of the budget, so that an addition costs nothing on average.
class Keeping {
public:
    explicit Keeping(std::size_t budget) : m_budget(budget) {}

    /// A holder had `before` bytes and has `after`. True where keepWithin() is due.
    [[nodiscard]] bool grew(std::size_t before, std::size_t after) {
        m_growth += after > before ? after - before : 0;
        return m_growth > m_budget / kParts;
    }

    /// Gives up what is needed least until the holders take no more than the budget, less what they may grow
    /// by until the next time. Pointers to them.
    template <class Holder>
    void keepWithin(const std::vector<Holder*>& holders) {
        using Next = std::pair<Droppable, Holder*>;
        constexpr auto isLater = [](const Next& a, const Next& b) { return a.first > b.first; };
        std::priority_queue<Next, std::vector<Next>, decltype(isLater)> next(isLater);
        std::size_t bytes = 0;
        const auto put = [&next](Holder* holder) {
            if (const auto oldest = holder->oldest()) {
                next.emplace(*oldest, holder);
            }
        };
        for (Holder* holder : holders) {
            bytes += holder->memoryBytes();
            put(holder);
        }
        const std::size_t most = m_budget - 2 * (m_budget / kParts);
        while (bytes > most && !next.empty()) {
            Holder* const holder = next.top().second;
            next.pop();
            bytes -= std::min(bytes, holder->dropOldest());
            put(holder);
        }
        m_growth = 0;
    }

private:
    static constexpr std::size_t kParts = 8;

    std::size_t m_budget;
    std::size_t m_growth = 0;
};

} // namespace posewire::model
