// SPDX-License-Identifier: GPL-3.0-or-later
// How the file of a character is read: its bytes, its textures.
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/own_characters.h"
#include "render/mesh/import.h"

#include <QBuffer>
#include <QCryptographicHash>
#include <QFile>
#include <QFileInfo>
#include <QImageReader>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

/// Texels of all textures of a character together.
constexpr double kMostTexels = 2048.0 * 2048.0;
/// Of a picture before it is made smaller, megabytes.
constexpr int kMostDecoded = 512;

/// The size of each texture in the file; empty where it cannot be read.
QSize sizeOf(const render::ImportedTexture& texture) {
    if (texture.width > 0) {
        return {texture.width, texture.height};
    }
    QByteArray bytes(reinterpret_cast<const char*>(texture.encoded.data()),
                     static_cast<qsizetype>(texture.encoded.size()));
    QBuffer buffer(&bytes);
    return QImageReader(&buffer).size();
}

QImage pictureOf(const render::ImportedTexture& texture, const QSize& size, QString* problem) {
    if (texture.width > 0) {
        const QImage image(texture.texels.data(), texture.width, texture.height, 4 * texture.width,
                           QImage::Format_RGBA8888);
        return image.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    }
    QByteArray bytes(reinterpret_cast<const char*>(texture.encoded.data()),
                     static_cast<qsizetype>(texture.encoded.size()));
    QBuffer buffer(&bytes);
    QImageReader reader(&buffer);
    reader.setAutoTransform(false);
    reader.setScaledSize(size);
    const QImage image = reader.read();
    *problem = image.isNull() ? reader.errorString() : QString();
    return image;
}

render::TextureImage texelsOf(const QImage& image) {
    const QImage rgba = image.convertToFormat(QImage::Format_RGBA8888);
    render::TextureImage texture{rgba.width(), rgba.height(), {}};
    for (int row = 0; row < rgba.height(); ++row) {
        const auto* line = rgba.constScanLine(row);
        texture.texels.insert(texture.texels.end(), line, line + 4 * rgba.width());
    }
    return texture;
}

/// Smaller by the same factor where they would be too many together.
std::vector<render::TextureImage> texturesOf(const render::ImportedCharacter& character,
                                             QStringList* remarks) {
    QImageReader::setAllocationLimit(kMostDecoded);
    double texels = 0;
    std::vector<QSize> sizes;
    for (const render::ImportedTexture& texture : character.textures) {
        const QSize& size = sizes.emplace_back(sizeOf(texture));
        texels += std::max(0, size.width()) * static_cast<double>(std::max(0, size.height()));
    }
    const double scale = texels > kMostTexels ? std::sqrt(kMostTexels / texels) : 1.0;
    std::vector<render::TextureImage> textures;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const render::ImportedTexture& texture = character.textures[i];
        const QSize& size = sizes[i];
        QString problem = QString::fromStdString(texture.problem);
        QImage image;
        if (problem.isEmpty() && size.isValid() && !size.isEmpty()) {
            image = pictureOf(texture, (size * scale).expandedTo({1, 1}), &problem);
        } else if (problem.isEmpty()) {
            problem = tr("it is no picture of a kind that is known here");
        }
        if (image.isNull()) {
            *remarks +=
                tr("Without its texture %1: %2.").arg(shown(model::ForeignText(texture.name)), problem);
        }
        textures.push_back(image.isNull() ? render::TextureImage{} : texelsOf(image));
    }
    return textures;
}

} // namespace

ReadCharacter readCharacterFile(const QString& path) {
    QFile file(path);
    QCryptographicHash sum(QCryptographicHash::Sha256);
    if (!file.open(QIODevice::ReadOnly)) {
        return tl::unexpected(tr("%1 cannot be opened: %2").arg(path, file.errorString()));
    }
    if (file.size() > static_cast<qint64>(render::kMostImportedBytes)) {
        return tl::unexpected(tr("%1 is larger than 256 MB").arg(path));
    }
    sum.addData(&file);
    auto imported = render::importCharacter(QFile::encodeName(path).toStdString());
    if (!imported) {
        return tl::unexpected(
            tr("%1 is no character that can be used: %2")
                .arg(QFileInfo(path).fileName(), shown(model::ForeignText(imported.error()))));
    }
    auto read = std::make_shared<CharacterFile>();
    read->path = path;
    read->sum = QString::fromLatin1(sum.result().toHex());
    read->character = std::move(*imported);
    read->mapping = render::mapBones(read->character.bones);
    read->textures = std::make_shared<const std::vector<render::TextureImage>>(
        texturesOf(read->character, &read->remarks));
    for (render::ImportedTexture& texture : read->character.textures) {
        texture.encoded = {};
        texture.texels = {};
    }
    return read;
}

QString importerName() {
    return QString::fromStdString(render::importerName());
}

} // namespace posewire::gui
