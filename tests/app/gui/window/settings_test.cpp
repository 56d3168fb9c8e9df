// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/settings.h"

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonObject>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class SettingsFileTest : public testing::Test {
protected:
    void writeText(const QByteArray& text) const {
        QFile target(path);
        ASSERT_TRUE(target.open(QIODevice::WriteOnly));
        target.write(text);
    }

    QTemporaryDir folder;
    QString path = folder.filePath("sub/settings.json");
    SettingsFile file{path};
    QString problem;
};

TEST_F(SettingsFileTest, MissingFileGivesDefaultsWithoutAProblem) {
    const Settings settings = file.read(&problem);
    EXPECT_TRUE(problem.isEmpty());
    EXPECT_EQ(settings.layout, "Debug");
    EXPECT_TRUE(settings.docks.isEmpty());
}

TEST_F(SettingsFileTest, ReadsBackWhatWasWritten) {
    Settings written;
    written.theme = ThemeChoice::Light;
    written.layout = "Inspect";
    written.window = {10, 20, 900, 700};
    written.isMaximized = true;
    written.docks = QByteArray("\x00\xff\x01 docks", 9);
    written.panels["statistics"] = QJsonObject{{"columns", QJsonArray{0, 3}}};
    written.inputs.inputs = {{"", 9763, InputAddress::Kind::TcpListener}};
    written.inputs.relays = {{"10.0.0.9", 9763, false}};
    ASSERT_EQ(file.write(written), "");
    const Settings read = file.read(&problem);
    EXPECT_TRUE(problem.isEmpty()) << problem.toStdString();
    EXPECT_EQ(read.theme, written.theme);
    EXPECT_EQ(read.layout, written.layout);
    EXPECT_EQ(read.window, written.window);
    EXPECT_TRUE(read.isMaximized);
    EXPECT_EQ(read.docks, written.docks);
    EXPECT_EQ(read.panels, written.panels);
    EXPECT_EQ(read.inputs, written.inputs);
}

TEST_F(SettingsFileTest, SetsABrokenFileAsideEachTimeUnderANewName) {
    ASSERT_EQ(file.write({}), "");
    for (const char* name : {"sub/settings.json.aside-1", "sub/settings.json.aside-2"}) {
        writeText("{\"schema\": 1, \"lay");
        const Settings settings = file.read(&problem);
        EXPECT_EQ(settings.layout, "Debug");
        EXPECT_TRUE(problem.contains(folder.filePath(name))) << problem.toStdString();
        EXPECT_FALSE(QFile::exists(path));
        EXPECT_TRUE(QFile::exists(folder.filePath(name)));
    }
}

TEST_F(SettingsFileTest, SetsSettingsOfANewerProgramAside) {
    ASSERT_EQ(file.write({}), "");
    writeText("{\"schema\": 99}");
    static_cast<void>(file.read(&problem));
    EXPECT_TRUE(problem.contains("99"));
    EXPECT_TRUE(QFile::exists(path + ".aside-1"));
}

TEST_F(SettingsFileTest, SaysWhyItCannotWrite) {
    const SettingsFile nowhere(QStringLiteral("/dev/null/settings.json"));
    EXPECT_NE(nowhere.write({}), "");
}

} // namespace
} // namespace posewire::gui
