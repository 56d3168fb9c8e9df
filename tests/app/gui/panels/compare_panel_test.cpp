// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/compare_panel.h"

#include "app/gui/models/comparison_text.h"
#include "tests/app/gui/models/stage.h"
#include "tests/app/gui/panels/trigger.h"

#include <QAbstractItemModelTester>
#include <QDoubleSpinBox>
#include <QTest>

namespace posewire::gui {
namespace {

using exporting::AlignBy;
using model::DifferenceFrame;

/// What is shown and a second recording of the same, with the head 10 mm higher; both at a moment.
class ComparePanelTest : public testing::Test {
protected:
    void SetUp() override {
        performer::Performer performer(sending(1, {2, 12, 13}, 60));
        m_stage.perform(performer, 0, 120);
        m_stage.follow();
        m_second.perform(performer, 0, 120);
        m_second.follow();
    }
    void compare() {
        ComparisonState& state = m_stage.program.compared;
        state.isOpen = true;
        state.name = "take-2.pcapng";
        state.second = &m_second.session;
        state.pair.emplace(m_stage.key(), m_second.key());
        state.alignment = exporting::Alignment{AlignBy::TimeCode, 0};
        state.step = 1000.0 / 60;
        state.atCursor.emplace();
        model::CharacterPose moved = *m_second.session.pose(m_second.key());
        moved.segments[model::segment::kHead].position.z() += 0.010;
        moved.segments[model::segment::kLeftHand].position.z() += 0.004;
        ASSERT_TRUE(model::differenceOf(*m_stage.session.pose(m_stage.key()), moved, DifferenceFrame::World,
                                        *state.atCursor));
        auto range = std::make_shared<exporting::MotionComparison>();
        range->pairs = 115;
        range->alone = 5;
        for (const model::SegmentDifference& one : state.atCursor->segments) {
            range->segments.push_back({one.slot, 115, {one.millimetres, 1, 2, 30, m_stage.now}, {0.5}});
        }
        range->all = {-1, 115, {0.6, 0.1, 9.9, 30, m_stage.now}, {0.5}};
        range->course.begin = Stage::kStart;
        range->course.length = 33ms;
        for (auto* all : {&range->course.millimetres, &range->course.degrees}) {
            (*all)[exporting::DifferenceCourse::kMean].assign(60, 1.0F);
            (*all)[model::segment::kHead].assign(60, 2.0F);
        }
        state.range = range;
        m_panel.refresh();
    }
    [[nodiscard]] TableView& table() { return *m_panel.findChild<TableView*>(); }
    [[nodiscard]] QString cell(int row, int column) {
        return table().model()->index(row, column).data().toString();
    }
    [[nodiscard]] QString label(const char* name) { return m_panel.findChild<ElidedLabel*>(name)->text(); }
    [[nodiscard]] QString emptyText() { return m_panel.findChild<QLabel*>("emptyText")->text(); }
    void carryOut(std::string_view id) {
        trigger(m_panel, id);
        m_stage.program.compared.choice = m_stage.commands.comparison;
        m_panel.refresh();
    }

    Stage m_stage;
    Stage m_second;
    ComparePanel m_panel{m_stage.session, m_stage.commands, m_stage.program, nullptr};
};

TEST_F(ComparePanelTest, SaysWhatToDoWhileNothingIsCompared) {
    m_panel.resize(400, 600);
    m_panel.show();
    EXPECT_TRUE(emptyText().contains("second recording"));
    EXPECT_FALSE(table().isVisible());
    for (QToolButton* button : m_panel.findChildren<QToolButton*>()) {
        if (button->isVisible()) {
            button->click();
        }
    }
    EXPECT_EQ(m_stage.commands.comparisonsAskedFor, 1);
}

TEST_F(ComparePanelTest, ListsSegmentsTheWorstFirst) {
    const QAbstractItemModelTester tester(table().model());
    m_panel.resize(700, 600);
    m_panel.show();
    compare();
    ASSERT_EQ(table().model()->rowCount(), 23);
    EXPECT_EQ(cell(0, DifferenceModel::kName), "Head");
    EXPECT_EQ(cell(0, DifferenceModel::kNow), "10.0");
    EXPECT_EQ(cell(0, DifferenceModel::kMost), "30.0");
    EXPECT_EQ(cell(0, DifferenceModel::kMeanTurn), "0.50");
    EXPECT_EQ(cell(1, DifferenceModel::kName), "Left Hand");
    table().sortByColumn(DifferenceModel::kName, Qt::AscendingOrder);
    EXPECT_EQ(cell(0, DifferenceModel::kName), "Pelvis");
    table().sortByColumn(DifferenceModel::kNow, Qt::DescendingOrder);
    EXPECT_EQ(cell(0, DifferenceModel::kName), "Head");
    m_panel.refresh();
    EXPECT_EQ(cell(0, DifferenceModel::kName), "Head") << "it stays sorted";
    m_stage.program.compared.atCursor.reset();
    m_panel.refresh();
    EXPECT_EQ(cell(0, DifferenceModel::kNow), "–");
    EXPECT_TRUE(label("counts").startsWith("No partner at this moment"));
}

TEST_F(ComparePanelTest, TellsWhatWasNotCompared) {
    compare();
    auto range = std::make_shared<exporting::MotionComparison>(*m_stage.program.compared.range);
    range->apart = 3;
    range->passedOver = 1'200;
    m_stage.program.compared.range = range;
    m_panel.refresh();
    EXPECT_TRUE(label("counts").endsWith("5 without a partner · 3 without a common segment · "
                                         "1 200 packets not looked at in time"))
        << qPrintable(label("counts"));
}

TEST_F(ComparePanelTest, SumsUpTheRange) {
    compare();
    EXPECT_TRUE(label("figures").startsWith("Mean 0.6 mm, 0.50 ° · median 0.1 · 95 % below 9.9"));
    EXPECT_TRUE(label("figures").endsWith("most in Head"));
    EXPECT_EQ(label("counts"), "115 pairs · 5 without a partner");
    EXPECT_EQ(m_panel.summary(), "now 0.6 mm");
}

TEST_F(ComparePanelTest, ARowSelectsItsSegmentAndFollowsTheSelection) {
    compare();
    table().setCurrentIndex(table().model()->index(1, 0));
    EXPECT_EQ(m_stage.session.selection().character, m_stage.key());
    EXPECT_EQ(m_stage.session.selection().segment, model::segment::kLeftHand);
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(), model::segment::kHead});
    m_panel.refresh();
    EXPECT_EQ(table().currentIndex().row(), 0);
    EXPECT_EQ(m_stage.commands.selections, 1);
}

