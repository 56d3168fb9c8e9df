// SPDX-License-Identifier: MIT
#include "render/mesh/flat_character.h"

#include <QCoreApplication>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

// Any bytes as the file of a character, for posewire-import: assimp may crash there. It takes no longer than
// it may, and what it answers, if it does, is a character that is valid or a sentence.
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
    static const int cleared = std::atexit([] { made->folder.remove(); });
    static_cast<void>(cleared);
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
    const QString folder = stage().folder.path();
    const QByteArray bytes(reinterpret_cast<const char*>(data), static_cast<qsizetype>(size));
    QFile file(folder + '/' + nameFor(bytes));
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size()) {
        std::abort();
    }
    file.close();
    QProcess program;
    program.start(POSEWIRE_IMPORT_PROGRAM, {file.fileName()}, QIODevice::ReadOnly);
    constexpr int kMostMs = 35'000;
    const bool isOver = program.waitForFinished(kMostMs);
    const QByteArray answer = program.readAllStandardOutput();
    const bool isCharacter = program.exitStatus() == QProcess::NormalExit && program.exitCode() == 0;
    const bool isSound =
        isCharacter ? render::unflatten(std::as_bytes(std::span(answer.data(), answer.size()))).has_value()
                    : program.error() != QProcess::FailedToStart;
    if (!isOver || !isSound) {
        std::abort();
    }
    return 0;
}
