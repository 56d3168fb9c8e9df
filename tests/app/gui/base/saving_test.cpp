// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/saving.h"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <memory>

#include <sys/stat.h>

namespace posewire::gui {
namespace {

class SavingTest : public testing::Test {
protected:
    [[nodiscard]] QString path(const QString& name) const { return m_folder.filePath(name); }
    [[nodiscard]] QByteArray content(const QString& name) const {
        QFile file(path(name));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("none");
    }
    [[nodiscard]] qsizetype filesThere() const {
        return QDir(m_folder.path()).entryList(QDir::Files | QDir::Hidden).size();
    }

private:
    QTemporaryDir m_folder;
};

TEST_F(SavingTest, ReplacesAFileAsAWhole) {
    EXPECT_EQ(saveFile(path("a"), "old"), "");
    EXPECT_EQ(saveFile(path("a"), "new"), "");
    EXPECT_EQ(content("a"), "new");
    EXPECT_EQ(filesThere(), 1);
    EXPECT_TRUE(saveFile(path("none/a"), "new").contains("cannot be written"));
}

TEST_F(SavingTest, NeverWritesOverWhatIsOpenAsInput) {
    EXPECT_EQ(saveFile(path("take.pcapng"), "precious"), "");
    ASSERT_TRUE(QFile::link(path("take.pcapng"), path("link")));
    const KeptFromSaving open(path("take.pcapng"));
    for (const char* name : {"take.pcapng", "link"}) {
        EXPECT_TRUE(saveFile(path(name), "new").startsWith("Not saved: ")) << name;
    }
    EXPECT_EQ(content("take.pcapng"), "precious");
    EXPECT_EQ(saveFile(path("other"), "new"), "");
}

TEST_F(SavingTest, WritesOverAFileAgainOnceNobodyHasItOpen) {
    EXPECT_EQ(saveFile(path("take.pcapng"), "precious"), "");
    auto first = std::make_unique<KeptFromSaving>(path("take.pcapng"));
    auto second = std::make_unique<KeptFromSaving>(path("take.pcapng"));
    first.reset();
    EXPECT_TRUE(saveFile(path("take.pcapng"), "new").startsWith("Not saved: ")) << "the other has it open";
    second.reset();
    EXPECT_EQ(saveFile(path("take.pcapng"), "new"), "");
    EXPECT_EQ(content("take.pcapng"), "new");
}

TEST(Suffix, SaysWhatIsInTheFile) {
    const QString filters = "CSV (*.csv);;JSON (*.json);;Pictures (*.png *.jpg)";
    EXPECT_EQ(withSuffix("events", "JSON (*.json)", filters), "events.json");
    EXPECT_EQ(withSuffix("events", "", filters), "events.csv");
    EXPECT_EQ(withSuffix("take 1.5", "JSON (*.json)", filters), "take 1.5.json");
    EXPECT_EQ(withSuffix("events.html", "JSON (*.json)", filters), "events.html.json") << "it is no HTML";
    EXPECT_EQ(withSuffix("events.CSV", "JSON (*.json)", filters), "events.CSV") << "as somebody typed it";
    EXPECT_EQ(withSuffix("picture.jpg", "CSV (*.csv)", filters), "picture.jpg");
    EXPECT_EQ(withSuffix("", "JSON (*.json)", filters), "");
}

TEST_F(SavingTest, ReadsNothingThatHasNoEnd) {
    ASSERT_EQ(::mkfifo(QFile::encodeName(path("pipe")).constData(), 0600), 0);
    for (const QString& name : {path("pipe"), QStringLiteral("/dev/zero"), path("")}) {
        const auto read = readSmallFile(name);
        ASSERT_FALSE(read) << name.toStdString();
        EXPECT_TRUE(read.error().contains("not a file"));
    }
    EXPECT_EQ(saveFile(path("large"), QByteArray((4 << 20) + 1, ' ')), "");
    EXPECT_TRUE(readSmallFile(path("large")).error().contains("4 MiB"));
    EXPECT_EQ(saveFile(path("small"), "{}"), "");
    EXPECT_EQ(readSmallFile(path("small")), QByteArray("{}"));
}

} // namespace
} // namespace posewire::gui
