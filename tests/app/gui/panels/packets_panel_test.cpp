// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packets_panel.h"

#include "app/gui/models/text.h"
#include "app/gui/panels/filter_bar.h"
#include "app/gui/panels/find_bar.h"
#include "app/gui/panels/fitting_header.h"
#include "app/gui/panels/packet_view.h"
#include "core/model/session/accounts.h"
#include "tests/app/gui/panels/panel_stage.h"
#include "tests/app/gui/panels/trigger.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>

#include <algorithm>

namespace posewire::gui {
namespace {

class PacketsPanelTest : public testing::Test {
protected:
    PacketsPanelTest() {
        m_panel.resize(900, 300);
        m_panel.show();
    }
    void poses(std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t sample = from; sample < to; ++sample) {
            m_stage.send(smallPose(), sample, sample * 10, Stage::kStart + sample * 10ms);
        }
        refresh();
    }
    void refresh() {
        m_stage.follow();
        m_panel.refresh();
    }
    void filterBy(const QString& text) {
        m_stage.commands.setDisplayFilter(text);
        refresh();
        if (m_panel.filter().run() != nullptr) {
            m_panel.filter().run()->wait();
        }
        refresh();
    }
    /// As an operator types it, with Return. Returns the line.
    QLineEdit* enterFilter(const QString& text) {
        auto* line = bar().findChild<QLineEdit*>("displayFilter");
        bar().focusLine();
        line->setText(text);
        QTest::keyClick(line, Qt::Key_Return);
        return line;
    }
    void trigger(std::string_view id) { gui::trigger(m_panel, id); }
    [[nodiscard]] PacketView& list() { return *m_panel.findChild<PacketView*>(); }
    [[nodiscard]] QString message() const { return m_panel.findChild<PassingMessage*>()->said(); }
    [[nodiscard]] FilterBar& bar() { return *m_panel.findChild<FilterBar*>(); }
    [[nodiscard]] std::optional<std::uint64_t> selected() const {
        return m_stage.session.choices().selection.packet;
    }

