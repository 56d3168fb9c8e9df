// SPDX-License-Identifier: MIT
#include "core/log/sender_table.h"

namespace posewire::log {

SenderId SenderTable::intern(const SenderInfo& info) {
    if (const auto known = m_ids.find(info); known != m_ids.end()) {
        return known->second;
    }
    const std::size_t count = m_size.load(std::memory_order_relaxed);
    if (count == kCapacity) {
        return static_cast<SenderId>(kCapacity - 1);
    }
    if (count % kBlock == 0) {
        m_blocks[count / kBlock] = std::make_unique<Block>();
    }
    const auto id = static_cast<SenderId>(count);
    if (count == kCapacity - 1) {
        slot(count) = SenderInfo{"other sources", info.transport, 0};
    } else {
        slot(count) = info;
        m_ids.emplace(info, id);
    }
    m_size.store(count + 1, std::memory_order_release);
    return id;
}

const SenderInfo* SenderTable::find(SenderId id) const {
    const auto index = static_cast<std::size_t>(id);
    return index < size() ? &slot(index) : nullptr;
}

} // namespace posewire::log
