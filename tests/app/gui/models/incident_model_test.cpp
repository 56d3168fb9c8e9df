// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/incident_model.h"

#include "app/gui/models/display_filter.h"
#include "app/gui/models/shown_character.h"
#include "core/model/incidents/thresholds.h"
#include "core/model/session/accounts.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

namespace posewire::gui {

namespace {

class IncidentModelTest : public testing::Test {
protected:
    IncidentModelTest() {
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
            if (m_model.line(m_model.index(row, 0))->incident().kind == kind) {
                return row;
            }
        }
        return -1;
    }

    Stage m_stage;
    performer::Performer m_performer{sending(1, {2}, 60.0)};
    IncidentModel m_model{m_stage.session};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(IncidentModelTest, SaysWhatHappenedWhoseItWasAndHowOften) {
    perform(0, 240, 60, 63);
    const int row = rowOfKind(model::IncidentKind::Loss);
    ASSERT_GE(row, 0);
    EXPECT_EQ(text(row, IncidentModel::kSeverity), QStringLiteral("▲ warning"));
    EXPECT_TRUE(
        text(row, IncidentModel::kText).startsWith(QStringLiteral("3 samples lost in 1 gap, cause: ")))
        << text(row, IncidentModel::kText).toStdString();
    EXPECT_TRUE(text(row, IncidentModel::kWho).endsWith(QStringLiteral(" · 02")));
    EXPECT_EQ(text(row, IncidentModel::kCount), "1");
    EXPECT_EQ(text(row, IncidentModel::kGroup), "Loss");
    EXPECT_GE(rowOfKind(model::IncidentKind::SourceUp), 0);
}

TEST_F(IncidentModelTest, AnEpisodeIsOneRowThatChanges) {
    perform(0, 120, 60, 61);
    const int rows = m_model.rowCount();
    const QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    const QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    perform(120, 240, 150, 152);
    EXPECT_EQ(m_model.rowCount(), rows);
    EXPECT_EQ(inserted.count(), 0);
    EXPECT_EQ(changed.count(), 1);
    EXPECT_EQ(text(rowOfKind(model::IncidentKind::Loss), IncidentModel::kCount), "2");
}

TEST_F(IncidentModelTest, NothingChangesWithoutNews) {
    perform(0, 120, 60, 61);
    const QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    m_model.refresh();
    EXPECT_EQ(changed.count(), 0);
}

TEST_F(IncidentModelTest, ListsOnlyWhatGoesOnIfAskedTo) {
    perform(0, 120, 60, 61);
    IncidentModel::Filter current;
    current.onlyCurrent = true;
    m_model.setFilter(current);
    EXPECT_GE(rowOfKind(model::IncidentKind::Loss), 0);
    perform(120, 900);
    EXPECT_EQ(rowOfKind(model::IncidentKind::Loss), -1);
    m_model.setFilter({});
    EXPECT_GE(rowOfKind(model::IncidentKind::Loss), 0);
    EXPECT_NE(text(rowOfKind(model::IncidentKind::Loss), IncidentModel::kLasted), "going on");
}

TEST_F(IncidentModelTest, FiltersBySeverityGroupAndText) {
    perform(0, 240, 60, 63);
    IncidentModel::Filter filter;
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

TEST_F(IncidentModelTest, WhatWasSeenIsDimAndNoLongerNew) {
    perform(0, 240, 60, 63);
    EXPECT_EQ(m_model.counts().unseen, m_model.counts().all);
    m_model.markSeen();
    EXPECT_EQ(m_model.counts().unseen, 0U);
    EXPECT_TRUE(m_model.index(0, IncidentModel::kText).data(Qt::ForegroundRole).isValid());
    perform(240, 300);
    m_stage.sendBytes(std::vector<std::byte>(8, std::byte{'G'}), m_stage.now);
    m_stage.follow();
    m_model.refresh();
    EXPECT_EQ(m_model.counts().unseen, 1U);
    EXPECT_FALSE(
        m_model.index(m_model.rowCount() - 1, IncidentModel::kText).data(Qt::ForegroundRole).isValid());
}

TEST_F(IncidentModelTest, AGapLeadsToItsPackets) {
    perform(0, 240, 60, 63);
    const model::Incident* gap =
        m_model.line(m_model.index(rowOfKind(model::IncidentKind::Loss), 0))->settled;
    const QString filter = packetFilterOf(m_stage.session, *gap);
    EXPECT_TRUE(filter.startsWith(QStringLiteral("gap > 0 && type == 02 && character == 0")))
        << filter.toStdString();
    const auto packet = incidentPacket(m_stage.session, *gap);
    ASSERT_TRUE(packet.has_value());
    EXPECT_EQ(m_stage.session.accounts().digests().find(*packet)->gap, 3U);
}

TEST_F(IncidentModelTest, NamesACharacterThatTheSessionDoesNotKnowByItsId) {
    model::Incident event;
    event.sender = log::SenderId{77};
    event.parts.push_back({event.sender, 3, {}});
    EXPECT_EQ(whoseWords(m_stage.session, event), "Character 3");
    event.parts.front().type = 2;
    EXPECT_EQ(whoseWords(m_stage.session, event), "Character 3 · 02");
    event.parts.push_back({event.sender, 4, 2});
    EXPECT_EQ(whoseWords(m_stage.session, event), "2 characters · 02");
}

TEST_F(IncidentModelTest, SaysOfWhichSenderItIsWhereTwoSendTheSame) {
    performer::Performer two(sending(2, {2, 12}, 60.0));
    for (std::uint64_t frame = 0; frame < 240; ++frame) {
        for (const wire::Datagram& datagram : two.frame(frame)) {
            for (const char* address : {"10.0.0.1:1000", "10.0.0.1:2000"}) {
                const bool isLost = frame > 100 && frame % 20 == 0 && address[9] == '2';
                if (!isLost) {
                    m_stage.send(datagram, m_stage.now + 4ms, address);
                }
            }
        }
    }
    m_stage.follow();
    m_model.refresh();
    const int loss = rowOfKind(model::IncidentKind::Loss);
    ASSERT_GE(loss, 0);
    EXPECT_EQ(text(loss, IncidentModel::kWho), QString::fromUtf8("2 characters · :2000 · 02"));
    const int conflict = rowOfKind(model::IncidentKind::Conflict);
    ASSERT_GE(conflict, 0);
    EXPECT_TRUE(text(conflict, IncidentModel::kWho).contains(QString::fromUtf8(" · 0 · :")))
        << text(conflict, IncidentModel::kWho).toStdString();
    EXPECT_TRUE(m_model.index(conflict, IncidentModel::kText)
                    .data(kShortTextRole)
                    .toString()
                    .startsWith("Also from port "));
}

TEST_F(IncidentModelTest, OneOutageIsOneRowThatOpensToItsStreams) {
    performer::Performer performer(sending(4, {2, 20, 21}, 60.0));
    m_stage.perform(performer, 0, 600, [](std::uint64_t frame) { return frame < 240 || frame >= 330; });
    m_stage.follow();
    m_model.refresh();
    const int row = rowOfKind(model::IncidentKind::Outage);
    ASSERT_GE(row, 0);
    EXPECT_EQ(rowOfKind(model::IncidentKind::Loss), -1);
    const QModelIndex outage = m_model.index(row, 0);
    ASSERT_EQ(m_model.rowCount(outage), 12);
    const auto below = [&](int part, int column) {
        return m_model.index(part, column, outage).data().toString();
    };
    EXPECT_EQ(below(0, IncidentModel::kWho), characterName(m_stage.session, m_stage.key(0)));
    EXPECT_EQ(below(0, IncidentModel::kText), "02 Pose, quaternion: 90 samples lost");
    EXPECT_EQ(below(11, IncidentModel::kLost), "90");
    EXPECT_EQ(text(row, IncidentModel::kLost).remove(QChar(0x202f)), "1080");
    EXPECT_EQ(m_model.index(0, 0, outage).parent(), outage);
}

TEST_F(IncidentModelTest, SaysInFewWordsTooWhatHasACauseAndNoFigures) {
    performer::Performer performer(sending(1, {2, 21}, 60.0));
    for (std::uint64_t frame = 0; frame < 600; ++frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            if (frame < 300 || datagram.header.type() != 21) {
                m_stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / 60));
            }
        }
    }
    m_stage.follow();
    m_model.refresh();
    const int row = rowOfKind(model::IncidentKind::Step);
    ASSERT_GE(row, 0);
    EXPECT_TRUE(m_model.index(row, IncidentModel::kText)
                    .data(kShortTextRole)
                    .toString()
                    .startsWith("Type 21 is no longer sent"));
}

