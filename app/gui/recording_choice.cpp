// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/recording_choice.h"

#include "app/gui/theme/words.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStandardPaths>

#include <algorithm>
#include <set>

namespace posewire::gui {

namespace {

int numberOf(const QJsonObject& object, const char* key, int usual, int most) {
    const int number = object[QLatin1String(key)].toInt(usual);
    return number >= 0 && number <= most ? number : usual;
}

/// The numbers of the takes that are there, whenever they were made.
std::set<int> takesIn(const QDir& folder, const QString& pattern) {
    QString wanted = QRegularExpression::escape(pattern + QStringLiteral(".pcapng"));
    for (const QLatin1String time : {QLatin1String("{date}"), QLatin1String("{time}")}) {
        wanted.replace(QRegularExpression::escape(QString(time)), QStringLiteral(".*"));
    }
    wanted.replace(QRegularExpression::escape(QStringLiteral("{take}")), QStringLiteral("(\\d{3,})"));
    const QRegularExpression name(QRegularExpression::anchoredPattern(wanted));
    std::set<int> takes;
    for (const QString& file : folder.entryList({QStringLiteral("*.pcapng")}, QDir::Files)) {
        if (const QRegularExpressionMatch match = name.match(file); match.hasMatch()) {
            takes.insert(match.captured(1).toInt());
        }
    }
    return takes;
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
    int take = 1;
    if (isNumbered) {
        const std::set<int> taken = takesIn(folder, pattern);
        while (taken.contains(take)) {
            ++take;
        }
    }
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
