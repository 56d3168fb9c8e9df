// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/text.h"
#include "app/gui/panels/filter_bar.h"
#include "app/gui/panels/packet_view.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/panels/timecode_panel.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/main_window.h"
#include "app/net/datagram_sender.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <QDockWidget>
#include <QJsonArray>
#include <QLabel>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include <fstream>

namespace posewire::gui {
namespace {

/// The bytes of some frames of one character.
std::vector<std::byte> frames(std::uint64_t first, std::uint64_t last) {
    performer::PerformerSettings settings;
    settings.types = {2};
    performer::Performer performer(settings);
    std::vector<std::byte> all;
    for (std::uint64_t frame = first; frame < last; ++frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            const auto bytes = *wire::encode(datagram);
            all.insert(all.end(), bytes.begin(), bytes.end());
        }
    }
    return all;
}

class PagesTest : public testing::Test {
protected:
    PagesTest() {
        m_window.resize(1280, 800);
        m_window.show();
        QTest::qWait(1);
    }

    void receive(std::uint64_t first, std::uint64_t last) {
        if (m_driver.receiving().openPort() == 0) {
            m_driver.receiving().addPort({"127.0.0.1", 0});
        }
        auto sender = net::DatagramSender::connect(
            {{"127.0.0.1", m_driver.receiving().openPort()}, net::SendTarget::Transport::Udp});
        ASSERT_TRUE(sender);
        const std::uint64_t end =
            m_driver.commands().live().end() + wire::countDatagrams(frames(first, last));
        for (std::uint64_t frame = first; frame < last; ++frame) {
            ASSERT_TRUE(sender->send(frames(frame, frame + 1)));
        }
        ASSERT_TRUE(QTest::qWaitFor([&] {
            m_driver.tick();
            return m_driver.commands().live().end() >= end;
        }));
    }

    void openFile() {
        const std::string path = m_folder.filePath("take.mxtp").toStdString();
        const std::vector<std::byte> bytes = frames(0, 40);
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        m_driver.files().open(QString::fromStdString(path));
        ASSERT_TRUE(QTest::qWaitFor([this] {
            m_driver.tick();
            return !m_driver.files().isOpening() && m_driver.commands().isFileShown();
        }));
    }

    QDockWidget* dock(const char* name) { return m_window.findChild<QDockWidget*>(QLatin1String(name)); }
    /// What a dock shows, of the page that is shown.
    template <class Part>
    Part* shownPart(const char* dockName) {
        return dock(dockName)->widget()->findChild<Part*>();
    }

    QTemporaryDir m_folder;
    SettingsFile m_file{m_folder.filePath("settings.json")};
    log::SystemClock m_clock;
    SessionDriver m_driver{m_clock};
    MainWindow m_window{m_driver, m_file, {}};
};

TEST_F(PagesTest, TheClockOnTheFullScreenRunsWhileItsDockIsClosed) {
    receive(0, 2);
    m_window.docks().show("timecode");
    auto* panel = shownPart<TimecodePanel>("timecode");
    panel->setFullScreen(true);
    m_window.docks().refresh();
    const QString before = panel->fullScreenClock()->text();
    dock("timecode")->close();
    receive(240, 242);
    emit m_driver.tableTick();
    EXPECT_TRUE(QTest::qWaitFor([&] { return panel->fullScreenClock()->text() != before; }));
}

TEST_F(PagesTest, TheClockOnTheFullScreenShowsWhatIsLiveWhileAFileIsShown) {
    receive(0, 2);
    m_window.docks().show("timecode");
    auto* panel = shownPart<TimecodePanel>("timecode");
    panel->setFullScreen(true);
    openFile();
    const QString before = panel->fullScreenClock()->text();
    receive(240, 242);
    emit m_driver.tableTick();
    EXPECT_TRUE(QTest::qWaitFor([&] { return panel->fullScreenClock()->text() != before; }));
}

TEST_F(PagesTest, WhatIsSetWhileAFileIsShownStaysWhenItIsClosedAndOpenedAgain) {
    openFile();
    shownPart<FilterBar>("packets")->setSaved({{"poses", "type == 02"}});
    const auto* faults = shownPart<TableView>("faults");
    faults->columns().setChosen({faults->model()->headerData(2, Qt::Horizontal).toString()});
    const QJsonObject columns = faults->columns().state();
    ASSERT_FALSE(columns.isEmpty());
    m_driver.files().close();
    EXPECT_EQ(shownPart<FilterBar>("packets")->saved().size(), 1U);
    EXPECT_EQ(shownPart<TableView>("faults")->columns().state(), columns);
    openFile();
    EXPECT_EQ(shownPart<FilterBar>("packets")->saved().size(), 1U);
    EXPECT_EQ(shownPart<TableView>("faults")->columns().state(), columns);
}

TEST_F(PagesTest, KeepsTheFilterOfAFileApartFromThatOfWhatIsLive) {
    m_driver.commands().setDisplayFilter("type == 12");
    openFile();
    m_driver.commands().setDisplayFilter("type == 02");
    EXPECT_EQ(m_window.settings().filter, "type == 12");
    EXPECT_EQ(m_window.settings().fileFilter, "type == 02");
    m_driver.files().close();
    EXPECT_EQ(m_window.settings().fileFilter, "");
}

TEST_F(PagesTest, TheHistoryOfFiltersGoesAlongOnceAndDefaultsComeBack) {
    auto* live = shownPart<FilterBar>("packets");
    live->restoreState({{"history", QJsonArray{"type == 02", "size > 100"}}});
    live->setSaved({{"poses", "type == 02"}});
    openFile();
    EXPECT_EQ(shownPart<FilterBar>("packets")->line().history(), (QStringList{"type == 02", "size > 100"}));
    shownPart<FilterBar>("packets")->setSaved(defaultFilters());
    m_driver.commands().showLive();
    EXPECT_EQ(live->line().history(), (QStringList{"type == 02", "size > 100"}));
    EXPECT_EQ(live->saved(), defaultFilters());
}

TEST_F(PagesTest, EndGoesBackToLiveFromEveryList) {
    receive(0, 10);
    m_window.useLayout("Debug");
    for (const auto& [name, list] :
         {std::pair<const char*, QWidget*>{"packets", shownPart<PacketView>("packets")},
          {"events", shownPart<TableView>("events")},
          {"faults", shownPart<TableView>("faults")}}) {
        m_window.docks().show(name);
        list->setFocus();
        m_driver.playback().playOrStop();
        QTest::keyClick(list, Qt::Key_End);
        EXPECT_FALSE(m_driver.playback().isPaused()) << name;
    }
}

TEST_F(PagesTest, TheClockTellsTheMomentOfThePast) {
    receive(0, 4);
    QTest::qWait(20);
    auto sender = net::DatagramSender::connect(
        {{"127.0.0.1", m_driver.receiving().openPort()}, net::SendTarget::Transport::Udp});
    const std::uint64_t before = m_driver.commands().live().end();
    ASSERT_TRUE(sender && sender->send(std::vector(10, std::byte{7})));
    ASSERT_TRUE(QTest::qWaitFor([&] {
        m_driver.tick();
        return m_driver.commands().live().end() == before + 1;
    }));
    m_driver.playback().playOrStop();
    m_driver.tick();
    emit m_driver.tableTick();
    const QString moment =
        timeOfDay(m_driver.commands().live().wallOf(m_driver.commands().live().cursorStamp()));
    EXPECT_EQ(m_window.findChild<QLabel*>("transportTime")->text(), moment);
}

} // namespace
} // namespace posewire::gui
