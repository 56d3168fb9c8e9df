// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/compare_panel.h"

#include "app/gui/models/comparison_text.h"
#include "tests/app/gui/models/recording_files.h"
#include "tests/app/gui/panels/panel_stage.h"
#include "tests/app/gui/panels/trigger.h"

#include <QAbstractItemModelTester>
#include <QDoubleSpinBox>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

namespace posewire::gui {
namespace {

using exporting::AlignBy;
using model::DifferenceFrame;

/// What is shown and a recording of the same without its end, with the head 10 mm and a hand 4 mm higher.
class ComparePanelTest : public testing::Test {
protected:
    void SetUp() override {
        m_stage.perform(m_performer, 0, 120);
        m_stage.follow();
        m_stage.playback.showMoment(Stage::kStart + 500ms);
    }
    void open(const QString& name) {
        const auto raised = [](wire::Datagram& datagram) {
            raise(datagram, model::segment::kHead, 0.010F);
            raise(datagram, model::segment::kLeftHand, 0.004F);
        };
        m_stage.comparing.open(recordFrames(m_folder.filePath(name), m_performer, 0, 115, raised));
    }
    void compare() {
        open("take-2.pcapng");
        settle();
    }
    /// Until all is worked out.
    void settle() {
        ASSERT_TRUE(QTest::qWaitFor([this] {
            m_stage.comparing.follow(10ms);
            return !state().isWorking && (state().range != nullptr || !state().problem.isEmpty());
        }));
        m_stage.comparing.follow(10ms); // to the moment that is shown
        m_panel.refresh();
    }
    [[nodiscard]] const ComparisonState& state() const { return m_stage.comparing.state(); }
    [[nodiscard]] const ComparisonChoice& choice() const { return state().choice; }
    [[nodiscard]] TableView& table() { return *m_panel.findChild<TableView*>(); }
    [[nodiscard]] QString cell(int row, int column) {
        return table().model()->index(row, column).data().toString();
    }
    [[nodiscard]] QString label(const char* name) { return m_panel.findChild<ElidedLabel*>(name)->text(); }
    [[nodiscard]] QString emptyText() { return m_panel.findChild<QLabel*>("emptyText")->text(); }
    void carryOut(std::string_view id) {
        trigger(m_panel, id);
        settle();
    }

    QTemporaryDir m_folder;
    performer::Performer m_performer{sending(1, {2, 12, 13}, 60)};
    PanelStage m_stage;
    ComparePanel m_panel{m_stage.session, m_stage.commands, m_stage.playback, m_stage.comparing, nullptr};
};

TEST_F(ComparePanelTest, SaysWhatToDoWhileNothingIsCompared) {
    m_panel.resize(400, 600);
    m_panel.show();
    EXPECT_TRUE(emptyText().contains("second recording"));
    EXPECT_FALSE(table().isVisible());
    const QSignalSpy asked(&m_stage.comparing, &Comparing::askForRecording);
    for (QToolButton* button : m_panel.findChildren<QToolButton*>()) {
        if (button->isVisible()) {
            button->click();
        }
    }
    EXPECT_EQ(asked.count(), 1);
}

TEST_F(ComparePanelTest, ListsSegmentsTheWorstFirst) {
    const QAbstractItemModelTester tester(table().model());
    m_panel.resize(700, 600);
    m_panel.show();
    compare();
    ASSERT_EQ(table().model()->rowCount(), 23);
    EXPECT_EQ(cell(0, DifferenceModel::kName), "Head");
    EXPECT_EQ(cell(0, DifferenceModel::kNow), "10.0");
    EXPECT_EQ(cell(0, DifferenceModel::kMost), "10.0");
    EXPECT_EQ(cell(0, DifferenceModel::kMeanTurn), "0.00");
    EXPECT_EQ(cell(1, DifferenceModel::kName), "Left Hand");
    table().sortByColumn(DifferenceModel::kName, Qt::AscendingOrder);
    EXPECT_EQ(cell(0, DifferenceModel::kName), "Pelvis");
    table().sortByColumn(DifferenceModel::kNow, Qt::DescendingOrder);
    EXPECT_EQ(cell(0, DifferenceModel::kName), "Head");
    m_panel.refresh();
    EXPECT_EQ(cell(0, DifferenceModel::kName), "Head") << "it stays sorted";
    m_stage.playback.goLive(); // the second one ends before
    m_panel.refresh();
    EXPECT_EQ(cell(0, DifferenceModel::kNow), "–");
    EXPECT_TRUE(label("counts").startsWith("No partner at this moment"));
}

TEST_F(ComparePanelTest, SumsUpTheRange) {
    compare();
    EXPECT_TRUE(label("figures").startsWith("Mean 0.6 mm, 0.00 ° · most in Head · "))
        << qPrintable(label("figures"));
    EXPECT_TRUE(label("figures").endsWith(" · median 0.0"));
    EXPECT_EQ(label("counts"), "115 pairs · 5 outside the common time");
    EXPECT_EQ(m_panel.summary(), "shown: 0.6 mm");
}

TEST_F(ComparePanelTest, ARowSelectsItsSegmentAndFollowsTheSelection) {
    compare();
    const int before = m_stage.asked.count;
    table().setCurrentIndex(table().model()->index(1, 0));
    EXPECT_EQ(m_stage.session.choices().selection.character, m_stage.key());
    EXPECT_EQ(m_stage.session.choices().selection.segment, model::segment::kLeftHand);
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(), model::segment::kHead});
    m_panel.refresh();
    EXPECT_EQ(table().currentIndex().row(), 0);
    EXPECT_EQ(m_stage.asked.count, before + 1);
}

