// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/own_characters.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/character_import.h"
#include "render/mesh/flat_character.h"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QThreadPool>

#include <algorithm>
#include <span>

namespace posewire::gui {

namespace {

/// Moves the texels out of the character and adds a remark for each texture that has none.
std::vector<render::TextureImage> texturesOf(render::ImportedCharacter& character, QStringList* remarks) {
    std::vector<render::TextureImage> textures;
    for (render::ImportedTexture& texture : character.textures) {
        if (!texture.problem.empty()) {
            *remarks +=
                tr("Without its texture %1: %2.")
                    .arg(shown(model::ForeignText(texture.name)), shown(model::ForeignText(texture.problem)));
        }
        textures.push_back({texture.width, texture.height, std::move(texture.texels)});
    }
    return textures;
}

tl::expected<render::ImportedCharacter, QString>
characterOf(const QString& path, const QString& sum, ReadingMark& mark, const std::atomic<bool>* isUnwanted) {
    if (auto cached = cachedCharacter(path, sum)) {
        return std::move(*cached);
    }
    const auto flat = readOutside(path, mark, isUnwanted);
    if (!flat) {
        return tl::unexpected(flat.error());
    }
    auto character = render::unflatten(std::as_bytes(std::span(flat->data(), flat->size())));
    if (!character) {
        return tl::unexpected(tr("the answer of the program that reads it is damaged"));
    }
    const auto isWhole = [](const render::ImportedTexture& texture) { return texture.problem.empty(); };
    if (std::ranges::all_of(character->textures, isWhole)) { // a missing texture may be put there later
        cacheCharacter(path, sum, *flat, *character);
    }
    return std::move(*character);
}

} // namespace

ReadCharacter readCharacterFile(const QString& path, bool isAgain, const std::atomic<bool>* isUnwanted) {
    if (const QFileInfo info(path); info.exists() && !info.isFile()) { // opening a pipe would wait
        return tl::unexpected(tr("%1 is not a file").arg(path));
    }
    ReadingMark mark(path, isAgain);
    if (mark.isLeft()) {
        return tl::unexpected(tr("%1 was not read to its end the last time, so it is not read automatically")
                                  .arg(QFileInfo(path).fileName()));
    }
    auto read = std::make_shared<CharacterFile>();
    read->path = path;
    read->sum = notedSum(path);
    if (read->sum.isEmpty()) {
        QFile file(path);
        if (!file.open(QIODevice::ReadOnly)) {
            return tl::unexpected(tr("%1 cannot be opened: %2").arg(path, file.errorString()));
        }
        if (file.size() > static_cast<qint64>(render::kMostImportedBytes)) {
            return tl::unexpected(tr("%1 is larger than 256 MB").arg(path));
        }
        QCryptographicHash sum(QCryptographicHash::Sha256);
        sum.addData(&file);
        read->sum = QString::fromLatin1(sum.result().toHex());
        noteSum(path, read->sum);
    }
    auto character = characterOf(path, read->sum, mark, isUnwanted);
    if (!character) {
        return tl::unexpected(
            tr("%1 is no character that can be used: %2").arg(QFileInfo(path).fileName(), character.error()));
    }
    read->character = std::move(*character);
    read->mapping = render::mapBones(read->character.bones);
    read->textures = std::make_shared<const std::vector<render::TextureImage>>(
        texturesOf(read->character, &read->remarks));
    return read;
}

void CharacterReading::begin(const QString& path, std::function<void(const ReadCharacter&)> done,
                             bool isAgain) {
    *m_isUnwanted = true;
    m_isUnwanted = std::make_shared<std::atomic<bool>>(false);
    QThreadPool::globalInstance()->start(
        [path, isAgain, done = std::move(done), read = m_read, isUnwanted = m_isUnwanted] {
            const ReadCharacter file = read(path, isAgain, isUnwanted.get());
            const auto tell = [isUnwanted, done, file] {
                if (!*isUnwanted) {
                    done(file);
                }
            };
            QMetaObject::invokeMethod(QCoreApplication::instance(), tell, Qt::QueuedConnection);
        });
}

render::BoneMapping mappingOf(const CharacterFile& file, const BodyChoice& choice, QStringList* unfit) {
    render::BoneMapping mapping = file.mapping;
    for (const auto& [segment, bone] : render::correct(mapping, file.character.bones, choice.bones)) {
        if (unfit != nullptr) {
            *unfit += QStringLiteral("%1 (%2)").arg(fromUtf8(render::mappableTitle(segment)),
                                                    shown(model::ForeignText(bone)));
        }
    }
    return mapping;
}

tl::expected<std::shared_ptr<const DressedBody>, QString> bodyOf(const CharacterFile& file,
                                                                 const BodyChoice& choice) {
    auto body = render::makeOwnBody(file.character, mappingOf(file, choice), choice.rest);
    if (!body) {
        return tl::unexpected(QString::fromStdString(body.error()));
    }
    return std::make_shared<const DressedBody>(DressedBody{std::move(*body), file.textures, choice.isScaled});
}

QJsonObject jsonOf(const CharacterFile& file, const BodyChoice& choice) {
    QJsonObject bones;
    for (const auto& [segment, bone] : choice.bones) {
        bones[fromUtf8(render::mappableName(segment))] = fromUtf8(bone);
    }
    return {{"file", QDir().absoluteFilePath(file.path)},
            {"sum", file.sum},
            {"unit", choice.rest.unit},
            {"quarterTurns", choice.rest.quarterTurns},
            {"straightened", choice.rest.isStraightened},
            {"scaled", choice.isScaled},
            {"bones", bones}};
}

BodyChoice choiceOf(const QJsonObject& kept) {
    BodyChoice choice;
    constexpr double kLargestUnit = 1'000;
    choice.rest.unit = static_cast<float>(std::clamp(kept["unit"].toDouble(), 0.0, kLargestUnit));
    choice.rest.quarterTurns = kept["quarterTurns"].toInt() & 3;
    choice.rest.isStraightened = kept["straightened"].toBool(true);
    choice.isScaled = kept["scaled"].toBool(true);
    const QJsonObject bones = kept["bones"].toObject();
    for (std::size_t i = 0; i < render::kMappableCount; ++i) {
        if (const auto bone = bones.constFind(fromUtf8(render::mappableName(i))); bone != bones.constEnd()) {
            choice.bones.push_back({i, bone->toString().toStdString()});
        }
    }
    return choice;
}

void OwnCharacters::dress(const QString& name, std::shared_ptr<const CharacterFile> file,
                          const BodyChoice& choice, std::shared_ptr<const DressedBody> body) {
    if (m_kept.size() >= kMost && !m_kept.contains(name)) {
        emit failed(tr("At most %1 characters have bodies of their own.").arg(kMost));
        return;
    }
    forget(name);
    m_kept[name] = jsonOf(*file, choice);
    (name.isEmpty() ? m_wardrobe.forAll : m_wardrobe.byName[name]) = std::move(body);
    emit changed();
}

void OwnCharacters::undress(const QString& name) {
    forget(name);
    m_kept.erase(name);
    if (name.isEmpty()) {
        m_wardrobe.forAll.reset();
    } else {
        m_wardrobe.byName.erase(name);
    }
    emit changed();
}

QJsonObject OwnCharacters::keptFor(const QString& name) const {
    const auto own = m_kept.find(name);
    const auto all = m_kept.find(QString());
    return own != m_kept.end() ? own->second : all != m_kept.end() ? all->second : QJsonObject();
}

QJsonArray OwnCharacters::state() const {
    QJsonArray state;
    for (const auto& [name, kept] : m_kept) {
        QJsonObject entry = kept;
        entry["character"] = name;
        state.append(entry);
    }
    return state;
}

void OwnCharacters::restoreState(const QJsonArray& state) {
    m_kept.clear();
    m_wardrobe = {};
    m_waiting.clear();
    m_failed.clear();
    m_isAgain = false;
    for (const auto& value : state) {
        const QJsonObject kept = value.toObject();
        const QString name = kept["character"].toString();
        if (!kept["file"].toString().isEmpty() && m_kept.size() < kMost) {
            m_kept[name] = kept;
            m_waiting.push_back(name);
        }
    }
    restoreNext();
    emit changed();
}

void OwnCharacters::forget(const QString& name) {
    std::erase(m_waiting, name);
    std::erase(m_failed, name);
}

void OwnCharacters::readAgain() {
    m_isAgain = true;
    m_waiting.swap(m_failed);
    m_failed.clear();
    restoreNext();
    emit changed();
}

void OwnCharacters::restoreNext() {
    if (!m_waiting.empty()) {
        const QString name = m_waiting.front();
        m_reading.begin(
            m_kept[name]["file"].toString(), [this, name](const ReadCharacter& file) { finish(name, file); },
            m_isAgain);
    }
}

void OwnCharacters::finish(const QString& name, const ReadCharacter& file) {
    const auto kept = m_kept.find(name);
    if (kept != m_kept.end() && std::ranges::find(m_waiting, name) != m_waiting.end()) {
        std::erase(m_waiting, name);
        const BodyChoice choice = choiceOf(kept->second);
        QStringList unfit;
        if (file) {
            static_cast<void>(mappingOf(**file, choice, &unfit));
        }
        if (!unfit.isEmpty()) {
            emit failed(tr("%1 has changed: it no longer has the bones that were chosen for %2.")
                            .arg(QFileInfo((*file)->path).fileName(), unfit.join(QStringLiteral(", "))));
        }
        const auto body =
            file ? bodyOf(**file, choice)
                 : tl::expected<std::shared_ptr<const DressedBody>, QString>(tl::unexpected(file.error()));
        if (body) {
            (name.isEmpty() ? m_wardrobe.forAll : m_wardrobe.byName[name]) = *body;
            emit changed();
        } else {
            m_failed.push_back(name);
            // What was chosen is kept: the file may be on a disk that is not there now.
            emit failed(file ? tr("The mannequin stands in for %1: %2")
                                   .arg(QFileInfo(kept->second["file"].toString()).fileName(), body.error())
                             : tr("The mannequin stays: %1").arg(body.error()));
        }
    }
    restoreNext();
}

} // namespace posewire::gui
