// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/scratch.h"
#include "core/log/system_memory.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace posewire::exporting {

/// Numbers that are added one by one and wanted all together at the end. They lie in a scratch: a range of
/// hours takes no memory.
class ScratchColumn {
public:
    explicit ScratchColumn(std::shared_ptr<log::Scratch> scratch) : m_scratch(std::move(scratch)) {}

    /// Adds the numbers of an array, a vector or a span.
    void add(const auto& numbers) {
        for (std::span<const std::byte> bytes = std::as_bytes(std::span(numbers)); !bytes.empty();) {
            const auto used = static_cast<std::size_t>(m_size % kPiece);
            if (used == 0) {
                m_pieces.push_back(m_scratch->bytes(kPiece));
            }
            const std::size_t count = std::min(bytes.size(), kPiece - used);
            std::memcpy(m_pieces.back().get() + used, bytes.data(), count);
            m_size += count;
            bytes = bytes.subspan(count);
        }
    }

    /// In bytes.
    [[nodiscard]] std::uint64_t size() const { return m_size; }
    /// Hands out all of it as it lies in memory, piece by piece. Each leaves memory afterwards, if it is in a
    /// file.
    void visit(auto&& visitor) const {
        for (std::size_t i = 0; i < m_pieces.size(); ++i) {
            const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, m_size - i * kPiece));
            visitor(std::string_view(reinterpret_cast<const char*>(m_pieces[i].get()), size));
            if (m_scratch->hasFile()) {
                log::letGo(m_pieces[i].get(), kPiece);
            }
        }
    }

private:
    static constexpr std::size_t kPiece = std::size_t{16} << 10; ///< bytes

    std::shared_ptr<log::Scratch> m_scratch;
    std::vector<std::shared_ptr<std::byte[]>> m_pieces; ///< all but the last are full
    std::uint64_t m_size = 0;
};

} // namespace posewire::exporting
