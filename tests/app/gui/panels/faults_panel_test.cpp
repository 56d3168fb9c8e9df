// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/faults_panel.h"

#include "core/model/session/accounts.h"
#include "tests/app/gui/models/stage.h"

#include <QHeaderView>
#include <QScrollBar>
#include <QTest>
#include <QToolButton>

namespace posewire::gui {
namespace {

class FaultsPanelTest : public testing::Test {
protected:
    FaultsPanelTest() {
        m_panel.resize(900, 260);
        m_panel.show();
    }
    void perform(std::uint64_t from, std::uint64_t to) {
        for (std::uint64_t frame = from; frame < to; ++frame) {
            for (const wire::Datagram& datagram : m_performer.frame(frame)) {
                if (frame % 50 != 25 || datagram.header.type() != 20) {
                    m_stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / 100));
                }
            }
        }
        refresh();
    }
    void refresh() {
        m_stage.follow();
        m_panel.refresh();
    }
    [[nodiscard]] QModelIndex character(int column = 0) const { return m_table->model()->index(1, column); }
    [[nodiscard]] QToolButton* button(const QString& text) const {
        for (QToolButton* each : m_panel.findChildren<QToolButton*>()) {
            if (each->text() == text) {
                return each;
            }
        }
        return nullptr;
    }

    Stage m_stage;
    performer::Performer m_performer{sending(1, {2, 20}, 100.0)};
    FaultsPanel m_panel{m_stage.session, m_stage.commands, nullptr};
    TableView* m_table = m_panel.findChild<TableView*>();
};

TEST_F(FaultsPanelTest, SaysWhyItIsEmpty) {
    refresh();
    EXPECT_TRUE(m_table->accessibleDescription().startsWith("No stream received yet."));
    EXPECT_EQ(m_panel.summary(), "");
}

TEST_F(FaultsPanelTest, NamesTheSpanAtItsHeadAndSharesItWithTheStatistics) {
    perform(0, 400);
    auto* span = m_panel.findChild<ElidedLabel*>("span");
    EXPECT_EQ(span->text(), QStringLiteral("Samples lost · all, 4.0 s"));
    EXPECT_FALSE(button("Since reset")->isVisible());
    EXPECT_FALSE(button("Selection")->isVisible());
    button("10 s")->click();
    refresh();
    EXPECT_EQ(m_stage.session.choices().range.last, 10s);
    EXPECT_EQ(span->text(), QStringLiteral("Samples lost · last 10 s"));
    m_stage.commands.selectRange({{}, model::TimeRange{Stage::kStart, Stage::kStart + 1s}});
    refresh();
    EXPECT_TRUE(button("Selection")->isVisible());
    EXPECT_TRUE(span->text().contains(QStringLiteral("selection "))) << span->text().toStdString();
    m_stage.session.resetForTake();
    refresh();
    EXPECT_TRUE(button("Since reset")->isVisible());
    EXPECT_TRUE(button("Since reset")->isChecked());
}

TEST_F(FaultsPanelTest, EnterOnACellShowsItsPacketsAndKeepsTheFilter) {
    perform(0, 400);
    m_stage.commands.setDisplayFilter("type == 20");
    m_table->setCurrentIndex(character(FaultModel::kNetwork));
    QTest::keyClick(m_table, Qt::Key_Return);
    ASSERT_TRUE(m_stage.session.choices().selection.packet.has_value());
    EXPECT_EQ(m_stage.session.accounts().digests().find(*m_stage.session.choices().selection.packet)->gap,
              1U);
    EXPECT_EQ(m_stage.session.choices().displayFilter, "type == 20");
    m_panel.showPackets(character(FaultModel::kNetwork), PacketLook::Alone);
    EXPECT_EQ(m_stage.session.choices().displayFilter, "character == 0 && gap > 0");
    EXPECT_EQ(m_stage.session.choices().ownFilter(), "type == 20");
}