    Stage m_stage;
    PacketsPanel m_panel{m_stage.session, m_stage.commands, nullptr};
};

TEST_F(PacketsPanelTest, KeepsLongNumbersWhole) {
    poses(1'654'180, 1'654'183);
    const int needed = list().fontMetrics().horizontalAdvance(QStringLiteral("1 654 182"));
    EXPECT_GE(list().header().sectionSize(PacketModel::kSample), needed);
}

TEST_F(PacketsPanelTest, FollowsTheNewestUntilScrolledAwayAndSaysSo) {
    poses(0, 200);
    QScrollBar* bar = list().verticalScrollBar();
    EXPECT_EQ(m_panel.summary(), QStringLiteral("following · 200"));
    EXPECT_EQ(bar->value(), bar->maximum());
    bar->setValue(50);
    poses(200, 300);
    EXPECT_EQ(m_panel.summary(), "300");
    EXPECT_EQ(bar->value(), 50);
    auto* newest = list().findChild<QPushButton*>("newestPacket");
    EXPECT_TRUE(newest->isVisible());
    EXPECT_TRUE(newest->text().contains("100 new")) << newest->text().toStdString();
    newest->click();
    EXPECT_EQ(bar->value(), bar->maximum());
    EXPECT_EQ(m_panel.summary(), QStringLiteral("following · 300"));
    EXPECT_FALSE(newest->isVisible());
}

TEST_F(PacketsPanelTest, SelectingARowSelectsThePacketAndBack) {
    poses(0, 200);
    list().setFocus();
    list().setCurrentIndex(m_panel.packets().index(150, 0));
    EXPECT_EQ(selected(), 150U);
    EXPECT_FALSE(list().isFollowing());
    QTest::keyClick(&list(), Qt::Key_Down);
    EXPECT_EQ(selected(), 151U);
    const int asked = m_stage.asked.count;
    m_stage.commands.selectPacket(7);
    refresh();
    EXPECT_EQ(list().currentIndex().row(), 7);
    EXPECT_EQ(m_stage.asked.count, asked + 1);
    trigger("newestPacket");
    EXPECT_EQ(selected(), std::nullopt);
    EXPECT_TRUE(list().isFollowing());
}

TEST_F(PacketsPanelTest, ListsWhatTheDisplayFilterOfTheSessionLetsThrough) {
    poses(0, 200);
    m_stage.sendMetadata("name:Mira\n", Stage::kStart);
    filterBy("type == 12");
    EXPECT_EQ(m_panel.packets().rowCount(), 1);
    EXPECT_EQ(bar().line().filter(), "type == 12");
    EXPECT_EQ(m_panel.summary(), QStringLiteral("following · 1 of 201 shown"));
    filterBy("type == 77");
    EXPECT_EQ(m_panel.packets().rowCount(), 0);
    EXPECT_TRUE(list().accessibleDescription().contains("No packet matches"));
    m_panel.findChild<QPushButton*>("clearFilter")->click();
    EXPECT_EQ(m_stage.session.choices().displayFilter, "");
    EXPECT_EQ(m_panel.packets().rowCount(), 201);
}

TEST_F(PacketsPanelTest, FiltersAgainWhereASendersPositionsTurnOutToBeCentimetres) {
    poses(0, 1);
    filterBy("position.z > 90 cm");
    EXPECT_EQ(m_panel.packets().rowCount(), 1);
    const auto sender = m_stage.session.roster().senders().begin()->id;
    m_stage.session.setOverride(sender, {.positionUnit = model::LengthUnit::Centimetre});
    filterBy("position.z > 90 cm");
    EXPECT_EQ(m_panel.packets().rowCount(), 0);
    filterBy("position.z == 1 cm");
    EXPECT_EQ(m_panel.packets().rowCount(), 1);
}

TEST_F(PacketsPanelTest, CallsNewOnlyWhatCameAfterTheFilter) {
    poses(0, 200);
    list().setFollowing(false);
    filterBy("sample >= 100");
    ASSERT_EQ(m_panel.packets().rowCount(), 100);
    auto* newest = list().findChild<QPushButton*>("newestPacket");
    EXPECT_EQ(newest->text(), QStringLiteral("↓ Follow"));
    poses(200, 210);
    m_panel.filter().run()->wait();
    refresh();
    EXPECT_EQ(newest->text(), QStringLiteral("↓ 10 new"));
}

TEST(PacketsPanelOfASmallLog, SaysWhatTheFilterWasTooLateFor) {
    log::PacketLog log({.memoryCap = 1, .chunkSize = std::size_t{256} << 10});
    model::Session session(log);
    Commands commands{session};
    const auto sender = log.senders().intern({"10.0.0.2:40001", log::Transport::Udp, 9763});
    const auto append = [&](int count) {
        const std::vector<std::byte> bytes(700);
        for (int i = 0; i < count; ++i) {
            log.writer().append(bytes, {.stamp = Stage::kStart, .sender = sender});
        }
        log.writer().publish();
    };
    append(100);
    session.follow(Stage::kStart);
    append(10'000); // the log drops all that the session knows
    PacketsPanel panel(session, commands, nullptr);
    panel.show();
    commands.setDisplayFilter("foreign");
    panel.refresh();
    panel.filter().run()->wait();
    panel.refresh();
    EXPECT_TRUE(panel.summary().endsWith("0 of 100 shown · 100 not looked at in time"))
        << panel.summary().toStdString();
    EXPECT_TRUE(panel.findChild<PassingMessage*>()->said().startsWith("Packets left memory"));
}

TEST_F(PacketsPanelTest, SaysThatAJumpPutTheFilterThereAndGoesBack) {
    poses(0, 200);
    EXPECT_TRUE(list().isFollowing());
    auto* back = bar().findChild<QPushButton*>("back");
    m_panel.activateWindow();
    m_stage.commands.jump(50, "number == 50");
    filterBy("number == 50");
    EXPECT_TRUE(back->isVisible());
    EXPECT_TRUE(back->text().endsWith("Back to all packets")) << back->text().toStdString();
    EXPECT_EQ(list().currentIndex(), m_panel.packets().index(0, list().currentIndex().column()));
    back->click();
    EXPECT_FALSE(back->isVisible());
    EXPECT_EQ(bar().line().filter(), "");
    EXPECT_EQ(selected(), std::nullopt);
    EXPECT_TRUE(list().isFollowing());
    filterBy("type == 02");
    m_stage.commands.jump(60, "type == 02");
    refresh();
    EXPECT_FALSE(back->isVisible()) << "it is the operator's own";
    m_stage.commands.jump(60, "gap > 0");
    refresh();
    EXPECT_TRUE(back->text().endsWith("Back to type == 02")) << back->text().toStdString();
    EXPECT_TRUE(m_stage.commands.goBack());
    EXPECT_EQ(bar().line().filter(), "type == 02");
    EXPECT_EQ(selected(), 60U);
    EXPECT_TRUE(m_stage.commands.goBack());
    EXPECT_EQ(selected(), std::nullopt);
    EXPECT_FALSE(m_stage.commands.goBack());
}

TEST_F(PacketsPanelTest, ShowsWhereTheDisplayWasStoppedInThePast) {
    poses(0, 500);
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 499});
    refresh();
    EXPECT_TRUE(list().isFollowing()) << "the end is in sight as it is";
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 100});
    refresh();
    EXPECT_TRUE(list().isShown(m_panel.packets().index(100, 0)));
    EXPECT_FALSE(list().isFollowing());
    m_stage.session.setCursor({});
    refresh();
    EXPECT_TRUE(list().isFollowing()) << "all is live again";
}

