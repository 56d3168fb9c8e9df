// SPDX-License-Identifier: MIT
#include "core/log/disk_history.h"

#include "core/log/file_names.h"
#include "core/log/output_file.h"
#include "core/log/recording_file.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string_view>
#include <utility>

namespace posewire::log {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kHistoryPause{100};
constexpr std::chrono::milliseconds kIdlePause{500}; // while no packet arrives
constexpr std::uint64_t kLeastFile = std::uint64_t{1} << 20;

// "history-<process>-<file>.pcapng": the process is for whoever looks into the folder, no more. Its number
// may be used again.
constexpr std::string_view kPrefix = "history-";
constexpr std::string_view kSuffix = ".pcapng";

bool isHistory(const fs::directory_entry& entry) {
    const std::string name = nameOf(entry.path().filename());
    std::error_code failed;
    return name.starts_with(kPrefix) && name.ends_with(kSuffix) && entry.is_regular_file(failed);
}

/// As far as the folder can be read.
std::vector<fs::directory_entry> filesIn(const std::string& folder) {
    std::vector<fs::directory_entry> files;
    std::error_code failed;
    fs::directory_iterator entry(pathOf(folder), failed);
    while (!failed && entry != fs::directory_iterator()) {
        if (isHistory(*entry)) {
            files.push_back(*entry);
        }
        entry.increment(failed);
    }
    return files;
}

} // namespace

tl::expected<std::unique_ptr<DiskHistory>, FileError>
DiskHistory::start(PacketLog& log, const DiskHistoryChoice& choice, const RecordingInfo& info) {
    std::unique_ptr<DiskHistory> history(new DiskHistory(log, choice, info));
    if (const auto begun = history->beginFile(history->m_follower.position()); !begun) {
        return tl::unexpected(begun.error());
    }
    history->m_thread = std::jthread([raw = history.get()](const std::stop_token& stop) { raw->run(stop); });
    return history;
}

DiskHistory::~DiskHistory() {
    m_thread = {};
    if (m_isLeft && !m_failure) {
        static_cast<void>(follow({}).and_then([this] { return endFile(); }));
    }
    m_log.past().dropBefore(UINT64_MAX);
    std::error_code ignored;
    while (!m_isLeft && !m_files.empty()) {
        fs::remove(pathOf(m_files.front().path), ignored);
        m_files.pop_front();
    }
}

DiskHistoryFigures DiskHistory::figures() const {
    const std::lock_guard lock(m_mutex);
    return m_figures;
}

std::optional<FileError> DiskHistory::failure() const {
    const std::lock_guard lock(m_mutex);
    return m_failure;
}

void DiskHistory::run(const std::stop_token& stop) {
    std::uint64_t end = 0;
    while (!stop.stop_requested()) {
        const Result followed = follow(stop).or_else([this](const FileError& why) { return makeRoom(why); });
        note(followed);
        if (!followed) {
            return;
        }
        std::unique_lock lock(m_mutex);
        const bool isIdle = std::exchange(end, m_figures.end) == m_figures.end;
        m_changed.wait_for(lock, stop, isIdle ? kIdlePause : kHistoryPause, [] { return false; });
    }
}

/// At the end all of it goes anyway: nobody waits for a slow disk then.
DiskHistory::Result DiskHistory::follow(const std::stop_token& stop) {
    m_follower.refresh();
    while (const auto packet = stop.stop_requested() ? std::nullopt : m_follower.next()) {
        if (const auto written = write(*packet); !written) {
            return written;
        }
    }
    return m_sink->flush();
}

DiskHistory::Result DiskHistory::write(const Packet& packet) {
    if (m_writer->bytes() >= std::max(kLeastFile, m_choice.most / kFiles)) {
        if (const auto begun = endFile().and_then([&] { return beginFile(packet.number); }); !begun) {
            return begun;
        }
    }
    const SenderInfo* sender = m_senders.find(packet.sender);
    const Duration setBy = m_log.timeline().setByAt(packet.stamp);
    Packet written = packet; // nothing else tells who opens the file of what was passed over
    written.addDrops(m_follower.takeUnseen().missingWith(m_follower.takeOvertaken()));
    if (const auto added = m_writer->add(written, sender != nullptr ? *sender : SenderInfo{}, {}, setBy);
        !added) {
        return added;
    }
    m_past->noteDrops(m_follower.dropsBeforeTaken());
    m_past->add(packet.number, {packet.stamp, packet.sender, packet.kernelDropsBefore, packet.flags},
                m_writer->packetOffset(), packet.bytes.size());
    m_files.back().bytes = m_writer->bytes();
    return m_past->isFull() ? handOver() : Result();
}

