// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/character_model.h"

#include "app/gui/theme/character_mark.h"

#include "app/gui/models/column.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/shown_character.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

namespace posewire::gui {

namespace {

using Column = CharacterModel::Column;

class CharacterModelTest : public testing::Test {
protected:
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    QString text(int row, int column) const { return m_model.index(row, column).data().toString(); }
    QStringList column(int column) const {
        QStringList texts;
        for (int row = 0; row < m_model.rowCount(); ++row) {
            texts += text(row, column);
        }
        return texts;
    }
    /// Frames of a sender at an address, from a second on.
    void perform(performer::Performer& performer, std::uint64_t from, std::uint64_t to, double atSecond,
                 const std::string& address = Stage::kAddress, std::uint64_t lostEach = 0) {
        for (std::uint64_t frame = from; frame < to; ++frame) {
            if (lostEach != 0 && frame % lostEach == lostEach - 1) {
                continue;
            }
            const double seconds = atSecond + static_cast<double>(frame - from) / performer.settings().rateHz;
            for (const wire::Datagram& datagram : performer.frame(frame)) {
                m_stage.send(datagram, Stage::kStart + log::durationOf(seconds), address);
            }
            if (frame % 6 == 0) {
                refresh();
            }
        }
        refresh();
    }

    Stage m_stage;
    CharacterModel m_model{m_stage.session, m_stage.commands};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(CharacterModelTest, IsEmptyBeforeADatagramComes) {
    refresh();
    EXPECT_EQ(m_model.rowCount(), 0);
}

TEST_F(CharacterModelTest, ShowsEachCharacterInOneLine) {
    m_stage.sendMetadata("name:Factory\ncolor:e96417\n", Stage::kStart);
    performer::Performer performer(sending(1, {2}, 60.0));
    perform(performer, 0, 180, 0);
    ASSERT_EQ(m_model.rowCount(), 1);
    EXPECT_EQ(text(0, Column::kName), "Factory");
    EXPECT_EQ(m_model.index(0, 0).data(kSuffixRole).toString(), QStringLiteral("· 0"));
    EXPECT_EQ(m_model.index(0, 0).data(kDotRole).value<CharacterMark>().colour.name(), "#e96417");
    EXPECT_EQ(text(0, Column::kVerdict), QStringLiteral("● good"));
    EXPECT_EQ(text(0, Column::kNominal), "60");
    EXPECT_EQ(text(0, Column::kMeasured), "60.0");
    EXPECT_EQ(text(0, Column::kLostOnNetwork), "0");
    EXPECT_EQ(text(0, Column::kAge), "0.0");
    EXPECT_EQ(text(0, Column::kPose), "02");
}

TEST_F(CharacterModelTest, ANameIsOfNowAsTheVerdictIsWhateverMomentIsShown) {
    m_stage.sendMetadata("name:Anna\n", Stage::kStart);
    performer::Performer performer(sending(1, {2}, 60.0));
    perform(performer, 0, 60, 0);
    m_stage.sendMetadata("name:Bert\n", Stage::kStart + 2s);
    perform(performer, 60, 180, 2);
    m_stage.playback.showMoment(Stage::kStart + 1s);
    refresh();
    EXPECT_EQ(characterName(m_stage.session, m_stage.key()), "Anna");
    EXPECT_EQ(text(0, Column::kName), "Bert");
    EXPECT_EQ(nameApart(m_stage.session.atNow(), m_stage.key()), "Bert");
}

TEST_F(CharacterModelTest, SaysWhereThereIsNoPose) {
    performer::Performer performer(sending(1, {24}, 60.0));
    perform(performer, 0, 60, 0);
    EXPECT_EQ(text(0, Column::kPose), "none");
    EXPECT_EQ(text(0, Column::kVerdict), QStringLiteral("▲ no pose"));
}

TEST_F(CharacterModelTest, AnnouncesOneInsertionAndOneChangeWhateverCame) {
    QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    performer::Performer performer(sending(20));
    m_stage.perform(performer, 0, 24);
    refresh();
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(changed.count(), 1);
    EXPECT_EQ(m_model.rowCount(), 20);
}

TEST_F(CharacterModelTest, CountsLossesByCauseInTheLastTenSecondsOnly) {
    performer::Performer performer(sending(1, {2, 21}, 60.0));
    perform(performer, 0, 360, 0, Stage::kAddress, 60);
    int sum = 0;
    for (int at = Column::kLostHere; at <= Column::kLostUnknown; ++at) {
        sum += text(0, at).toInt();
    }
    EXPECT_EQ(sum, 10) << "five gaps in two streams, and one that is not settled";
    EXPECT_EQ(boardSpanText(m_stage.session), "now, last 10 s");
    perform(performer, 360, 1'100, 6);
    for (int at = Column::kLostHere; at <= Column::kLostUnknown; ++at) {
        EXPECT_EQ(text(0, at), "0");
    }
}

TEST_F(CharacterModelTest, DoesNotCountAsLostWhatMayStillCome) {
    performer::Performer performer(sending(1, {2}, 60.0));
    perform(performer, 0, 120, 0);
    for (const wire::Datagram& datagram : performer.frame(121)) { // 120 is under way
        m_stage.send(datagram, m_stage.now + 17ms);
    }
    refresh();
    EXPECT_EQ(text(0, Column::kLostUnknown), "0");
    EXPECT_EQ(text(0, Column::kVerdict), QStringLiteral("▲ 1 not yet here"));
    for (const wire::Datagram& datagram : performer.frame(120)) {
        m_stage.send(datagram, m_stage.now + 2ms);
    }
    perform(performer, 122, 200, log::secondsOf(m_stage.now - Stage::kStart) + 0.016);
    EXPECT_EQ(text(0, Column::kLostUnknown), "0");
    EXPECT_EQ(text(0, Column::kVerdict), QStringLiteral("▲ 1 reordered, over"));
}

// Defect 2: live rows under the ended sender, the wrong row picked, the predecessor's nominal rate.
TEST_F(CharacterModelTest, KeepsOneRowInItsPlaceThroughARestartOnAnotherPort) {
    performer::Performer pair(sending(2, {2, 12}, 120.0));
    perform(pair, 0, 360, 0);
    const QString first = text(0, Column::kName);
    const model::CharacterKey before = m_stage.key(0);
    performer::Performer slower(sending(1, {2}, 60.0));
    perform(slower, 0, 90, 4, "192.168.10.21:52012");
    const model::CharacterKey after{m_stage.sender("192.168.10.21:52012"), 0};
    ASSERT_EQ(m_model.rowCount(), 2);
    EXPECT_EQ(m_model.character(m_model.index(0, 0)), after);
    EXPECT_EQ(text(0, Column::kName), first);
    EXPECT_EQ(m_model.indexOf(before), m_model.index(0, 0));
    EXPECT_EQ(m_model.indexOf(after), m_model.index(0, 0));
    EXPECT_EQ(m_model.indexOf(m_stage.key(1)), m_model.index(1, 0));
    EXPECT_EQ(text(0, Column::kNominal), "60") << "learnt anew";
    EXPECT_EQ(text(0, Column::kMeasured), "60.0");
    EXPECT_EQ(m_model.index(0, Column::kVerdict).data(kSuffixRole).toString(),
              QStringLiteral("↻ restarted 1 ×"));
    EXPECT_TRUE(portHistory(m_stage.session, after).contains("192.168.10.21:52011 until "));
    EXPECT_TRUE(m_stage.session.accounts().endedSenders().empty()) << "its other character has no successor";
}

TEST_F(CharacterModelTest, LearnsTheNominalRateAnewAfterARestartOnTheSamePort) {
    performer::Performer fast(sending(1, {2}, 120.0));
    perform(fast, 50'000, 50'360, 0);
    EXPECT_EQ(text(0, Column::kNominal), "120");
    performer::Performer slow(sending(1, {2}, 60.0));
    perform(slow, 0, 120, 4);
    EXPECT_EQ(m_model.rows()[0].restarts, 1U);
    EXPECT_EQ(text(0, Column::kNominal), "60");
}

TEST_F(CharacterModelTest, FlagsTwoSendersOfOneIdBothAndNamesTheOther) {
    performer::Performer one(sending(1, {2}, 60.0));
    for (std::uint64_t frame = 0; frame < 120; ++frame) {
        for (const wire::Datagram& datagram : one.frame(frame)) {
            m_stage.send(datagram, m_stage.now + 8ms, "10.0.0.1:1000");
            m_stage.send(datagram, m_stage.now + 8ms, "10.0.0.2:2000");
        }
    }
    refresh();
    ASSERT_EQ(m_model.rowCount(), 2);
    for (int row = 0; row < 2; ++row) {
        EXPECT_EQ(text(row, Column::kVerdict), row == 0 ? QStringLiteral("■ also from 10.0.0.2:2000")
                                                        : QStringLiteral("■ also from 10.0.0.1:1000"));
        EXPECT_TRUE(m_model.index(row, Column::kVerdict)
                        .data(Qt::ToolTipRole)
                        .toString()
                        .contains(row == 0 ? "10.0.0.2:2000" : "10.0.0.1:1000"));
    }
}

TEST_F(CharacterModelTest, TellsTwoOfOneNameAndIdApartByTheirSenders) {
    const auto play = [&](const std::vector<std::string>& addresses) {
        performer::Performer one(sending(1, {2, 12}, 60.0));
        for (std::uint64_t frame = 0; frame < 120; ++frame) {
            for (const wire::Datagram& datagram : one.frame(frame)) {
                for (const std::string& address : addresses) {
                    m_stage.send(datagram, m_stage.now + 8ms, address);
                }
            }
        }
        refresh();
    };
    const auto suffix = [&](int row) {
        return m_model.index(row, Column::kName).data(kSuffixRole).toString();
    };
    play({"10.0.0.1:1000"});
    EXPECT_EQ(suffix(0), QString::fromUtf8("· 0"));
    play({"10.0.0.1:1000", "10.0.0.1:2000"});
    ASSERT_EQ(m_model.rowCount(), 2);
    EXPECT_EQ(text(0, Column::kName), text(1, Column::kName));
    EXPECT_EQ(suffix(0), QString::fromUtf8("· 0 · :1000"));
    EXPECT_EQ(suffix(1), QString::fromUtf8("· 0 · :2000"));
    EXPECT_EQ(text(0, Column::kVerdict), QString::fromUtf8("■ also from port 2000"));
    EXPECT_EQ(m_model.index(0, Column::kName).data(Qt::AccessibleTextRole).toString(),
              text(0, Column::kName) + QString::fromUtf8(" · 0 · :1000"));
    EXPECT_EQ(nameApart(m_stage.session, *m_model.character(m_model.index(1, 0))),
              text(1, Column::kName) + QString::fromUtf8(" · 0 · :2000"));
    play({"10.0.0.1:1000", "10.0.0.1:2000", "10.0.0.2:1000"});
    EXPECT_EQ(suffix(0), QString::fromUtf8("· 0 · 10.0.0.1:1000"));
    EXPECT_EQ(suffix(2), QString::fromUtf8("· 0 · 10.0.0.2:1000"));
}

TEST_F(CharacterModelTest, PutsTroubleFirstWhereItIsAskedTo) {
    performer::Performer both(sending(3, {2}, 60.0));
    for (std::uint64_t frame = 0; frame < 300; ++frame) {
        for (const wire::Datagram& datagram : both.frame(frame)) {
            if (datagram.header.character != 2 || frame % 10 != 0) {
                m_stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / 60));
            }
        }
    }
    refresh();
    EXPECT_EQ(m_model.character(m_model.index(0, 0)), m_stage.key(0));
    m_model.setOrder(BoardOrder::TroubleFirst);
    refresh();
    EXPECT_EQ(m_model.character(m_model.index(0, 0)), m_stage.key(2));
    EXPECT_EQ(m_model.character(m_model.index(1, 0)), m_stage.key(0));
    EXPECT_EQ(m_model.indexOf(m_stage.key(2)), m_model.index(0, 0));
}

// Defect 3: paused, and the sender dies.
TEST_F(CharacterModelTest, ShowsWhatIsNowWhileTheDisplayIsPaused) {
    performer::Performer performer(sending(1, {2}, 60.0));
    perform(performer, 0, 120, 0);
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 60});
    m_stage.now += 3s;
    refresh();
    EXPECT_TRUE(text(0, Column::kVerdict).startsWith(QStringLiteral("■ no data for 3")))
        << text(0, Column::kVerdict).toStdString();
    EXPECT_EQ(text(0, Column::kMeasured), "0.0");
    EXPECT_EQ(text(0, Column::kAge), "3.0");
}