TEST_F(PacketsPanelTest, FilterLineSaysWhatIsWrongAndWhere) {
    poses(0, 10);
    auto* line = m_panel.findChild<QLineEdit*>("displayFilter");
    line->setText("type == 02 && gop > 0");
    QTest::keyClick(line, Qt::Key_Return);
    ASSERT_TRUE(bar().line().error().has_value());
    EXPECT_EQ(bar().line().error()->offset, 14U);
    const auto* problem = bar().findChild<QLabel*>("filterProblem");
    EXPECT_TRUE(problem->text().contains("gop")) << problem->text().toStdString();
    EXPECT_EQ(m_stage.session.choices().displayFilter, "");
    line->setText("type == 02 && gap > 0");
    QTest::keyClick(line, Qt::Key_Return);
    EXPECT_EQ(m_stage.session.choices().displayFilter, "type == 02 && gap > 0");
    EXPECT_EQ(problem->text(), "");
    EXPECT_EQ(bar().line().history(), QStringList("type == 02 && gap > 0"));
}

TEST_F(PacketsPanelTest, TabTakesTheFirstCompletion) {
    auto* line = m_panel.findChild<QLineEdit*>("displayFilter");
    m_panel.activateWindow();
    line->setFocus();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&m_panel));
    QTest::keyClicks(line, "type == 02 && ga");
    QWidget* offers = QApplication::activePopupWidget();
    ASSERT_NE(offers, nullptr);
    QTest::keyClick(offers, Qt::Key_Tab);
    EXPECT_EQ(line->text(), "type == 02 && gap");
    EXPECT_TRUE(line->hasFocus());
}

TEST_F(PacketsPanelTest, EnterAppliesWhatWasWrittenAndNoOffer) {
    auto* line = m_panel.findChild<QLineEdit*>("displayFilter");
    m_panel.activateWindow();
    line->setFocus();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&m_panel));
    QTest::keyClicks(line, "malformed");
    QWidget* offers = QApplication::activePopupWidget();
    ASSERT_NE(offers, nullptr);
    QTest::keyClick(offers, Qt::Key_Return);
    EXPECT_EQ(m_stage.session.choices().displayFilter, "malformed");
    EXPECT_EQ(line->text(), "malformed");
    line->selectAll();
    QTest::keyClick(line, Qt::Key_Delete);
    EXPECT_EQ(QApplication::activePopupWidget(), nullptr) << "nothing is written: nothing to complete";
    EXPECT_EQ(m_stage.session.choices().displayFilter, "");
}

TEST_F(PacketsPanelTest, ShippedFiltersAreRight) {
    ASSERT_EQ(bar().saved().size(), 3U);
    for (const FilterBar::Saved& saved : bar().saved()) {
        EXPECT_TRUE(filter::Filter::compile(saved.text.toStdString()).has_value())
            << saved.text.toStdString();
    }
}

