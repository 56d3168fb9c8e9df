// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/nullpose_panel.h"

#include "tests/app/gui/models/stage.h"

#include <QAction>
#include <QFile>
#include <QMenu>
#include <QScrollBar>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTest>

#include <memory>

namespace posewire::gui {

namespace {

class NullPosePanelTest : public testing::Test {
protected:
    void send(log::Stamp stamp = Stage::kStart, const std::function<void(wire::NullPose&)>& change = {}) {
        performer::Performer performer(sending(1, {2, 12, 13}));
        for (wire::Datagram datagram : performer.frame(0)) {
            auto* part = std::get_if<wire::NullPose>(&datagram.body);
            if (part != nullptr && change) {
                change(*part);
                wire::completeHeader(datagram, wire::HeaderEra::Counted);
            }
            m_stage.send(datagram, stamp);
        }
    }
    void open(const QSize& size = {600, 800}) {
        m_panel = std::make_unique<NullPosePanel>(m_stage.session, m_stage.commands, nullptr);
        m_panel->resize(size);
        m_panel->show();
        refresh();
        refresh(); // sizes settle
    }
    void refresh() {
        m_stage.follow();
        m_panel->refresh();
        QApplication::processEvents();
    }
    TableView* table(const QString& name) {
        for (TableView* view : m_panel->findChildren<TableView*>()) {
            if (view->accessibleName().startsWith(name)) {
                return view;
            }
        }
        return nullptr;
    }
    NullPoseFigure* figure() { return m_panel->findChild<NullPoseFigure*>(); }
    int selectedSegment() const { return m_stage.session.choices().selection.segment; }

    Stage m_stage;
    std::unique_ptr<NullPosePanel> m_panel;
};

TEST_F(NullPosePanelTest, SaysWhatANullPoseIsWhereThereIsNone) {
    open();
    EXPECT_TRUE(table("Segments")->accessibleDescription().contains("T-pose"));
    EXPECT_EQ(m_panel->summary(), "");
    m_stage.send(smallPose(), 1, 1, Stage::kStart);
    refresh();
    EXPECT_TRUE(table("Segments")->accessibleDescription().contains("Network Streamer"));
    EXPECT_FALSE(figure()->isVisible());
}

TEST_F(NullPosePanelTest, ARowSelectsItsSegmentEverywhereAndBack) {
    send();
    open();
    TableView* view = table("Segments");
    view->setCurrentIndex(view->model()->index(9, 0));
    EXPECT_EQ(selectedSegment(), 9);
    EXPECT_EQ(figure()->accessibleDescription(), "10 Right Forearm");
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(), 3, {}});
    const int asked = m_stage.asked.count;
    refresh();
    EXPECT_EQ(view->currentIndex().row(), 3);
    EXPECT_EQ(m_stage.asked.count, asked);
}

TEST_F(NullPosePanelTest, PickingInTheFigureSelectsSegmentsAndPoints) {
    send();
    open();
    QTest::mouseClick(figure(), Qt::LeftButton, {}, figure()->placeOfSegment(14).toPoint());
    refresh();
    EXPECT_EQ(selectedSegment(), 14);
    EXPECT_EQ(table("Segments")->currentIndex().row(), 14);
    // 11.2 pRightTopOfHand lies apart from everything.
    const auto* points = table("Points")->model();
    int row = 0;
    while (points->index(row, NullPosePointModel::kName).data().toString() != "pRightTopOfHand") {
        ++row;
    }
    QTest::mouseClick(figure(), Qt::LeftButton, {}, figure()->placeOfPoint(row).toPoint());
    refresh();
    EXPECT_EQ(table("Points")->currentIndex().row(), row);
    EXPECT_EQ(selectedSegment(), 10);
    EXPECT_EQ(figure()->accessibleDescription(), "11.2 pRightTopOfHand");
}

TEST_F(NullPosePanelTest, APointOfTheTableIsNamedInTheFigureUntilAnotherSegmentIsSelected) {
    send();
    open();
    TableView* view = table("Points");
    view->setCurrentIndex(view->model()->index(12, 0));
    refresh();
    EXPECT_EQ(figure()->accessibleDescription(), "1.13 pSacrum");
    EXPECT_EQ(selectedSegment(), 0);
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(), 6, {}});
    refresh();
    EXPECT_EQ(figure()->accessibleDescription(), "7 Head");
    EXPECT_FALSE(view->currentIndex().isValid());
}

