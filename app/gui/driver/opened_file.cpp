// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/opened_file.h"

#include "app/mvnx/mvnx_source.h"
#include "core/log/raw_pace.h"
#include "core/model/accounting/other_formats.h"

#include <QFileInfo>

#include <algorithm>
#include <array>
#include <chrono>

namespace posewire::gui {

namespace {

/// Read before all of it must have been looked at: much less than the smallest log holds.
constexpr std::uint64_t kPacketsInStep = 8'192;
constexpr std::uint64_t kBytesAtOnce = std::uint64_t{4} << 20;

/// Time within a raw file, from 0.
class RawTime {
public:
    log::Duration next(const log::FileRecord& record) {
        constexpr log::RawPace::Nanoseconds longest{1e18}; // 31 years: more may not fit into a duration
        if (!record.flags.skipped) {
            m_time = std::min(m_time + m_pace.step(record.bytes), longest);
        }
        return std::chrono::duration_cast<log::Duration>(m_time);
    }

private:
    log::RawPace m_pace;
    log::RawPace::Nanoseconds m_time{};
};

/// Reads a file from its beginning to its end, or as far as it is not cut off or damaged: then the
/// result says so.
ImportResult visitFile(const QString& path, const log::FileVisitor& visit,
                       const log::IsCancelled& isCancelled, const log::NotesVisitor& visitNotes = {},
                       log::FileContents* contents = nullptr) {
    const auto source = mvnx::openFile(path.toStdString(), isCancelled);
    if (!source) {
        return tl::unexpected(QString::fromStdString(source.error().text));
    }
    const auto read = log::readFile(**source, visit, visitNotes, contents);
    const QString text = read ? QString() : QString::fromStdString(read.error().text);
    const bool isRead = read || read.error().leavesABeginning();
    return isRead ? ImportResult(text) : tl::unexpected(text);
}

/// At once, so that the time that was given is kept to.
constexpr std::size_t kPacketsInTurn = 1'000;

/// The file is read again if this is too little.
constexpr std::size_t kMemoryCap = std::size_t{64} << 20;

log::LogLimits limitsOf(const log::Scratch& scratch) {
    return scratch.hasFile() ? log::LogLimits{.memoryCap = kMemoryCap} : log::LogLimits{};
}

} // namespace

ImportResult importRawFile(const QString& path, const PacketTaker& take, log::Stamp end,
                           log::Timeline& timeline, const std::function<bool()>& isCancelled,
                           const log::NotesVisitor& visitNotes) {
    if (const QFileInfo info(path); info.exists() && !info.isFile() && !info.isDir()) {
        return tl::unexpected(
            QCoreApplication::translate(
                "FileImport", "%1 is a pipe or a device, which may have no end; posewire-cli reads it")
                .arg(path));
    }
    // A raw file is read twice over: how long it lasts is known at its end, and it may be larger than memory.
    RawTime measuring;
    log::Duration length{};
    std::uint64_t count = 0;
    bool hasTimes = false;
    log::FileContents contents;
    const auto measured = visitFile(
        path,
        [&](const log::FileRecord& record) {
            hasTimes = hasTimes || record.time;
            length = measuring.next(record);
            ++count;
        },
        [&] { return hasTimes || (isCancelled && isCancelled()); }, {}, &contents);
    if (!measured && !hasTimes) {
        return measured;
    }
    const QString name = QFileInfo(path).fileName();
    const QString other = QString::fromStdString(model::otherContents(contents, name.toStdString()));
    const QString remark =
        hasTimes || other.isEmpty() ? QString() : QStringLiteral("%1: %2").arg(path, other);
    if (count == 0) {
        return tl::unexpected(measured->isEmpty() ? remark : *measured);
    }
    const log::SenderInfo file{name.toStdString(), log::Transport::File, 0};
    RawTime places;
    log::RecordedClock clock(timeline);
    std::optional<log::Stamp> last; // of those that say their time: the others came with them
    ImportResult result = visitFile(
        path,
        [&](const log::FileRecord& record) {
            const log::Duration place = places.next(record);
            last = record.time ? clock.stampOf(*record.time, record.setBy) : last;
            const log::Stamp stamp = last.value_or(end - length + place);
            take(record, record.sender.value_or(file), log::arrivalOf(record, {}, stamp));
        },
        isCancelled, visitNotes);
    clock.end();
    return result && result->isEmpty() ? ImportResult(remark) : result;
}

FileImport::FileImport(log::PacketLog& log, QString path, log::Stamp end)
    : m_log(log),
      m_path(std::move(path)),
      m_size(QFileInfo(m_path).size()),
      m_thread([this, end](const std::stop_token& stop) { run(stop, end); }) {}

void FileImport::run(const std::stop_token& stop, log::Stamp end) {
    if (const auto store = log::openStore(m_path.toStdString()); store && m_log.scratch()->hasFile()) {
        m_past.emplace(m_log.past(), m_log.senders(), *store);
        std::array<std::byte, mvnx::kLookedAt> head{};
        m_isInPlace = !mvnx::isMvnx(std::span(head).first((*store)->readAt(0, head)));
    }
    std::uint64_t bytesInStep = 0;
    const PacketTaker taker = [&](const log::FileRecord& record, const log::SenderInfo& sender,
                                  const log::Arrival& arrival) {
        log::Arrival whole = arrival;
        whole.sender = m_log.senders().intern(sender);
        take(record, whole);
        if (m_packetsRead % kPacketsInStep == 0 || m_bytesRead - bytesInStep >= kBytesAtOnce) {
            bytesInStep = m_bytesRead;
            keepStep(stop);
        }
    };
    ImportResult result = importRawFile(
        m_path, taker, end, m_log.timeline(), [&stop] { return stop.stop_requested(); },
        [this](std::span<const std::string_view> notes) { keepNotes(notes); });
    keepStep(stop);
    m_log.writer().publish(); // also if it was stopped
    if (m_past) {
        m_past->finish();
    }
    const std::lock_guard lock(m_mutex);
    m_result = std::move(result);
}

void FileImport::take(const log::FileRecord& record, log::Arrival arrival) {
    m_log.writer().append(record.bytes, arrival);
    keepComments(record);
    if (m_past && !m_log.scratch()->hasFile()) { // full: from here on memory has to do
        m_past.reset();
        m_log.past().dropBefore(UINT64_MAX);
    }
    if (m_past && record.isInOnePiece && m_isInPlace) {
        m_past->add(m_packetsRead, arrival, record.offset, record.bytes.size());
    } else if (m_past) {
        m_past->keep(m_packetsRead, arrival, record.bytes);
    }
    if (m_past && m_past->isFull()) {
        m_past->finish();
    }
    ++m_packetsRead;
    m_bytesRead += record.bytes.size();
}

void FileImport::keepComments(const log::FileRecord& record) {
    if (record.comments.empty() || m_commentCount == kMostComments) {
        return;
    }
    Comment added{m_packetsRead};
    for (const std::string& comment : record.comments) {
        const auto ofMark = log::parsePacketMark(comment);
        added.isMarked = added.isMarked || ofMark;
        added.text += (added.text.empty() ? "" : "\n") + ofMark.value_or(comment);
    }
    added.text.resize(std::min(added.text.size(), kLongestComment));
    ++m_commentCount;
    const std::lock_guard lock(m_mutex);
    m_comments.push_back(std::move(added));
}

/// A note says whatever its writer wanted: only of packets that are there.
void FileImport::keepNotes(std::span<const std::string_view> notes) {
    std::vector<log::RecordedMark> marks;
    for (const std::string_view note : notes) {
        auto mark = log::parseMark(note);
        if (mark && mark->packet < m_packetsRead && marks.size() < kMostComments) {
            mark->comment.resize(std::min(mark->comment.size(), kLongestComment));
            marks.push_back(std::move(*mark));
        }
    }
    const std::lock_guard lock(m_mutex);
    m_marks = std::move(marks);
}

std::vector<log::RecordedMark> FileImport::marks() const {
    const std::lock_guard lock(m_mutex);
    return m_marks;
}

std::vector<FileImport::Comment> FileImport::takeComments() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_comments, {});
}

