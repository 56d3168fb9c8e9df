// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/joints_panel.h"

#include "app/gui/models/shown_character.h"
#include "tests/app/gui/panels/panel_stage.h"

#include <QCoreApplication>
#include <QImage>

#include <memory>

namespace posewire::gui {
namespace {

class JointsPanelTest : public testing::Test {
protected:
    void open(std::vector<std::uint8_t> types, int width = 560) {
        if (!types.empty()) {
            performer::Performer performer(sending(1, std::move(types)));
            m_stage.perform(performer, 0, 240);
        }
        m_panel = std::make_unique<JointsPanel>(m_stage.session, m_stage.commands, nullptr);
        m_panel->resize(width, 700);
        m_panel->show();
        refresh();
    }
    void refresh() {
        m_stage.follow();
        m_panel->refresh();
        QCoreApplication::processEvents();
    }
    /// Until the range of motion has been read.
    void refreshAll() {
        do {
            refresh();
        } while (m_panel->summary().contains("reading"));
    }
    TableView& table() { return *m_panel->findChildren<TableView*>()[0]; }
    TableView& detail() { return *m_panel->findChildren<TableView*>()[1]; }
    QModelIndex row(const QString& joint) {
        return table().model()->match(table().model()->index(0, 0), Qt::DisplayRole, joint).value(0);
    }

    PanelStage m_stage;
    std::unique_ptr<JointsPanel> m_panel;
};

TEST_F(JointsPanelTest, SaysWhatWouldBeNeeded) {
    open({12, 23});
    EXPECT_TRUE(table().accessibleDescription().contains("type 02"));
    EXPECT_TRUE(table().accessibleDescription().contains("type 20"));
    EXPECT_FALSE(detail().isVisible());
    EXPECT_EQ(m_panel->summary(), "");
}

TEST_F(JointsPanelTest, SaysWhereAnglesComeFromAndWhatTheRangesAreOf) {
    open({2, 20});
    refreshAll();
    EXPECT_EQ(m_panel->summary(), QStringLiteral("sent · computed from 02 · all, 1.0 s"));
    EXPECT_EQ(table().model()->rowCount(), 22);
    EXPECT_TRUE(detail().isVisible());
}

TEST_F(JointsPanelTest, SelectsTheSegmentOfARowAndTheRowOfASegment) {
    open({2, 20});
    table().setCurrentIndex(row("Left Knee"));
    EXPECT_EQ(m_stage.session.choices().selection.segment, model::segment::kLeftLowerLeg);
    EXPECT_EQ(m_stage.session.choices().selection.character, m_stage.key());
    m_stage.commands.select(selectionOf(m_stage.session, m_stage.key(), model::segment::kRightHand));
    refresh();
    EXPECT_EQ(table().currentIndex().row(), row("Right Wrist").row());
    EXPECT_EQ(detail().model()->index(1, 0).data(), "Radial / ulnar deviation");
    EXPECT_EQ(m_stage.session.choices().selection.segment, model::segment::kRightHand);
}

TEST_F(JointsPanelTest, SelectsNothingByItself) {
    open({2, 20});
    refreshAll();
    EXPECT_EQ(m_stage.session.choices().selection.segment, -1);
}

TEST_F(JointsPanelTest, ShowsTheMomentOfTheCursor) {
    open({2, 20});
    const auto knee = [&] { return row("Right Knee").siblingAtColumn(JointModel::kFlexion).data(); };
    const QVariant now = knee();
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 100});
    refresh();
    EXPECT_NE(knee(), now);
}

TEST_F(JointsPanelTest, PaintsABarForAnglesThatHaveAReferenceRange) {
    open({2, 20});
    refreshAll();
    const QImage picture = table().viewport()->grab().toImage();
    const auto coloured = [&](const QString& joint) {
        const QRect cell = table().visualRect(row(joint).siblingAtColumn(JointModel::kFlexion));
        int count = 0;
        for (int y = cell.top(); y <= cell.bottom(); ++y) {
            for (int x = cell.left(); x <= cell.right(); ++x) {
                count += picture.pixelColor(x, y) == theme().accent ? 1 : 0;
            }
        }
        return count;
    };
    EXPECT_GT(coloured("Right Knee"), 20) << "a walk bends the knee";
    EXPECT_EQ(coloured("L4 L3"), 0);
}

} // namespace
} // namespace posewire::gui
