// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/character_import.h"

#include "app/gui/viewport/own_characters.h"
#include "render/mesh/flat_character.h"
#include "render/mesh/import.h"
#include "tests/support/paths.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include <sys/stat.h>

namespace posewire::gui {
namespace {

const QString kReadable = QString::fromStdString(test::sourcePath("resources/mannequin_low.glb").string());
/// Two nodes that instance each other: assimp recurses until its stack is full.
constexpr const char* kDeadly =
    R"(<?xml version="1.0"?><COLLADA version="1.4.1"><library_visual_scenes><visual_scene id="s">)"
    R"(<node id="a"><instance_node url="#b"/></node><node id="b"><instance_node url="#a"/></node></visual_scene>)"
    R"(</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

class CharacterImportTest : public testing::Test {
protected:
    CharacterImportTest() { QDir(m_cache).removeRecursively(); }

    QString write(const QString& name, const QByteArray& content) const {
        QFile file(m_folder.filePath(name));
        EXPECT_TRUE(file.open(QIODevice::WriteOnly));
        file.write(content);
        return file.fileName();
    }
    QStringList cached(const QString& kind) const { return QDir(m_cache).entryList({kind}, QDir::Files); }
    static void useProgram(const QString& program) { qputenv("POSEWIRE_IMPORT", QFile::encodeName(program)); }
    void TearDown() override { qputenv("POSEWIRE_IMPORT", m_program); }

    QTemporaryDir m_folder;
    const QByteArray m_program = qgetenv("POSEWIRE_IMPORT");
    const QString m_cache = QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + "/characters";
};

TEST_F(CharacterImportTest, TheProgramReadsWhatTheImporterReads) {
    ReadingMark mark(kReadable, false);
    const auto flat = readOutside(kReadable, mark);
    ASSERT_TRUE(flat) << flat.error().toStdString();
    const auto imported = render::importCharacter(kReadable.toStdString());
    ASSERT_TRUE(imported);
    const std::vector<std::byte> expected = render::flatten(*imported);
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(flat->data(), flat->size())), expected));
}

TEST_F(CharacterImportTest, AFileThatCrashesItsReaderIsASentenceAndIsOnlyReadAgainOnRequest) {
    const QString deadly = write("deadly.dae", kDeadly);
    const ReadCharacter first = readCharacterFile(deadly);
    ASSERT_FALSE(first);
    EXPECT_TRUE(first.error().contains("crashed")) << first.error().toStdString();
    EXPECT_EQ(cached("*.reading").size(), 1);
    const ReadCharacter next = readCharacterFile(deadly);
    ASSERT_FALSE(next);
    EXPECT_TRUE(next.error().contains("not read automatically")) << next.error().toStdString();
    write("deadly.dae", "mended");
    const ReadCharacter again = readCharacterFile(deadly, true);
    ASSERT_FALSE(again);
    EXPECT_TRUE(again.error().contains("no character")) << again.error().toStdString();
    EXPECT_TRUE(cached("*.reading").isEmpty());
}

TEST_F(CharacterImportTest, AFileIsNotReadWhoseReadingTheWindowDidNotSurvive) {
    { ReadingMark(kReadable, false).leave(); } // as a window does that is killed
    OwnCharacters characters;
    QSignalSpy failed(&characters, &OwnCharacters::failed);
    characters.restoreState({QJsonObject{{"character", "Alice"}, {"file", kReadable}}});
    ASSERT_TRUE(QTest::qWaitFor([&] { return !characters.isRestoring(); }, 20'000));
    EXPECT_EQ(failed.size(), 1);
    EXPECT_TRUE(characters.hasFailed());
    EXPECT_EQ(characters.wardrobe().of("Alice"), nullptr);
    characters.readAgain();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !characters.isRestoring(); }, 20'000));
    EXPECT_FALSE(characters.hasFailed());
    EXPECT_NE(characters.wardrobe().of("Alice"), nullptr);
}

TEST_F(CharacterImportTest, AMarkOfAnotherThatIsReadingIsNotTakenForLeft) {
    const ReadingMark other(kReadable, false);
    EXPECT_FALSE(ReadingMark(kReadable, false).isLeft());
    EXPECT_EQ(cached("*.reading").size(), 1);
}

TEST_F(CharacterImportTest, AFileThatWasReadComesFromTheCache) {
    ASSERT_TRUE(readCharacterFile(kReadable));
    ASSERT_EQ(cached("*.character").size(), 1);
    useProgram("/nowhere/posewire-import");
    EXPECT_TRUE(readCharacterFile(kReadable));
    QFile entry(m_cache + '/' + cached("*.character").first());
    ASSERT_TRUE(entry.open(QIODevice::ReadWrite));
    entry.seek(entry.size() / 2);
    entry.write("damage");
    entry.close();
    const ReadCharacter damaged = readCharacterFile(kReadable);
    ASSERT_FALSE(damaged);
    EXPECT_TRUE(damaged.error().contains("cannot be started")) << damaged.error().toStdString();
    useProgram(QFile::decodeName(m_program));
    EXPECT_TRUE(readCharacterFile(kReadable));
}

TEST_F(CharacterImportTest, AFileThatWasReadIsNotOpenedAgainUntilItChanges) {
    QFile source(kReadable);
    ASSERT_TRUE(source.open(QIODevice::ReadOnly));
    const QByteArray bytes = source.readAll();
    const QString path = write("own.glb", bytes);
    const QDateTime time = QFileInfo(path).lastModified();
    const ReadCharacter first = readCharacterFile(path);
    ASSERT_TRUE(first) << first.error().toStdString();
    write("own.glb", QByteArray(bytes.size(), 'x'));
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadWrite));
    ASSERT_TRUE(file.setFileTime(time, QFileDevice::FileModificationTime));
    file.close();
    const ReadCharacter kept = readCharacterFile(path);
    ASSERT_TRUE(kept) << kept.error().toStdString();
    EXPECT_EQ((*kept)->sum, (*first)->sum);
    write("own.glb", "longer or shorter");
    EXPECT_FALSE(readCharacterFile(path));
}

