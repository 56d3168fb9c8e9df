// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/settings.h"

#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class RecordingChoiceTest : public testing::Test {
protected:
    [[nodiscard]] std::string next() const {
        const QDateTime begin(QDate(2026, 11, 23), QTime(10, 42, 17));
        return QFileInfo(nextTakePath(m_choice, begin)).fileName().toStdString();
    }
    void makeFile(const QString& name) const {
        QFile file(m_folder.filePath(name));
        EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    }

    QTemporaryDir m_folder;
    RecordingChoice m_choice{.folder = m_folder.path()};
};

TEST_F(RecordingChoiceTest, TakesAreNumberedWhateverTheSignsInTheirNames) {
    m_choice.pattern = QStringLiteral("[A] {date} (take {take})");
    EXPECT_EQ(next(), "[A] 2026-11-23 (take 001).pcapng");
    makeFile("[A] 2026-11-20 (take 001).pcapng");
    makeFile("A 2026-11-20 (take 002).pcapng");
    EXPECT_EQ(next(), "[A] 2026-11-23 (take 002).pcapng");
}

TEST_F(RecordingChoiceTest, TakesAreNumberedWhateverTheTimeInTheirNames) {
    EXPECT_EQ(next(), "Take 001 2026-11-23 10-42-17.pcapng");
    makeFile("Take 001 2026-11-22 09-00-00.pcapng");
    EXPECT_EQ(next(), "Take 002 2026-11-23 10-42-17.pcapng");
}

TEST_F(RecordingChoiceTest, TakesAreNumberedWhereNothingIsBetweenNumberAndDate) {
    m_choice.pattern = "{take}{date}";
    makeFile("0072026-11-22.pcapng");
    EXPECT_EQ(next(), "0082026-11-23.pcapng");
    m_choice.pattern = "{date}{take}";
    makeFile("2026-11-221000.pcapng");
    EXPECT_EQ(next(), "2026-11-231001.pcapng");
}

TEST_F(RecordingChoiceTest, NumbersOfTakesDoNotGoBack) {
    makeFile("Take 001 2026-11-22 09-00-00.pcapng");
    makeFile("Take 003 2026-11-22 09-10-00 part 2.pcapng");
    EXPECT_EQ(next(), "Take 004 2026-11-23 10-42-17.pcapng");
    makeFile("Take 004 2026-11-22 09-20-00 good.pcapng");
    makeFile("Take 20261123 2026-11-22 09-20-00.pcapng");
    EXPECT_EQ(next(), "Take 005 2026-11-23 10-42-17.pcapng");
}

TEST_F(RecordingChoiceTest, NoTakeIsWrittenOverAnother) {
    m_choice.pattern = "Jonas";
    EXPECT_EQ(next(), "Jonas.pcapng");
    makeFile("Jonas.pcapng");
    EXPECT_EQ(next(), "Jonas (2).pcapng");
    makeFile("Jonas (2).pcapng");
    EXPECT_EQ(next(), "Jonas (3).pcapng");
}

TEST_F(RecordingChoiceTest, ANameIsNoPath) {
    for (const char* bad : {"../Jonas", "a/b", "a\\b", "a*", "a?", "a\nb"}) {
        EXPECT_FALSE(patternProblem(bad).isEmpty()) << bad;
    }
    EXPECT_TRUE(patternProblem("Jonas {take}, {date}").isEmpty());
    EXPECT_TRUE(recordingChoiceOf({{"pattern", "../../etc/x"}}).pattern.isEmpty());
}

TEST_F(RecordingChoiceTest, IsKeptAndReadAgain) {
    m_choice = {"/takes", "Jonas {take}", 30, 2'000, 10, 5'000};
    EXPECT_EQ(recordingChoiceOf(jsonOf(m_choice)), m_choice);
    EXPECT_EQ(recordingChoiceOf({}), RecordingChoice());
    EXPECT_EQ(recordingChoiceOf({{"preRollSeconds", -5}, {"fileMegabytes", 1e9}}), RecordingChoice());
}

} // namespace
} // namespace posewire::gui