TEST_F(NullPosePanelTest, ArrowKeysMoveThroughTheFigure) {
    send();
    open();
    figure()->setFocus();
    QTest::keyClick(figure(), Qt::Key_Right);
    QTest::keyClick(figure(), Qt::Key_Right);
    refresh();
    EXPECT_EQ(selectedSegment(), 1);
    QTest::keyClick(figure(), Qt::Key_Left);
    EXPECT_EQ(selectedSegment(), 0);
}

TEST_F(NullPosePanelTest, ContradictionsStandAtTheTopAndAreCounted) {
    send(Stage::kStart, [](wire::NullPose& part) {
        if (!part.segments.empty()) {
            part.segments[3].name = "Chest";
            part.segments[5].name = "Pelvis";
        }
    });
    open();
    auto* notices = m_panel->findChild<NullPoseNotices*>();
    EXPECT_TRUE(notices->isVisible());
    EXPECT_TRUE(notices->toPlainText().contains("\"Pelvis\" occurs twice"));
    EXPECT_TRUE(m_panel->summary().contains("1 error · 2 warnings")) << m_panel->summary().toStdString();
    send(Stage::kStart + 1s);
    refresh();
    EXPECT_FALSE(notices->toPlainText().contains("occurs twice"));
}

TEST_F(NullPosePanelTest, GhostButtonAsksForTheGhostAndShowsItsState) {
    send();
    open();
    QToolButton* ghost = nullptr;
    for (QToolButton* button : m_panel->findChildren<QToolButton*>()) {
        ghost = button->text() == "Ghost" ? button : ghost;
    }
    ASSERT_NE(ghost, nullptr);
    EXPECT_NE(ghost->focusPolicy() & Qt::TabFocus, 0);
    ghost->click();
    EXPECT_TRUE(m_stage.session.choices().isGhostShown);
    m_stage.session.setGhostShown(false);
    refresh();
    EXPECT_FALSE(ghost->isChecked());
}

TEST_F(NullPosePanelTest, SavesCsvAndJsonByTheNameOfTheFile) {
    send();
    open();
    const QTemporaryDir folder;
    for (const auto& [name, begin] :
         {std::pair{"a.csv", "kind,segment"}, std::pair{"a.json", "{\n  \"character\""}}) {
        const QString path = folder.filePath(name);
        EXPECT_EQ(m_panel->save(path), "");
        QFile file(path);
        ASSERT_TRUE(file.open(QIODevice::ReadOnly));
        EXPECT_TRUE(file.readAll().startsWith(begin)) << name;
    }
    EXPECT_NE(m_panel->save(folder.filePath("no/such/folder.csv")), "");
}

TEST_F(NullPosePanelTest, LowDocksHaveTheFigureAsATab) {
    send();
    open({420, 260});
    auto* tabs = m_panel->findChild<QTabWidget*>();
    EXPECT_EQ(tabs->tabText(0), "Figure");
    tabs->setCurrentIndex(0);
    refresh();
    EXPECT_TRUE(figure()->isVisible());
    m_panel->resize(420, 900);
    refresh();
    EXPECT_NE(tabs->tabText(0), "Figure");
    EXPECT_TRUE(figure()->isVisible());
}

TEST_F(NullPosePanelTest, PaintsPosesOfAnySize) {
    for (const float factor : {0.0F, 1e-30F, 1e30F, -100.0F, std::numeric_limits<float>::quiet_NaN()}) {
        send(m_stage.now + 1s, [factor](wire::NullPose& part) {
            for (wire::NullPoseSegment& segment : part.segments) {
                segment.position[2] *= factor;
                segment.position[1] *= factor;
            }
        });
        open();
        EXPECT_FALSE(figure()->grab().isNull());
    }
}

TEST_F(NullPosePanelTest, ANarrowDockShowsEveryCoordinateWhole) {
    send();
    open({345, 330});
    for (const char* name : {"Segments", "Points"}) {
        TableView* view = table(name);
        auto* tabs = m_panel->findChild<QTabWidget*>();
        tabs->setCurrentWidget(view);
        refresh();
        ASSERT_GT(view->verticalScrollBar()->maximum(), 0);
        EXPECT_EQ(view->horizontalScrollBar()->maximum(), 0) << name;
        const QRect last = view->visualRect(view->model()->index(0, NullPoseSegmentModel::kZ));
        EXPECT_LE(last.right(), view->viewport()->rect().right()) << name;
        EXPECT_GE(last.width(), QFontMetrics(tabularFont()).horizontalAdvance("−9.9999")) << name;
    }
}

} // namespace

} // namespace posewire::gui
