// SPDX-License-Identifier: MIT
#include "core/log/sender_table.h"

#include <deque>
#include <functional>
#include <mutex>
#include <unordered_map>

namespace posewire::log {
namespace {

struct Hash {
    std::size_t operator()(const SenderInfo* info) const {
        return std::hash<std::string>{}(info->address) + std::size_t{31} * info->localPort +
               static_cast<std::size_t>(info->transport) + std::hash<std::string>{}(info->probe);
    }
};

struct Equal {
    bool operator()(const SenderInfo* a, const SenderInfo* b) const { return *a == *b; }
};

} // namespace

/// No entry may be let go while the mutex is held, since its deleter locks it.
struct SenderTable::State {
    std::mutex mutex; ///< guards all members
    std::unordered_map<const SenderInfo*, SenderId, Hash, Equal> numbers;
    std::unordered_map<SenderId, std::weak_ptr<const SenderInfo>> entries;
    std::deque<Held> newest;
    std::uint32_t next = 0;

    void forget(SenderId id, const SenderInfo* info) {
        {
            const std::lock_guard lock(mutex);
            entries.erase(id);
            const auto known = numbers.find(info);
            if (known != numbers.end() && known->second == id) {
                numbers.erase(known);
            }
        }
        delete info;
    }
};

SenderTable::SenderTable() : m_state(std::make_shared<State>()) {}

SenderId SenderTable::intern(const SenderInfo& info) {
    Held known;
    Held oldest;
    const std::lock_guard lock(m_state->mutex);
    const auto number = m_state->numbers.find(&info);
    if (number != m_state->numbers.end()) {
        known = m_state->entries[number->second].lock();
        if (known) {
            return number->second;
        }
        m_state->numbers.erase(number); // the last one who held it is just letting go
    }
    const auto id = static_cast<SenderId>(m_state->next++);
    // The table's end may come first: entries hold the state weakly while it holds them.
    known = Held(new SenderInfo(info), [id, owner = std::weak_ptr(m_state)](const SenderInfo* entry) {
        if (const auto state = owner.lock()) {
            state->forget(id, entry);
        } else {
            delete entry;
        }
    });
    m_state->numbers.emplace(known.get(), id);
    m_state->entries.emplace(id, known);
    m_state->newest.push_back(known);
    if (m_state->newest.size() > kNewest) {
        oldest = std::move(m_state->newest.front());
        m_state->newest.pop_front();
    }
    return id;
}

SenderTable::Held SenderTable::find(SenderId id) const {
    const std::lock_guard lock(m_state->mutex);
    const auto entry = m_state->entries.find(id);
    return entry == m_state->entries.end() ? nullptr : entry->second.lock();
}

std::size_t SenderTable::size() const {
    const std::lock_guard lock(m_state->mutex);
    return m_state->entries.size();
}

} // namespace posewire::log
