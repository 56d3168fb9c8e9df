// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/bodies.h"

#include <QJsonArray>
#include <QJsonObject>
#include <QObject>
#include <QString>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

namespace posewire::gui {

struct CharacterFile {
    QString path;
    QString sum; ///< SHA-256 of its bytes
    render::ImportedCharacter character;
    render::BoneMapping mapping;
    std::shared_ptr<const std::vector<render::TextureImage>> textures; ///< by texture; empty if there is none
    QStringList remarks;                                               ///< what is odd about it, in sentences
};
using ReadCharacter = tl::expected<std::shared_ptr<const CharacterFile>, QString>;

/// Reads a file with its textures, which together become no larger than 2048 × 2048; takes long, on any
/// thread. The error says what is wrong with it. A character that was read before comes from the cache.
/// If an earlier reading did not come to an end, it is only read again on request.
[[nodiscard]] ReadCharacter readCharacterFile(const QString& path, bool isAgain = false,
                                              const std::atomic<bool>* isUnwanted = nullptr);

/// Reads a character file on a thread of its own. Calls `done` on the window's thread, unless this object has
/// gone or has begun to read another file.
class CharacterReading final {
public:
    using Reader =
        std::function<ReadCharacter(const QString& path, bool isAgain, const std::atomic<bool>* isUnwanted)>;

    explicit CharacterReading(Reader read = readCharacterFile) : m_read(std::move(read)) {}
    ~CharacterReading() { *m_isUnwanted = true; }
    CharacterReading(const CharacterReading&) = delete;
    CharacterReading& operator=(const CharacterReading&) = delete;

    void begin(const QString& path, std::function<void(const ReadCharacter&)> done, bool isAgain = false);

private:
    Reader m_read;
    std::shared_ptr<std::atomic<bool>> m_isUnwanted = std::make_shared<std::atomic<bool>>(false);
};

struct BodyChoice {
    render::RestChoice rest;
    bool isScaled = true;
    std::vector<render::BoneCorrection> bones; ///< one at most for a segment

    bool operator==(const BodyChoice&) const = default;
};
/// The mapping of the file with the operator's bones; `unfit` gets "Left Hand (claw_l)" for those it lacks.
[[nodiscard]] render::BoneMapping mappingOf(const CharacterFile& file, const BodyChoice& choice,
                                            QStringList* unfit = nullptr);
[[nodiscard]] tl::expected<std::shared_ptr<const DressedBody>, QString> bodyOf(const CharacterFile& file,
                                                                               const BodyChoice& choice);

/// Choices as they are kept from one run to the next.
[[nodiscard]] QJsonObject jsonOf(const CharacterFile& file, const BodyChoice& choice);
/// Values that make no sense are as they would be found.
[[nodiscard]] BodyChoice choiceOf(const QJsonObject& kept);

/// Which characters have bodies of the user's own. Kept with their files from one run to the next: these are
/// read again one after the other, and until then, or where one is gone or broken, the mannequin stands
/// there.
class OwnCharacters final : public QObject {
    Q_OBJECT

public:
    using QObject::QObject;

    /// `name`: as the character is shown; empty for all that have none of their own.
    void dress(const QString& name, std::shared_ptr<const CharacterFile> file, const BodyChoice& choice,
               std::shared_ptr<const DressedBody> body);
    /// The mannequin again.
    void undress(const QString& name);

    [[nodiscard]] const Wardrobe& wardrobe() const { return m_wardrobe; }
    /// As it was kept for that name, else for all; empty for the mannequin.
    [[nodiscard]] QJsonObject keptFor(const QString& name) const;
    [[nodiscard]] bool hasOwn(const QString& name) const { return m_kept.contains(name); }

    [[nodiscard]] QJsonArray state() const;
    void restoreState(const QJsonArray& state);
    [[nodiscard]] bool isRestoring() const { return !m_waiting.empty(); }

    /// True if a chosen character could not be read and the mannequin replaces it.
    [[nodiscard]] bool hasFailed() const { return !m_failed.empty(); }
    /// All that failed, also those whose reading did not come to an end.
    void readAgain();

signals:
    /// Somebody is dressed otherwise.
    void changed();
    /// A body of the last run is not to be had as it was; in a sentence.
    void failed(const QString& problem);

private:
    void forget(const QString& name);
    void restoreNext();
    void finish(const QString& name, const ReadCharacter& file);

    static constexpr std::size_t kMost = 32; ///< of names
    std::map<QString, QJsonObject> m_kept;   ///< by name
    Wardrobe m_wardrobe;
    std::vector<QString> m_waiting; ///< names whose files are still to be read
    std::vector<QString> m_failed;
    bool m_isAgain = false; ///< the operator asked for it
    CharacterReading m_reading;
};

} // namespace posewire::gui