TEST_F(CharacterImportTest, ATextureThatChangedMakesTheCacheOld) {
    render::ImportedCharacter character = *render::importCharacter(kReadable.toStdString());
    character.filesBeside = {"skin.png"};
    const auto bytes = render::flatten(character);
    const QByteArray flat(reinterpret_cast<const char*>(bytes.data()), static_cast<qsizetype>(bytes.size()));
    const QString path = write("own.glb", "any");
    write("skin.png", "one");
    cacheCharacter(path, "sum", flat, character);
    EXPECT_TRUE(cachedCharacter(path, "sum"));
    EXPECT_FALSE(cachedCharacter(path, "other"));
    write("skin.png", "longer");
    EXPECT_FALSE(cachedCharacter(path, "sum"));
}

TEST_F(CharacterImportTest, TheLongestUnusedLeaveACacheThatIsFull) {
    const render::ImportedCharacter character = *render::importCharacter(kReadable.toStdString());
    const QDateTime now = QDateTime::currentDateTime();
    for (int i = 0; i < 6; ++i) {
        QFile old(m_cache + QString("/%1.character").arg(i));
        QDir().mkpath(m_cache);
        ASSERT_TRUE(old.open(QIODevice::WriteOnly));
        old.resize(qint64{120} * 1024 * 1024); // takes no room on the disk
        old.setFileTime(now.addSecs(-100 - i), QFileDevice::FileModificationTime);
    }
    cacheCharacter(kReadable, "new", QByteArray(1'000, 'x'), character);
    EXPECT_EQ(cached("*.character"),
              (QStringList{"0.character", "1.character", "2.character", "3.character", "new.character"}));
}

TEST_F(CharacterImportTest, AnAnswerIsNotTrusted) {
    const auto answering = [this](const QByteArray& script) {
        const QString program = write("program", "#!/bin/sh\n" + script);
        QFile::setPermissions(program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        useProgram(program);
        const ReadCharacter read = readCharacterFile(kReadable, true);
        return read ? QString() : read.error();
    };
    EXPECT_TRUE(answering("printf 'PWCHAR\\0\\2'; exit 0").contains("answer"));
    EXPECT_TRUE(answering("exit 0").contains("crashed"));
    EXPECT_TRUE(answering("printf 'bad \\033[31m bones'; exit 1").contains("bad"));
    EXPECT_FALSE(answering("printf 'bad \\033[31m bones'; exit 1").contains(QChar(27)));
    EXPECT_TRUE(answering("head -c 300000000 /dev/zero").contains("larger than 256 MB"));
}

TEST_F(CharacterImportTest, NobodyWaitsForAFileThatIsUnwanted) {
    const QString program = write("program", "#!/bin/sh\nexec sleep 60\n");
    QFile::setPermissions(program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    useProgram(program);
    const std::atomic<bool> isUnwanted = true;
    EXPECT_FALSE(readCharacterFile(kReadable, true, &isUnwanted));
    EXPECT_TRUE(cached("*.reading").isEmpty());
}

TEST_F(CharacterImportTest, APipeIsNoCharacter) {
    const QString pipe = m_folder.filePath("pipe.glb");
    ASSERT_EQ(::mkfifo(QFile::encodeName(pipe).constData(), 0600), 0);
    EXPECT_FALSE(readCharacterFile(pipe));
}

} // namespace
} // namespace posewire::gui
