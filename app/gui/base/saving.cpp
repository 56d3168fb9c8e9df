// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/saving.h"

#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QBuffer>
#include <QClipboard>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QJsonArray>
#include <QJsonDocument>
#include <QPixmap>
#include <QRegularExpression>

#include <algorithm>
#include <span>

namespace posewire::gui {

namespace {

std::vector<std::string>& filesInUse() {
    static std::vector<std::string> files;
    return files;
}

/// Why a path is no place for a file; empty where it is one. Opening a pipe may take forever, and a device
/// has no end.
QString noFile(const QString& path) {
    const QFileInfo info(path);
    return info.exists() && !info.isFile() ? tr("it is a folder, a pipe or a device, not a file") : QString();
}

QJsonValue small(const QJsonValue& value, int depth);

QJsonObject small(const QJsonObject& object, int depth) {
    QJsonObject result;
    for (auto entry = object.begin(); entry != object.end() && result.size() < kMostJsonEntries; ++entry) {
        if (entry.key().size() <= kLongestJsonText) {
            result.insert(entry.key(), small(entry.value(), depth + 1));
        }
    }
    return result;
}

QJsonArray small(const QJsonArray& array, int depth) {
    QJsonArray result;
    for (auto entry = array.begin(); entry != array.end() && result.size() < kMostJsonEntries; ++entry) {
        result.append(small(*entry, depth + 1));
    }
    return result;
}

QJsonValue small(const QJsonValue& value, int depth) {
    const bool isText = value.isString();
    if (depth > kDeepestJson || (isText && value.toString().size() > kLongestJsonText)) {
        return {};
    }
    return value.isObject()  ? QJsonValue(small(value.toObject(), depth))
           : value.isArray() ? QJsonValue(small(value.toArray(), depth))
                             : value;
}

} // namespace

bool wantsToReplace(QWidget* parent, const QString& title, const QString& path) {
    MessageBox question(title, tr("%1 exists already. Replace it?").arg(QFileInfo(path).fileName()),
                        QMessageBox::Yes | QMessageBox::No, parent);
    question.setIcon(QMessageBox::Warning);
    question.setDefaultButton(QMessageBox::No);
    return question.exec() == QMessageBox::Yes;
}

log::OutputRules replacing() {
    return {.mayReplace = true, .inUse = filesInUse()};
}

QString withSuffix(const QString& path, const QString& filter, const QString& filters) {
    static const QRegularExpression pattern(QStringLiteral("\\*(\\.\\w+)"));
    bool isOne = path.isEmpty();
    for (const QRegularExpressionMatch& known : pattern.globalMatch(filters)) {
        isOne = isOne || path.endsWith(known.captured(1), Qt::CaseInsensitive);
    }
    return isOne ? path : path + pattern.match(filter.isEmpty() ? filters : filter).captured(1);
}

QString askWhereToSave(QWidget* parent, const QString& title, const QString& name, const QString& filters) {
    QString filter;
    const QString chosen = QFileDialog::getSaveFileName(parent, title, name, filters, &filter);
    const QString path = withSuffix(chosen, filter, filters);
    const bool isOther = path != chosen && QFileInfo::exists(path); // the dialog has not asked about that
    return isOther && !wantsToReplace(parent, title, path) ? QString() : path;
}

QString fileFilter(const char* kind, const char* suffix) {
    return QStringLiteral("%1 (*.%2)").arg(translatedText(kind), QLatin1String(suffix));
}

QString saveFile(const QString& path, QByteArrayView content) {
    if (const QString problem = noFile(path); !problem.isEmpty()) {
        return tr("Not saved: %1: %2").arg(path, problem);
    }
    const auto bytes = std::as_bytes(std::span(content.data(), static_cast<std::size_t>(content.size())));
    const auto written = log::writeWholeFile(path.toStdString(), bytes, replacing());
    return written ? QString() : tr("Not saved: %1").arg(QString::fromStdString(written.error().text));
}

QString whyNotWritten(const log::FileError& error) {
    return error.kind == log::FileError::Kind::Cancelled ? tr("Cancelled: nothing was written.")
                                                         : QString::fromStdString(error.text);
}

std::future<QString> saveCopy(const QString& from, const QString& to) {
    log::OutputRules rules = replacing();
    rules.inUse.push_back(from.toStdString());
    return std::async(std::launch::async, [from, to, rules] {
        const auto copied = log::copyFile(from.toStdString(), to.toStdString(), rules);
        return copied ? QString() : tr("Not saved: %1").arg(QString::fromStdString(copied.error().text));
    });
}

void copyText(const QString& text) {
    QGuiApplication::clipboard()->setText(text);
}

QString savePicture(const QPixmap& picture, const QString& path) {
    QByteArray content;
    QBuffer buffer(&content);
    const QByteArray format = QFileInfo(path).suffix().toLatin1();
    return picture.save(&buffer, format.constData())
               ? saveFile(path, content)
               : tr("Not saved: %1 does not end as a picture does; give it .png").arg(path);
}

KeptFromSaving::KeptFromSaving(const QString& path)
    : m_file(QFileInfo(path).absoluteFilePath().toStdString()) {
    filesInUse().push_back(m_file);
}

KeptFromSaving::~KeptFromSaving() {
    const auto own = std::ranges::find(filesInUse(), m_file); // once: another may have it open as well
    if (own != filesInUse().end()) {
        filesInUse().erase(own);
    }
}

tl::expected<QByteArray, QString> readSmallFile(const QString& path) {
    constexpr qint64 kMost = qint64{4} << 20;
    QFile file(path);
    if (const QString problem = noFile(path); !problem.isEmpty()) {
        return tl::unexpected(problem);
    }
    if (!file.open(QIODevice::ReadOnly)) {
        return tl::unexpected(file.errorString());
    }
    const QByteArray content = file.read(kMost + 1);
    if (content.size() > kMost) {
        return tl::unexpected(tr("it is larger than 4 MiB, the most that is read"));
    }
    return content;
}

tl::expected<QJsonObject, QString> parseSmallObject(const QByteArray& json) {
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(json, &error);
    if (error.error != QJsonParseError::NoError) {
        return tl::unexpected(tr("%1 at byte %2").arg(error.errorString()).arg(error.offset));
    }
    if (!document.isObject()) {
        return tl::unexpected(tr("it does not begin with {"));
    }
    return small(document.object(), 0);
}

} // namespace posewire::gui
