// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/own_characters.h"

#include "app/gui/theme/words.h"

#include <QDir>
#include <QFileInfo>
#include <QThreadPool>

#include <algorithm>
#include <utility>

namespace posewire::gui {

CharacterReading::CharacterReading(QObject* parent, Reader read)
    : QObject(parent), m_read(std::move(read)), m_recipient(std::make_shared<Recipient>()) {
    m_recipient->reading = this;
}

CharacterReading::~CharacterReading() {
    const std::lock_guard lock(m_recipient->mutex);
    m_recipient->reading = nullptr;
}

void CharacterReading::begin(const QString& path, std::function<void(const ReadCharacter&)> done) {
    const std::uint64_t number = ++m_number;
    QThreadPool::globalInstance()->start(
        [path, number, done = std::move(done), read = m_read, recipient = m_recipient] {
            const ReadCharacter file = read(path);
            const std::lock_guard lock(recipient->mutex);
            CharacterReading* reading = recipient->reading;
            if (reading == nullptr) {
                return;
            }
            QMetaObject::invokeMethod(
                reading,
                [reading, number, done, file] {
                    if (number == reading->m_number) {
                        done(file);
                    }
                },
                Qt::QueuedConnection);
        });
}

tl::expected<std::shared_ptr<const DressedBody>, QString> bodyOf(const CharacterFile& file,
                                                                 const BodyChoice& choice) {
    auto body = render::makeOwnBody(file.character, file.mapping, choice.rest);
    if (!body) {
        return tl::unexpected(QString::fromStdString(body.error()));
    }
    return std::make_shared<const DressedBody>(DressedBody{std::move(*body), file.textures, choice.isScaled});
}

QJsonObject jsonOf(const CharacterFile& file, const BodyChoice& choice) {
    return {{"file", QDir().absoluteFilePath(file.path)},
            {"sum", file.sum},
            {"unit", choice.rest.unit},
            {"quarterTurns", choice.rest.quarterTurns},
            {"straightened", choice.rest.isStraightened},
            {"scaled", choice.isScaled}};
}

BodyChoice choiceOf(const QJsonObject& kept) {
    BodyChoice choice;
    constexpr double kLargestUnit = 1'000;
    choice.rest.unit = static_cast<float>(std::clamp(kept["unit"].toDouble(), 0.0, kLargestUnit));
    choice.rest.quarterTurns = kept["quarterTurns"].toInt() & 3;
    choice.rest.isStraightened = kept["straightened"].toBool(true);
    choice.isScaled = kept["scaled"].toBool(true);
    return choice;
}

void OwnCharacters::dress(const QString& name, std::shared_ptr<const CharacterFile> file,
                          const BodyChoice& choice, std::shared_ptr<const DressedBody> body) {
    if (m_kept.size() >= kMost && !m_kept.contains(name)) {
        emit failed(tr("At most %1 characters have bodies of their own.").arg(kMost));
        return;
    }
    std::erase(m_waiting, name);
    m_kept[name] = jsonOf(*file, choice);
    if (name.isEmpty()) {
        m_wardrobe.forAll = std::move(body);
    } else {
        m_wardrobe.byName[name] = std::move(body);
    }
    emit changed();
}

void OwnCharacters::undress(const QString& name) {
    std::erase(m_waiting, name);
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

void OwnCharacters::restoreNext() {
    if (!m_waiting.empty()) {
        const QString name = m_waiting.front();
        m_reading.begin(m_kept[name]["file"].toString(),
                        [this, name](const ReadCharacter& file) { finish(name, file); });
    }
}

void OwnCharacters::finish(const QString& name, const ReadCharacter& file) {
    const auto kept = m_kept.find(name);
    if (kept != m_kept.end() && std::ranges::find(m_waiting, name) != m_waiting.end()) {
        std::erase(m_waiting, name);
        const auto body =
            file ? bodyOf(**file, choiceOf(kept->second))
                 : tl::expected<std::shared_ptr<const DressedBody>, QString>(tl::unexpected(file.error()));
        if (body) {
            (name.isEmpty() ? m_wardrobe.forAll : m_wardrobe.byName[name]) = *body;
            emit changed();
        } else {
            // What was chosen is kept: the file may be on a disk that is not there now.
            emit failed(file ? tr("The mannequin stands in for %1: %2")
                                   .arg(QFileInfo(kept->second["file"].toString()).fileName(), body.error())
                             : tr("The mannequin stays: %1").arg(body.error()));
        }
    }
    restoreNext();
}

} // namespace posewire::gui
