// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_source.h"
#include "core/log/packet.h"
#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace posewire::log {

/// What a file is by its first bytes, whatever its name. Fewer than four bytes are Raw.
enum class FileFormat : std::uint8_t { Raw, Pcap, Pcapng };
[[nodiscard]] FileFormat fileFormat(std::span<const std::byte> firstBytes);

/// One datagram of a file, or bytes between datagrams.
struct FileRecord {
    std::uint64_t offset = 0;         ///< of the first byte in the file
    std::span<const std::byte> bytes; ///< valid during the call
    bool isSkipped = false; ///< belongs to no datagram; a run longer than 64 KiB comes in several records
    std::optional<Stamp> stamp; ///< since 1970-01-01 UTC; raw files have none
    std::optional<SenderInfo> sender;    ///< raw files know none

    // What recordings know besides; see PcapngWriter.
    std::uint32_t kernelDropsBefore = 0; ///< as in Arrival
    bool isTruncated = false;            ///< as in PacketFlags
    bool isStampedByKernel = false;
    bool isDropRecord = false;               ///< then also isSkipped, and without bytes
    std::span<const std::string> comments{}; ///< UTF-8, valid during the call
};

/// What the log keeps of a record of `sender`. `stamp` is for records without a stamp.
[[nodiscard]] Arrival arrivalOf(const FileRecord& record, SenderId sender, Stamp stamp);

using FileVisitor = std::function<void(const FileRecord&)>;

/// Datagrams back to back, as on TCP.
tl::expected<void, FileError> readRawFile(ByteSource& source, const FileVisitor& visit);

/// Reads a file of any format that is known, found by its content.
tl::expected<void, FileError> readFile(ByteSource& source, const FileVisitor& visit);

} // namespace posewire::log
