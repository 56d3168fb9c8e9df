// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/saving.h"
#include "app/gui/driver/file_import.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"
#include "core/model/session/session.h"
#include "core/model/session/verdict.h"

#include <QCoreApplication>
#include <QString>
#include <QStringList>

#include <memory>

namespace posewire::gui {

/// A file that was opened: a session of its own, so that it touches none of what is received. It is shown as
/// it was then, stopped at its newest packet. Its packets are read from the file when they are wanted; in
/// memory are only the newest that were read, unless there is no room for a scratch file.
class OpenedFile {
    Q_DECLARE_TR_FUNCTIONS(OpenedFile)

public:
    /// Begins to read. The clock outlives this. `cacheFolder`: for its scratch file; in memory without one.
    OpenedFile(const log::Clock& clock, QString path, const QString& cacheFolder);

    [[nodiscard]] model::Session& session() { return m_session; }
    [[nodiscard]] const QString& path() const { return m_path; }
    /// Its name without folders.
    [[nodiscard]] QString name() const;

    [[nodiscard]] bool isReading() const { return m_import != nullptr; }
    /// How much of it was read, from 0 to 1.
    [[nodiscard]] double share() const { return m_import == nullptr ? 1 : m_import->share(); }
    /// Follows what was read, for about as long as `most`; true if anything was new.
    bool follow(log::Duration most);
    /// Reads no further: what was read is there.
    void stop();
    /// Why it could not be read; empty if it could, or is being read.
    [[nodiscard]] const QString& failure() const { return m_failure; }

    /// On all of it that was read.
    [[nodiscard]] const model::TakeVerdict& verdict();
    /// For the operator to know for as long as the file is shown: that it is cut off, was not read to its
    /// end, or does not fit into memory. A line each.
    [[nodiscard]] QStringList notes() const;

private:
    void finish(const ImportResult& result);
    void takeComments();
    void takeMarks(); ///< once: they are known at the end
    void readRest();
    [[nodiscard]] bool isShownAtEnd() const;
    void showEnd();

    const log::Clock& m_clock;
    const QString m_path;
    const KeptFromSaving m_kept{m_path};
    const std::shared_ptr<log::Scratch> m_scratch;
    log::PacketLog m_log;
    model::Session m_session{m_log};
    model::TakeVerdict m_verdict;
    std::uint64_t m_verdictEnd = 0; ///< packets that it is on
    QString m_failure;
    QString m_ending;                     ///< if it ends too early, or was stopped
    std::unique_ptr<FileImport> m_import; ///< null once it was read; last: it writes the log
};

} // namespace posewire::gui
