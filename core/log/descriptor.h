// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"

#include <atomic>
#include <string>
#include <utility>
#include <vector>

/// Files as the system knows them (POSIX); only for the units that read and write them.
namespace posewire::log {

/// A file descriptor, closed with its owner.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : m_number(number) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept : m_number(std::exchange(other.m_number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(m_number, other.m_number);
        return *this;
    }

    [[nodiscard]] int number() const { return m_number; }
    [[nodiscard]] bool isOpen() const { return m_number >= 0; }

private:
    int m_number;
};

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
