// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/settings.h"

#include "app/gui/base/logging.h"
#include "app/gui/base/options.h"
#include "app/gui/base/saving.h"
#include "app/gui/theme/words.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QLockFile>
#include <QRegularExpression>
#include <QStandardPaths>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
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

/// Raised when the meaning of something in the file changes, with a step for files of the version before.
constexpr int kSchema = 2;

/// Version 1 called what we receive by the word for senders.
void renameSources(QJsonObject& object) {
    object["receiving"] = object.take("sources");
}

/// From each version to the next, from version 1 on.
constexpr std::array<void (*)(QJsonObject&), kSchema - 1> kMigrations{renameSources};

QLatin1String keyOf(const model::ThresholdRow& row) {
    return {row.key.data(), static_cast<qsizetype>(row.key.size())};
}

/// Of a window, in logical pixels: a rectangle of these has edges that can be calculated with.
constexpr int kFarthest = 100'000;

int pixels(const QJsonValue& value, int least) {
    return std::clamp(value.toInt(), least, kFarthest);
}

/// Qt trusts the places of docks that it reads: where they are damaged, it may crash.
QString sumOf(const QByteArray& docks) {
    return QString::fromLatin1(QCryptographicHash::hash(docks, QCryptographicHash::Sha256).toHex());
}

QByteArray docksOf(const QJsonObject& object) {
    const QByteArray docks = QByteArray::fromBase64(object["docks"].toString().toLatin1());
    return object["docksSum"].toString() == sumOf(docks) ? docks : QByteArray();
}

QJsonObject jsonOf(const HistoryChoice& history) {
    return {{"disk", history.isOnDisk}, {"gigabytes", history.gigabytes}};
}

HistoryChoice historyOf(const QJsonObject& object) {
    HistoryChoice history;
    history.isOnDisk = object["disk"].toBool(history.isOnDisk);
    const int gigabytes = object["gigabytes"].toInt();
    if (gigabytes >= 1 && gigabytes <= HistoryChoice::kMostGigabytes) {
        history.gigabytes = gigabytes;
    }
    return history;
}

Settings settingsOf(const QJsonObject& object) {
    Settings settings;
    settings.theme = themeNamed(object["theme"].toString()).value_or(settings.theme);
    settings.layout = object["layout"].toString(settings.layout);
    const QJsonObject window = object["window"].toObject();
    settings.window = {pixels(window["x"], -kFarthest), pixels(window["y"], -kFarthest),
                       pixels(window["width"], 0), pixels(window["height"], 0)};
    settings.isMaximized = window["maximized"].toBool();
    settings.docks = docksOf(object);
    settings.panels = object["panels"].toObject();
    settings.alerts = alertChoicesOf(object["alerts"].toObject());
    settings.inputs = inputChoicesOf(object["receiving"].toObject());
    settings.history = historyOf(object["history"].toObject());
    settings.recording = recordingChoiceOf(object["recording"].toObject());
    settings.viewport = object["viewport"].toObject();
    settings.filter = object["filter"].toString().left(Settings::kLongestFilter);
    settings.file = object["file"].toString();
    settings.fileFilter = object["fileFilter"].toString().left(Settings::kLongestFilter);
    settings.comparedFile = object["comparedFile"].toString();
    settings.take = object["take"].toString();
    settings.recovered = object["recovered"].toString();
    settings.replayTarget = object["replayTarget"].toString().left(Settings::kLongestFilter);
    settings.isGuideOffered = object["tour"].toInt() > 0;
    for (const auto& path : object["recentFiles"].toArray()) {
        if (path.isString() && settings.recentFiles.size() < Settings::kMostRecentFiles) {
            settings.recentFiles += path.toString();
        }
    }
    return settings;
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
    QString path = folder.filePath(named(QStringLiteral("%1").arg(take, 3, 10, QLatin1Char('0')),
                                         begin.toString(QStringLiteral("yyyy-MM-dd")),
                                         begin.toString(QStringLiteral("HH-mm-ss"))));
    const QString stem = path.chopped(7);
    for (int copy = 2; QFileInfo::exists(path); ++copy) {
        path = QStringLiteral("%1 (%2).pcapng").arg(stem).arg(copy);
    }
    return path;
}

QString patternProblem(const QString& pattern) {
    const bool isPath = pattern.contains(QLatin1Char('/')) || pattern.contains(QLatin1Char('\\'));
    const bool hasOdd = std::ranges::any_of(pattern, [](QChar letter) {
        return letter < QLatin1Char(' ') || QStringLiteral("<>:\"|?*").contains(letter);
    });
    return isPath || hasOdd ? tr("A name has none of / \\ < > : \" | ? *; the folder is chosen above.")
                            : QString();
}

QJsonObject jsonOf(const AlertChoices& choices) {
    QJsonObject object;
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        object[keyOf(row)] = choices.thresholds.*row.limit;
    }
    object["warningSound"] = choices.hasWarningSound;
    object["errorSound"] = choices.hasErrorSound;
    object["notification"] = choices.hasNotification;
    return object;
}

