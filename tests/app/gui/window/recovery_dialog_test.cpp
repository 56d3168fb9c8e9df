// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/recording_dialogs.h"

#include "app/gui/driver/session_driver.h"
#include "core/log/recording.h"

#include <QFile>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include <array>
#include <chrono>

namespace posewire::gui {
namespace {

using namespace std::chrono_literals;

class RecoveryDialogTest : public testing::Test {
protected:
    /// What a process that was killed has left.
    QString leave(const QString& name, std::chrono::seconds begin) {
        const QString path = m_folder.filePath(name);
        log::PacketLog log;
        const std::array<std::byte, 40> bytes{};
        log.writer().append(bytes, {.stamp = log::Stamp(begin),
                                    .sender = log.senders().intern({"10.0.0.2:40001", {}, 9763})});
        log.writer().publish();
        const auto recording = log::Recording::start(log, path.toStdString(), {});
        EXPECT_TRUE(recording && (*recording)->stop());
        QFile file(path);
        EXPECT_TRUE(file.open(QIODevice::ReadWrite));
        file.setFileTime(QDateTime::fromSecsSinceEpoch((begin + 90s).count()), QFile::FileModificationTime);
        return path;
    }
    static QStringList line(const QTreeWidget& list, int row) {
        QStringList cells;
        for (int column = 0; column < list.columnCount(); ++column) {
            cells += list.topLevelItem(row)->text(column);
        }
        return cells;
    }
    static QPushButton* button(RecoveryDialog& dialog, const QString& text) {
        for (auto* one : dialog.findChildren<QPushButton*>()) {
            if (one->text().remove(u'&') == text) {
                return one;
            }
        }
        return nullptr;
    }

    QTemporaryDir m_folder;
    log::SystemClock m_clock;
    SessionDriver m_driver{m_clock, m_folder.path()};
};

TEST_F(RecoveryDialogTest, ListsWhenEachFileWasReceivedTheNewestSelected) {
    leave("history-7-1.pcapng", 1'000'000'000s);
    const QString newest = leave("history-7-2.pcapng", 1'000'000'100s);
    leave("take.pcapng", 1'000'000'200s);
    RecoveryDialog dialog(m_driver.history(), nullptr);
    const auto* list = dialog.findChild<QTreeWidget*>();
    ASSERT_EQ(list->topLevelItemCount(), 2);
    const QString begin = QDateTime::fromSecsSinceEpoch(1'000'000'100).toString("HH:mm:ss.zzz");
    const QString end = QDateTime::fromSecsSinceEpoch(1'000'000'190).toString("HH:mm:ss.zzz");
    EXPECT_EQ(line(*list, 1).mid(1, 2), (QStringList{begin, end}));
    QSignalSpy opened(&dialog, &RecoveryDialog::openRequested);
    button(dialog, "Open")->click();
    ASSERT_EQ(opened.count(), 1);
    EXPECT_EQ(opened.front().front().toString(), newest);
}

TEST_F(RecoveryDialogTest, SavesACopyAndSaysSo) {
    const QString lost = leave("history-7-1.pcapng", 1'000'000'000s);
    RecoveryDialog dialog(m_driver.history(), nullptr);
    const QString target = m_folder.filePath("kept.pcapng");
    dialog.save(target);
    EXPECT_FALSE(button(dialog, "Discard all")->isEnabled()) << "not while it is read";
    ASSERT_TRUE(QTest::qWaitFor([&] { return button(dialog, "Open")->isEnabled(); }, 10'000));
    QFile from(lost);
    QFile to(target);
    ASSERT_TRUE(from.open(QIODevice::ReadOnly) && to.open(QIODevice::ReadOnly));
    EXPECT_EQ(from.readAll(), to.readAll());
    dialog.save(m_folder.filePath("none/kept.pcapng"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return button(dialog, "Open")->isEnabled(); }, 10'000));
    const QList<QLabel*> labels = dialog.findChildren<QLabel*>();
    EXPECT_TRUE(std::ranges::any_of(labels, [](const QLabel* one) {
        return one->text().startsWith("Not saved: ") && one->text().contains("none/kept.pcapng");
    }));
}

TEST_F(RecoveryDialogTest, ClosedWhileItSavesItTellsLater) {
    leave("history-7-1.pcapng", 1'000'000'000s);
    RecoveryDialog dialog(m_driver.history(), nullptr);
    const QSignalSpy over(&dialog, &RecoveryDialog::over);
    dialog.show();
    dialog.save(m_folder.filePath("kept.pcapng"));
    dialog.close();
    EXPECT_TRUE(dialog.isHidden());
    EXPECT_EQ(over.count(), 0) << "its copy is not done";
    ASSERT_TRUE(QTest::qWaitFor([&] { return over.count() == 1; }, 10'000));
    EXPECT_EQ(over[0][0].toString(), "Saved " + m_folder.filePath("kept.pcapng"));
    dialog.show();
    dialog.close();
    EXPECT_EQ(over.count(), 2) << "nothing to wait for";
}

TEST_F(RecoveryDialogTest, SaysWhereThereIsNothing) {
    RecoveryDialog dialog(m_driver.history(), nullptr);
    EXPECT_TRUE(dialog.isEmpty());
    EXPECT_FALSE(button(dialog, "Open")->isEnabled());
    EXPECT_TRUE(m_driver.history().lost().empty());
}

TEST_F(RecoveryDialogTest, DiscardedFilesAreGone) {
    const QString lost = leave("history-7-1.pcapng", 1'000'000'000s);
    m_driver.history().discardLost();
    EXPECT_FALSE(QFile::exists(lost));
}

} // namespace
} // namespace posewire::gui