TEST_F(CharacterModelTest, LeavesOutWhatACorruptHeaderMayHaveInvented) {
    performer::Performer performer(sending(1, {2}, 60.0));
    perform(performer, 0, 120, 0);
    wire::Datagram odd = performer.frame(121).front();
    odd.header.character = 66;
    m_stage.send(odd, m_stage.now + 1ms);
    refresh();
    EXPECT_EQ(m_model.rowCount(), 1);
    EXPECT_EQ(m_stage.session.accounts().unproven().characters, 1U);
    EXPECT_EQ(m_stage.session.accounts().unproven().datagrams, 1U);
}

TEST_F(CharacterModelTest, ListsTheStreamsOfOneInDetail) {
    performer::Performer performer(sending(2, {21, 2, 12}, 60.0));
    perform(performer, 0, 120, 0);
    CharacterDetailModel detail(m_stage.session);
    detail.refresh(m_stage.key(1), m_model.nominalRates());
    ASSERT_EQ(detail.rowCount(), 3);
    EXPECT_EQ(detail.index(0, 0).data().toString(), "02 Pose, quaternion");
    EXPECT_EQ(detail.index(0, 1).data().toString(), "60");
    EXPECT_EQ(detail.index(0, 2).data().toString(), "60.0");
    EXPECT_EQ(detail.index(1, 2).data().toString(), QStringLiteral("–")) << "metadata has no rate";
    detail.refresh(std::nullopt, m_model.nominalRates());
    EXPECT_EQ(detail.rowCount(), 0);
}