TEST_F(IncidentModelTest, WhatIsOfOneStreamIsOneRow) {
    perform(0, 240, 60, 63);
    EXPECT_EQ(m_model.rowCount(m_model.index(rowOfKind(model::IncidentKind::Loss), 0)), 0);
}

TEST_F(IncidentModelTest, WhatIsNotHereYetIsProvisionalAndThenSettledInItsPlace) {
    perform(0, 120);
    EXPECT_EQ(rowOfKind(model::IncidentKind::Loss), -1);
    perform(125, 126);
    const int row = rowOfKind(model::IncidentKind::Loss);
    ASSERT_GE(row, 0);
    EXPECT_EQ(text(row, IncidentModel::kSeverity), "provisional");
    EXPECT_TRUE(text(row, IncidentModel::kText).startsWith("5 samples of ")) << text(row, 3).toStdString();
    EXPECT_TRUE(text(row, IncidentModel::kText).endsWith(" not yet here"));
    EXPECT_EQ(text(row, IncidentModel::kLost), "") << "nothing is lost for good";
    const QPersistentModelIndex kept(m_model.index(row, 0));
    const QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    const QSignalSpy removed(&m_model, &QAbstractItemModel::rowsRemoved);
    perform(126, 200);
    EXPECT_EQ(inserted.count() + removed.count(), 0);
    ASSERT_TRUE(kept.isValid());
    EXPECT_EQ(text(kept.row(), IncidentModel::kLost), "5");
    EXPECT_TRUE(text(kept.row(), IncidentModel::kText).startsWith("5 samples lost in 1 gap"));
}

