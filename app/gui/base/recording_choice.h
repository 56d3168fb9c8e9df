// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDateTime>
#include <QJsonObject>
#include <QString>

namespace posewire::gui {

/// Where takes are recorded, and how.
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

/// What is missing or out of bounds is as it is by default.
[[nodiscard]] RecordingChoice recordingChoiceOf(const QJsonObject& object);
[[nodiscard]] QJsonObject jsonOf(const RecordingChoice& choice);

[[nodiscard]] QString recordingFolder(const RecordingChoice& choice);
/// The path of the next take, whose name is free.
[[nodiscard]] QString nextTakePath(const RecordingChoice& choice, const QDateTime& begin);
/// What is wrong with a pattern; empty for nothing.
[[nodiscard]] QString patternProblem(const QString& pattern);

} // namespace posewire::gui
