// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/own_character_dialog.h"

#include "tests/support/paths.h"

#include <QComboBox>
#include <QFile>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QUrl>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class OwnCharacterDialogTest : public testing::Test {
protected:
    void open(const QString& selected = {}) {
        m_dialog = std::make_unique<OwnCharacterDialog>(m_characters, QStringList{"Alice", "Bob"}, selected,
                                                        nullptr);
    }
    bool read(const QString& path) {
        m_dialog->read(path);
        return settle();
    }
    bool settle() {
        return QTest::qWaitFor([this] { return !m_dialog->isReading(); }, 20'000);
    }
    QPushButton* button(const QString& text) {
        for (auto* one : m_dialog->findChildren<QPushButton*>()) {
            if (one->text().remove(u'&') == text) {
                return one;
            }
        }
        return nullptr;
    }

    const QString m_mannequin =
        QString::fromStdString(test::sourcePath("resources/mannequin_low.glb").string());
    OwnCharacters m_characters;
    std::unique_ptr<OwnCharacterDialog> m_dialog;
    QTemporaryDir m_folder;
};

TEST_F(OwnCharacterDialogTest, SaysWhatToDoBeforeThereIsAFile) {
    open();
    EXPECT_TRUE(m_dialog->stateText().contains("Mixamo"));
    EXPECT_FALSE(button("Apply")->isEnabled());
    EXPECT_FALSE(button("Use the mannequin")->isEnabled());
}

TEST_F(OwnCharacterDialogTest, AppliesAFileToWhoIsSelected) {
    open("Bob");
    ASSERT_TRUE(read(m_mannequin));
    EXPECT_TRUE(m_dialog->stateText().contains("named as by MVN")) << m_dialog->stateText().toStdString();
    EXPECT_TRUE(m_dialog->stateText().contains("1.75 m tall, in metres · T-pose"))
        << m_dialog->stateText().toStdString();
    ASSERT_TRUE(button("Apply")->isEnabled());
    button("Apply")->click();
    EXPECT_NE(m_characters.wardrobe().of("Bob"), nullptr);
    EXPECT_EQ(m_characters.wardrobe().of("Alice"), nullptr);
}

TEST_F(OwnCharacterDialogTest, ABrokenFileIsExplainedAndChangesNothing) {
    open();
    const QString path = m_folder.filePath("broken.fbx");
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("Kaydara FBX Binary  ");
    file.close();
    ASSERT_TRUE(read(path));
    EXPECT_TRUE(m_dialog->stateText().contains("broken.fbx")) << m_dialog->stateText().toStdString();
    EXPECT_FALSE(button("Apply")->isEnabled());
    m_dialog->accept();
    EXPECT_TRUE(m_characters.wardrobe().isEmpty());
}

TEST_F(OwnCharacterDialogTest, NamesTheBonesThatItGuesses) {
    QFile source(m_mannequin);
    ASSERT_TRUE(source.open(QIODevice::ReadOnly));
    QByteArray bytes = source.readAll();
    const QByteArray hand("\"LeftHand\"");
    ASSERT_EQ(bytes.count(hand), 1);
    const QString path = m_folder.filePath("claw.glb");
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(bytes.replace(hand, "\"LeftClaw\""));
    file.close();
    open();
    ASSERT_TRUE(read(path));
    EXPECT_TRUE(
        m_dialog->stateText().contains("Guessed by the skeleton's shape, check the preview: Left Hand"))
        << m_dialog->stateText().toStdString();
    EXPECT_TRUE(button("Apply")->isEnabled());
}

/// Opens the editor of a cell as the keyboard does and chooses a bone in it.
void chooseBone(BoneTable& table, int row, const QString& bone) {
    table.setCurrentItem(table.topLevelItem(row));
    QTest::keyClick(&table, Qt::Key_F2);
    auto* box = table.findChild<QComboBox*>();
    ASSERT_NE(box, nullptr);
    const int at = box->findText(bone);
    ASSERT_GE(at, 0) << bone.toStdString();
    box->setCurrentIndex(at);
    emit box->activated(at);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
}

