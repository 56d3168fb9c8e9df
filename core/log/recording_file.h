// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"
#include "core/log/packet.h"
#include "core/log/pcapng_writer.h"
#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace posewire::log {

/// One datagram of a file, or bytes between datagrams. A run of those that is longer than 64 KiB comes in
/// several records.
struct FileRecord {
    std::uint64_t offset = 0;           ///< of the first byte in the file
    std::span<const std::byte> bytes;   ///< valid during the call
    std::optional<WallTime> time{};     ///< raw files have none
    std::optional<SenderInfo> sender{}; ///< raw files know none
    PacketFlags flags{};
    Duration setBy{};                        ///< what its clock had been set by, known to recordings
    std::uint32_t kernelDropsBefore = 0;     ///< as in Arrival; known to recordings, see PcapngWriter
    std::span<const std::string> comments{}; ///< UTF-8, valid during the call; of recordings
    /// The bytes lie like this in the file, from `offset` on; else they were put together from several
    /// frames.
    bool isInOnePiece = true;
};

[[nodiscard]] inline Arrival arrivalOf(const FileRecord& record, SenderId sender, Stamp stamp) {
    return {stamp, sender, record.kernelDropsBefore, record.flags};
}

using FileVisitor = std::function<void(const FileRecord&)>;
/// Told of the notes that a recording has on itself (parseReception, parseMark): all of them, in place of
/// what it was told before.
using NotesVisitor = std::function<void(std::span<const std::string_view>)>;

/// Reads a file of any format that is known, found by its content: datagrams back to back, as on TCP; pcap
/// (microseconds or nanoseconds, either byte order); pcapng. In captures it finds what Reassembly finds. A
/// capture that is cut off or damaged is read up to there, and fails then with FileError::Kind::Cut or
/// Damaged and the byte where that is. What PcapngWriter has written comes back as it was. A time before 1740
/// or after 2260, or 146 years from the first one of the file, is none: all others can be subtracted from
/// each other and from now. `visitNotes` is called for what a pcapng file says about itself, mostly at its
/// end. `contents`, if there is one, gets what the file holds as far as it was read, its datagrams as they
/// are read.
tl::expected<void, FileError> readFile(ByteSource& source, const FileVisitor& visit,
                                       const NotesVisitor& visitNotes = {}, FileContents* contents = nullptr);

} // namespace posewire::log
