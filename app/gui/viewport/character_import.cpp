// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/character_import.h"

#include "app/gui/base/logging.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "render/mesh/flat_character.h"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QDateTime>
#include <QDeadlineTimer>
#include <QDir>
#include <QFileInfo>
#include <QProcess>
#include <QSaveFile>
#include <QStandardPaths>
#include <QThread>

#include <chrono>
#include <span>

namespace posewire::gui {

namespace {

constexpr std::chrono::seconds kLongest{30};
constexpr int kLongestSentence = 400;
constexpr qint64 kMostCached = qint64{512} * 1024 * 1024;
constexpr int kSealBytes = 32;
constexpr qint64 kMostNoteBytes = 256;

/// Installed, in a folder of ours alone, or built.
QString importProgram() {
    const QString here = QCoreApplication::applicationDirPath();
    const QString set = qEnvironmentVariable("POSEWIRE_IMPORT");
    return !set.isEmpty()
               ? set
               : QStandardPaths::findExecutable(QStringLiteral("posewire-import"),
                                                {here, here + "/../libexec/posewire", here + "/../import"});
}

QString cacheFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + "/characters";
    QDir().mkpath(folder);
    return folder;
}

/// Path of a cache file that belongs to the file at `path`.
QString nameFor(const QString& path, const char* ending) {
    return cacheFolder() + '/' + QCryptographicHash::hash(path.toUtf8(), QCryptographicHash::Sha1).toHex() +
           ending;
}

/// While both stay the same, the file is assumed to be unchanged.
QByteArray sizeAndTime(const QFileInfo& file) {
    return QByteArray::number(file.size()) + ' ' +
           QByteArray::number(file.lastModified().toMSecsSinceEpoch()) + ' ';
}

QString entryOf(const QString& sum) {
    return cacheFolder() + '/' + sum + ".character";
}

QByteArray sealOf(const QString& path, QByteArrayView flat, const render::ImportedCharacter& character) {
    const QDir folder = QFileInfo(QFileInfo(path).canonicalFilePath()).dir();
    QCryptographicHash seal(QCryptographicHash::Sha256);
    seal.addData(flat);
    for (const std::string& name : character.filesBeside) {
        seal.addData(sizeAndTime(QFileInfo(folder, QString::fromStdString(name))));
    }
    return seal.result();
}

} // namespace

QString importerName() {
    QProcess program;
    program.start(importProgram(), {QStringLiteral("--version")}, QIODevice::ReadOnly);
    return program.waitForFinished(2'000) ? QString::fromUtf8(program.readAllStandardOutput())
                                          : QStringLiteral("posewire-import is missing");
}

tl::expected<QByteArray, QString> readOutside(const QString& path, ReadingMark& mark,
                                              const std::atomic<bool>* isUnwanted) {
    QProcess program;
    program.start(importProgram(), {QFileInfo(path).absoluteFilePath()}, QIODevice::ReadOnly);
    const QDeadlineTimer deadline(kLongest);
    QByteArray answer;
    QByteArray confinement;
    while (program.state() != QProcess::NotRunning) {
        constexpr int kLookMs = 100;
        program.waitForReadyRead(kLookMs);
        answer += program.readAllStandardOutput();
        confinement = (confinement + program.readAllStandardError()).left(kLongestSentence);
        const bool isTooLong = answer.size() > static_cast<qsizetype>(render::kMostFlatBytes);
        if (isTooLong || deadline.hasExpired() || (isUnwanted != nullptr && *isUnwanted)) {
            program.kill();
            program.waitForFinished();
            if (deadline.hasExpired()) {
                mark.leave();
            }
            return tl::unexpected(isTooLong ? tr("it becomes larger than 256 MB")
                                            : tr("reading it takes too long"));
        }
    }
    answer += program.readAllStandardOutput();
    if (program.error() == QProcess::FailedToStart) {
        return tl::unexpected(
            tr("the program that reads characters cannot be started: %1").arg(program.errorString()));
    }
    qCInfo(filesLog) << "posewire-import confined itself by" << confinement.trimmed();
    const bool hasCrashed = program.exitStatus() == QProcess::CrashExit;
    if (hasCrashed || program.exitCode() > 1) {
        mark.leave();
    }
    if (hasCrashed || answer.isEmpty()) {
        return tl::unexpected(tr("the program that reads it crashed"));
    }
    if (program.exitCode() != 0) {
        return tl::unexpected(shown(model::ForeignText(answer.left(kLongestSentence).toStdString())));
    }
    return answer;
}

QString notedSum(const QString& path) {
    QFile note(nameFor(path, ".sum"));
    const QByteArray begin = sizeAndTime(QFileInfo(path));
    const QByteArray text = note.open(QIODevice::ReadOnly) ? note.read(kMostNoteBytes) : QByteArray();
    return text.startsWith(begin) ? QString::fromLatin1(text.mid(begin.size())) : QString();
}

void noteSum(const QString& path, const QString& sum) {
    QSaveFile note(nameFor(path, ".sum"));
    if (note.open(QIODevice::WriteOnly)) {
        note.write(sizeAndTime(QFileInfo(path)) + sum.toLatin1());
        note.commit();
    }
}

std::optional<render::ImportedCharacter> cachedCharacter(const QString& path, const QString& sum) {
    QFile entry(entryOf(sum));
    if (!entry.open(QIODevice::ReadWrite | QIODevice::ExistingOnly) ||
        entry.size() > static_cast<qint64>(render::kMostFlatBytes) + kSealBytes) {
        return std::nullopt;
    }
    const QByteArray bytes = entry.readAll();
    const QByteArrayView flat = QByteArrayView(bytes).chopped(std::min<qsizetype>(kSealBytes, bytes.size()));
    auto character = render::unflatten(std::as_bytes(std::span(flat.data(), flat.size())));
    if (!character || sealOf(path, flat, *character) != bytes.last(kSealBytes)) {
        return std::nullopt;
    }
    entry.setFileTime(QDateTime::currentDateTime(), QFileDevice::FileModificationTime);
    return std::move(*character);
}

void cacheCharacter(const QString& path, const QString& sum, const QByteArray& flat,
                    const render::ImportedCharacter& character) {
    QSaveFile entry(entryOf(sum));
    if (entry.open(QIODevice::WriteOnly)) {
        entry.write(flat);
        entry.write(sealOf(path, flat, character));
        entry.commit();
    }
    qint64 bytes = 0;
    for (const QFileInfo& file :
         QDir(cacheFolder()).entryInfoList({QStringLiteral("*.character*")}, QDir::Files, QDir::Time)) {
        bytes += file.size();
        if (bytes > kMostCached) {
            QFile::remove(file.filePath());
        }
    }
}

ReadingMark::ReadingMark(const QString& path, bool isAgain) : m_name(nameFor(path, ".reading")) {
    constexpr int kAttempts = 20; // a program that was killed may take a while to be gone
    for (int attempt = 0; attempt < kAttempts && !m_lock.isOpen(); ++attempt) {
        QThread::msleep(attempt == 0 ? 0 : 100);
        m_isLeft = QFile::exists(m_name) && !isAgain;
        if (!QFile(m_name).open(QIODevice::ReadWrite)) {
            break;
        }
        m_lock = log::openLocked(m_name.toStdString());
    }
    m_isLeft = m_isLeft && m_lock.isOpen();
}

ReadingMark::~ReadingMark() {
    if (m_lock.isOpen() && !m_isLeft) {
        m_lock = log::Descriptor(); // a file that is open cannot be removed everywhere
        QFile::remove(m_name);
    }
}

} // namespace posewire::gui
