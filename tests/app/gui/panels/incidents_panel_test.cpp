// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/incidents_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/panels/table_view.h"
#include "core/model/session/accounts.h"
#include "core/model/session/verdict.h"
#include "tests/app/gui/models/stage.h"

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

namespace posewire::gui {

namespace {

class IncidentsPanelTest : public testing::Test {
protected:
    IncidentsPanelTest() {
        m_panel.resize(900, 260);
        m_panel.show();
        perform(0, 240, 60, 63);
    }
    void perform(std::uint64_t from, std::uint64_t to, std::uint64_t lostFrom = 0, std::uint64_t lostTo = 0) {
        m_stage.perform(m_performer, from, to,
                        [=](std::uint64_t frame) { return frame < lostFrom || frame >= lostTo; });
        m_stage.follow();
        m_panel.refresh();
    }
    /// `count` events of the smallest kind, each an episode of its own.
    void sendForeign(int count) {
        for (int i = 0; i < count; ++i) {
            m_stage.sendBytes(std::vector<std::byte>(8, std::byte{'G'}), m_stage.now + 1ms,
                              "10.0.0." + std::to_string(++m_sender) + ":1");
        }
        m_stage.follow();
        m_panel.refresh();
    }
    [[nodiscard]] QModelIndex rowWith(const QString& text) const {
        const QAbstractItemModel* model = m_table->model();
        for (int row = 0; row < model->rowCount(); ++row) {
            if (model->index(row, IncidentModel::kText).data().toString().contains(text)) {
                return model->index(row, 0);
            }
        }
        return {};
    }
    [[nodiscard]] QToolButton* button(const char* name) const {
        return m_panel.findChild<QToolButton*>(QLatin1String(name));
    }

