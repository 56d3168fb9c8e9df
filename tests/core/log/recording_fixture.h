// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/pcapng_writer.h"
#include "core/log/recording_file.h"
#include "core/log/time.h"
#include "tests/core/log/datagram_fixture.h"

#include <algorithm>
#include <ostream>

namespace posewire::log {

/// A packet with what a recording keeps of it.
struct Recorded {
    ByteVector bytes;
    SenderInfo sender{"10.0.0.2:40001", Transport::Udp, 9763};
    Stamp stamp = stampOf(1'700'000'000'123'456'789);
    std::uint32_t kernelDropsBefore = 0;
    PacketFlags flags{.stampedByKernel = true};
    std::vector<std::string> comments{};

    friend bool operator==(const Recorded&, const Recorded&) = default;
};

/// For the messages of tests.
inline void PrintTo(const Recorded& one, std::ostream* out) {
    *out << one.bytes.size() << " bytes from " << one.sender.address << " ("
         << static_cast<int>(one.sender.transport) << ") to " << one.sender.localPort << " at "
         << nanosecondsOf(asWallTime(one.stamp)) << " after " << one.kernelDropsBefore << " drops, flags "
         << one.flags.truncated << one.flags.stampedByKernel << one.flags.skipped << one.flags.isDropRecord
         << one.flags.afterClosed << ", " << one.comments.size() << " comments";
}

/// In memory; full after `room` bytes.
class MemorySink final : public ByteSink {
public:
    explicit MemorySink(std::size_t room = SIZE_MAX) : m_room(room) {}

    tl::expected<void, FileError> write(std::span<const std::byte> more) override {
        if (more.size() > m_room - bytes.size()) {
            return tl::unexpected(FileError{"memory: the disk is full"});
        }
        bytes.insert(bytes.end(), more.begin(), more.end());
        return {};
    }
    tl::expected<void, FileError> flush() override {
        flushed = bytes.size();
        return {};
    }

    tl::expected<void, FileError> sync() override {
        ++syncs;
        return flush();
    }

    ByteVector bytes;
    std::size_t flushed = 0;
    int syncs = 0;

private:
    std::size_t m_room;
};

/// Ends with its bytes, or fails there.
class BytesSource final : public ByteSource {
public:
    explicit BytesSource(std::span<const std::byte> bytes, bool fails = false)
        : m_bytes(bytes), m_fails(fails) {}
    tl::expected<std::size_t, FileError> read(std::span<std::byte> into) override {
        if (m_fails && m_bytes.empty()) {
            return tl::unexpected(FileError{"memory: the device is gone"});
        }
        const std::size_t count = std::min(into.size(), m_bytes.size());
        std::copy_n(m_bytes.begin(), count, into.begin());
        m_bytes = m_bytes.subspan(count);
        return count;
    }
    [[nodiscard]] std::string name() const override { return "memory"; }

private:
    std::span<const std::byte> m_bytes;
    bool m_fails;
};

/// What a reader finds; the file must be sound or cut off.
inline std::vector<Recorded> recordedIn(std::span<const std::byte> file) {
    std::vector<Recorded> all;
    BytesSource source(file);
    const auto result = readFile(source, [&](const FileRecord& record) {
        const Arrival arrival = arrivalOf(record, {}, record.time ? asStamp(*record.time) : stampOf(-1));
        all.push_back({{record.bytes.begin(), record.bytes.end()},
                       record.sender.value_or(SenderInfo{"unknown", Transport::File, 0}),
                       arrival.stamp,
                       arrival.kernelDropsBefore,
                       arrival.flags,
                       {record.comments.begin(), record.comments.end()}});
    });
    const bool isCut = !result && result.error().kind == FileError::Kind::Cut;
    return result || isCut ? all : std::vector<Recorded>{};
}

} // namespace posewire::log
