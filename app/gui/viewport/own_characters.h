// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/bodies.h"

#include <QJsonArray>
#include <QJsonObject>
#include <QObject>
#include <QString>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
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
/// thread. The error says what is wrong with it.
[[nodiscard]] ReadCharacter readCharacterFile(const QString& path);

/// The same on a thread of its own; `done` is called on the thread of this object, unless it is gone or
/// another reading was begun.
class CharacterReading final : public QObject {
    Q_OBJECT

public:
    using Reader = std::function<ReadCharacter(const QString& path)>;

    explicit CharacterReading(QObject* parent = nullptr, Reader read = readCharacterFile);
    /// Waits for nobody: the program does at its end.
    ~CharacterReading() override;

    void begin(const QString& path, std::function<void(const ReadCharacter&)> done);

private:
    struct Recipient {
        std::mutex mutex;
        CharacterReading* reading; ///< null once it is gone
    };

    Reader m_read;
    std::uint64_t m_number = 0;
    std::shared_ptr<Recipient> m_recipient;
};

struct BodyChoice {
    render::RestChoice rest;
    bool isScaled = true;

    bool operator==(const BodyChoice&) const = default;
};
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

signals:
    /// Somebody is dressed otherwise.
    void changed();
    /// A body of the last run is not to be had; in a sentence.
    void failed(const QString& problem);

private:
    void restoreNext();
    void finish(const QString& name, const ReadCharacter& file);

    static constexpr std::size_t kMost = 32; ///< of names
    std::map<QString, QJsonObject> m_kept;   ///< by name
    Wardrobe m_wardrobe;
    std::vector<QString> m_waiting; ///< names whose files are still to be read
    CharacterReading m_reading{this};
};

/// "Assimp 5.2".
[[nodiscard]] QString importerName();

} // namespace posewire::gui