TEST_F(OwnCharacterDialogTest, KeepsTheBonesThatAreChosenByHand) {
    const QString path = m_folder.filePath("mine.glb");
    ASSERT_TRUE(QFile::copy(m_mannequin, path));
    open("Bob");
    ASSERT_TRUE(read(path));
    auto* table = m_dialog->findChild<BoneTable*>();
    ASSERT_NE(table, nullptr);
    EXPECT_EQ(table->topLevelItemCount(), static_cast<int>(render::kMappableCount));
    m_dialog->show();
    const QString before = table->topLevelItem(render::L5)->text(1);
    EXPECT_EQ(table->topLevelItem(render::L5)->text(2), "name");
    chooseBone(*table, render::L5, "no bone");
    EXPECT_EQ(table->topLevelItem(render::L5)->text(2), "");
    chooseBone(*table, render::L3, before);
    EXPECT_EQ(table->topLevelItem(render::L3)->text(1), before);
    EXPECT_EQ(table->topLevelItem(render::L3)->text(2), "by hand");
    m_dialog->accept();
    open("Bob");
    ASSERT_TRUE(settle());
    table = m_dialog->findChild<BoneTable*>();
    EXPECT_EQ(table->topLevelItem(render::L3)->text(1), before);

    QFile file(path); // somebody edits the file: the bone has another name now
    ASSERT_TRUE(file.open(QIODevice::ReadWrite));
    QByteArray bytes = file.readAll();
    bytes.replace(("\"" + before + "\"").toUtf8(),
                  ("\"" + QString("q").repeated(before.size()) + "\"").toUtf8());
    file.seek(0);
    file.write(bytes);
    file.close();
    open("Bob");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(m_dialog->stateText().contains("L3 (" + before + ")")) << m_dialog->stateText().toStdString();
}

TEST_F(OwnCharacterDialogTest, ReadsPathsAsPeoplePasteThem) {
    open();
    auto* path = m_dialog->findChild<QLineEdit*>();
    ASSERT_NE(path, nullptr);
    for (const QString& text :
         {m_mannequin, '"' + m_mannequin + '"', QUrl::fromLocalFile(m_mannequin).toString()}) {
        QSignalSpy finished(m_dialog.get(), &OwnCharacterDialog::finished);
        path->clear();
        QTest::keyClicks(path, text);
        QTest::keyClick(path, Qt::Key_Return);
        ASSERT_TRUE(finished.wait(20'000)) << text.toStdString();
        EXPECT_EQ(path->text(), m_mannequin);
        EXPECT_TRUE(m_dialog->stateText().contains("named as by MVN"));
    }
}

TEST_F(OwnCharacterDialogTest, ShowsWhatWasChosenBefore) {
    open("Alice");
    ASSERT_TRUE(read(m_mannequin));
    const auto boxes = m_dialog->findChildren<QComboBox*>();
    const auto size = std::ranges::find_if(
        boxes, [](const QComboBox* one) { return one->itemText(1) == "As tall as in the file"; });
    ASSERT_NE(size, boxes.end());
    (*size)->setCurrentIndex(1);
    emit(*size)->activated(1);
    m_dialog->accept();
    ASSERT_FALSE(m_characters.wardrobe().of("Alice")->isScaled);
    open("Alice");
    ASSERT_TRUE(settle());
    m_dialog->accept();
    EXPECT_FALSE(m_characters.wardrobe().of("Alice")->isScaled);
    open("Alice");
    ASSERT_TRUE(settle());
    ASSERT_TRUE(button("Use the mannequin")->isEnabled());
    button("Use the mannequin")->click();
    EXPECT_EQ(m_characters.wardrobe().of("Alice"), nullptr);
}

} // namespace
} // namespace posewire::gui
