// SPDX-License-Identifier: GPL-3.0-or-later
// Every layout in the least room: 1920 × 1080 at 200 %.
#include "app/gui/base/dock_layout.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/main_window.h"
#include "app/net/datagram_sender.h"
#include "core/model/session/roster.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <QDockWidget>
#include <QScrollBar>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include <fstream>

namespace posewire::gui {
namespace {

constexpr QSize kLeastRoom(960, 540); // logical pixels
constexpr int kCharacters = 4;

/// Frames of four characters with long names, with gaps, so that every figure has something to say.
std::vector<std::vector<std::byte>> datagrams(std::uint64_t frames) {
    performer::PerformerSettings settings;
    settings.characters = kCharacters;
    performer::Performer performer(settings);
    std::vector<std::vector<std::byte>> all;
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        for (wire::Datagram& datagram : performer.frame(frame)) {
            if (auto* metadata = std::get_if<wire::MetaData>(&datagram.body)) {
                metadata->text = "name:Performer with a name that is rather long " +
                                 std::to_string(datagram.header.character) + "\n";
                wire::completeHeader(datagram, wire::HeaderEra::Counted);
            }
            if (frame % 10 != 7) {
                all.push_back(*wire::encode(datagram));
            }
        }
    }
    return all;
}

class RoomTest : public testing::Test {
protected:
    RoomTest() {
        m_window.resize(kLeastRoom);
        m_window.show();
    }

    void receive() {
        m_driver.receiving().addPort({"127.0.0.1", 0});
        auto sender = net::DatagramSender::connect(
            {{"127.0.0.1", m_driver.receiving().openPort()}, net::SendTarget::Transport::Udp});
        ASSERT_TRUE(sender);
        for (const std::vector<std::byte>& bytes : datagrams(40)) {
            ASSERT_TRUE(sender->send(bytes));
        }
        ASSERT_TRUE(QTest::qWaitFor([this] {
            m_driver.tick();
            return m_driver.commands().live().atNow().roster().listed().size() == kCharacters;
        }));
        m_driver.commands().select({m_driver.commands().live().atNow().roster().listed()[0]->key.sender,
                                    m_driver.commands().live().atNow().roster().listed()[0]->key, -1});
    }

    /// What the docks that show need, for a message.
    std::string offenders() {
        std::string text;
        for (const auto* dock : m_window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
            if (!dock->isHidden()) {
                const QSize least = dock->minimumSizeHint();
                text += dock->objectName().toStdString() + " " + std::to_string(least.width()) + " x " +
                        std::to_string(least.height()) + "; ";
            }
        }
        return text;
    }

    void expectRoomInEveryLayout() {
        for (const QString& layout : layoutNames()) {
            SCOPED_TRACE(layout.toStdString());
            m_window.useLayout(layout);
            m_driver.tick();
            emit m_driver.tableTick();
            QTest::qWait(20);
            const QSize least = m_window.minimumSizeHint();
            EXPECT_LE(least.width(), kLeastRoom.width()) << offenders();
            EXPECT_LE(least.height(), kLeastRoom.height()) << offenders();
            EXPECT_EQ(m_window.size(), kLeastRoom);
            const auto* board = m_window.findChild<TableView*>("board");
            EXPECT_EQ(board->horizontalScrollBar()->maximum(), 0) << "names and verdicts are all in view";
        }
    }

    QTemporaryDir m_folder;
    SettingsFile m_file{m_folder.filePath("settings.json")};
    log::SystemClock m_clock;
    SessionDriver m_driver{m_clock};
    MainWindow m_window{m_driver, m_file, {}};
};

TEST_F(RoomTest, EveryLayoutFitsBeforeAnythingCame) {
    expectRoomInEveryLayout();
}

TEST_F(RoomTest, EveryLayoutFitsWithFourCharactersOfLongNames) {
    receive();
    expectRoomInEveryLayout();
}

TEST_F(RoomTest, DocksBesideEachOtherDoNotWidenTheWindow) {
    for (auto* dock : m_window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
        m_window.removeDockWidget(dock);
        m_window.addDockWidget(Qt::RightDockWidgetArea, dock, Qt::Horizontal);
        dock->show();
    }
    QTest::qWait(20);
    EXPECT_EQ(m_window.size(), kLeastRoom);
    m_window.useLayout("Check");
    QTest::qWait(20);
    EXPECT_EQ(m_window.size(), kLeastRoom);
}

TEST_F(RoomTest, EveryLayoutFitsWithARecordingOpen) {
    receive();
    const std::string path = m_folder.filePath("A take with a name that is rather long.mxtp").toStdString();
    std::ofstream file(path, std::ios::binary);
    for (const std::vector<std::byte>& bytes : datagrams(40)) {
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    file.close();
    m_driver.files().open(QString::fromStdString(path));
    ASSERT_TRUE(QTest::qWaitFor([this] {
        m_driver.tick();
        return !m_driver.files().isOpening() && m_driver.commands().isFileShown();
    }));
    expectRoomInEveryLayout();
}

/// By itself, at the width that layouts give it at 1280 × 720.
TEST_F(RoomTest, EveryDockShowsItsTitleAndItsFirstRowsAt1280By720) {
    constexpr QSize kRoom(1280, 720);
    receive();
    m_window.resize(kRoom);
    for (const QString& layout : layoutNames()) {
        m_window.useLayout(layout);
        QTest::qWait(20);
        for (auto* dock : m_window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
            SCOPED_TRACE((layout + ' ' + dock->objectName()).toStdString());
            m_window.docks().show(dock->objectName());
            QTest::qWait(5);
            m_driver.tick();
            emit m_driver.tableTick();
            QTest::qWait(20);
            EXPECT_EQ(m_window.size(), kRoom);
            EXPECT_LE(m_window.minimumSizeHint().width(), kRoom.width()) << offenders();
            const QRect place = dock->geometry();
            EXPECT_TRUE(m_window.rect().contains(place));
            for (const TableView* table : dock->findChildren<TableView*>()) {
                if (table->isVisible() && table->model()->rowCount() != 0) {
                    EXPECT_GE(table->viewport()->height(), table->fontMetrics().height())
                        << table->accessibleName().toStdString();
                    EXPECT_EQ(table->horizontalScrollBar()->maximum(), 0)
                        << table->accessibleName().toStdString();
                }
            }
        }
    }
}

} // namespace
} // namespace posewire::gui
