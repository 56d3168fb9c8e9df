// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/statistics_panel.h"

#include "core/model/session/accounts.h"
#include "tests/app/gui/panels/panel_stage.h"

#include <QContextMenuEvent>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QTest>
#include <QToolButton>

#include <cstdlib>
#include <memory>

namespace posewire::gui {
namespace {

using Column = model::Figure;

int columnOf(model::Figure figure) {
    int column = 0;
    while (figureIn(column) != figure) {
        ++column;
    }
    return column;
}

class StatisticsPanelTest : public testing::Test {
protected:
    void open(int width = 420) {
        m_panel = std::make_unique<StatisticsPanel>(m_stage.session, m_stage.commands, m_stage.receiving,
                                                    m_stage.health, nullptr);
        m_panel->resize(width, 400);
        m_panel->show();
        refresh();
    }
    void perform(std::uint64_t seconds) {
        performer::Performer performer(sending(2, {2, 20, 23}, 100.0));
        m_stage.perform(performer, 0, seconds * 100, [](std::uint64_t frame) { return frame != 520; });
    }
    void refresh() {
        m_stage.follow();
        m_panel->refresh();
        QCoreApplication::processEvents();
    }
    TableView& table() { return *m_panel->findChild<TableView*>("streams"); }
    RangeStrip& strip() { return *m_panel->findChild<RangeStrip*>(); }
    QModelIndex stream(int column) {
        const QAbstractItemModel& model = *table().model();
        return model.index(0, column, model.index(0, 0, model.index(0, 0)));
    }
    QModelIndex stream(Column column) { return stream(columnOf(column)); }
    std::optional<model::TimeRange> range() const { return m_stage.session.range(); }