TEST_F(CharacterModelTest, ListsEndedSendersUntilTheyAreForgotten) {
    performer::Performer performer(sending(1, {2}, 60.0));
    perform(performer, 0, 60, 0);
    perform(performer, 0, 60, 2, "192.168.10.21:52012");
    EndedSenderModel ended(m_stage.session);
    ended.refresh();
    ASSERT_EQ(ended.rowCount(), 1);
    EXPECT_EQ(ended.index(0, 0).data().toString(), Stage::kAddress);
    m_stage.commands.forgetSender(ended.rows()[0].sender);
    ended.refresh();
    EXPECT_EQ(ended.rowCount(), 0);
    refresh();
    EXPECT_EQ(m_model.rowCount(), 1);
    EXPECT_EQ(m_model.rows()[0].restarts, 1U);
}

TEST_F(CharacterModelTest, FiltersThePacketsOfACharacterFromAllItsPorts) {
    performer::Performer performer(sending(1, {2}, 60.0));
    perform(performer, 0, 60, 0);
    EXPECT_EQ(characterFilter(m_stage.session, m_stage.key()), "character == 0");
    perform(performer, 0, 60, 2, "192.168.10.21:52012");
    const QString filter = characterFilter(m_stage.session, {m_stage.sender("192.168.10.21:52012"), 0});
    EXPECT_TRUE(filter.contains("52011") && filter.contains("52012")) << filter.toStdString();
}

TEST_F(CharacterModelTest, AsksToHideACharacterByItsCheckMark) {
    m_stage.send(smallPose(), 1, 1, Stage::kStart);
    refresh();
    const QModelIndex name = m_model.index(0, 0);
    EXPECT_EQ(name.data(Qt::CheckStateRole).toInt(), Qt::Checked);
    EXPECT_TRUE(m_model.setData(name, Qt::Unchecked, Qt::CheckStateRole));
    EXPECT_TRUE(m_stage.session.roster().isHidden(m_stage.key()));
    EXPECT_EQ(name.data(Qt::CheckStateRole).toInt(), Qt::Unchecked);
}

} // namespace

} // namespace posewire::gui
