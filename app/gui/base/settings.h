// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/input_choices.h"
#include "app/gui/theme/theme.h"
#include "core/model/incidents/thresholds.h"

#include <QByteArray>
#include <QDateTime>
#include <QJsonObject>
#include <QRect>
#include <QString>
#include <QStringList>

#include <tl/expected.hpp>

namespace posewire::gui {

struct RecordingChoice {
    QString folder{};          ///< empty for "Posewire" in the user's documents
    QString pattern{};         ///< of the names of files; empty for kDefaultPattern
    int preRollSeconds = 0;    ///< of what was received before, kept too
    int fileMegabytes = 0;     ///< of one file; 0 for any
    int fileMinutes = 0;       ///< of one file; 0 for any
    int freeMegabytes = 1'000; ///< a recording ends before its disk has less

    static constexpr int kMostPreRoll = 3'600;
    static constexpr int kMostMegabytes = 1'000'000;
    static constexpr int kMostMinutes = 1'440;
    /// {take} is the first number of which there is no file, {date} and {time} are when it begins.
    static constexpr const char* kDefaultPattern = "Take {take} {date} {time}";

    friend bool operator==(const RecordingChoice&, const RecordingChoice&) = default;
};

/// Entries that are missing or out of bounds are as by default.
[[nodiscard]] RecordingChoice recordingChoiceOf(const QJsonObject& object);
[[nodiscard]] QJsonObject jsonOf(const RecordingChoice& choice);

[[nodiscard]] QString recordingFolder(const RecordingChoice& choice);
/// The path of the next take, whose name is free.
[[nodiscard]] QString nextTakePath(const RecordingChoice& choice, const QDateTime& begin);
/// Says why a pattern cannot be used; empty if it can.
[[nodiscard]] QString patternProblem(const QString& pattern);

/// When the operator wants to be alerted, and how: kept from one run to the next.
struct AlertChoices {
    model::Thresholds thresholds;
    bool hasWarningSound = false;
    bool hasErrorSound = false;
    bool hasNotification = false; ///< by the desktop, when the verdict turns bad
    friend bool operator==(const AlertChoices&, const AlertChoices&) = default;
};

[[nodiscard]] QJsonObject jsonOf(const AlertChoices& choices);
/// Entries that are missing or make no sense are as shipped.
[[nodiscard]] AlertChoices alertChoicesOf(const QJsonObject& object);

struct HistoryChoice {
    static constexpr int kMostGigabytes = 10'000;
    bool isOnDisk = true;
    int gigabytes = 8; ///< at most, and never more than a tenth of what is free
    friend bool operator==(const HistoryChoice&, const HistoryChoice&) = default;
};

struct Settings {
    ThemeChoice theme = ThemeChoice::System;
    QString layout = QStringLiteral("Debug"); ///< the layout last chosen; docks may have been moved since
    QRect window;                             ///< logical pixels; empty for the default
    bool isMaximized = false;
    QByteArray docks;   ///< QMainWindow::saveState, as it was written; empty for the layout as shipped
    QJsonObject panels; ///< Panel::state() by the name of the dock
    AlertChoices alerts;
    InputChoices inputs;
    HistoryChoice history;
    RecordingChoice recording;
    QJsonObject viewport;        ///< ViewportWidget::state()
    QString filter;              ///< the display filter chosen for what is received; empty for none
    QString file;                ///< the recording that was shown at the end; empty for none
    QString fileFilter;          ///< the display filter chosen for that
    QString comparedFile;        ///< what that, or what was received, was compared with; empty for none
    bool isGuideOffered = false; ///< at the first start
    QString take;                ///< that is being recorded, or was cut off; empty once that has been seen
    QString recovered;           ///< what an earlier run left and the operator has seen; empty for nothing
    QString replayTarget;        ///< that was sent to last; empty for none
    QStringList recentFiles;     ///< paths, the newest first, at most kMostRecentFiles
    static constexpr int kMostRecentFiles = 8;
    static constexpr qsizetype kLongestFilter = 10'000;
    friend bool operator==(const Settings&, const Settings&) = default;
};

/// Also those that earlier versions wrote. What is missing, larger than it can be or of the wrong kind is as
/// shipped. The error says why nothing could be read.
[[nodiscard]] tl::expected<Settings, QString> parseSettings(const QByteArray& json);
[[nodiscard]] QJsonObject jsonOf(const Settings& settings);

class SettingsFile {
public:
    /// An empty path means the user's own file.
    explicit SettingsFile(QString path = {});

    /// Defaults where there is no file. A file that cannot be understood is renamed, so that nothing in it is
    /// lost, and `problem` says so in words for the operator.
    [[nodiscard]] Settings read(QString* problem);

    /// Replaces the file as a whole or leaves it; the answer is what went wrong, empty for nothing. Entries
    /// that are as they were read or written last stay as they are in the file: another window may have
    /// changed them. If that is all, nothing is written.
    [[nodiscard]] QString write(const Settings& settings);

private:
    QString setAside(const QString& reason) const;

    QString m_path;
    QJsonObject m_known; ///< as read or written last
};

} // namespace posewire::gui