    PanelStage m_stage;
    std::unique_ptr<StatisticsPanel> m_panel;
};

TEST_F(StatisticsPanelTest, ShowsAsManyColumnsAsFitOrThoseThatWereChosen) {
    perform(1);
    open(380);
    EXPECT_LE(table().header()->length(), table().viewport()->width());
    EXPECT_FALSE(table().isColumnHidden(columnOf(Column::LossShare)));
    EXPECT_TRUE(table().isColumnHidden(columnOf(Column::Drift)));
    EXPECT_TRUE(m_panel->state().isEmpty());
    m_panel->resize(4000, 400);
    for (int column = 0; column < kStatisticsColumns; ++column) {
        EXPECT_EQ(table().isColumnHidden(column), column > columnOf(model::Figure::Jitter)) << column;
    }
    m_panel->restoreState({{"columns", QJsonArray{"Stream", "Drift ms"}}});
    EXPECT_TRUE(table().isColumnHidden(columnOf(Column::Rate)));
    m_panel->resize(380, 400);
    EXPECT_FALSE(table().isColumnHidden(columnOf(Column::Drift)));
    EXPECT_EQ(m_panel->state()["columns"].toArray().size(), 2);
}

TEST_F(StatisticsPanelTest, SaysTheVerdictOfARange) {
    perform(10); // without sample 520
    open();
    const auto* verdict = m_panel->findChild<QLabel*>("rangeVerdict");
    EXPECT_FALSE(verdict->isVisible());
    m_stage.commands.selectRange({.fixed = model::TimeRange{Stage::kStart + 1s, Stage::kStart + 3s}});
    refresh();
    EXPECT_TRUE(verdict->isVisible());
    EXPECT_TRUE(verdict->text().startsWith(QStringLiteral("● "))) << qPrintable(verdict->text());
    m_stage.commands.selectRange({.fixed = model::TimeRange{Stage::kStart + 4s, Stage::kStart + 6s}});
    refresh();
    EXPECT_TRUE(verdict->text().startsWith(QStringLiteral("▲ "))) << qPrintable(verdict->text());
}

TEST_F(StatisticsPanelTest, FoldsASenderThatAnotherTookOverFromOnce) {
    perform(1);
    open();
    const QAbstractItemModel& model = *table().model();
    EXPECT_TRUE(table().isExpanded(model.index(0, 0)));
    performer::Performer again(sending(2, {2, 20, 23}, 100.0));
    for (std::uint64_t frame = 0; frame < 100; ++frame) {
        for (const wire::Datagram& datagram : again.frame(frame)) {
            m_stage.send(datagram, Stage::kStart + 4s + frame * 10ms, "192.168.10.21:52012");
        }
    }
    refresh();
    ASSERT_EQ(model.rowCount(), 2);
    EXPECT_FALSE(table().isExpanded(model.index(0, 0)));
    EXPECT_EQ(model.index(0, 0).data(kSuffixRole).toString(), "· ended");
    EXPECT_TRUE(table().isExpanded(model.index(1, 0)));
    EXPECT_EQ(model.index(1, 0).data(kSuffixRole).toString(), "");
    table().expand(model.index(0, 0));
    refresh();
    EXPECT_TRUE(table().isExpanded(model.index(0, 0))) << "the operator opened it";
}

TEST_F(StatisticsPanelTest, ForgetsColumnsThatOldSettingsKnowByPlaceAndThoseThatAreNoMore) {
    perform(1);
    open(4000);
    m_panel->restoreState({{"columns", QJsonArray{0, 3, "Nothing of that name"}}});
    EXPECT_TRUE(m_panel->state().isEmpty());
    EXPECT_FALSE(table().isColumnHidden(columnOf(Column::LostOnNetwork)));
    m_panel->restoreState({{"columns", QJsonArray{0, "Stream", "Lost"}}});
    EXPECT_EQ(m_panel->state()["columns"].toArray(), (QJsonArray{"Stream", "Lost"}));
}

TEST_F(StatisticsPanelTest, ACellJumpsToItsPacketsByDoubleClickAndByKey) {
    perform(6);
    open();
    QTest::mouseDClick(table().viewport(), Qt::LeftButton, {},
                       table().visualRect(stream(Column::Lost)).center());
    table().activated(stream(Column::Lost)); // what a double click is depends on the platform's style
    EXPECT_EQ(m_stage.session.choices().displayFilter, "") << "in their context";
    ASSERT_TRUE(m_stage.session.choices().selection.packet.has_value());
    EXPECT_EQ(m_stage.session.accounts().digests().find(*m_stage.session.choices().selection.packet)->gap,
              1U);
    EXPECT_EQ(m_stage.asked.dock, "packets");
    table().setCurrentIndex(stream(kNameColumn));
    table().setFocus();
    QTest::keyClick(&table(), Qt::Key_Return);
    EXPECT_EQ(m_stage.session.accounts().digests().find(*m_stage.session.choices().selection.packet)->type,
              2);
    m_panel->showPackets(stream(Column::Lost), PacketLook::Alone);
    EXPECT_EQ(m_stage.session.choices().displayFilter, "type == 02 && character == 0 && gap > 0");
    m_stage.session.goBack();
    EXPECT_EQ(m_stage.session.choices().displayFilter, "");
}

TEST_F(StatisticsPanelTest, ClickingARowSelectsItsCharacter) {
    perform(1);
    open();
    const QModelIndex second = table().model()->index(1, 0, table().model()->index(0, 0));
    QTest::mouseClick(table().viewport(), Qt::LeftButton, {}, table().visualRect(second).center());
    EXPECT_EQ(m_stage.session.choices().selection.character, m_stage.key(1));
}

TEST_F(StatisticsPanelTest, DraggingInTheStripChoosesARangeAndAClickTakesItAway) {
    perform(20);
    open();
    const int middle = strip().height() / 2;
    const int from = strip().width() / 4;
    const int to = strip().width() / 2;
    QTest::mousePress(&strip(), Qt::LeftButton, {}, {from, middle});
    QTest::mouseMove(&strip(), {to, middle});
    QTest::mouseRelease(&strip(), Qt::LeftButton, {}, {to, middle});
    ASSERT_TRUE(range().has_value());
    EXPECT_NEAR(log::secondsOf(range()->from - Stage::kStart), 5.0, 0.5);
    EXPECT_NEAR(range()->seconds(), 5.0, 0.5);
    EXPECT_TRUE(m_panel->summary().startsWith("selection ")) << m_panel->summary().toStdString();
    QTest::mouseClick(&strip(), Qt::LeftButton, {}, {2, middle});
    EXPECT_FALSE(range().has_value());
    EXPECT_EQ(m_panel->summary(), "all, 19 s · 6 streams");
}

TEST_F(StatisticsPanelTest, ButtonsChooseTheNewestSecondsAndTheTitleSaysSo) {
    perform(20);
    open();
    for (QToolButton* button : m_panel->findChildren<QToolButton*>()) {
        if (button->text() == "10 s") {
            button->click();
        }
    }
    EXPECT_EQ(m_stage.session.choices().range.last, 10s);
    EXPECT_EQ(m_panel->summary(), "last 10 s · 6 streams");
    refresh();
    const double samples = stream(Column::Samples).data().toString().remove(QChar(0x202f)).toDouble();
    EXPECT_NEAR(samples, 1000, 11);
}

TEST_F(StatisticsPanelTest, FiltersThePacketsToTheRange) {
    perform(6);
    open();
    m_panel->filterToRange();
    EXPECT_EQ(m_stage.asked.dock, "");
    m_stage.commands.selectRange({0s, model::TimeRange{Stage::kStart + 2s, Stage::kStart + 4s}});
    m_panel->filterToRange();
    EXPECT_EQ(m_stage.session.choices().displayFilter, "time >= 2.000 && time < 4.000");
    EXPECT_EQ(m_stage.asked.dock, "packets");
}

TEST_F(StatisticsPanelTest, AnEmptyStripTakesTheMouseWithoutARange) {
    open();
    QTest::mouseClick(&strip(), Qt::LeftButton, {}, {10, 5});
    EXPECT_FALSE(range().has_value());
}

TEST_F(StatisticsPanelTest, MenuOffersThePacketsAndCsv) {
    perform(6);
    open();
    QMenu menu;
    emit table().menuRequested(menu, stream(kNameColumn));
    ASSERT_EQ(menu.actions().size(), 5);
    QMenu* packets = menu.actions()[1]->menu();
    ASSERT_NE(packets, nullptr);
    ASSERT_EQ(packets->actions().size(), 6);
    packets->actions()[1]->trigger();
    EXPECT_EQ(m_stage.session.choices().displayFilter, "type == 02 && character == 0 && gap > 0");
    menu.actions().back()->trigger();
    EXPECT_TRUE(copiedText().startsWith("Sender,Character"));
}

} // namespace
} // namespace posewire::gui
