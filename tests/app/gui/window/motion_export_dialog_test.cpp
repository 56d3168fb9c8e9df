// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/export_dialogs.h"

#include "tests/app/gui/models/stage.h"

#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>

namespace posewire::gui {
namespace {

class MotionExportDialogTest : public testing::Test {
protected:
    MotionExportDialogTest() {
        m_stage.perform(m_performer, 0, 120, [](std::uint64_t frame) { return frame != 50; });
        m_stage.follow();
        m_dialog = std::make_unique<MotionExportDialog>(m_stage.session, nullptr);
    }
    void choose(const QString& suffix) {
        auto* formats = m_dialog->findChild<QComboBox*>();
        formats->setCurrentIndex(formats->findText(QStringLiteral("(.%1)").arg(suffix), Qt::MatchContains));
    }
    [[nodiscard]] bool says(const QString& text) const {
        return std::ranges::any_of(m_dialog->findChildren<QLabel*>(),
                                   [&](const QLabel* one) { return one->text().contains(text); });
    }
    /// All lines of a file, in the end.
    [[nodiscard]] QStringList saved(const QString& name) {
        const QString path = m_folder.filePath(name);
        m_dialog->save(path);
        EXPECT_TRUE(QTest::qWaitFor([&] { return !says("Writing: "); }, 20'000));
        QFile file(path);
        return file.open(QIODevice::ReadOnly)
                   ? QString::fromUtf8(file.readAll()).split(u'\n', Qt::SkipEmptyParts)
                   : QStringList();
    }

    Stage m_stage;
    performer::Performer m_performer{sending(2, {2}, 60.0)};
    QTemporaryDir m_folder;
    std::unique_ptr<MotionExportDialog> m_dialog;
};

TEST_F(MotionExportDialogTest, WritesEachSampleOfAllCharactersAndSaysSo) {
    const QStringList lines = saved("take.csv");
    EXPECT_EQ(lines.size(), 1 + 2 * 120) << "a header, and a row for each sample, also for the one missing";
    EXPECT_TRUE(says("119 samples to " + m_folder.filePath("take.csv")));
    EXPECT_TRUE(says("1 is missing: a row without values"));
}

TEST_F(MotionExportDialogTest, OnlyWhoIsTickedIsWritten) {
    auto* list = m_dialog->findChild<QListWidget*>();
    ASSERT_EQ(list->count(), 2);
    list->item(0)->setCheckState(Qt::Unchecked);
    EXPECT_EQ(saved("one.csv").size(), 1 + 120);
    list->item(1)->setCheckState(Qt::Unchecked);
    const auto buttons = m_dialog->findChildren<QPushButton*>();
    EXPECT_TRUE(std::ranges::any_of(buttons, [](const QPushButton* one) {
        return one->text().contains("Save") && !one->isEnabled();
    })) << "nobody is left";
}

TEST_F(MotionExportDialogTest, FormatsOfOneCharacterGiveAFileEach) {
    choose("bvh");
    EXPECT_TRUE(says("Each character has a file of its own"));
    EXPECT_TRUE(saved("take.bvh").isEmpty());
    EXPECT_EQ(QDir(m_folder.path()).entryList({"take-*.bvh"}).size(), 2);
}

TEST_F(MotionExportDialogTest, SaysWhyAFileCannotBeWritten) {
    EXPECT_TRUE(saved("none/take.csv").isEmpty());
    EXPECT_TRUE(says("none/take.csv"));
}

TEST_F(MotionExportDialogTest, GrowsSoThatAllThatItSaysIsSeen) {
    m_dialog->show();
    const QString name = QStringLiteral("a take with a name that is about as long as names of takes are.csv");
    EXPECT_FALSE(saved(name).isEmpty());
    const auto labels = m_dialog->findChildren<QLabel*>();
    const auto said = std::ranges::find_if(labels, [&](QLabel* one) { return one->text().contains(name); });
    ASSERT_NE(said, labels.end());
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return (*said)->height() >= (*said)->heightForWidth((*said)->width()); }, 1'000));
    EXPECT_GE((*said)->y(), m_dialog->findChild<QListWidget*>()->geometry().bottom());
}

TEST_F(MotionExportDialogTest, WhatIsClosedBeforeItIsDoneLeavesNothing) {
    choose("glb");
    m_dialog->save(m_folder.filePath("take.glb"));
    m_dialog.reset();
    const QStringList left = QDir(m_folder.path()).entryList(QDir::Files | QDir::Hidden);
    EXPECT_TRUE(left.isEmpty() || left == QStringList{"take.glb"}) << left.join(u' ').toStdString();
}

} // namespace
} // namespace posewire::gui