DiskHistory::Result DiskHistory::handOver() {
    const auto flushed = m_sink->flush();
    if (flushed) {
        m_past->finish();
    }
    return flushed;
}

DiskHistory::Result DiskHistory::beginFile(std::uint64_t first) {
    while (m_files.size() >= kFiles || (m_files.size() > 1 && isDiskFull())) {
        dropOldest();
    }
    const auto path = createNext();
    if (!path) {
        return tl::unexpected(path.error());
    }
    m_files.push_back({*path, first, openLocked(*path)});
    auto store = openStore(*path);
    if (!store) {
        return tl::unexpected(store.error());
    }
    m_writer.emplace(*m_sink);
    m_past.emplace(m_log.past(), m_log.senders(), *store);
    return m_writer->begin(m_info);
}

/// Opens a file under a name that nothing has, and returns that.
tl::expected<std::string, FileError> DiskHistory::createNext() {
    while (true) {
        const std::string name = std::string(kPrefix) + std::to_string(processNumber()) + "-" +
                                 std::to_string(++m_fileCount) + std::string(kSuffix);
        const std::string path = nameOf(pathOf(m_choice.folder) / name);
        auto sink = createFile(path, {.isWatched = false}); // readers have it open
        if (sink) {
            m_sink = std::move(*sink);
            return path;
        }
        if (std::error_code failed; !fs::exists(pathOf(path), failed)) {
            return tl::unexpected(sink.error());
        }
    }
}

/// The disk is full, say. What was not handed over by now is missing in the history.
DiskHistory::Result DiskHistory::makeRoom(const FileError& why) {
    m_past.reset();
    const std::size_t kept = m_files.size() / 2;
    while (m_files.size() > kept) {
        dropOldest();
    }
    return kept == 0 ? tl::unexpected(why) : beginFile(m_follower.position());
}

void DiskHistory::dropOldest() {
    std::error_code ignored;
    fs::remove(pathOf(m_files.front().path), ignored);
    m_files.pop_front();
    m_log.past().dropBefore(m_files.empty() ? UINT64_MAX : m_files.front().first);
}

bool DiskHistory::isDiskFull() const {
    std::error_code failed;
    const fs::space_info space = fs::space(pathOf(m_choice.folder), failed);
    return !failed && space.available < m_choice.leaveFree;
}

void DiskHistory::note(const Result& result) {
    const std::lock_guard lock(m_mutex);
    m_figures = {0, m_files.empty() ? m_follower.position() : m_files.front().first, m_follower.position(),
                 m_follower.overtaken()};
    for (const File& file : m_files) {
        m_figures.bytes += file.bytes;
    }
    if (!result) {
        m_failure = result.error();
    }
}

std::vector<LostHistory> lostHistories(const std::string& folder) {
    std::vector<LostHistory> lost;
    std::error_code failed; // a file that goes meanwhile counts as empty
    for (const fs::directory_entry& entry : filesIn(folder)) {
        // An empty one may be about to be locked.
        if (entry.file_size(failed) > 0 && openLocked(nameOf(entry.path())).isOpen()) {
            const auto end = std::chrono::file_clock::to_sys(entry.last_write_time(failed));
            lost.push_back(
                {nameOf(entry.path()), entry.file_size(failed), std::chrono::time_point_cast<Duration>(end)});
        }
    }
    std::ranges::sort(lost, {}, &LostHistory::end);
    return lost;
}

std::optional<WallTime> beginOf(const std::string& path) {
    std::optional<WallTime> begin;
    if (const auto source = openFile(path, [&begin] { return begin.has_value(); })) {
        static_cast<void>(
            readFile(**source, [&begin](const FileRecord& record) { begin = begin ? begin : record.time; }));
    }
    return begin;
}

void discardHistories(const std::string& folder, std::uint64_t most) {
    constexpr std::chrono::minutes kUnused(1);
    std::error_code failed;
    std::uint64_t bytes = 0;
    const std::vector<LostHistory> lost = lostHistories(folder);
    for (auto file = lost.rbegin(); file != lost.rend(); ++file) { // the newest first
        bytes += file->bytes;
        if (bytes > most) {
            fs::remove(pathOf(file->path), failed);
        }
    }
    for (const fs::directory_entry& entry : filesIn(folder)) {
        const bool isOld = fs::file_time_type::clock::now() - entry.last_write_time(failed) > kUnused;
        if (entry.file_size(failed) == 0 && isOld && openLocked(nameOf(entry.path())).isOpen()) {
            fs::remove(entry.path(), failed);
        }
    }
}

} // namespace posewire::log
