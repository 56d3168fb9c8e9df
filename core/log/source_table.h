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

/// The sources of a log. One thread (the log's writer) interns, any thread reads; nothing ever moves or
/// disappears.
class SourceTable {
public:
    /// A sender that forges its address must not grow the table for ever: all sources beyond this many share
    /// the last entry.
    static constexpr std::size_t kCapacity = 4096;

    SourceTable();

    /// The id of `info`, new if need be. Writer's thread only.
    SourceId intern(const SourceInfo& info);

    [[nodiscard]] std::size_t size() const { return m_size.load(std::memory_order_acquire); }

    /// Null where there is no such source. The result stays valid as long as the table.
    [[nodiscard]] const SourceInfo* find(SourceId id) const;

private:
    static constexpr std::size_t kBlock = 64;
    using Block = std::array<SourceInfo, kBlock>;

    [[nodiscard]] SourceInfo& slot(std::size_t index) const {
        return (*m_blocks[index / kBlock])[index % kBlock];
    }

    std::array<std::unique_ptr<Block>, kCapacity / kBlock> m_blocks;
    std::atomic<std::size_t> m_size = 0;

    struct Hash {
        std::size_t operator()(const SourceInfo& info) const {
            return std::hash<std::string>{}(info.address) + std::size_t{31} * info.localPort +
                   static_cast<std::size_t>(info.transport);
        }
    };
    std::unordered_map<SourceInfo, SourceId, Hash> m_ids; ///< the writer's own
};

} // namespace posewire::log
