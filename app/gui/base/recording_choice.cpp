// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/recording_choice.h"

#include "app/gui/theme/words.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStandardPaths>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

int numberOf(const QJsonObject& object, const char* key, int usual, int most) {
    const int number = object[QLatin1String(key)].toInt(usual);
    return number >= 0 && number <= most ? number : usual;
}

/// The highest number of the takes that are there, whenever they were made, and whatever somebody has added
/// to their names; 0 where there are none.
int newestTakeIn(const QDir& folder, const QString& pattern) {
    QString wanted = QRegularExpression::escape(pattern);
    for (const auto& [place, digits] :
         {std::pair("{date}", "\\d{4}-\\d\\d-\\d\\d"), std::pair("{time}", "\\d\\d-\\d\\d-\\d\\d"),
          std::pair("{take}", "(\\d{3,6})")}) {
        wanted.replace(QRegularExpression::escape(QLatin1String(place)), QLatin1String(digits));
    }
    const QRegularExpression name(
        QRegularExpression::anchoredPattern(wanted + QStringLiteral("(\\D.*)?\\.pcapng")));
    int newest = 0;
    for (const QString& file : folder.entryList({QStringLiteral("*.pcapng")}, QDir::Files | QDir::Hidden)) {
        if (const QRegularExpressionMatch match = name.match(file); match.hasMatch()) {
            newest = std::max(newest, match.captured(1).toInt());
        }
    }
    return newest;
}

} // namespace

RecordingChoice recordingChoiceOf(const QJsonObject& object) {
    RecordingChoice choice;
    choice.folder = object["folder"].toString();
    choice.pattern = object["pattern"].toString();
    if (!patternProblem(choice.pattern).isEmpty()) {
        choice.pattern.clear();
    }
    choice.preRollSeconds = numberOf(object, "preRollSeconds", 0, RecordingChoice::kMostPreRoll);
    choice.fileMegabytes = numberOf(object, "fileMegabytes", 0, RecordingChoice::kMostMegabytes);
    choice.fileMinutes = numberOf(object, "fileMinutes", 0, RecordingChoice::kMostMinutes);
    choice.freeMegabytes =
        numberOf(object, "freeMegabytes", choice.freeMegabytes, RecordingChoice::kMostMegabytes);
    return choice;
}

QJsonObject jsonOf(const RecordingChoice& choice) {
    return {{"folder", choice.folder},
            {"pattern", choice.pattern},
            {"preRollSeconds", choice.preRollSeconds},
            {"fileMegabytes", choice.fileMegabytes},
            {"fileMinutes", choice.fileMinutes},
            {"freeMegabytes", choice.freeMegabytes}};
}

QString recordingFolder(const RecordingChoice& choice) {
    return !choice.folder.isEmpty() ? choice.folder
                                    : QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) +
                                          QStringLiteral("/Posewire");
}

QString nextTakePath(const RecordingChoice& choice, const QDateTime& begin) {
    const QString pattern =
        choice.pattern.isEmpty() ? QLatin1String(RecordingChoice::kDefaultPattern) : choice.pattern;
    const QDir folder(recordingFolder(choice));
    // The number counts takes: a time in the name must not make each the first.
    const auto named = [&](const QString& take, const QString& day, const QString& moment) {
        QString name = pattern;
        name.replace(QLatin1String("{date}"), day).replace(QLatin1String("{time}"), moment);
        return name.replace(QLatin1String("{take}"), take) + QStringLiteral(".pcapng");
    };
    const bool isNumbered = pattern.contains(QLatin1String("{take}"));
    const int take = isNumbered ? newestTakeIn(folder, pattern) + 1 : 1;
    const QString path = folder.filePath(named(QStringLiteral("%1").arg(take, 3, 10, QLatin1Char('0')),
                                               begin.toString(QStringLiteral("yyyy-MM-dd")),
                                               begin.toString(QStringLiteral("HH-mm-ss"))));
    if (!QFileInfo::exists(path)) {
        return path;
    }
    int copy = 2;
    const QString stem = path.chopped(7);
    while (QFileInfo::exists(QStringLiteral("%1 (%2).pcapng").arg(stem).arg(copy))) {
        ++copy;
    }
    return QStringLiteral("%1 (%2).pcapng").arg(stem).arg(copy);
}

QString patternProblem(const QString& pattern) {
    const bool isPath = pattern.contains(QLatin1Char('/')) || pattern.contains(QLatin1Char('\\'));
    const bool hasOdd = std::ranges::any_of(pattern, [](QChar letter) {
        return letter < QLatin1Char(' ') || QStringLiteral("<>:\"|?*").contains(letter);
    });
    return isPath || hasOdd ? tr("A name has none of / \\ < > : \" | ? *; the folder is chosen above.")
                            : QString();
}

} // namespace posewire::gui