TEST_F(PacketsPanelTest, KeepsFiltersAndTimesFromOneRunToTheNext) {
    bar().setSaved({{"Mine", "size > 100"}});
    trigger("timeOfDay");
    trigger("deltaToRowAbove");
    PacketsPanel next(m_stage.session, m_stage.commands, nullptr);
    next.restoreState(m_panel.state());
    EXPECT_EQ(next.findChild<FilterBar*>()->saved(), bar().saved());
    EXPECT_EQ(next.packets().timeMode(), PacketModel::TimeMode::TimeOfDay);
    EXPECT_EQ(next.packets().deltaMode(), PacketModel::DeltaMode::RowAbove);
}

TEST_F(PacketsPanelTest, GoesToProblemsMarksAndTheStreamsOtherPackets) {
    poses(0, 100);
    poses(104, 200); // packet 100 follows a gap
    m_stage.sendMetadata("name:Mira\n", Stage::kStart + 3s);
    poses(200, 210);
    trigger("nextProblem");
    EXPECT_EQ(selected(), 100U);
    trigger("nextProblem");
    EXPECT_EQ(selected(), 100U);
    EXPECT_TRUE(message().contains("No problem of Mira after")) << message().toStdString();
    EXPECT_EQ(m_panel.goTo("195"), "");
    trigger("nextOfStream");
    EXPECT_EQ(selected(), 197U); // 196 is the metadata
    EXPECT_FALSE(isOn(m_panel, "mark"));
    trigger("mark");
    EXPECT_TRUE(m_stage.session.choices().annotations.marks.contains(197));
    EXPECT_TRUE(isOn(m_panel, "mark"));
    trigger("previousProblem");
    EXPECT_EQ(selected(), 100U);
    trigger("nextMark");
    EXPECT_EQ(selected(), 197U);
    EXPECT_NE(m_panel.goTo("9999"), "");
    trigger("firstPacket");
    EXPECT_EQ(selected(), 0U);
}

TEST_F(PacketsPanelTest, KeepsRoomForNotesWhereNotAllColumnsFit) {
    poses(0, 10);
    const auto isShown = [&](int column) { return !list().header().isSectionHidden(column); };
    m_panel.resize(1400, 300);
    EXPECT_TRUE(isShown(PacketModel::kPart) && isShown(PacketModel::kSize));
    m_panel.resize(560, 300);
    EXPECT_FALSE(isShown(PacketModel::kPart));
    EXPECT_TRUE(isShown(PacketModel::kNote) && isShown(PacketModel::kSample));
    EXPECT_EQ(list().horizontalScrollBar()->maximum(), 0);
    list().header().setChosen({"No.", "Part"});
    EXPECT_TRUE(isShown(PacketModel::kPart));
    EXPECT_FALSE(isShown(PacketModel::kSample));
    list().setCurrentIndex(m_panel.packets().index(3, PacketModel::kNumber));
    QTest::keyClick(&list(), Qt::Key_Right);
    EXPECT_EQ(list().currentIndex().column(), PacketModel::kPart);
}

TEST_F(PacketsPanelTest, OpensTheMenuOfTheKeyboardAtTheCurrentRow) {
    poses(0, 100);
    m_stage.commands.selectPacket(50);
    refresh();
    std::optional<QPoint> asked;
    QObject::disconnect(&list(), &PacketView::menuRequested, &m_panel, nullptr);
    QObject::connect(&list(), &PacketView::menuRequested, [&](const QPoint& place) { asked = place; });
    list().verticalScrollBar()->setValue(0);
    QContextMenuEvent event(QContextMenuEvent::Keyboard, QPoint(400, 5), QPoint(400, 5));
    QApplication::sendEvent(list().viewport(), &event);
    ASSERT_TRUE(asked.has_value());
    const QRect row = list().visualRect(list().currentIndex());
    const QPoint place = list().viewport()->mapFromGlobal(*asked);
    EXPECT_TRUE(row.contains(place)) << place.y();
    EXPECT_TRUE(list().isShown(list().currentIndex()));
}

