// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <unordered_map>

namespace posewire::log {

/// The senders of a log. One thread (the log's writer) interns, any thread reads; nothing ever moves or
/// disappears.
class SenderTable {
public:
    /// A sender that forges its address must not grow the table for ever: all senders beyond this many share
    /// the last entry.
    static constexpr std::size_t kCapacity = 4096;

    /// The id of `info`, new if need be. Writer's thread only.
    SenderId intern(const SenderInfo& info);

    [[nodiscard]] std::size_t size() const { return m_size.load(std::memory_order_acquire); }

    /// Null where there is no such sender. The result stays valid as long as the table.
    [[nodiscard]] const SenderInfo* find(SenderId id) const;

private:
    static constexpr std::size_t kBlock = 64;
    using Block = std::array<SenderInfo, kBlock>;

    [[nodiscard]] SenderInfo& slot(std::size_t index) const {
        return (*m_blocks[index / kBlock])[index % kBlock];
    }

    std::array<std::unique_ptr<Block>, kCapacity / kBlock> m_blocks;
    std::atomic<std::size_t> m_size = 0;

    struct Hash {
        std::size_t operator()(const SenderInfo& info) const {
            return std::hash<std::string>{}(info.address) + std::size_t{31} * info.localPort +
                   static_cast<std::size_t>(info.transport);
        }
    };
    std::unordered_map<SenderInfo, SenderId, Hash> m_ids; ///< the writer's own
};

} // namespace posewire::log
