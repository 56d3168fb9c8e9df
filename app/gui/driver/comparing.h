// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/background.h"
#include "app/gui/base/commands.h"
#include "app/gui/base/comparison.h"
#include "app/gui/driver/opened_file.h"
#include "core/export/comparison/pose_comparison.h"

#include <QObject>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace posewire::gui {

/// A comparison as a thread takes it: by value except the logs, which outlive it.
struct ComparisonOrder {
    feed::PoseSource first;      ///< all of it
    feed::PoseSource firstRange; ///< what is compared of it
    feed::PoseSource second;
    /// As far as they are known from before; null if they are to be made.
    std::shared_ptr<const exporting::Timetable> firstTable;
    std::shared_ptr<const exporting::Timetable> secondTable;
    std::optional<exporting::AlignBy> by;
    double offset = 0;
    model::DifferenceFrame frame = model::DifferenceFrame::World;
};

struct ComparisonOutcome {
    std::shared_ptr<const exporting::Timetable> firstTable; ///< null if it was cancelled
    std::shared_ptr<const exporting::Timetable> secondTable;
    std::shared_ptr<const exporting::Partners> partners;
    std::shared_ptr<const exporting::MotionComparison> comparison;
};

[[nodiscard]] ComparisonOutcome compared(const ComparisonOrder& order,
                                         const exporting::ExportProgress& progress);

/// Writes the differences of a range to a file. Returns what went wrong, empty for nothing.
[[nodiscard]] std::string writeDifferences(const ComparisonOrder& order,
                                           const std::vector<exporting::SegmentFigures>& segments,
                                           const std::string& path,
                                           const exporting::ExportProgress& progress);

/// Compares what is shown with a second recording: keeps that at the same moment, and has a thread work out
/// the range that figures are of. Neither ever waits for that thread, except if a log goes that it reads.
class Comparing final : public QObject {
    Q_OBJECT

public:
    /// Commands and clock must outlive it.
    Comparing(Commands& commands, const log::Clock& clock, QString cacheFolder);

    /// Begins to read the second recording, instead of one that is open; changed() says how it went.
    void open(const QString& path);
    void close();
    /// Reads no further: what was read is compared.
    void stopReading();
    /// Null if none is open.
    [[nodiscard]] OpenedFile* file() const { return m_file.get(); }
    [[nodiscard]] bool isReading() const { return m_file != nullptr && m_file->isReading(); }

    void choose(const ComparisonChoice& choice);
    /// Ends the work on the range until it is asked for again, or something else is chosen.
    void stop();
    void workAgain();
    /// Ends the comparison if it is of this log. No thread reads the log once this returns.
    void endOf(const log::PacketLog& log);

    /// One display tick, for about as long as `most`; true if there is something new to show.
    bool follow(log::Duration most);
    [[nodiscard]] const ComparisonState& state() const { return m_state; }

    /// Writes the differences of the range that was worked out last; changed() says how it went.
    void save(const QString& path);

signals:
    /// Another recording is compared, or it is in another way; `text` is what is to be said, empty for
    /// nothing.
    void changed(const QString& text = {});
    /// The window asks which recording what is shown is to be compared with.
    void askForRecording();

private:
    struct Subject {
        const log::PacketLog* log = nullptr;
        exporting::CharacterPair pair;
        std::optional<exporting::AlignBy> by;
        double offset = 0;
        model::DifferenceFrame frame = model::DifferenceFrame::World;
        friend bool operator==(const Subject&, const Subject&) = default;
    };
    struct Reach {
        std::optional<model::TimeRange> range;
        std::uint64_t end = 0;
        friend bool operator==(const Reach&, const Reach&) = default;
    };

    void clear();
    void updatePair(model::SessionView& shown);
    [[nodiscard]] std::optional<exporting::CharacterPair> choosePair(model::SessionView& shown) const;
    void endWork();
    void forgetResults();
    [[nodiscard]] bool takeResult();
    void beginWork(model::SessionView& shown);
    [[nodiscard]] bool isWorkDue(const model::SessionView& shown) const;
    [[nodiscard]] Subject subjectOf(const model::SessionView& shown) const;
    [[nodiscard]] ComparisonOrder orderFor(const model::SessionView& shown) const;
    void followCursor(model::SessionView& shown);
    [[nodiscard]] QString problemOf(model::SessionView& shown) const;
    void addNotes();

    Commands& m_commands;
    const log::Clock& m_clock;
    const QString m_cacheFolder;
    std::unique_ptr<OpenedFile> m_file;
    ComparisonState m_state;
    model::Selection m_pairSelection; ///< that the pair was chosen for, and when
    log::Moment m_pairChosen{};
    // What is known of the pair:
    Subject m_known; ///< by and offset mean nothing here
    std::shared_ptr<const exporting::Timetable> m_firstTable;
    std::uint64_t m_firstTableEnd = 0; ///< packets that it is of
    std::shared_ptr<const exporting::Timetable> m_secondTable;
    std::optional<exporting::Partners> m_partners;
    // What was worked out last, or is:
    std::optional<Subject> m_subject;
    Reach m_reach;
    ComparisonOrder m_order;   ///< that is worked on
    ComparisonOrder m_shown{}; ///< of the range in the state
    log::Moment m_begun{};
    log::Moment m_nextWork{};
    // Last: their threads read the logs.
    using Work = Background<ComparisonOutcome>;
    std::unique_ptr<Work> m_work;
    std::vector<std::unique_ptr<Work>> m_ending;
    std::unique_ptr<Background<std::string>> m_saving;
    QString m_savingTo;
    const log::PacketLog* m_savingOf = nullptr;
};

} // namespace posewire::gui
