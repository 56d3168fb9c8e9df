// SPDX-License-Identifier: MIT
#include "core/log/recording.h"

#include "core/log/file_names.h"
#include "core/log/packet_log.h"
#include "core/log/system_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace posewire::log {
namespace {

constexpr std::chrono::milliseconds kPause{50};
constexpr std::chrono::seconds kSync{1};

constexpr const char* kInEarlierFile = "In an earlier file: ";

bool isDisplaced(const Recorder::Result& result) {
    return !result && result.error().kind == FileError::Kind::Displaced;
}

Recorder::Result checkRoom(const std::string& path, std::uint64_t leaveFree) {
    std::error_code failed;
    const auto folder = pathOf(path).parent_path();
    const auto space = leaveFree == 0 ? std::filesystem::space_info{}
                                      : std::filesystem::space(folder.empty() ? "." : folder, failed);
    if (leaveFree == 0 || failed || space.available >= leaveFree) {
        return {};
    }
    return tl::unexpected(FileError{path + ": less than " + std::to_string(leaveFree / 1'000'000) +
                                    " MB are free on its disk; free some, or record to another one"});
}

/// The next part that nothing has the name of, in a folder that is made if it is missing.
tl::expected<std::unique_ptr<ByteSink>, FileError> createNext(const std::string& first, unsigned& part,
                                                              std::string& path) {
    static_cast<void>(makeFolder(nameOf(pathOf(first).parent_path())));
    while (true) {
        path = partPath(first, ++part);
        auto sink = createFile(path);
        std::error_code failed;
        if (sink || !std::filesystem::exists(std::filesystem::symlink_status(pathOf(path), failed))) {
            return sink;
        }
    }
}

} // namespace

Recorder::Recorder(const PacketLog& log, ByteSink& sink, std::uint64_t from)
    : Recorder(log, sink, LogFollower::fromOldest(log, from)) {}

Recorder::Recorder(const PacketLog& log, ByteSink& sink, LogFollower follower)
    : m_sink(sink),
      m_log(log),
      m_follower(std::move(follower)),
      m_first(m_follower.position()),
      m_missedBefore(m_follower.overtaken()),
      m_senders(log.senders()),
      m_writer(sink) {}

Recorder::Result Recorder::begin(const RecordingInfo& info, std::span<const std::uint64_t> before) {
    Result result = m_writer.begin(info);
    LogReader reader(m_log);
    for (const std::uint64_t number : before) {
        if (auto packet = reader.packet(number); packet && result) {
            packet->flags.isFromBefore = true;
            packet->kernelDropsBefore = 0;
            result = write(*packet);
        }
    }
    m_before = m_writer.packets();
    return result.and_then([this] { return m_sink.flush(); });
}

Recorder::Result Recorder::write(const Packet& packet) {
    const SenderInfo* sender = m_senders.find(packet.sender);
    return m_writer.add(packet, sender != nullptr ? *sender : SenderInfo{}, {},
                        m_log.timeline().setByAt(packet.stamp));
}

Recorder::Result Recorder::follow() {
    return writeNew().and_then([this] { return m_sink.flush(); });
}

Recorder::Result Recorder::note(std::span<const std::string> notes) {
    return m_writer.addStatistics(notes).and_then([this] { return m_sink.flush(); });
}

Recorder::Result Recorder::finish(std::span<const std::string> notes) {
    return writeNew().and_then([&] { return m_writer.addStatistics(notes); }).and_then([this] {
        return m_sink.finish();
    });
}

Recorder::Result Recorder::sync() {
    return std::exchange(m_synced, m_follower.position()) == m_follower.position() ? Result() : m_sink.sync();
}

Recorder::Result Recorder::writeNew() {
    m_follower.refresh();
    while (auto packet = m_follower.next()) {
        const std::uint64_t missed = m_follower.takeOvertaken();
        if (missed > 0) {
            m_holes.push_back({std::max(packet->number - missed, m_first), packet->number});
        }
        packet->addDrops(m_follower.takeUnseen().missingWith(missed));
        if (auto added = write(*packet); !added) {
            return added;
        }
    }
    return {};
}

std::uint64_t Recorder::placeOf(std::uint64_t packet) const {
    std::uint64_t place = m_before + packet - m_first;
    for (const Hole& hole : m_holes) {
        place -= std::clamp(packet, hole.begin, hole.end) - hole.begin;
    }
    return place;
}

std::string partPath(const std::string& path, unsigned part) {
    if (part <= 1) {
        return path;
    }
    const std::filesystem::path whole = pathOf(path);
    const std::string name =
        nameOf(whole.stem()) + " part " + std::to_string(part) + nameOf(whole.extension());
    return nameOf(whole.parent_path() / pathOf(name));
}

