// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/settings.h"

#include "app/gui/options.h"
#include "app/gui/saving.h"
#include "app/gui/theme/words.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>

namespace posewire::gui {

namespace {

/// Raised when the meaning of something in the file changes.
constexpr int kSchema = 1;

Settings settingsOf(const QJsonObject& object) {
    Settings settings;
    settings.theme = themeNamed(object["theme"].toString()).value_or(settings.theme);
    settings.layout = object["layout"].toString(settings.layout);
    const QJsonObject window = object["window"].toObject();
    settings.window = {window["x"].toInt(), window["y"].toInt(), window["width"].toInt(),
                       window["height"].toInt()};
    settings.isMaximized = window["maximized"].toBool();
    settings.docks = QByteArray::fromBase64(object["docks"].toString().toLatin1());
    settings.panels = object["panels"].toObject();
    settings.alerts = alertChoicesOf(object["alerts"].toObject());
    settings.inputs = inputChoicesOf(object["sources"].toObject());
    return settings;
}

QJsonObject objectOf(const Settings& settings) {
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
            {"alerts", jsonOf(settings.alerts)},
            {"panels", settings.panels},
            {"sources", jsonOf(settings.inputs)}};
}

} // namespace

SettingsFile::SettingsFile(QString path) : m_path(std::move(path)) {
    if (m_path.isEmpty()) {
        m_path = QStandardPaths::writableLocation(QStandardPaths::AppConfigLocation) +
                 QStringLiteral("/settings.json");
    }
}

Settings SettingsFile::read(QString* problem) {
    problem->clear();
    if (!QFile::exists(m_path)) {
        return {};
    }
    const auto content = readSmallFile(m_path);
    if (!content) {
        *problem = QFileInfo(m_path).isFile()
                       ? setAside(content.error())
                       : tr("Settings in %1 cannot be read: %2").arg(m_path, content.error());
        return {};
    }
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(*content, &error);
    if (!document.isObject()) {
        *problem = setAside(error.errorString());
        return {};
    }
    const int schema = document.object()["schema"].toInt();
    if (schema != kSchema) {
        *problem =
            setAside(tr("their version is %1, this program reads version %2").arg(schema).arg(kSchema));
        return {};
    }
    return settingsOf(document.object());
}

QString SettingsFile::setAside(const QString& reason) const {
    QString aside;
    for (int i = 1; aside.isEmpty() || QFile::exists(aside); ++i) {
        aside = QStringLiteral("%1.aside-%2").arg(m_path).arg(i);
    }
    if (!QFile::rename(m_path, aside)) {
        return tr("Settings in %1 cannot be used (%2).").arg(m_path, reason);
    }
    return tr("Settings could not be used (%1); they were set aside as %2.").arg(reason, aside);
}

QString SettingsFile::write(const Settings& settings) const {
    if (!QDir().mkpath(QFileInfo(m_path).absolutePath())) {
        return tr("The folder of %1 cannot be created.").arg(m_path);
    }
    return saveFile(m_path, QJsonDocument(objectOf(settings)).toJson());
}

} // namespace posewire::gui
