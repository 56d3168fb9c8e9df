// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"

#include <cstddef>
#include <memory>

namespace posewire::log {

/// The senders of a log, by number. An entry lasts as long as somebody holds it: the log those of the packets
/// that it has, a session those that it lists. So forged addresses cannot fill the table for good, and no
/// packet is without its sender. Safe from any thread.
class SenderTable {
public:
    using Held = std::shared_ptr<const SenderInfo>;

    /// The newest ones are held by the table itself, until their first packet is in the log.
    static constexpr std::size_t kNewest = 1024;

    SenderTable();

    /// The number of `info`, a new one where it has no holder. Numbers grow and are never used twice.
    SenderId intern(const SenderInfo& info);

    /// Null if it has no holder any more.
    [[nodiscard]] Held find(SenderId id) const;

    [[nodiscard]] std::size_t size() const;

private:
    struct State;
    std::shared_ptr<State> m_state; ///< shared with the entries, which may outlive the table
};

/// Finds senders for one reader, the last one without asking the table again.
class SenderFinder {
public:
    explicit SenderFinder(const SenderTable& table) : m_table(table) {}

    /// Null if it has no holder any more. Valid until the next call.
    [[nodiscard]] const SenderInfo* find(SenderId id) {
        if (m_last == nullptr || id != m_lastId) {
            m_last = m_table.find(id);
            m_lastId = id;
        }
        return m_last.get();
    }

private:
    const SenderTable& m_table;
    SenderTable::Held m_last;
    SenderId m_lastId{};
};

} // namespace posewire::log
