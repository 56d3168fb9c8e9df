// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/system_files.h"
#include "render/mesh/character_file.h"

#include <QByteArray>
#include <QString>

#include <atomic>
#include <optional>

#include <tl/expected.hpp>

/// How a foreign character file is read: in a program of its own, whose answer is as foreign as the file.
/// From any thread.
namespace posewire::gui {

/// "Assimp 5.2".
[[nodiscard]] QString importerName();

/// Marks a file in the cache for as long as it is being read, so that the next start knows if the window died
/// meanwhile, or posewire-import did.
class ReadingMark {
public:
    /// A mark that is left is taken over if the file is to be read again.
    ReadingMark(const QString& path, bool isAgain);
    ~ReadingMark();
    ReadingMark(const ReadingMark&) = delete;
    ReadingMark& operator=(const ReadingMark&) = delete;

    /// An earlier reading left this mark; it stays.
    [[nodiscard]] bool isLeft() const { return m_isLeft; }
    void leave() { m_isLeft = true; }

private:
    QString m_name;
    bool m_isLeft = false;
    log::Descriptor m_lock; ///< not open if another reads the same file
};

/// The file in the flat form, as posewire-import answers; takes up to 30 s, or until it is unwanted. Leaves
/// the mark if that crashed or took too long. The error is the second half of a sentence.
[[nodiscard]] tl::expected<QByteArray, QString> readOutside(const QString& path, ReadingMark& mark,
                                                            const std::atomic<bool>* isUnwanted = nullptr);

/// The SHA-256 that noteSum() recorded for a file, in hexadecimal, so that the next start need not open the
/// file. Empty if there is no record, or if the size or time of the file has changed since.
[[nodiscard]] QString notedSum(const QString& path);
void noteSum(const QString& path, const QString& sum);

/// Characters that were read once, in the user's cache by the SHA-256 of their file, at most 512 MB: the
/// longest unused go first. Each entry is the flat form and a seal over it and over size and time of the
/// files beside, so a damaged or outdated one is not found.
[[nodiscard]] std::optional<render::ImportedCharacter> cachedCharacter(const QString& path,
                                                                       const QString& sum);
void cacheCharacter(const QString& path, const QString& sum, const QByteArray& flat,
                    const render::ImportedCharacter& character);

} // namespace posewire::gui
