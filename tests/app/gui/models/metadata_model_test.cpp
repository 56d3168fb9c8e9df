// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/metadata_model.h"

#include "app/gui/models/column.h"
#include "tests/app/gui/models/stage.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

namespace posewire::gui {

namespace {

class MetadataModelTest : public testing::Test {
protected:
    void refresh() {
        m_stage.follow();
        m_model.refresh();
    }
    QModelIndex row(const QString& name) const {
        for (int i = 0; i < m_model.rowCount(); ++i) {
            if (m_model.index(i, 0).data().toString() == name) {
                return m_model.index(i, 0);
            }
        }
        return {};
    }
    QString value(const QString& name) const {
        return row(name).siblingAtColumn(MetadataModel::kValue).data().toString();
    }

    Stage m_stage;
    MetadataModel m_model{m_stage.session};
    QAbstractItemModelTester m_tester{&m_model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(MetadataModelTest, IsEmptyWithoutACharacter) {
    refresh();
    EXPECT_EQ(m_model.rowCount(), 0);
}

TEST_F(MetadataModelTest, ShowsEveryTagAndMarksUnknownOnesInWords) {
    m_stage.sendMetadata("color:e96417\nname:Factory\nmood:fine:today\n", Stage::kStart);
    refresh();
    EXPECT_EQ(value("name"), "Factory");
    EXPECT_EQ(value("mood"), "fine:today");
    EXPECT_EQ(row("mood").data(kSuffixRole).toString(), QStringLiteral("· unknown"));
    EXPECT_FALSE(row("name").data(kSuffixRole).isValid());
    const QModelIndex colour = row("color").siblingAtColumn(MetadataModel::kValue);
    EXPECT_EQ(colour.data(kSwatchRole).value<QColor>().name(), "#e96417");
}

TEST_F(MetadataModelTest, ShowsWhatTheOperatorDeclaredInsteadOfWhatWasDetected) {
    m_stage.send(smallPose(), 1, 0, Stage::kStart);
    refresh();
    EXPECT_TRUE(value("Revision").startsWith("L to N"));
    EXPECT_TRUE(value("Units").startsWith("metres"));
    m_stage.commands.setOverride(m_stage.sender(), {model::Revision::E, model::LengthUnit::Centimetre});
    refresh();
    EXPECT_EQ(value("Revision"), QStringLiteral("E · as you said"));
    EXPECT_EQ(value("Units"), QStringLiteral("centimetres · as you said"));
    const QModelIndex units = row("Units").siblingAtColumn(MetadataModel::kValue);
    EXPECT_TRUE(units.data(Qt::ToolTipRole).toString().contains("Detected: metres"));
}

TEST_F(MetadataModelTest, KeepsEarlierValuesBelowTheTagNewestFirst) {
    for (const char* text : {"name:Ana\n", "name:Bea\n", "name:Cleo\n"}) {
        m_stage.sendMetadata(text, m_stage.now + 1s);
        refresh();
    }
    const QModelIndex name = row("name");
    ASSERT_EQ(m_model.rowCount(name), 2);
    EXPECT_EQ(m_model.index(0, MetadataModel::kValue, name).data().toString(), "Bea");
    EXPECT_EQ(m_model.index(1, MetadataModel::kValue, name).data().toString(), "Ana");
    EXPECT_EQ(name.data(kSuffixRole).toString(), QStringLiteral("· 2 changes"));
    EXPECT_EQ(name.siblingAtColumn(MetadataModel::kSent).data().toString(), "0.0 s");
}

TEST_F(MetadataModelTest, ShowsWhatWasSaidAtTheCursor) {
    m_stage.sendMetadata("name:Ana\n", Stage::kStart);
    m_stage.sendMetadata("name:Bea\n", Stage::kStart + 1s);
    refresh();
    EXPECT_EQ(m_model.rowCount(row("name")), 1);
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 0});
    refresh();
    EXPECT_EQ(value("name"), "Ana");
    EXPECT_EQ(m_model.rowCount(row("name")), 0);
}

TEST_F(MetadataModelTest, FollowsTheSelectedCharacter) {
    performer::Performer performer(sending(2, {2, 12}));
    m_stage.perform(performer, 0, 2);
    refresh();
    const QString first = value("name");
    m_stage.session.setSelection({m_stage.sender(), m_stage.key(1), -1});
    refresh();
    EXPECT_NE(value("name"), first);
    EXPECT_EQ(m_model.character(), m_stage.key(1));
}

TEST_F(MetadataModelTest, SaysOnWhatItsConclusionsRest) {
    performer::Performer performer(sending(1));
    m_stage.perform(performer, 0, 10);
    refresh();
    EXPECT_TRUE(value("Revision").contains(QStringLiteral(" · "))) << value("Revision").toStdString();
    EXPECT_TRUE(value("Units").startsWith("metres")) << value("Units").toStdString();
    EXPECT_EQ(value("Sender"), Stage::kAddress);
    EXPECT_EQ(value("Segments"), QStringLiteral("23 body · 0 props · 0 fingers"));
    EXPECT_TRUE(value("Null pose").startsWith(QStringLiteral("● "))) << value("Null pose").toStdString();
}

TEST_F(MetadataModelTest, SaysThatTheReferenceBodyStandsIn) {
    m_stage.send(smallPose(), 1, 1, Stage::kStart);
    refresh();
    EXPECT_EQ(value("Null pose"), QStringLiteral("not received · reference body"));
}

TEST_F(MetadataModelTest, ListsMotionGridTagsByTheirIdsWithTheirAges) {
    m_stage.send(wire::TagPositions{{{901, {100, 120, 50}}}}, 1, 0, Stage::kStart);
    m_stage.send(wire::TagPositions{{{900, {0, 110, 20}}}}, 2, 0, Stage::kStart + 3s);
    refresh();
    const int count = m_model.rowCount();
    ASSERT_GE(count, 2);
    EXPECT_EQ(m_model.index(count - 2, 0).data().toString(), QStringLiteral("Tag 900"));
    EXPECT_EQ(value("Tag 901"), QStringLiteral("0.500, 1.000, 1.200 m"));
    EXPECT_EQ(row("Tag 901").siblingAtColumn(MetadataModel::kSent).data().toString(), "3.0 s");
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 0});
    refresh();
    EXPECT_EQ(m_model.rowCount(), count - 1);
    EXPECT_FALSE(row("Tag 900").isValid());
    m_stage.session.setCursor({});
    refresh();
    EXPECT_EQ(m_model.index(count - 2, 0).data().toString(), QStringLiteral("Tag 900"));
}

TEST_F(MetadataModelTest, AnnouncesAtMostOneOfEachInARefresh) {
    m_stage.sendMetadata("name:Ana\ncolor:112233\n", Stage::kStart);
    refresh();
    m_stage.sendMetadata("name:Bea\ncolor:445566\nxmid:1\n", Stage::kStart + 1ns);
    QSignalSpy inserted(&m_model, &QAbstractItemModel::rowsInserted);
    QSignalSpy changed(&m_model, &QAbstractItemModel::dataChanged);
    for (int i = 1; i <= 3; ++i) {
        refresh();
        EXPECT_EQ(inserted.count(), i);
        EXPECT_EQ(changed.count(), i);
    }
    refresh();
    EXPECT_EQ(inserted.count(), 3);
}

} // namespace

} // namespace posewire::gui
