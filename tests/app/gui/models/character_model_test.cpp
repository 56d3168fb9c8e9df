// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/character_model.h"

#include "app/gui/models/column.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

namespace posewire::gui {

namespace {

class CharacterModelTest : public testing::Test {
protected:
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    QString text(const QModelIndex& index) const { return index.data().toString(); }
    QModelIndex sender() const { return m_model.index(0, 0); }
    QModelIndex character(int row) const { return m_model.index(row, 0, sender()); }

    Stage m_stage;
    CharacterModel m_model{m_stage.session, m_stage.commands};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(CharacterModelTest, IsEmptyBeforeADatagramComes) {
    refresh();
    EXPECT_EQ(m_model.rowCount(), 0);
}

TEST_F(CharacterModelTest, ShowsSenderCharacterAndStream) {
    m_stage.sendMetadata("name:Factory\ncolor:e96417\n", Stage::kStart);
    m_stage.send(smallPose(), 1, 1, Stage::kStart);
    refresh();
    ASSERT_EQ(m_model.rowCount(), 1);
    EXPECT_EQ(text(sender()), Stage::kAddress);
    EXPECT_EQ(text(sender().siblingAtColumn(CharacterModel::kRate)), "UDP");
    ASSERT_EQ(m_model.rowCount(sender()), 1);
    EXPECT_EQ(text(character(0)), "Factory");
    EXPECT_EQ(character(0).data(kSuffixRole).toString(), QStringLiteral("· 0"));
    EXPECT_EQ(character(0).data(kDotRole).value<QColor>().name(), "#e96417");
    ASSERT_EQ(m_model.rowCount(character(0)), 2);
    EXPECT_EQ(text(m_model.index(1, 0, character(0))), "02 Pose, quaternion");
}

TEST_F(CharacterModelTest, AnnouncesOneInsertionAndOneChangeWhateverCame) {
    QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    performer::Performer performer(sending(4));
    m_stage.perform(performer, 0, 24);
    refresh();
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(changed.count(), 1);
    EXPECT_EQ(m_model.rowCount(sender()), 4);
    EXPECT_EQ(m_model.rowCount(character(3)),
              static_cast<int>(performer::typesOf(performer::Revision::N).size()));
    refresh();
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(changed.count(), 2);
}

TEST_F(CharacterModelTest, AddsNewStreamsBelowTheirCharacterOverRefreshes) {
    performer::Performer poses(sending(3, {2}));
    m_stage.perform(poses, 0, 2);
    refresh();
    performer::Performer more(sending(3, {2, 21, 22}));
    m_stage.perform(more, 2, 4);
    QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    for (int i = 1; i <= 3; ++i) {
        refresh();
        EXPECT_EQ(inserted.count(), i);
    }
    refresh();
    EXPECT_EQ(inserted.count(), 3);
    for (int row = 0; row < 3; ++row) {
        EXPECT_EQ(m_model.rowCount(character(row)), 3);
    }
}

TEST_F(CharacterModelTest, KeepsTheOrderOfAppearance) {
    wire::Datagram second;
    second.body = smallPose();
    wire::completeHeader(second, wire::HeaderEra::Counted);
    second.header.character = 3;
    m_stage.send(second, Stage::kStart);
    refresh();
    m_stage.send(smallPose(), 1, 1, Stage::kStart + 1ns);
    refresh();
    EXPECT_EQ(m_model.character(character(0)), m_stage.key(3));
    EXPECT_EQ(m_model.character(character(1)), m_stage.key(0));
    EXPECT_EQ(m_model.indexOf(m_stage.key(0)), character(1));
}

TEST_F(CharacterModelTest, ShowsNominalBesideMeasuredRate) {
    performer::Performer performer(sending(1, {2}, 60.0));
    for (std::uint64_t frame = 0; frame < 120; frame += 6) {
        m_stage.perform(performer, frame, frame + 6);
        refresh();
    }
    const QModelIndex rate = m_model.index(0, CharacterModel::kRate, character(0));
    EXPECT_EQ(text(rate), "60/60.0");
    EXPECT_EQ(text(character(0).siblingAtColumn(CharacterModel::kRate)), "60.0");
}

TEST_F(CharacterModelTest, SaysInShapeAndWordsHowAStreamDoes) {
    performer::Performer performer(sending(1, {2}, 100.0));
    m_stage.perform(performer, 0, 200);
    refresh();
    const QModelIndex state = m_model.index(0, CharacterModel::kState, character(0));
    EXPECT_EQ(text(state), QStringLiteral("● 0"));
    m_stage.perform(performer, 203, 300);
    refresh();
    EXPECT_EQ(text(state), QStringLiteral("▲ 3"));
    m_stage.now += 400ms;
    refresh();
    EXPECT_EQ(text(state), QStringLiteral("▲ silent 0.4 s"));
    m_stage.now += 3s;
    refresh();
    EXPECT_EQ(text(state), QStringLiteral("■ stale 3.4 s"));
    EXPECT_EQ(text(character(0).siblingAtColumn(CharacterModel::kState)), QStringLiteral("■ stale 3.4 s"));
}

TEST_F(CharacterModelTest, NamesForeignDatagramsOfASender) {
    const std::string foreign = "{\"type\":\"transport\"}";
    m_stage.sendBytes(std::as_bytes(std::span(foreign)), Stage::kStart);
    refresh();
    EXPECT_EQ(text(sender().siblingAtColumn(CharacterModel::kState)), QStringLiteral("▲ 1 foreign"));
    EXPECT_EQ(m_model.rowCount(sender()), 0);
}

TEST_F(CharacterModelTest, SaysInFullWhatContradictsADeclarationWhereTheRowHasNoRoom) {
    m_stage.send(smallPose(), 1, 1, Stage::kStart);
    refresh();
    model::SenderOverride declared;
    declared.revision = model::Revision::JOrK;
    m_stage.commands.setOverride(m_stage.sender(), declared);
    const QModelIndex state = sender().siblingAtColumn(CharacterModel::kState);
    EXPECT_TRUE(state.data(Qt::ToolTipRole).toString().contains("header counts are filled"))
        << state.data(Qt::ToolTipRole).toString().toStdString();
}

TEST_F(CharacterModelTest, AsksToHideACharacterByItsCheckMark) {
    m_stage.send(smallPose(), 1, 1, Stage::kStart);
    refresh();
    EXPECT_EQ(character(0).data(Qt::CheckStateRole).toInt(), Qt::Checked);
    EXPECT_TRUE(m_model.setData(character(0), Qt::Unchecked, Qt::CheckStateRole));
    EXPECT_TRUE(m_stage.session.isHidden(m_stage.key()));
    EXPECT_EQ(character(0).data(Qt::CheckStateRole).toInt(), Qt::Unchecked);
    EXPECT_FALSE(m_model.setData(sender(), Qt::Unchecked, Qt::CheckStateRole));
}

} // namespace

} // namespace posewire::gui