AlertChoices alertChoicesOf(const QJsonObject& object) {
    AlertChoices choices;
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        const double value = object[keyOf(row)].toDouble(-1);
        if (value >= row.least && value <= row.most) {
            choices.thresholds.*row.limit = value;
        }
    }
    choices.hasWarningSound = object["warningSound"].toBool();
    choices.hasErrorSound = object["errorSound"].toBool();
    choices.hasNotification = object["notification"].toBool();
    return choices;
}

tl::expected<Settings, QString> parseSettings(const QByteArray& json) {
    auto object = parseSmallObject(json);
    if (!object) {
        return tl::unexpected(object.error());
    }
    const int schema = (*object)["schema"].toInt();
    if (schema < 1 || schema > kSchema) {
        return tl::unexpected(
            tr("their version is %1, this program reads up to version %2").arg(schema).arg(kSchema));
    }
    for (int version = schema; version < kSchema; ++version) {
        qCInfo(settingsLog) << "migrated from version" << version;
        kMigrations.at(static_cast<std::size_t>(version - 1))(*object);
    }
    return settingsOf(*object);
}

QJsonObject jsonOf(const Settings& settings) {
    const QJsonObject window{{"x", settings.window.x()},
                             {"y", settings.window.y()},
                             {"width", settings.window.width()},
                             {"height", settings.window.height()},
                             {"maximized", settings.isMaximized}};
    return {{"schema", kSchema},
            {"theme", themeName(settings.theme)},
            {"layout", settings.layout},
            {"window", window},
            {"docks", QString::fromLatin1(settings.docks.toBase64())},
            {"docksSum", sumOf(settings.docks)},
            {"alerts", jsonOf(settings.alerts)},
            {"panels", settings.panels},
            {"receiving", jsonOf(settings.inputs)},
            {"history", jsonOf(settings.history)},
            {"recording", jsonOf(settings.recording)},
            {"viewport", settings.viewport},
            {"filter", settings.filter},
            {"file", settings.file},
            {"fileFilter", settings.fileFilter},
            {"comparedFile", settings.comparedFile},
            {"take", settings.take},
            {"recovered", settings.recovered},
            {"replayTarget", settings.replayTarget},
            {"tour", settings.isGuideOffered ? 1 : 0},
            {"recentFiles", QJsonArray::fromStringList(settings.recentFiles)}};
}

SettingsFile::SettingsFile(QString path) : m_path(std::move(path)) {
    if (m_path.isEmpty()) {
        m_path = QStandardPaths::writableLocation(QStandardPaths::AppConfigLocation) +
                 QStringLiteral("/settings.json");
    }
}

Settings SettingsFile::read(QString* problem) {
    problem->clear();
    m_known = jsonOf(Settings());
    if (!QFile::exists(m_path)) {
        qCInfo(settingsLog).noquote() << "none in" << m_path;
        return {};
    }
    const auto content = readSmallFile(m_path);
    if (!content) {
        *problem = QFileInfo(m_path).isFile()
                       ? setAside(content.error())
                       : tr("Settings in %1 cannot be read: %2").arg(m_path, content.error());
        return {};
    }
    auto settings = parseSettings(*content);
    if (!settings) {
        *problem = setAside(settings.error());
        return {};
    }
    qCInfo(settingsLog).noquote() << "read from" << m_path;
    m_known = jsonOf(*settings);
    return *std::move(settings);
}

QString SettingsFile::setAside(const QString& reason) const {
    QString aside;
    for (int i = 1; aside.isEmpty() || QFile::exists(aside); ++i) {
        aside = QStringLiteral("%1.aside-%2").arg(m_path).arg(i);
    }
    if (!QFile::rename(m_path, aside)) {
        return tr("Settings in %1 cannot be used (%2).").arg(m_path, reason);
    }
    qCInfo(settingsLog).noquote() << "set aside as" << aside;
    return tr("Settings could not be used (%1); they were set aside as %2.").arg(reason, aside);
}

QString SettingsFile::write(const Settings& settings) {
    constexpr std::chrono::milliseconds kPatience(500); // for another window that writes
    const QJsonObject own = jsonOf(settings);
    if (own == m_known) {
        return {};
    }
    if (!log::makeFolder(QFileInfo(m_path).absolutePath().toStdString())) {
        return tr("The folder of %1 cannot be created.").arg(m_path);
    }
    QLockFile lock(m_path + QStringLiteral(".lock"));
    static_cast<void>(lock.tryLock(kPatience)); // the file is whole without, too
    QJsonObject whole = QJsonDocument::fromJson(readSmallFile(m_path).value_or(QByteArray())).object();
    for (auto entry = own.constBegin(); entry != own.constEnd(); ++entry) {
        if (entry.value() != m_known.value(entry.key()) || !whole.contains(entry.key())) {
            whole.insert(entry.key(), entry.value());
        }
    }
    const QString problem = saveFile(m_path, QJsonDocument(whole).toJson());
    qCInfo(settingsLog).noquote() << (problem.isEmpty() ? "written to " + m_path : problem);
    m_known = problem.isEmpty() ? own : m_known;
    return problem;
}

} // namespace posewire::gui
