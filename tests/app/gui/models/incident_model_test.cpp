// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/event_model.h"

#include "app/gui/models/display_filter.h"
#include "core/model/incidents/thresholds.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

namespace posewire::gui {

namespace {

class EventModelTest : public testing::Test {
protected:
    EventModelTest() {
        m_stage.session.setThresholds({0, 0, 0, 0, 0}); // limits would be events of their own
    }
    /// Frames of one stream; those from `lostFrom` to `lostTo` do not come.
    void perform(std::uint64_t from, std::uint64_t to, std::uint64_t lostFrom = 0, std::uint64_t lostTo = 0) {
        m_stage.perform(m_performer, from, to,
                        [=](std::uint64_t frame) { return frame < lostFrom || frame >= lostTo; });
        m_stage.follow();
        m_model.refresh();
    }
    [[nodiscard]] QString text(int row, int column) const {
        return m_model.index(row, column).data().toString();
    }
    [[nodiscard]] int rowOfKind(model::IncidentKind kind) const {
        for (int row = 0; row < m_model.rowCount(); ++row) {
            if (m_model.event(m_model.index(row, 0))->kind == kind) {
                return row;
            }
        }
        return -1;
    }

    Stage m_stage;
    performer::Performer m_performer{sending(1, {2}, 60.0)};
    EventModel m_model{m_stage.session};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(EventModelTest, SaysWhatHappenedWhoseItWasAndHowOften) {
    perform(0, 240, 60, 63);
    const int row = rowOfKind(model::IncidentKind::Loss);
    ASSERT_GE(row, 0);
    EXPECT_EQ(text(row, EventModel::kSeverity), QStringLiteral("▲ warning"));
    EXPECT_TRUE(text(row, EventModel::kText).startsWith(QStringLiteral("3 samples lost in 1 gap, cause: ")))
        << text(row, EventModel::kText).toStdString();
    EXPECT_TRUE(text(row, EventModel::kWho).endsWith(QStringLiteral(" · 02")));
    EXPECT_EQ(text(row, EventModel::kCount), "1");
    EXPECT_EQ(text(row, EventModel::kGroup), "Loss");
    EXPECT_GE(rowOfKind(model::IncidentKind::SourceUp), 0);
}

TEST_F(EventModelTest, AnEpisodeIsOneRowThatChanges) {
    perform(0, 120, 60, 61);
    const int rows = m_model.rowCount();
    const QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    const QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    perform(120, 240, 150, 152);
    EXPECT_EQ(m_model.rowCount(), rows);
    EXPECT_EQ(inserted.count(), 0);
    EXPECT_EQ(changed.count(), 1);
    EXPECT_EQ(text(rowOfKind(model::IncidentKind::Loss), EventModel::kCount), "2");
}

TEST_F(EventModelTest, NothingChangesWithoutNews) {
    perform(0, 120, 60, 61);
    const QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    m_model.refresh();
    EXPECT_EQ(changed.count(), 0);
}

TEST_F(EventModelTest, ListsOnlyWhatGoesOnIfAskedTo) {
    perform(0, 120, 60, 61);
    EventModel::Filter current;
    current.onlyCurrent = true;
    m_model.setFilter(current);
    EXPECT_GE(rowOfKind(model::IncidentKind::Loss), 0);
    perform(120, 900);
    EXPECT_EQ(rowOfKind(model::IncidentKind::Loss), -1);
    m_model.setFilter({});
    EXPECT_GE(rowOfKind(model::IncidentKind::Loss), 0);
    EXPECT_NE(text(rowOfKind(model::IncidentKind::Loss), EventModel::kLasted), "lasts");
}

TEST_F(EventModelTest, FiltersBySeverityGroupAndText) {
    perform(0, 240, 60, 63);
    EventModel::Filter filter;
    filter.severities = {false, true, true};
    m_model.setFilter(filter);
    EXPECT_EQ(rowOfKind(model::IncidentKind::SourceUp), -1);
    EXPECT_GE(rowOfKind(model::IncidentKind::Loss), 0);
    filter = {};
    filter.groups = {true, false, true, true};
    m_model.setFilter(filter);
    EXPECT_EQ(rowOfKind(model::IncidentKind::Loss), -1);
    EXPECT_GE(rowOfKind(model::IncidentKind::SourceUp), 0);
    filter = {};
    filter.text = QStringLiteral("SAMPLES LOST");
    m_model.setFilter(filter);
    EXPECT_EQ(m_model.rowCount(), 1);
}

TEST_F(EventModelTest, WhatWasSeenIsDimAndNoLongerNew) {
    perform(0, 240, 60, 63);
    EXPECT_EQ(m_model.counts().unseen, m_model.counts().all);
    m_model.markSeen();
    EXPECT_EQ(m_model.counts().unseen, 0U);
    EXPECT_TRUE(m_model.index(0, EventModel::kText).data(Qt::ForegroundRole).isValid());
    perform(240, 300);
    m_stage.sendBytes(std::vector<std::byte>(8, std::byte{'G'}), m_stage.now);
    m_stage.follow();
    m_model.refresh();
    EXPECT_EQ(m_model.counts().unseen, 1U);
    EXPECT_FALSE(m_model.index(m_model.rowCount() - 1, EventModel::kText).data(Qt::ForegroundRole).isValid());
}

TEST_F(EventModelTest, AGapLeadsToItsPackets) {
    perform(0, 240, 60, 63);
    const model::Incident* gap = m_model.event(m_model.index(rowOfKind(model::IncidentKind::Loss), 0));
    const QString filter = packetFilterOf(m_stage.session, *gap);
    EXPECT_TRUE(filter.startsWith(QStringLiteral("gap > 0 && type == 02 && character == 0")))
        << filter.toStdString();
    const auto packet = eventPacket(m_stage.session, *gap);
    ASSERT_TRUE(packet.has_value());
    EXPECT_EQ(m_stage.session.digests().find(*packet)->gap, 3U);
    EXPECT_TRUE(briefWords(*gap).startsWith(QStringLiteral("3 lost"))) << briefWords(*gap).toStdString();
}

TEST_F(EventModelTest, NamesACharacterThatTheSessionDoesNotKnowByItsId) {
    model::Incident event;
    event.sender = log::SenderId{77};
    event.parts.push_back({3, {}});
    EXPECT_EQ(whoseWords(m_stage.session, event), "Character 3");
    event.parts.front().type = 2;
    EXPECT_EQ(whoseWords(m_stage.session, event), "Character 3 · 02");
    event.parts.push_back({4, 2});
    EXPECT_EQ(whoseWords(m_stage.session, event), "2 characters · 02");
}

TEST_F(EventModelTest, WhatHasNoPacketLeadsToTheOneBefore) {
    perform(0, 60);
    m_stage.now += 3s;
    m_stage.follow();
    m_model.refresh();
    const int row = rowOfKind(model::IncidentKind::Outage);
    ASSERT_GE(row, 0);
    const model::Incident& event = *m_model.event(m_model.index(row, 0));
    EXPECT_EQ(eventPacket(m_stage.session, event), m_stage.session.end() - 1);
    EXPECT_TRUE(m_model.index(row, EventModel::kText).data().toString().startsWith("No data."));
}

} // namespace

} // namespace posewire::gui
