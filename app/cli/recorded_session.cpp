// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/recorded_session.h"

#include "core/log/file_names.h"
#include "core/log/pcapng_writer.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace posewire::cli {
namespace {

namespace fs = std::filesystem;

/// Of a file that is read again where it is wanted.
constexpr std::size_t kMemoryCap = std::size_t{64} << 20;

std::shared_ptr<log::Scratch> newScratch() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    return error ? std::make_shared<log::Scratch>() : log::scratchOfFile(folder);
}

std::shared_ptr<const log::ByteStore> storeOf(const std::string& path) {
    const auto store = path == "-" ? tl::unexpected(log::FileError{}) : log::openStore(path);
    return store ? *store : nullptr;
}

double sizeOf(const std::string& path) {
    std::error_code error;
    const fs::path file = log::pathOf(path);
    const std::uintmax_t size = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
    return error ? 0 : static_cast<double>(size);
}

} // namespace

RecordedSession::RecordedSession(const std::string& path)
    : m_name(log::nameOf(log::pathOf(path).filename())),
      m_size(sizeOf(path)),
      m_store(storeOf(path)),
      m_log(m_store != nullptr ? log::LogLimits{.memoryCap = kMemoryCap} : log::LogLimits{}, newScratch()) {
    if (m_store != nullptr) {
        m_past.emplace(m_log.past(), m_log.senders(), m_store);
    }
}

tl::expected<void, log::FileError> RecordedSession::read(log::ByteSource& source,
                                                         const std::function<void(double share)>& progress) {
    std::optional<log::Reception> reception;
    auto result = log::readFile(
        source,
        [&](const log::FileRecord& record) {
            take(record);
            if (m_packets % kPacketsAtOnce == 0 || m_bytesWaiting >= kBytesAtOnce) {
                follow();
                progress(m_size > 0 ? std::min(1.0, static_cast<double>(record.offset) / m_size) : 0);
            }
        },
        [&](std::span<const std::string_view> notes) { reception = log::receptionIn(notes); }, &m_contents);
    follow();
    if (m_past) {
        m_past->finish();
    }
    m_session.endFile(reception ? reception->afterLast : log::Duration());
    return result;
}

void RecordedSession::take(const log::FileRecord& record) {
    const log::Stamp stamp =
        record.time ? m_clock.stampOf(*record.time, record.setBy) : log::Stamp(*m_pacer.due(record));
    m_newest = std::max(m_newest, stamp);
    const log::SenderId sender =
        m_log.senders().intern(record.sender.value_or(log::SenderInfo{m_name, log::Transport::File, 0}));
    const log::Arrival arrival = log::arrivalOf(record, sender, stamp);
    m_log.writer().append(record.bytes, arrival);
    if (m_past) {
        note(record, arrival);
    }
    ++m_packets;
    m_bytesWaiting += record.bytes.size();
}

void RecordedSession::note(const log::FileRecord& record, const log::Arrival& arrival) {
    if (record.isInOnePiece) {
        m_past->add(m_packets, arrival, record.offset, record.bytes.size());
    } else {
        m_past->keep(m_packets, arrival, record.bytes);
    }
    if (m_past->isFull()) {
        m_past->finish();
    }
}

void RecordedSession::follow() {
    m_bytesWaiting = 0;
    m_log.writer().publish();
    while (m_session.followFile(m_newest)) {
    }
}

} // namespace posewire::cli
