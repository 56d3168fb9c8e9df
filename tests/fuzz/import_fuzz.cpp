// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/character_import.h"
#include "render/mesh/flat_character.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

// Any bytes as the file of a character, read as the window does, by posewire-import: assimp may crash there.
// Whatever happens, it takes no longer than it may, and ends in a character that is valid or in a sentence.
namespace {

using namespace posewire;

struct Stage {
    QCoreApplication application;
    QTemporaryDir folder;
};

Stage& stage() {
    static int count = 1;
    static char name[] = "import";
    static char* arguments[] = {name, nullptr};
    static auto* const made = new Stage{{count, arguments}, {}}; // Qt does not outlive main()
    return *made;
}

/// As the first bytes say, so that each importer has its part.
QString nameFor(const QByteArray& bytes) {
    return bytes.startsWith("glTF")                               ? "a.glb"
           : bytes.startsWith('{')                                ? "a.gltf"
           : bytes.startsWith('<')                                ? "a.dae"
           : bytes.startsWith("Kaydara") || bytes.startsWith(';') ? "a.fbx"
                                                                  : "a.vrm";
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    qputenv("POSEWIRE_IMPORT", POSEWIRE_IMPORT_PROGRAM);
    const QString folder = stage().folder.path();
    qputenv("XDG_CACHE_HOME", QFile::encodeName(folder));
    const QByteArray bytes(reinterpret_cast<const char*>(data), static_cast<qsizetype>(size));
    QFile file(folder + '/' + nameFor(bytes));
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size()) {
        std::abort();
    }
    file.close();
    QElapsedTimer timer;
    timer.start();
    gui::ReadingMark mark(file.fileName(), true);
    const auto flat = gui::readOutside(file.fileName(), mark);
    constexpr int kMostMs = 35'000;
    const bool isSound =
        flat ? render::unflatten(std::as_bytes(std::span(flat->data(), flat->size()))).has_value()
             : !flat.error().isEmpty() && !flat.error().contains("cannot be started");
    if (!isSound || timer.elapsed() > kMostMs) {
        std::abort();
    }
    return 0;
}