    Stage m_stage;
    performer::Performer m_performer{sending(1, {2}, 60.0)};
    IncidentsPanel m_panel{m_stage.session, m_stage.commands, nullptr};
    TableView* m_table = m_panel.findChild<TableView*>();
    int m_sender = 0;
};

TEST_F(IncidentsPanelTest, EnterOnAGapShowsItsPackets) {
    const QModelIndex gap = rowWith(QStringLiteral("samples lost"));
    ASSERT_TRUE(gap.isValid());
    m_table->setCurrentIndex(gap);
    QTest::keyClick(m_table, Qt::Key_Return);
    EXPECT_EQ(m_stage.asked.dock, QStringLiteral("packets"));
    EXPECT_EQ(m_stage.session.choices().displayFilter, "") << "its packets in their context";
    ASSERT_TRUE(m_stage.session.choices().selection.packet.has_value());
    EXPECT_EQ(m_stage.session.accounts().digests().find(*m_stage.session.choices().selection.packet)->gap,
              3U);
}

TEST_F(IncidentsPanelTest, AJumpKeepsTheFilterOfTheOperator) {
    m_stage.session.setDisplayFilter("type == 02");
    m_panel.jump(rowWith(QStringLiteral("samples lost")));
    EXPECT_EQ(m_stage.session.choices().displayFilter, "type == 02");
    EXPECT_EQ(m_stage.session.choices().filterJump(), nullptr);
    m_stage.session.goBack();
    EXPECT_FALSE(m_stage.session.choices().selection.packet.has_value());
    EXPECT_EQ(m_stage.session.choices().displayFilter, "type == 02");
}

TEST_F(IncidentsPanelTest, AFilterThatHidesThePacketIsWidenedAndComesBack) {
    m_stage.session.setDisplayFilter("type == 20");
    m_panel.jump(rowWith(QStringLiteral("samples lost")));
    const std::string filter = m_stage.session.choices().displayFilter;
    EXPECT_TRUE(filter.starts_with("type == 20 || gap > 0 && type == 02")) << filter;
    ASSERT_TRUE(m_stage.session.choices().selection.packet.has_value());
    EXPECT_TRUE(isListed(m_stage.session, QString::fromStdString(filter),
                         *m_stage.session.choices().selection.packet));
    EXPECT_EQ(m_stage.session.choices().ownFilter(), "type == 20");
    m_stage.session.goBack();
    EXPECT_EQ(m_stage.session.choices().displayFilter, "type == 20");
}

TEST_F(IncidentsPanelTest, ShowsOnlyItsPacketsWhereThatIsAskedFor) {
    m_stage.session.setDisplayFilter("type == 02");
    m_table->setCurrentIndex(rowWith(QStringLiteral("samples lost")));
    m_panel.showOnlyCurrent();
    EXPECT_TRUE(m_stage.session.choices().displayFilter.starts_with("gap > 0 && type == 02"));
    EXPECT_EQ(m_stage.session.choices().ownFilter(), "type == 02");
    EXPECT_EQ(m_stage.asked.dock, QStringLiteral("packets"));
}

TEST_F(IncidentsPanelTest, AStreamOfAnIncidentLeadsToItsOwnPackets) {
    performer::Performer performer(sending(2, {20, 21}, 60.0));
    m_stage.perform(performer, 240, 480, [](std::uint64_t frame) { return frame < 300 || frame >= 310; });
    m_stage.follow();
    m_panel.refresh();
    const QAbstractItemModel* model = m_table->model();
    int seen = 0;
    for (int row = 0; row < model->rowCount(); ++row) {
        const QModelIndex whole = model->index(row, 0);
        for (int part = 0; part < model->rowCount(whole); ++part) {
            m_panel.jump(model->index(part, 0, whole));
            const auto packet = m_stage.session.choices().selection.packet;
            ASSERT_TRUE(packet.has_value());
            const auto* digest = m_stage.session.accounts().digests().find(*packet);
            const QString what = model->index(part, IncidentModel::kText, whole).data().toString();
            const QString type = QStringLiteral("%1 ").arg(int{digest->type}, 2, 10, QLatin1Char('0'));
            EXPECT_TRUE(what.startsWith(type)) << what.toStdString();
            EXPECT_GT(digest->gap, 0U);
            ++seen;
        }
    }
    EXPECT_GE(seen, 4);
}

TEST_F(IncidentsPanelTest, ListsTheIncidentsOfACharacterEachTimeTheyAreAskedFor) {
    sendForeign(1);
    ASSERT_GT(m_table->model()->rowCount(), 1);
    const model::Incident* loss = nullptr;
    for (const model::Incident& one : m_stage.session.verdicts().incidents().all()) {
        loss = one.kind == model::IncidentKind::Loss ? &one : loss;
    }
    ASSERT_NE(loss, nullptr);
    const model::CharacterKey key = *loss->character();
    for (int time = 0; time < 2; ++time) {
        m_stage.commands.showIncident(loss->number, key);
        m_panel.refresh();
        EXPECT_TRUE(rowWith("lost").isValid()) << "its loss stays listed";
        EXPECT_FALSE(rowWith("MXTP").isValid()) << "foreign datagrams are of no character";
        EXPECT_EQ(m_table->currentIndex().row(), rowWith("lost").row());
        EXPECT_EQ(m_panel.filter().text, characterName(m_stage.session, key));
        m_panel.setFilter({});
        EXPECT_TRUE(rowWith("MXTP").isValid()) << "the operator took the filter off";
    }
}

TEST_F(IncidentsPanelTest, SummaryTellsWhatGoesOnAndWhatIsNew) {
    const QString summary = m_panel.summary();
    EXPECT_TRUE(summary.contains(QStringLiteral(" now · "))) << summary.toStdString();
    EXPECT_FALSE(summary.contains(QStringLiteral("new")));
    m_panel.markSeen();
    sendForeign(1);
    EXPECT_TRUE(m_panel.summary().endsWith(QStringLiteral("1 new"))) << m_panel.summary().toStdString();
}

TEST_F(IncidentsPanelTest, FollowsTheNewestUntilARowIsSelected) {
    sendForeign(40);
    QScrollBar* bar = m_table->verticalScrollBar();
    EXPECT_GT(bar->maximum(), 0);
    EXPECT_EQ(bar->value(), bar->maximum());
    m_table->setCurrentIndex(m_table->model()->index(2, 0));
    EXPECT_FALSE(m_panel.isFollowing());
    sendForeign(5);
    auto* chip = m_panel.findChild<QPushButton*>(QStringLiteral("newestEvent"));
    EXPECT_TRUE(chip->isVisible());
    EXPECT_TRUE(chip->text().contains(QStringLiteral("5 new"))) << chip->text().toStdString();
    EXPECT_EQ(m_table->currentIndex().row(), 2);
    chip->click();
    EXPECT_TRUE(m_panel.isFollowing());
    EXPECT_FALSE(chip->isVisible());
    EXPECT_EQ(bar->value(), bar->maximum());
}

TEST_F(IncidentsPanelTest, TheButtonThatFollowsLeavesTheLastTitleToBeRead) {
    sendForeign(40);
    m_table->setCurrentIndex(m_table->model()->index(2, 0));
    const auto* chip = m_panel.findChild<QPushButton*>(QStringLiteral("newestEvent"));
    const FittingHeader& header = m_table->columns();
    int seen = 0;
    for (int width = 420; width < 900; width += 5) {
        m_panel.resize(width, 260);
        m_panel.refresh();
        const bool hasRoom = header.width() - header.titlesEnd() > 40;
        seen += hasRoom ? 1 : 0;
        EXPECT_TRUE(!hasRoom || chip->x() > header.x() + header.titlesEnd())
            << width << " " << chip->text().toStdString();
    }
    EXPECT_GT(seen, 10);
}

TEST_F(IncidentsPanelTest, ButtonsFilterAndAreRemembered) {
    button("notes")->click();
    EXPECT_FALSE(rowWith(QStringLiteral("A sender started")).isValid());
    EXPECT_TRUE(rowWith(QStringLiteral("samples lost")).isValid());
    IncidentsPanel again(m_stage.session, m_stage.commands, nullptr);
    again.restoreState(m_panel.state());
    EXPECT_EQ(again.state(), m_panel.state());
    EXPECT_FALSE(again.state().isEmpty());
    auto* text = m_panel.findChild<QLineEdit*>(QStringLiteral("eventText"));
    QTest::keyClicks(text, QStringLiteral("nothing has such a text"));
    EXPECT_EQ(m_table->model()->rowCount(), 0);
    EXPECT_TRUE(m_table->accessibleDescription().contains(QStringLiteral("No incident matches the filter")));
    QTest::keyClick(text, Qt::Key_Escape);
    EXPECT_GT(m_table->model()->rowCount(), 0);
}

TEST_F(IncidentsPanelTest, SavesByTheEndingAndSaysWhatWentWrong) {
    const QTemporaryDir folder;
    EXPECT_EQ(m_panel.save(folder.filePath("events.json")), QString());
    QFile json(folder.filePath("events.json"));
    ASSERT_TRUE(json.open(QIODevice::ReadOnly));
    EXPECT_EQ(QJsonDocument::fromJson(json.readAll()).array().size(), m_table->model()->rowCount());
    EXPECT_EQ(m_panel.save(folder.filePath("events.csv")), QString());
    QFile csv(folder.filePath("events.csv"));
    ASSERT_TRUE(csv.open(QIODevice::ReadOnly));
    EXPECT_TRUE(csv.readAll().startsWith("number,severity"));
    EXPECT_TRUE(m_panel.save(folder.filePath("none/events.csv")).contains("cannot be written"));
}

TEST_F(IncidentsPanelTest, EveryControlIsReachedByTheKeyboardAndNamed) {
    for (const QToolButton* each : m_panel.findChildren<QToolButton*>()) {
        if (!each->objectName().isEmpty()) {
            EXPECT_NE(each->focusPolicy() & Qt::TabFocus, 0) << each->objectName().toStdString();
            EXPECT_FALSE(each->toolTip().isEmpty()) << each->objectName().toStdString();
        }
    }
}

TEST_F(IncidentsPanelTest, WhatHappenedHasRoomBeforeOtherColumns) {
    for (const int width : {480, 666, 900}) {
        m_panel.resize(width, 220);
        m_panel.refresh();
        EXPECT_GE(m_table->columnWidth(IncidentModel::kText),
                  m_table->fontMetrics().horizontalAdvance("11509 samples lost in 11293 gaps"))
            << width;
    }
}

TEST_F(IncidentsPanelTest, ANarrowDockScrollsNotSidewaysAndSaysWhatHappened) {
    for (const int width : {250, 310, 420}) {
        m_panel.resize(width, 220);
        m_panel.refresh();
        QTest::qWait(1); // sizes settle
        EXPECT_EQ(m_table->horizontalScrollBar()->maximum(), 0) << width;
        EXPECT_FALSE(m_table->isColumnHidden(IncidentModel::kText));
        EXPECT_GE(m_table->columnWidth(IncidentModel::kText),
                  m_table->fontMetrics().horizontalAdvance("3 samples lost"))
            << width;
    }
}

} // namespace

} // namespace posewire::gui
