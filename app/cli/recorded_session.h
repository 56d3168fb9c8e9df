// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/datagram_pacer.h"
#include "core/log/byte_io.h"
#include "core/log/packet_log.h"
#include "core/model/session/session.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace posewire::cli {

/// A file as a log with a session that has followed all of it, with the stamps of the file; where it has
/// none, time codes space it. What the log's memory drops is read from the file again, where it can be.
class RecordedSession {
public:
    explicit RecordedSession(const std::string& path);

    /// Reads all of it; `progress` gets from 0 to 1 how far it is, where the file has a size. Where it is cut
    /// off, what is before that was read.
    tl::expected<void, log::FileError> read(log::ByteSource& source,
                                            const std::function<void(double share)>& progress);

    [[nodiscard]] const model::Session& session() const { return m_session; }
    /// What the file held, as far as it was read.
    [[nodiscard]] const log::FileContents& contents() const { return m_contents; }

private:
    static constexpr std::uint64_t kPacketsAtOnce = 4'096;
    static constexpr std::uint64_t kBytesAtOnce = std::uint64_t{4} << 20;

    void take(const log::FileRecord& record);
    void note(const log::FileRecord& record, const log::Arrival& arrival);
    void follow();

    std::string m_name;                            ///< of the sender of a raw file
    double m_size = 0;                             ///< bytes; 0 where it is not known
    std::shared_ptr<const log::ByteStore> m_store; ///< null where it can be read only once
    log::PacketLog m_log;
    model::Session m_session{m_log};
    log::RecordedClock m_clock{m_log.timeline()};
    std::optional<log::PastWriter> m_past;
    DatagramPacer m_pacer{1.0 / 240, 1.0};
    std::uint64_t m_packets = 0;
    std::uint64_t m_bytesWaiting = 0; ///< not followed yet
    log::Stamp m_newest{};
    log::FileContents m_contents;
};

} // namespace posewire::cli
