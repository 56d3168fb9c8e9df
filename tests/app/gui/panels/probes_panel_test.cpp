// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/probes_panel.h"

#include "tests/app/gui/panels/panel_stage.h"

#include <gtest/gtest.h>

#include <chrono>

namespace posewire::gui {
namespace {

using namespace std::chrono_literals;

class ProbesPanelTest : public testing::Test {
protected:
    static stage::ProbeState probe(const std::string& name) {
        stage::ProbeState probe;
        probe.name = name;
        probe.isAlive = true;
        return probe;
    }
    void show(std::vector<stage::ProbeState> probes) {
        m_stage.receiving.probes = std::move(probes);
        m_panel.refresh();
    }
    [[nodiscard]] QVariant cell(int row, ProbeModel::Column column, int role = Qt::DisplayRole) const {
        return m_table->model()->index(row, column).data(role);
    }

    PanelStage m_stage;
    ProbesPanel m_panel{m_stage.session, m_stage.commands, m_stage.receiving, nullptr};
    TableView* m_table = m_panel.findChild<TableView*>();
};

TEST_F(ProbesPanelTest, SaysWhatToDoOrWhatIsWrongWhereThereIsNone) {
    show({});
    EXPECT_TRUE(m_table->accessibleDescription().contains("--nats"));
    EXPECT_EQ(m_panel.summary(), "");
    m_stage.receiving.stageProblem = "nats://stage: no server answers there";
    show({});
    EXPECT_EQ(m_table->accessibleDescription(), m_stage.receiving.stageProblem);
}

TEST_F(ProbesPanelTest, TellsWhoIsAliveAndWhoIsNot) {
    stage::ProbeState silent = probe("STAGE-B");
    silent.isAlive = false;
    stage::ProbeState behind = probe("STAGE-C");
    behind.spoolBytes = 2'500'000;
    stage::ProbeState twin = probe("STAGE-D");
    twin.problem = "two probes of this name publish at the same time";
    show({probe("STAGE-A"), silent, behind, twin});
    EXPECT_EQ(m_panel.summary(), "3 of 4 alive");
    EXPECT_EQ(cell(0, ProbeModel::kState), "● alive");
    EXPECT_EQ(cell(1, ProbeModel::kState), "■ silent");
    EXPECT_EQ(cell(2, ProbeModel::kState), "▲ catching up");
    EXPECT_EQ(cell(2, ProbeModel::kSpool), "2.5 MB");
    EXPECT_TRUE(cell(3, ProbeModel::kState).toString().endsWith(QString::fromStdString(twin.problem)));
}

TEST_F(ProbesPanelTest, ShowsWhatWasLostThereAndOnTheWayAndTheClock) {
    stage::ProbeState one = probe("STAGE-A");
    one.kernelDropped = 12;
    one.lostOnWay = 3;
    one.rateHz = 960.4;
    one.ahead = -1'234us;
    one.uncertainty = 250us;
    show({one, probe("STAGE-B")});
    EXPECT_EQ(cell(0, ProbeModel::kDropped), "■ 12");
    EXPECT_EQ(cell(0, ProbeModel::kLostOnWay), "▲ 3");
    EXPECT_EQ(cell(0, ProbeModel::kRate), "960");
    EXPECT_EQ(cell(0, ProbeModel::kClock), "−1.2 ± 0.2 ms");
    EXPECT_EQ(cell(1, ProbeModel::kDropped), "0");
    EXPECT_EQ(cell(1, ProbeModel::kClock), "–");
}

} // namespace
} // namespace posewire::gui