tl::expected<std::unique_ptr<Recording>, FileError>
Recording::start(const PacketLog& log, const std::string& path, const RecordingInfo& info,
                 const OutputRules& rules, std::uint64_t from, const RecordingLimits& limits,
                 std::vector<std::uint64_t> before) {
    std::error_code failed;
    const bool isNew = !std::filesystem::exists(pathOf(path), failed);
    auto sink = checkRoom(path, limits.leaveFree).and_then([&] { return createFile(path, rules); });
    if (!sink) {
        return tl::unexpected(sink.error());
    }
    std::unique_ptr<Recording> recording(new Recording(log, std::move(*sink), from));
    recording->m_path = recording->m_file = path;
    recording->m_limits = limits;
    recording->m_fromBefore = std::move(before);
    auto begun = begin(std::move(recording), info);
    if (!begun && isNew) {
        std::filesystem::remove(pathOf(path), failed);
    }
    return begun;
}

tl::expected<std::unique_ptr<Recording>, FileError> Recording::start(const PacketLog& log,
                                                                     std::unique_ptr<ByteSink> sink,
                                                                     const RecordingInfo& info,
                                                                     std::uint64_t from) {
    return begin(std::unique_ptr<Recording>(new Recording(log, std::move(sink), from)), info);
}

tl::expected<std::unique_ptr<Recording>, FileError> Recording::begin(std::unique_ptr<Recording> recording,
                                                                     const RecordingInfo& info) {
    recording->m_info = info;
    if (const auto begun = recording->m_recorder->begin(info, recording->m_fromBefore); !begun) {
        return tl::unexpected(begun.error());
    }
    recording->m_figures = recording->figuresNow();
    recording->m_thread = std::thread([raw = recording.get()] { raw->run(); });
    return recording;
}

Recording::Recording(const PacketLog& log, std::unique_ptr<ByteSink> sink, std::uint64_t from)
    : m_log(log), m_sink(std::move(sink)) {
    m_recorder.emplace(log, *m_sink, from);
}

Recording::~Recording() {
    static_cast<void>(stop());
}

void Recording::setMarks(std::vector<RecordedMark> marks) {
    const std::lock_guard lock(m_mutex);
    m_marks = std::move(marks);
}

tl::expected<void, FileError> Recording::stop(std::vector<std::string> notes) {
    {
        const std::lock_guard lock(m_mutex);
        if (!m_isStopping) {
            m_notes = std::move(notes);
        }
        m_isStopping = true;
    }
    m_changed.notify_all();
    if (m_thread.joinable()) {
        m_thread.join();
    }
    if (const auto why = failure()) {
        return tl::unexpected(*why);
    }
    return {};
}

RecordingFigures Recording::figures() const {
    const std::lock_guard lock(m_mutex);
    return m_figures;
}

std::optional<FileError> Recording::failure() const {
    const std::lock_guard lock(m_mutex);
    return m_failure;
}

void Recording::run() {
    bool isStopping = false;
    auto synced = std::chrono::steady_clock::now();
    while (!isStopping) {
        {
            std::unique_lock lock(m_mutex);
            isStopping = m_changed.wait_for(lock, kPause, [this] { return m_isStopping; });
        }
        if (!carryOut([&] { return isStopping ? finish() : m_recorder->follow(); })) {
            return;
        }
        const auto now = std::chrono::steady_clock::now();
        if (!isStopping && now - synced >= kSync) {
            synced = now;
            if (!carryOut([this] { return keepMarks().and_then([this] { return m_recorder->sync(); }); })) {
                return;
            }
            if (const auto room = checkRoom(m_file, m_limits.leaveFree); !room) {
                static_cast<void>(finish()); // while that still has room
                note(room);
                return;
            }
        }
        if (!isStopping && isFileFull() && !note(goOn())) {
            return;
        }
    }
}

bool Recording::isFileFull() const {
    const auto figures = m_recorder->figures();
    return (m_limits.fileBytes != 0 && figures.bytes >= m_limits.fileBytes) ||
           (m_limits.fileTime != Duration() &&
            std::chrono::steady_clock::now() - m_fileBegin >= m_limits.fileTime);
}

/// If the file is not where it was, in another one and once more. False if nothing more is written.
bool Recording::carryOut(const std::function<Result()>& step) {
    constexpr std::size_t kMost = 8; // who moves every file away would fill the disk
    Result result = step();
    while (isDisplaced(result) && !m_path.empty() && m_displaced.size() < kMost && (result = goOn())) {
        result = step();
    }
    return note(result);
}

