// SPDX-License-Identifier: MIT
#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace posewire::log {

/// Says in one line for the user why a file cannot be read or written, and what to do.
struct FileError {
    enum class Kind : std::uint8_t {
        Failed,
        Cut,       ///< a capture ends amidst a packet; all before it was read
        Damaged,   ///< a capture makes no sense from some byte on; all before it was read
        Cancelled, ///< by the caller
        Unread,    ///< the reader of what was written is gone
        Displaced, ///< what was written is not under its name any more, or not all of it
    };
    std::string text;
    Kind kind = Kind::Failed;

    /// What comes before the fault is as good as a whole file.
    [[nodiscard]] bool leavesABeginning() const { return kind == Kind::Cut || kind == Kind::Damaged; }
};

/// Bytes in order, from a file or a stream.
class ByteSource {
public:
    virtual ~ByteSource() = default;

    /// Fills the front of `into` and returns how much; 0 only at the end.
    virtual tl::expected<std::size_t, FileError> read(std::span<std::byte> into) = 0;

    /// For messages: the name of the file, "standard input".
    [[nodiscard]] virtual std::string name() const = 0;
};

/// Returns true to end reading. Called before each read, and ten times a second while no bytes come: a file
/// may have no end, a pipe no writer.
using IsCancelled = std::function<bool()>;

/// Fails if there is no such file, it is a folder, or may not be read. Reading fails with
/// FileError::Kind::Cancelled once `isCancelled` returns true.
tl::expected<std::unique_ptr<ByteSource>, FileError> openFile(const std::string& path,
                                                              IsCancelled isCancelled = {});

/// The standard input of this process.
std::unique_ptr<ByteSource> openStandardInput(IsCancelled isCancelled = {});

/// Bytes that can be read anywhere, as often as wanted and from any thread.
class ByteStore {
public:
    virtual ~ByteStore() = default;

    /// Fills the front of `into` with the bytes from `offset` on and returns the count: less only at the end,
    /// or if they cannot be read.
    [[nodiscard]] virtual std::size_t readAt(std::uint64_t offset, std::span<std::byte> into) const = 0;
};

/// Fails as openFile() does, and if the file can only be read once, such as a pipe.
tl::expected<std::shared_ptr<const ByteStore>, FileError> openStore(const std::string& path);

/// Takes bytes in order. Write no more after a failure.
class ByteSink {
public:
    virtual ~ByteSink() = default;

    virtual tl::expected<void, FileError> write(std::span<const std::byte> bytes) = 0;

    /// What was written is in the hands of the system: it survives the end of this process.
    virtual tl::expected<void, FileError> flush() = 0;

    /// What was written is on the disk: it survives the end of this computer. May take long.
    virtual tl::expected<void, FileError> sync() { return flush(); }

    /// Call last: what was written stays, under its name.
    virtual tl::expected<void, FileError> finish() { return sync(); }
};

/// The packets that a capture holds.
struct CaptureContents {
    std::uint64_t packets = 0;
    std::uint64_t withoutIp = 0;    ///< or damaged, or carrying neither UDP nor TCP
    std::uint64_t ofOtherLinks = 0; ///< of a link type that is not looked through
    std::uint32_t otherLink = 0;    ///< the first one of these, as registered for pcap
    std::uint64_t udp = 0;
    std::uint64_t tcp = 0;
};

/// So many of the first bytes tell which format something is of that is not MXTP.
inline constexpr std::size_t kLookedAt = 192;

/// The contents of a file, counted while it is read, to explain a file that holds little or no MXTP.
struct FileContents {
    bool isEmpty = true;
    std::uint64_t datagrams = 0;              ///< that begin with "MXTP"
    std::uint64_t bytes = 0;                  ///< of datagrams, whatever they begin with
    std::uint64_t skipped = 0;                ///< bytes that belong to none
    std::vector<std::byte> head;              ///< of a file that begins with these: its first kLookedAt ones
    std::optional<CaptureContents> capture{}; ///< if it is one

    void count(std::span<const std::byte> record, bool isSkipped);
    [[nodiscard]] bool isMostlyOther() const { return datagrams == 0 || skipped > bytes; }
};

} // namespace posewire::log
