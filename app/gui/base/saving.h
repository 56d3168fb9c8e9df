// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/formats.h"
#include "core/log/output_file.h"

#include <QByteArray>
#include <QByteArrayView>
#include <QJsonObject>
#include <QStringList>

#include <tl/expected.hpp>

#include <future>
#include <string>

class QPixmap;
class QWidget;

/// All saving of the window. What may be written is decided where it is for the command line: see
/// core/log/output_file. From the window's thread.
namespace posewire::gui {

/// Asks where to save, and before a file is replaced. `name` is proposed, without anything in it that leads
/// to another folder. A path without a suffix of the filters gets that of the chosen one; where there is such
/// a file that is asked about too. Empty where it was cancelled.
[[nodiscard]] QString askWhereToSave(QWidget* parent, const QString& title, const QString& name,
                                     const QString& filters);
[[nodiscard]] bool wantsToReplace(QWidget* parent, const QString& title, const QString& path);
/// For what the operator was asked about: files may be replaced, but none that is open as an input.
[[nodiscard]] log::OutputRules replacing();
/// The path with the suffix of `filter`, such as "JSON (*.json)", or of the first of `filters` where it is
/// empty; unless it has one of `filters` already. So the suffix always says what is in the file.
[[nodiscard]] QString withSuffix(const QString& path, const QString& filter, const QString& filters);

/// Writes a file whole or not at all: what was there stays until all is written. For a path that the operator
/// chose in askWhereToSave(), or that is the program's own. Returns what went wrong as a sentence for the
/// operator, empty for nothing.
[[nodiscard]] QString saveFile(const QString& path, QByteArrayView content);

/// One sentence for the operator.
[[nodiscard]] QString whyNotWritten(const log::FileError& error);

/// Copies a file likewise, on a thread of its own.
[[nodiscard]] std::future<QString> saveCopy(const QString& from, const QString& to);

void copyText(const QString& text);

/// Saves a picture likewise, in the format that its ending says.
[[nodiscard]] QString savePicture(const QPixmap& picture, const QString& path);

/// The file is open as an input for as long as this is there: saveFile() does not write over it, whatever
/// leads to it.
class KeptFromSaving {
public:
    explicit KeptFromSaving(const QString& path);
    ~KeptFromSaving();
    KeptFromSaving(const KeptFromSaving&) = delete;
    KeptFromSaving& operator=(const KeptFromSaving&) = delete;

private:
    std::string m_file;
};

/// A small file of the program's own kind, such as settings or a layout. The error is for the operator: it is
/// no regular file, is larger than 4 MiB, or cannot be read.
[[nodiscard]] tl::expected<QByteArray, QString> readSmallFile(const QString& path);

/// A format for QFileDialog: "JSON (*.json)".
[[nodiscard]] QString fileFilter(const char* kind, const char* suffix);

/// All formats of a subject for QFileDialog, the usual one first.
template <class Subject>
[[nodiscard]] QString fileFilters() {
    QStringList filters;
    for (const exporting::Format<Subject>& format : exporting::formats<Subject>()) {
        filters += fileFilter(format.kind, format.suffix);
    }
    return filters.join(QStringLiteral(";;"));
}

/// No text of a file of ours is longer, no list or object has more entries, and none lies deeper.
inline constexpr int kLongestJsonText = 16'384;
inline constexpr int kMostJsonEntries = 256;
inline constexpr int kDeepestJson = 16;

/// An object of the program's own kind, such as settings or a layout, that anyone may have written since:
/// what is larger than ours ever is has been left out, so that whoever reads a value of it need not fear its
/// size. The error says what is wrong, and where.
[[nodiscard]] tl::expected<QJsonObject, QString> parseSmallObject(const QByteArray& json);

} // namespace posewire::gui
