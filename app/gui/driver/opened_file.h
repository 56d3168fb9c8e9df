// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/saving.h"
#include "core/log/clock.h"
#include "core/log/past.h"
#include "core/log/pcapng_writer.h"
#include "core/log/recording_file.h"
#include "core/log/time.h"
#include "core/model/session/origin.h"
#include "core/model/session/verdict.h"

#include <QCoreApplication>
#include <QString>
#include <QStringList>

#include <tl/expected.hpp>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace posewire::gui {

/// Read well, with why it was not read to its end, if so; or why it could not be read. For the operator.
using ImportResult = tl::expected<QString, QString>;
using PacketTaker = std::function<void(const log::FileRecord& record, const log::SenderInfo& sender,
                                       const log::Arrival& arrival)>;

/// Reads a file of datagrams, in the order of the file. Captures keep stamps and senders; a raw file has
/// none: it is spaced as log::RawPace says so that its newest datagram is at `end`, and is its own sender.
/// The clock of the file goes to `timeline`. Ends once `isCancelled` returns true.
[[nodiscard]] ImportResult importRawFile(const QString& path, const PacketTaker& take, log::Stamp end,
                                         log::Timeline& timeline,
                                         const std::function<bool()>& isCancelled = {},
                                         const log::NotesVisitor& visitNotes = {});

/// Brings a file into a log on a thread of its own, which alone writes that log, in step with who follows it:
/// what was read waits until all before it was looked at, so that nothing of a file is ever overtaken,
/// however small the log. Where the log has a scratch file, what its memory drops is read from the file
/// itself from then on.
class FileImport {
public:
    static constexpr std::size_t kMostComments = 10'000;
    static constexpr std::size_t kLongestComment = 1'024; ///< bytes

    /// The log outlives this.
    FileImport(log::PacketLog& log, QString path, log::Stamp end);
    /// The follower has looked at all packets below one.
    void follow(std::uint64_t position);
    /// From 0 to 1.
    [[nodiscard]] double share() const;
    /// Of a packet of the file, by its number; its bytes as they are there, clipped.
    struct Comment {
        std::uint64_t packet = 0;
        bool isMarked = false;
        std::string text{};
    };
    /// Those that were read since this was asked last; of a file that has too many the first ones.
    [[nodiscard]] std::vector<Comment> takeComments();
    /// Packets that were marked while the file was recorded, as far as it was read.
    [[nodiscard]] std::vector<log::RecordedMark> marks() const;
    /// Once all of it is in the log, or no more comes.
    [[nodiscard]] std::optional<ImportResult> result() const;

private:
    void run(const std::stop_token& stop, log::Stamp end);
    void take(const log::FileRecord& record, log::Arrival arrival);
    void keepComments(const log::FileRecord& record);
    void keepNotes(std::span<const std::string_view> notes);
    /// Waits until all that was read was looked at.
    void keepStep(const std::stop_token& stop);

    log::PacketLog& m_log;
    const QString m_path;
    const std::int64_t m_size; ///< bytes
    std::atomic<std::uint64_t> m_bytesRead = 0;
    std::uint64_t m_packetsRead = 0;       ///< the thread's own
    std::size_t m_commentCount = 0;        ///< likewise
    std::optional<log::PastWriter> m_past; ///< likewise
    bool m_isInPlace = true;               ///< packets lie in the file as they are: not of MVNX
    mutable std::mutex m_mutex;            ///< guards the members below
    std::condition_variable_any m_moved;
    std::uint64_t m_followed = 0;
    std::vector<Comment> m_comments; ///< not taken yet
    std::vector<log::RecordedMark> m_marks;
    std::optional<ImportResult> m_result;
    std::jthread m_thread; ///< last: it uses all of the above
};

/// A file that was opened: an origin of its own, so that it touches none of what is received. It is shown as
/// it was then, stopped at its newest packet. Its packets are read from the file when they are wanted; in
/// memory are only the newest that were read, unless there is no room for a scratch file.
class OpenedFile {
    Q_DECLARE_TR_FUNCTIONS(OpenedFile)

public:
    /// Begins to read. The clock outlives this. `cacheFolder`: for its scratch file; in memory without one.
    OpenedFile(const log::Clock& clock, QString path, const QString& cacheFolder);

    [[nodiscard]] model::Session& session() { return m_session; }
    [[nodiscard]] const QString& path() const { return m_path; }
    [[nodiscard]] QString name() const;

    [[nodiscard]] bool isReading() const { return m_import != nullptr; }
    /// From 0 to 1.
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
    model::Origin m_origin;
    model::Session& m_session = m_origin.session();
    model::TakeVerdict m_verdict;
    std::uint64_t m_verdictEnd = 0; ///< packets that it is on
    QString m_failure;
    QString m_ending;                     ///< if it ends too early, or was stopped
    std::unique_ptr<FileImport> m_import; ///< null once it was read; last: it writes the log
};

} // namespace posewire::gui
