// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/spool.h"

#include "core/log/file_names.h"
#include "core/log/output_file.h"

#include <array>
#include <cinttypes>
#include <cstdio>

namespace posewire::stage {
namespace {

/// "00001700000000123456789 0123456789abcdef": the time of a packet, and a checksum (FNV-1a) of its bytes.
std::string signOf(log::WallTime time, std::span<const std::byte> bytes) {
    std::uint64_t sum = 0xcbf29ce484222325;
    for (const std::byte byte : bytes) {
        sum = (sum ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3;
    }
    std::array<char, 64> text{};
    const int size =
        std::snprintf(text.data(), text.size(), "%023" PRId64 " %016" PRIx64, log::nanosecondsOf(time), sum);
    return {text.data(), static_cast<std::size_t>(size)};
}

void readAll(const std::string& folder, const log::FileVisitor& take) {
    for (const log::LostHistory& file : log::lostHistories(folder)) {
        if (const auto source = log::openFile(file.path)) {
            static_cast<void>(log::readFile(**source, take)); // a file that is cut off is read up to there
        }
    }
}

} // namespace

std::optional<log::FileError> Spool::begin(log::PacketLog& log) {
    if (!log::makeFolder(m_folder)) {
        return log::FileError{m_folder + ": this folder cannot be made; choose another with --spool"};
    }
    auto history = log::DiskHistory::start(log, {.folder = m_folder, .most = m_most}, {});
    if (!history) {
        return history.error();
    }
    m_history = std::move(*history);
    return std::nullopt;
}

void Spool::leave() {
    if (m_history) {
        m_history->leave();
        m_history.reset();
    }
}

void Spool::noteStored(log::WallTime time, std::span<const std::byte> bytes) {
    if (!m_stored.is_open() && log::makeFolder(m_folder)) {
        m_stored.open(log::pathOf(m_folder) / "stored", std::ios::binary);
    }
    m_stored.seekp(0);
    m_stored << signOf(time, bytes) << std::flush;
}

void Spool::readLeft(const log::FileVisitor& take) const {
    std::ifstream file(log::pathOf(m_folder) / "stored", std::ios::binary);
    std::string stored;
    std::getline(file, stored);
    std::uint64_t number = 0;
    std::uint64_t next = 0; // after the one that was stored last
    readAll(m_folder, [&](const log::FileRecord& record) {
        ++number;
        next = signOf(record.time.value_or(log::WallTime()), record.bytes) == stored ? number : next;
    });
    number = 0;
    readAll(m_folder, [&](const log::FileRecord& record) {
        if (number++ >= next) {
            take(record);
        }
    });
}

void Spool::dropLeft() const {
    log::discardHistories(m_folder, 0);
}

} // namespace posewire::stage