TEST_F(PacketsPanelTest, MessagesKeepTheSelectedRowInSight) {
    poses(0, 200);
    m_stage.commands.selectPacket(199);
    refresh();
    ASSERT_TRUE(list().isShown(list().currentIndex()));
    trigger("nextProblem");
    EXPECT_FALSE(message().isEmpty());
    EXPECT_TRUE(list().isShown(list().currentIndex()));
}

TEST_F(PacketsPanelTest, GoesToProblemsThatTheFilterShows) {
    poses(0, 100);
    poses(104, 150); // packet 100 follows a gap
    poses(160, 200); // and packet 146
    filterBy("sample > 120");
    trigger("nextProblem");
    EXPECT_EQ(selected(), 146U);
    trigger("nextProblem");
    EXPECT_TRUE(message().contains("No problem after")) << message().toStdString();
    trigger("previousProblem");
    EXPECT_EQ(selected(), 146U) << "packet 100 is not listed";
}

TEST_F(PacketsPanelTest, FiltersByTheCellUnderTheCursor) {
    poses(0, 100);
    list().setCurrentIndex(m_panel.packets().index(50, PacketModel::kSample));
    trigger("filterByCell");
    EXPECT_EQ(m_stage.session.choices().displayFilter, "sample == 50");
    filterBy("sample == 50");
    list().setCurrentIndex(m_panel.packets().index(0, PacketModel::kSize));
    trigger("filterAndCell");
    const QString narrowed = QString::fromStdString(m_stage.session.choices().displayFilter);
    EXPECT_TRUE(narrowed.contains("sample == 50") && narrowed.contains("&& size == "))
        << narrowed.toStdString();
}

TEST_F(PacketsPanelTest, FindsTextInThePackets) {
    poses(0, 100);
    m_stage.sendMetadata("name:Mira Lindqvist\n", Stage::kStart + 3s);
    refresh();
    auto* find = m_panel.findChild<FindBar*>();
    trigger("find");
    EXPECT_TRUE(find->isVisible());
    find->setText("lindqvist");
    trigger("findNext");
    EXPECT_TRUE(QTest::qWaitFor([&] { return selected() == 100U; }));
    const auto found = m_stage.session.choices().selection.found;
    ASSERT_TRUE(found.has_value());
    const auto bytes = m_stage.session.packet(100)->bytes.subspan(found->begin, found->end - found->begin);
    EXPECT_EQ(readable(bytes), "Lindqvist");
    find->setText("nobody");
    trigger("findNext");
    EXPECT_TRUE(QTest::qWaitFor([&] { return find->said().contains("Not found"); }));
}

TEST_F(PacketsPanelTest, CopiesTheSelectedPacketInEachFormat) {
    poses(0, 10);
    list().setCurrentIndex(m_panel.packets().index(3, PacketModel::kSample));
    const auto copied = [&](std::string_view id) {
        QGuiApplication::clipboard()->clear();
        trigger(id);
        return copiedText();
    };
    EXPECT_EQ(copied("copyCell"), "3");
    EXPECT_TRUE(copied("copyRows").contains(QLatin1Char('\t')));
    EXPECT_TRUE(copied("copyCsv").contains(QLatin1Char(',')));
    EXPECT_TRUE(copied("copyBytesRaw").startsWith("4d58545030320000"));
    EXPECT_TRUE(copied("copyBytesText").contains("4d 58 54 50"));
    EXPECT_TRUE(copied("copyBytesCArray").contains("0x4d, 0x58"));
    EXPECT_TRUE(copied("copyBytesJson").startsWith("{"));
    EXPECT_EQ(message(), "Packets copied: 1");
}

TEST_F(PacketsPanelTest, MarksTheMomentWhereNoPacketIsSelected) {
    trigger("mark");
    EXPECT_FALSE(message().isEmpty());
    poses(0, 50);
    trigger("mark");
    poses(50, 60);
    trigger("mark");
    EXPECT_EQ(m_stage.session.choices().annotations.marks, (std::set<std::uint64_t>{49, 59}));
    EXPECT_EQ(message(), QStringLiteral("Packet 59 is marked."));
    EXPECT_EQ(selected(), std::nullopt) << "the list still follows";
}

