// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"

namespace posewire::log {

/// Appends what is written to a vector, which outlives this; it never fails.
class MemorySink final : public ByteSink {
public:
    explicit MemorySink(std::vector<std::byte>& bytes) : m_bytes(bytes) {}
    tl::expected<void, FileError> write(std::span<const std::byte> bytes) override {
        m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
        return {};
    }
    tl::expected<void, FileError> flush() override { return {}; }

private:
    std::vector<std::byte>& m_bytes;
};

} // namespace posewire::log