TEST_F(IncidentModelTest, MoreThatIsNotHereYetIsToldInTheRowOfTheLossThatGoesOn) {
    perform(0, 240, 100, 103);
    const int rows = m_model.rowCount();
    perform(245, 246);
    EXPECT_EQ(m_model.rowCount(), rows);
    const QString words = text(rowOfKind(model::IncidentKind::Loss), IncidentModel::kText);
    EXPECT_TRUE(words.endsWith(" 5 not yet here")) << words.toStdString();
    EXPECT_EQ(text(rowOfKind(model::IncidentKind::Loss), IncidentModel::kLost), "3");
}

TEST_F(IncidentModelTest, NotesAreListedWithTheIncidents) {
    perform(0, 240, 60, 63);
    const int row = rowOfKind(model::IncidentKind::SourceUp);
    ASSERT_GE(row, 0);
    EXPECT_TRUE(text(row, IncidentModel::kSeverity).endsWith("note"));
}

TEST_F(IncidentModelTest, WhatHasNoPacketLeadsToTheOneBefore) {
    perform(0, 60);
    m_stage.now += 3s;
    m_stage.follow();
    m_model.refresh();
    const int row = rowOfKind(model::IncidentKind::Outage);
    ASSERT_GE(row, 0);
    const model::Incident& event = *m_model.line(m_model.index(row, 0))->settled;
    EXPECT_EQ(incidentPacket(m_stage.session, event), m_stage.session.end() - 1);
    EXPECT_TRUE(m_model.index(row, IncidentModel::kText).data().toString().startsWith("No data."));
}

} // namespace

} // namespace posewire::gui
