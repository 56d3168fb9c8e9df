// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/settings.h"

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <sys/stat.h>

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
    written.inputs.waysOut = {{"10.0.0.9", 9763, false}};
    written.viewport = QJsonObject{{"axes", 1}};
    written.filter = "type == 02 && gap > 0";
    written.file = "/takes/take 3.pcapng";
    written.comparedFile = "/takes/reference.pcapng";
    written.fileFilter = "gap > 0";
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
    EXPECT_EQ(read.viewport, written.viewport);
    EXPECT_EQ(read.filter, written.filter);
    EXPECT_EQ(read.file, written.file);
    EXPECT_EQ(read.comparedFile, written.comparedFile);
    EXPECT_EQ(read.fileFilter, written.fileFilter);
}

TEST_F(SettingsFileTest, KeepsWhatAnotherWindowChanged) {
    SettingsFile other(path);
    Settings ours = file.read(&problem);
    Settings theirs = other.read(&problem);
    ours.theme = ThemeChoice::Dark;
    ours.filter = "type == 02";
    ASSERT_EQ(file.write(ours), "");
    theirs.recentFiles = {"/takes/1.pcapng"};
    ASSERT_EQ(other.write(theirs), "");
    ours.filter.clear();
    ASSERT_EQ(file.write(ours), "");
    const Settings both = SettingsFile(path).read(&problem);
    EXPECT_EQ(both.theme, ThemeChoice::Dark);
    EXPECT_EQ(both.filter, "");
    EXPECT_EQ(both.recentFiles, QStringList("/takes/1.pcapng"));
}

TEST_F(SettingsFileTest, DoesNotWaitForAPipe) {
    const QString pipe = folder.filePath("pipe");
    ASSERT_EQ(::mkfifo(pipe.toLocal8Bit().constData(), 0600), 0);
    EXPECT_TRUE(SettingsFile(pipe).write({}).contains("a pipe"));
    static_cast<void>(SettingsFile(pipe).read(&problem));
    EXPECT_TRUE(problem.contains("a pipe")) << problem.toStdString();
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

TEST(Settings, AreReadAsVersionOneWroteThem) {
    const auto settings = parseSettings(R"({"schema": 1, "theme": "light", "layout": "Check",
        "sources": {"inputs": [{"protocol": "udp", "host": "", "port": 9800}], "from": ["10.0.0.7"]}})");
    ASSERT_TRUE(settings);
    EXPECT_EQ(settings->theme, ThemeChoice::Light);
    EXPECT_EQ(settings->layout, "Check");
    ASSERT_TRUE(settings->inputs.inputs);
    ASSERT_EQ(settings->inputs.inputs->size(), 1U);
    EXPECT_EQ(settings->inputs.inputs->front().port, 9800);
    EXPECT_EQ(settings->inputs.allowed, QStringList{"10.0.0.7"});
    EXPECT_EQ(*parseSettings(QJsonDocument(jsonOf(*settings)).toJson()), *settings)
        << "nothing is lost by the next writing";
}

TEST(Settings, WithoutAVersionAreNotGuessedAt) {
    EXPECT_FALSE(parseSettings(R"({"theme": "light"})"));
    EXPECT_FALSE(parseSettings(R"({"schema": 0})"));
    EXPECT_FALSE(parseSettings(R"({"schema": -1})"));
    EXPECT_FALSE(parseSettings(R"({"schema": "2"})"));
}

TEST(Settings, KeepTheWindowWhereItsEdgesCanBeCalculated) {
    const auto settings = parseSettings(R"({"schema": 1, "window":
        {"x": 2147483647, "y": -2147483648, "width": 2147483647, "height": -1}})");
    ASSERT_TRUE(settings);
    EXPECT_EQ(settings->window, QRect(100'000, -100'000, 100'000, 0));
}

TEST(Settings, TakePlacesOfDocksOnlyAsTheyWereWritten) {
    Settings written;
    written.docks = "places of docks";
    const QByteArray json = QJsonDocument(jsonOf(written)).toJson();
    EXPECT_EQ(parseSettings(json)->docks, written.docks);
    QByteArray damaged = json;
    damaged.replace(written.docks.toBase64(), QByteArray("another place").toBase64());
    ASSERT_NE(damaged, json);
    EXPECT_EQ(parseSettings(damaged)->docks, QByteArray()) << "Qt would crash on some";
}

TEST(Settings, TakeNoMoreInputsAndRelaysThanAnyoneChooses) {
    QJsonArray inputs;
    QJsonArray relays;
    for (int port = 1; port <= 1'000; ++port) {
        inputs.append(QJsonObject{{"protocol", "udp"}, {"host", ""}, {"port", port}});
        relays.append(QJsonObject{{"host", "10.0.0.9"}, {"port", port}, {"on", true}});
    }
    const QJsonObject receiving{{"inputs", inputs}, {"relays", relays}};
    const auto settings =
        parseSettings(QJsonDocument(QJsonObject{{"schema", 2}, {"receiving", receiving}}).toJson());
    ASSERT_TRUE(settings);
    EXPECT_EQ(settings->inputs.inputs->size(), 256U);
    EXPECT_EQ(settings->inputs.waysOut.size(), 256U);
}

TEST(Settings, AreAsShippedWhereTheyAreOfTheWrongKind) {
    const auto settings =
        parseSettings(R"({"schema": 2, "theme": 7, "layout": [], "window": "wide", "docks": {},
        "panels": 3, "alerts": true, "receiving": {"inputs": 5, "relays": "all", "from": {}}})");
    ASSERT_TRUE(settings);
    EXPECT_EQ(*settings, Settings());
}

TEST_F(SettingsFileTest, SaysWhyItCannotWrite) {
    SettingsFile nowhere(QStringLiteral("/dev/null/settings.json"));
    EXPECT_NE(nowhere.write({}), "");
}

} // namespace
} // namespace posewire::gui
