// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/opened_file.h"

#include <QFile>
#include <QFileInfo>

#include <utility>

namespace posewire::gui {
namespace {

/// At once, so that the time that was given is kept to.
constexpr std::size_t kPacketsInTurn = 1'000;

/// Of a file that is read again when it is wanted.
constexpr std::size_t kMemoryCap = std::size_t{64} << 20;

log::LogLimits limitsOf(const log::Scratch& scratch) {
    return scratch.hasFile() ? log::LogLimits{.memoryCap = kMemoryCap} : log::LogLimits{};
}

} // namespace

OpenedFile::OpenedFile(const log::Clock& clock, QString path, const QString& cacheFolder)
    : m_clock(clock),
      m_path(std::move(path)),
      m_scratch(log::scratchOfFile(QFile::encodeName(cacheFolder).toStdString())),
      m_log(limitsOf(*m_scratch), m_scratch),
      m_import(std::make_unique<FileImport>(m_log, m_path, m_log.timeline().now(clock))) {}

QString OpenedFile::name() const {
    return QFileInfo(m_path).fileName();
}

bool OpenedFile::follow(log::Duration most) {
    const log::Stamp now = m_log.timeline().now(m_clock);
    const log::Moment begin = m_clock.monotonic();
    const std::uint64_t before = m_session.end();
    const bool isAtEnd = isShownAtEnd();
    while (m_session.followFile(now, kPacketsInTurn) && m_clock.monotonic() - begin < most) {
    }
    if (isAtEnd) {
        showEnd();
    }
    takeComments();
    if (m_import != nullptr) {
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
    if (m_import != nullptr) {
        for (auto& [packet, text] : m_import->takeComments()) {
            m_session.setComment(packet, std::move(text));
        }
    }
}

void OpenedFile::takeMarks() {
    if (m_import == nullptr) {
        return;
    }
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
    const log::Duration afterLast = m_import->afterLast();
    m_import.reset();
    const bool isAtEnd = isShownAtEnd();
    while (m_session.followFile(m_log.timeline().now(m_clock))) {
    }
    m_session.endFile(afterLast);
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
    if (m_log.past().isDamaged()) {
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
