// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"
#include "core/log/system_files.h"

#include <atomic>
#include <string>
#include <vector>

namespace posewire::log {

/// Gathers small pieces, so that the system is called seldom.
class DescriptorSink : public ByteSink {
public:
    /// `consequence` ends the messages about failures: what became of what was written before.
    DescriptorSink(Descriptor descriptor, std::string name, std::string consequence);
    /// Writes what it still holds; whoever wants to know of failures calls flush() before.
    ~DescriptorSink() override;

    tl::expected<void, FileError> write(std::span<const std::byte> bytes) override;
    tl::expected<void, FileError> flush() override;
    tl::expected<void, FileError> sync() override;
    void hurry() override { m_isHurried = true; }

protected:
    [[nodiscard]] const Descriptor& descriptor() const { return m_descriptor; }
    [[nodiscard]] const std::string& name() const { return m_name; }
    /// Of the last call of the system, which failed.
    [[nodiscard]] tl::unexpected<FileError> failure();
    /// What has not been written by now never will be.
    void discard();

private:
    tl::expected<void, FileError> put(std::span<const std::byte> bytes);
    [[nodiscard]] bool waitForRoom() const;

    Descriptor m_descriptor;
    std::string m_name;
    std::string m_consequence;
    std::vector<std::byte> m_waiting;
    bool m_hasFailed = false;
    bool m_isFile = false; ///< else writing may wait for a reader
    std::atomic<bool> m_isHurried = false;
};

} // namespace posewire::log