/// In another file; where there can be none, this one ends as well as it can.
Recording::Result Recording::goOn() {
    const Result ended = finish();
    if (!ended && !isDisplaced(ended)) {
        return ended;
    }
    std::string path;
    auto next = createPart(path, !ended);
    if (!next) {
        return ended ? tl::unexpected(next.error())
                     : tl::unexpected(FileError{ended.error().text + "; " + next.error().text,
                                                FileError::Kind::Displaced});
    }
    LogFollower follower = m_recorder->follower();
    std::uint64_t begin = m_recorder->figures().fileBegin;
    if (ended) {
        m_before = m_kept;
        m_ended.push_back(m_recorder->figures());
        m_ended.back().path = m_file;
    } else {
        begin = forgetGone(begin);
        follower = LogFollower::fromOldest(m_log, begin);
        m_kept.clear();
    }
    m_recorder.reset(); // it writes to the sink
    m_sink = std::move(*next);
    m_recorder.emplace(m_log, *m_sink, follower);
    m_file = path;
    m_fileBegin = std::chrono::steady_clock::now();
    if (!ended) {
        m_displaced.push_back({ended.error().text, path, follower.position() - begin});
    }
    const bool isWhole = !ended && m_ended.empty(); // in place of the first file
    return m_recorder->begin(m_info, isWhole ? m_fromBefore : std::vector<std::uint64_t>());
}

/// Of the files that have ended, those from the first one on that is not there as it was. The packet that it
/// began with; `begin` if all are there.
std::uint64_t Recording::forgetGone(std::uint64_t begin) {
    const auto gone = std::ranges::find_if(m_ended, [](const RecordingFigures& one) {
        const auto there = statusOf(one.path);
        return !there || there->size != one.bytes;
    });
    begin = gone == m_ended.end() ? begin : gone->fileBegin;
    m_ended.erase(gone, m_ended.end());
    return begin;
}

/// Under the next name that nothing has; in another folder only if that of the recording cannot be had.
tl::expected<std::unique_ptr<ByteSink>, FileError> Recording::createPart(std::string& path, bool mayMove) {
    auto sink = createNext(m_path, m_part, path);
    if (!sink && mayMove && !m_limits.otherFolder.empty()) {
        const std::string other = nameOf(pathOf(m_limits.otherFolder) / pathOf(m_path).filename());
        if (auto elsewhere = createNext(other, m_part, path)) {
            m_path = other;
            return elsewhere;
        }
    }
    return sink;
}

/// Those that are set by now, for the file that is being written, once it has their packets.
tl::expected<std::vector<std::string>, FileError> Recording::noteMarks() {
    {
        const std::lock_guard lock(m_mutex);
        m_kept = m_marks;
    }
    if (const auto followed = m_recorder->follow(); !followed && !isDisplaced(followed)) {
        return tl::unexpected(followed.error());
    }
    const std::uint64_t first = m_recorder->figures().fileBegin;
    std::vector<std::string> notes;
    for (RecordedMark mark : m_kept) {
        if (mark.packet >= first) {
            mark.packet = m_recorder->placeOf(mark.packet);
            notes.push_back(markText(mark));
        } else if (std::ranges::find(m_before, mark) == m_before.end()) {
            notes.push_back(kInEarlierFile + markText(mark));
        }
    }
    return notes;
}

/// So that they are there whatever happens.
Recording::Result Recording::keepMarks() {
    {
        const std::lock_guard lock(m_mutex);
        if (m_marks == m_kept) {
            return {};
        }
    }
    const auto notes = noteMarks();
    return notes ? m_recorder->note(*notes) : tl::unexpected(notes.error());
}

/// Of the file; the last one has the other notes too.
Recording::Result Recording::finish() {
    auto notes = noteMarks();
    if (!notes) {
        return tl::unexpected(notes.error());
    }
    {
        const std::lock_guard lock(m_mutex);
        notes->insert(notes->end(), m_notes.begin(), m_notes.end());
    }
    return m_recorder->finish(*notes);
}

RecordingFigures Recording::figuresNow() const {
    RecordingFigures figures = m_recorder->figures();
    for (const RecordingFigures& one : m_ended) {
        figures.packets += one.packets;
        figures.bytes += one.bytes;
        figures.missed += one.missed;
        ++figures.files;
    }
    figures.path = m_ended.empty() ? m_file : m_ended.front().path;
    figures.displaced = m_displaced;
    return figures;
}

/// False if nothing more is written. What was written until then is ended as well as that can be.
bool Recording::note(const Result& result) {
    const std::lock_guard lock(m_mutex);
    m_figures = figuresNow();
    if (!result) {
        m_failure = result.error();
    }
    return result.has_value();
}

} // namespace posewire::log