TEST_F(FaultsPanelTest, ACellWithoutLossesLeadsNowhere) {
    perform(0, 20);
    m_panel.showPackets(character(FaultModel::kSender), PacketLook::InContext);
    EXPECT_FALSE(m_stage.session.choices().selection.packet.has_value());
    perform(20, 400);
    ASSERT_EQ(character(FaultModel::kSender).data().toString(), "0");
    m_panel.showPackets(character(FaultModel::kSender), PacketLook::InContext);
    EXPECT_EQ(m_panel.findChild<PassingMessage*>()->text(), "Nothing is counted in this cell.")
        << "though the network lost some";
}

TEST_F(FaultsPanelTest, ArrowsGoFromCellToCellAndOpenRows) {
    perform(0, 100);
    m_table->setCurrentIndex(character());
    m_table->setFocus();
    QTest::keyClick(m_table, Qt::Key_Right);
    EXPECT_TRUE(m_table->isExpanded(character()));
    QTest::keyClick(m_table, Qt::Key_Right);
    EXPECT_EQ(m_table->currentIndex(), character(FaultModel::kThisComputer));
    QTest::keyClick(m_table, Qt::Key_Right);
    QTest::keyClick(m_table, Qt::Key_Left);
    QTest::keyClick(m_table, Qt::Key_Left);
    EXPECT_EQ(m_table->currentIndex(), character());
}

TEST_F(FaultsPanelTest, WhatIsOpenStaysOpenWhenRowsCome) {
    perform(0, 100);
    m_table->expand(character());
    m_table->setCurrentIndex(character(FaultModel::kNetwork));
    performer::Performer other(sending(1, {2}, 100.0));
    for (std::uint64_t frame = 100; frame < 200; ++frame) {
        for (const wire::Datagram& datagram : other.frame(frame)) {
            m_stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / 100),
                         "192.168.10.99:5000");
        }
    }
    refresh();
    EXPECT_EQ(m_table->model()->rowCount(), 3);
    EXPECT_TRUE(m_table->isExpanded(character()));
    EXPECT_EQ(m_table->currentIndex(), character(FaultModel::kNetwork));
}

TEST_F(FaultsPanelTest, ANarrowDockShowsNamesWholeAndScrollsNotSideways) {
    perform(0, 400);
    m_panel.resize(490, 260);
    refresh();
    const auto isShown = [this](int column) { return !m_table->header()->isSectionHidden(column); };
    const int name = m_table->fontMetrics().horizontalAdvance("    ● All characters");
    EXPECT_GE(m_table->columnWidth(0), name);
    for (const int column : {FaultModel::kThisComputer, FaultModel::kNetwork, FaultModel::kSender,
                             FaultModel::kUnknown, FaultModel::kLost}) {
        EXPECT_TRUE(isShown(column)) << column;
        const QString title = m_table->model()->headerData(column, Qt::Horizontal).toString();
        EXPECT_GE(m_table->columnWidth(column), m_table->fontMetrics().horizontalAdvance(title) + 8)
            << title.toStdString();
    }
    for (const int width : {280, 313, 400, 490, 900}) {
        m_panel.resize(width, 260);
        refresh();
        QTest::qWait(1); // sizes settle
        EXPECT_EQ(m_table->horizontalScrollBar()->maximum(), 0) << width;
        EXPECT_TRUE(isShown(FaultModel::kNetwork) && isShown(FaultModel::kSender)) << width;
    }
}

TEST_F(FaultsPanelTest, ANarrowDockLeavesOutNoCauseThatHasLosses) {
    perform(0, 400);
    m_panel.resize(300, 260);
    refresh();
    for (int column = FaultModel::kThisComputer; column <= FaultModel::kUnknown; ++column) {
        const QString lost = m_table->model()->index(0, column).data().toString();
        EXPECT_TRUE(lost == "0" || !m_table->isColumnHidden(column)) << column << lost.toStdString();
    }
}

} // namespace
} // namespace posewire::gui