void FileImport::keepStep(const std::stop_token& stop) {
    if (stop.stop_requested()) {
        return;
    }
    m_log.writer().publish();
    const std::uint64_t written = m_log.history().end();
    std::unique_lock lock(m_mutex);
    m_moved.wait(lock, stop, [&] { return m_followed >= written; });
}

void FileImport::follow(std::uint64_t position) {
    {
        const std::lock_guard lock(m_mutex);
        m_followed = position;
    }
    m_moved.notify_all();
}

double FileImport::share() const {
    const auto size = static_cast<double>(m_size);
    return size <= 0 ? 1 : std::min(1.0, static_cast<double>(m_bytesRead.load()) / size);
}

std::optional<ImportResult> FileImport::result() const {
    const std::lock_guard lock(m_mutex);
    return m_result;
}

OpenedFile::OpenedFile(const log::Clock& clock, QString path, const QString& cacheFolder)
    : m_clock(clock),
      m_path(std::move(path)),
      m_scratch(log::scratchOfFile(cacheFolder.toStdString())),
      m_origin(limitsOf(*m_scratch), m_scratch),
      m_import(std::make_unique<FileImport>(m_origin.log(), m_path, m_origin.log().timeline().now(clock))) {}

QString OpenedFile::name() const {
    return QFileInfo(m_path).fileName();
}

