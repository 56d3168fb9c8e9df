// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"

#include <istream>
#include <memory>
#include <string>
#include <utility>

namespace posewire::test {

class StreamSource final : public log::ByteSource {
public:
    StreamSource(std::istream& stream, std::string name) : m_stream(stream), m_name(std::move(name)) {}

    tl::expected<std::size_t, log::FileError> read(std::span<std::byte> into) override {
        m_stream.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
        if (m_stream.bad()) {
            return tl::unexpected(log::FileError{
                m_name + ": reading failed; the device or the connection behind it may be gone"});
        }
        return static_cast<std::size_t>(m_stream.gcount());
    }
    [[nodiscard]] std::string name() const override { return m_name; }

private:
    std::istream& m_stream;
    std::string m_name;
};

/// Reads from a stream that belongs to the caller.
inline std::unique_ptr<log::ByteSource> readingFrom(std::istream& stream, std::string name) {
    return std::make_unique<StreamSource>(stream, std::move(name));
}

} // namespace posewire::test