TEST_F(PacketsPanelTest, HoldsToTheSelectedRangeUntilAPacketElsewhereIsShown) {
    poses(0, 200); // 10 ms apart
    const auto choose = [this](log::Duration from, log::Duration to) {
        m_stage.commands.selectRange({.fixed = model::TimeRange{Stage::kStart + from, Stage::kStart + to}});
        refresh();
        m_panel.filter().run()->wait();
        refresh();
    };
    choose(500ms, 700ms);
    EXPECT_EQ(m_panel.packets().rowCount(), 20);
    EXPECT_EQ(m_panel.packets().packetAt(0), 50U);
    EXPECT_EQ(m_panel.summary(), QStringLiteral("following · 20 of 200 shown, of the selected range"));
    filterBy(QStringLiteral("sample < 55 || sample > 150"));
    EXPECT_EQ(m_panel.packets().rowCount(), 5);
    filterBy({});
    m_panel.goTo(QStringLiteral("150"));
    EXPECT_EQ(m_panel.packets().rowCount(), 200);
    choose(100ms, 200ms);
    EXPECT_EQ(m_panel.packets().rowCount(), 10);
    m_stage.commands.selectRange({});
    refresh();
    EXPECT_EQ(m_panel.packets().rowCount(), 200);
}

TEST_F(PacketsPanelTest, GoesThroughStreamsAndMarksInBothDirections) {
    poses(0, 20);
    EXPECT_EQ(m_panel.goTo("10"), "");
    trigger("mark");
    trigger("previousOfStream");
    EXPECT_EQ(selected(), 9U);
    trigger("nextOfStream");
    trigger("nextOfStream");
    EXPECT_EQ(selected(), 11U);
    trigger("previousMark");
    EXPECT_EQ(selected(), 10U);
    trigger("newestPacket");
    EXPECT_EQ(selected(), std::nullopt);
    EXPECT_TRUE(list().isFollowing());
}

TEST_F(PacketsPanelTest, SaysWhyThereIsNothingToDo) {
    for (const char* id : {"mark", "comment", "copyRows", "copyCell", "copyBytesText", "filterByCell"}) {
        trigger(id);
        EXPECT_EQ(message(), "No packet is selected.") << id;
    }
}

TEST_F(PacketsPanelTest, ChecksTheTimesThatItShows) {
    const auto isOn = [&](std::string_view id) { return gui::isOn(m_panel, id); };
    EXPECT_TRUE(isOn("timeSinceFirst") && isOn("deltaInStream"));
    trigger("timeOfDay");
    trigger("deltaToRowAbove");
    EXPECT_TRUE(isOn("timeOfDay") && isOn("deltaToRowAbove"));
    EXPECT_FALSE(isOn("timeSinceFirst") || isOn("deltaInStream"));
    trigger("timeSinceFirst");
    trigger("deltaInStream");
    EXPECT_TRUE(isOn("timeSinceFirst") && isOn("deltaInStream"));
}

TEST_F(PacketsPanelTest, BringsTheKeyboardToTheFilterAndToTheFindBar) {
    m_panel.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&m_panel));
    trigger("filter");
    EXPECT_TRUE(m_panel.findChild<QLineEdit*>("displayFilter")->hasFocus());
    trigger("findPrevious");
    EXPECT_TRUE(m_panel.findChild<FindBar*>()->isVisible()) << "there is nothing to look for yet";
}

TEST_F(PacketsPanelTest, NotesHaveRoomBeforeNamesAndFiguresDo) {
    poses(1, 10);
    const int note = QFontMetrics(packetFont()).horizontalAdvance(QStringLiteral("▲ gap: 1 sample"));
    for (const int width : {1400, 650, 500}) {
        m_panel.resize(width, 300);
        EXPECT_GE(list().header().sectionSize(PacketModel::kNote), note) << width;
    }
    m_panel.resize(300, 300);
    EXPECT_EQ(list().horizontalScrollBar()->maximum(), 0) << "in the least room, all gives way a little";
}