TEST_F(ComparePanelTest, IsAlignedByMenuAndByHand) {
    compare();
    carryOut("alignBySample");
    EXPECT_EQ(m_stage.commands.comparison.by, AlignBy::Sample);
    EXPECT_TRUE(isOn(m_panel, "alignBySample"));
    EXPECT_FALSE(isOn(m_panel, "alignAutomatically"));
    carryOut("nudgeLater");
    EXPECT_EQ(m_stage.commands.comparison.by, AlignBy::TimeCode) << "as it is aligned by now";
    EXPECT_NEAR(m_stage.commands.comparison.offset, 1000.0 / 60, 1e-9);
    carryOut("nudgeNone");
    EXPECT_EQ(m_stage.commands.comparison.offset, 0);
    carryOut("alignAutomatically");
    EXPECT_FALSE(m_stage.commands.comparison.by);
    auto* offset = m_panel.findChild<QDoubleSpinBox*>();
    offset->setValue(250);
    EXPECT_EQ(m_stage.commands.comparison.offset, 250);
}

TEST_F(ComparePanelTest, KeepsHowBodiesAreLaidOver) {
    compare();
    carryOut("compareOnTheSpot");
    carryOut("compareBeside");
    const QJsonObject kept = m_panel.state();
    m_stage.program.compared.choice = m_stage.commands.comparison = {};
    m_panel.restoreState(kept);
    EXPECT_EQ(m_stage.commands.comparison.frame, DifferenceFrame::Heading);
    EXPECT_TRUE(m_stage.commands.comparison.isBeside);
    m_panel.restoreState({{"frame", 77}, {"beside", "x"}});
    EXPECT_NE(m_stage.commands.comparison.frame, static_cast<DifferenceFrame>(77));
}

TEST_F(ComparePanelTest, SaysWhyNothingIsComparedAndHowFarItIs) {
    ComparisonState& state = m_stage.program.compared;
    state.isOpen = true;
    state.name = "take-2.pcapng";
    state.isWorking = true;
    state.share = 0.43;
    m_panel.refresh();
    EXPECT_EQ(emptyText(), "take-2.pcapng is read: 43 %");
    state.isWorking = false;
    state.problem = "There is no character in take-2.pcapng.";
    m_panel.refresh();
    EXPECT_EQ(emptyText(), state.problem);
}

TEST_F(ComparePanelTest, AClickIntoThePlotShowsThatMoment) {
    m_panel.resize(700, 700);
    m_panel.show();
    compare();
    auto* plot = m_panel.findChild<TimePlot*>();
    emit plot->momentPicked(1.0);
    EXPECT_NEAR(log::secondsOf(m_stage.session.cursorStamp() - Stage::kStart), 1, 0.02);
}

TEST(ComparisonTextTest, SaysWithWhatAndHow) {
    ComparisonState state;
    EXPECT_EQ(comparisonText(state), "");
    state.isOpen = true;
    state.name = "b.pcapng";
    EXPECT_EQ(comparisonText(state), "compared with b.pcapng");
    state.alignment = exporting::Alignment{AlignBy::TimeCode, 12.5};
    EXPECT_EQ(comparisonText(state), "compared with b.pcapng by time code, +12.5 ms");
    state.alignment = exporting::Alignment{AlignBy::Sample, -1};
    EXPECT_EQ(comparisonText(state), "compared with b.pcapng by sample counter, −1 sample");
}

TEST(ComparisonTextTest, TheScaleOfColoursIsARoundNumber) {
    ComparisonState state;
    EXPECT_EQ(scaleOf(state).full, 1);
    auto range = std::make_shared<exporting::MotionComparison>();
    range->all.millimetres.p95 = 34;
    state.range = range;
    EXPECT_EQ(scaleOf(state).full, 50);
    EXPECT_EQ(scaleOf(state).colourOf(0), theme().good);
    EXPECT_EQ(scaleOf(state).colourOf(80), theme().error);
    EXPECT_EQ(scaleOf(state).colourOf(25), theme().warning);
}

} // namespace
} // namespace posewire::gui