bool OpenedFile::follow(log::Duration most) {
    const log::Stamp now = m_origin.log().timeline().now(m_clock);
    const log::Moment begin = m_clock.monotonic();
    const std::uint64_t before = m_session.end();
    const bool isAtEnd = isShownAtEnd();
    while (m_session.followFile(now, kPacketsInTurn) && m_clock.monotonic() - begin < most) {
    }
    if (isAtEnd) {
        showEnd();
    }
    if (m_import != nullptr) {
        takeComments();
        m_import->follow(m_session.end());
        if (const auto result = m_import->result()) {
            finish(*result);
        }
    }
    return m_session.end() != before;
}

void OpenedFile::finish(const ImportResult& result) {
    readRest();
    m_ending = result ? *result : result.error();
    if (m_session.end() == 0) {
        m_failure = m_ending.isEmpty() ? tr("%1 has no datagrams.").arg(m_path) : m_ending;
    }
}

void OpenedFile::stop() {
    if (isReading()) {
        readRest();
        m_ending = tr("Opening %1 was stopped: %2 packets of it are here.").arg(name()).arg(m_session.end());
    }
}

void OpenedFile::takeComments() {
    for (FileImport::Comment& one : m_import->takeComments()) {
        m_session.setComment(one.packet, std::move(one.text));
        if (one.isMarked) {
            m_session.setMarked(one.packet, true);
        }
    }
}

void OpenedFile::takeMarks() {
    for (log::RecordedMark& mark : m_import->marks()) {
        m_session.setMarked(mark.packet, true);
        if (!mark.comment.empty()) {
            m_session.setComment(mark.packet, std::move(mark.comment));
        }
    }
}

/// All that is in the log: at most what is read at once.
void OpenedFile::readRest() {
    takeComments();
    takeMarks();
    m_import.reset();
    const bool isAtEnd = isShownAtEnd();
    while (m_session.followFile(m_origin.log().timeline().now(m_clock))) {
    }
    m_session.endFile();
    m_verdictEnd = 0; // its end settles what was open
    if (isAtEnd) {
        showEnd();
    }
}

/// Nobody has looked elsewhere while it was read.
bool OpenedFile::isShownAtEnd() const {
    const model::Cursor& cursor = m_session.choices().cursor;
    return cursor.speed == 0 && cursor.packet + 1 >= m_session.end();
}

/// By today's clock all of it would be old.
void OpenedFile::showEnd() {
    if (m_session.end() != 0) {
        m_session.setCursor({model::Cursor::Mode::Paused, m_session.end() - 1});
    }
}

const model::TakeVerdict& OpenedFile::verdict() {
    if (m_session.end() != m_verdictEnd) {
        m_verdictEnd = m_session.end();
        m_verdict = verdictOf(m_session, {});
    }
    return m_verdict;
}

QStringList OpenedFile::notes() const {
    QStringList notes;
    if (m_origin.log().past().isDamaged()) {
        notes += tr("The file was changed since it was opened: some of its packets cannot be read any more. "
                    "Open it again.");
    }
    if (!m_ending.isEmpty()) {
        notes += m_ending;
    }
    if (m_session.begin() != 0) {
        notes += tr("Memory is full: the first %1 of %2 packets are counted, but cannot be looked at.")
                     .arg(m_session.begin())
                     .arg(m_session.end());
    }
    return notes;
}

} // namespace posewire::gui