TEST_F(PacketsPanelTest, TheButtonThatFollowsCoversNoTitle) {
    poses(0, 200);
    list().verticalScrollBar()->setValue(10);
    poses(200, 1300);
    auto* newest = list().findChild<QPushButton*>("newestPacket");
    for (const int width : {300, 420, 520, 640, 900, 1400}) {
        m_panel.resize(width, 300);
        refresh();
        ASSERT_TRUE(newest->isVisible());
        const FittingHeader& header = list().header();
        int shown = 0;
        for (int column = 0; column < header.count(); ++column) {
            const QString title = m_panel.packets().headerData(column, Qt::Horizontal, 0).toString();
            const int space = header.fontMetrics().averageCharWidth();
            const bool isNumber =
                m_panel.packets().headerData(column, Qt::Horizontal, Qt::TextAlignmentRole).isValid();
            const int text = std::min(header.sectionSize(column) - 2 * space,
                                      header.fontMetrics().horizontalAdvance(title));
            const int left = header.sectionViewportPosition(column) +
                             (isNumber ? header.sectionSize(column) - space - text : space);
            const QRect words(header.x() + left, header.y(), text, header.height());
            const bool isSeen = !header.isSectionHidden(column) && words.right() <= header.geometry().right();
            shown += isSeen ? 1 : 0;
            EXPECT_FALSE(isSeen && newest->geometry().intersects(words)) << title.toStdString() << width;
        }
        EXPECT_GT(shown, 1);
        EXPECT_TRUE(list().rect().contains(newest->geometry()) && (width < 640 || newest->y() == header.y()));
    }
}

TEST_F(PacketsPanelTest, GoesToProblemsOfTheSelectedCharacterAlone) {
    for (std::uint32_t sample = 0; sample < 60; ++sample) {
        for (std::uint8_t character = 0; character < 2; ++character) {
            const bool isLost = sample == (character == 0 ? 20U : 40U);
            wire::Datagram datagram;
            datagram.body = smallPose();
            datagram.header.sampleCounter = sample;
            datagram.header.character = character;
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            if (!isLost) {
                m_stage.send(datagram, Stage::kStart + sample * 10ms);
            }
        }
    }
    m_stage.now += 1s;
    refresh();
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(1), -1});
    trigger("nextProblem");
    ASSERT_TRUE(selected());
    EXPECT_EQ(m_stage.session.accounts().digests().at(*selected()).character, 1);
    const std::uint64_t only = *selected();
    trigger("nextProblem");
    EXPECT_EQ(selected(), only);
    const QString name = QString::fromStdString(m_stage.session.roster().displayName(m_stage.key(1)).shown());
    EXPECT_EQ(message(), "No problem of " + name + " after this packet.");
    m_stage.session.setSelection({});
    trigger("nextProblem");
    EXPECT_EQ(m_stage.session.accounts().digests().at(*selected()).character, 0) << "of all";
}

TEST_F(PacketsPanelTest, EnterInTheFilterLineGoesToTheListWithoutTakingARow) {
    poses(0, 50);
    m_panel.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&m_panel));
    QLineEdit* line = enterFilter("type == 02");
    EXPECT_TRUE(list().hasFocus());
    EXPECT_EQ(m_stage.session.choices().displayFilter, "type == 02");
    EXPECT_EQ(selected(), std::nullopt);
    EXPECT_TRUE(list().isFollowing());
    enterFilter("type ==");
    EXPECT_TRUE(line->hasFocus()) << "it is to be put right";
}

TEST_F(PacketsPanelTest, DownGoesFromTheFilterLineToTheListAndAltDownOpensEarlierFilters) {
    poses(0, 50);
    m_panel.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&m_panel));
    QLineEdit* line = enterFilter("type == 02");
    bar().focusLine();
    QTest::keyClick(line, Qt::Key_Down);
    EXPECT_EQ(QApplication::activePopupWidget(), nullptr);
    EXPECT_TRUE(list().hasFocus());
    bar().focusLine();
    QTest::keyClick(line, Qt::Key_Down, Qt::AltModifier);
    ASSERT_NE(QApplication::activePopupWidget(), nullptr);
    QTest::keyClick(QApplication::activePopupWidget(), Qt::Key_Escape);
}

} // namespace
} // namespace posewire::gui