TEST_F(ComparePanelTest, IsAlignedByMenuAndByHand) {
    compare();
    carryOut("nudgeLater");
    EXPECT_EQ(choice().by, AlignBy::TimeCode) << "as it is aligned by now";
    EXPECT_NEAR(choice().offset, 1000.0 / 60, 0.5);
    carryOut("alignBySample");
    EXPECT_EQ(choice().by, AlignBy::Sample);
    EXPECT_EQ(choice().offset, 0) << "it was in the unit of time codes";
    EXPECT_TRUE(isOn(m_panel, "alignBySample"));
    EXPECT_FALSE(isOn(m_panel, "alignAutomatically"));
    carryOut("nudgeLater");
    EXPECT_EQ(choice().offset, 1);
    carryOut("nudgeNone");
    EXPECT_EQ(choice().offset, 0);
    carryOut("alignAutomatically");
    EXPECT_FALSE(choice().by);
    auto* offset = m_panel.findChild<QDoubleSpinBox*>();
    offset->setValue(250);
    EXPECT_EQ(choice().offset, 250);
}

TEST_F(ComparePanelTest, KeepsHowBodiesAreLaidOver) {
    compare();
    carryOut("compareOnTheSpot");
    carryOut("compareBeside");
    const QJsonObject kept = m_panel.state();
    m_stage.comparing.choose({});
    m_panel.restoreState(kept);
    EXPECT_EQ(choice().frame, DifferenceFrame::Heading);
    EXPECT_TRUE(choice().isBeside);
    m_panel.restoreState({{"frame", 77}, {"beside", "x"}});
    EXPECT_NE(choice().frame, static_cast<DifferenceFrame>(77));
}

TEST_F(ComparePanelTest, SaysWhyNothingIsComparedAndHowFarItIs) {
    open("take-2.pcapng");
    m_panel.refresh();
    EXPECT_EQ(emptyText(), "take-2.pcapng is read: 0 %");
    m_stage.comparing.open(recordFrames(m_folder.filePath("names.pcapng"), m_performer, 0, 30,
                                        [](wire::Datagram& datagram) { datagram.body = wire::MetaData(); }));
    settle();
    EXPECT_FALSE(state().problem.isEmpty());
    EXPECT_EQ(emptyText(), state().problem);
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
    EXPECT_EQ(comparisonText(state), "compared with b.pcapng · Time code, +12.5 ms");
    state.alignment = exporting::Alignment{AlignBy::Sample, -1};
    EXPECT_EQ(comparisonText(state), "compared with b.pcapng · Sample counter, −1 sample");
}

TEST(ComparisonTextTest, SaysWhatWasNotCompared) {
    ComparisonState state;
    auto range = std::make_shared<exporting::MotionComparison>();
    range->pairs = 115;
    range->alone = 5;
    range->apart = 3;
    range->passedOver = 1'200;
    state.range = range;
    EXPECT_EQ(comparedText(state),
              QStringList({"115 pairs", "5 without a partner", "3 without a common segment",
                           "1 200 packets not looked at in time"}));
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
