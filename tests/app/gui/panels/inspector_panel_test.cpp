// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/inspector_panel.h"

#include "core/model/session/accounts.h"
#include "tests/app/gui/models/stage.h"

#include <QScrollBar>
#include <QTest>
#include <QToolButton>

namespace posewire::gui {
namespace {

class InspectorPanelTest : public testing::Test {
protected:
    static constexpr std::uint32_t kFirstSegment = 24; // after the header
    static constexpr std::uint32_t kSegmentSize = 32;  // of a type 02

    InspectorPanelTest() {
        m_panel.resize(420, 900);
        m_panel.setVisible(true);
        performer::Performer performer(sending(1, {2}));
        m_stage.perform(performer, 0, 3);
        refresh();
        m_stage.commands.selectPacket(1);
        refresh();
    }
    void refresh() {
        m_stage.follow();
        m_panel.refresh();
    }
    void selectSegment(int segment) {
        model::Selection selection = m_stage.session.choices().selection;
        selection.segment = segment;
        m_stage.commands.select(selection);
        refresh();
    }
    static ByteRange bytesOf(int segment) {
        const std::uint32_t begin = kFirstSegment + static_cast<std::uint32_t>(segment) * kSegmentSize;
        return {begin, begin + kSegmentSize};
    }
    [[nodiscard]] FieldView& fields() { return *m_panel.findChild<FieldView*>(); }
    [[nodiscard]] ByteView& bytes() { return *m_panel.findChild<ByteView*>(); }

    Stage m_stage;
    InspectorPanel m_panel{m_stage.session, m_stage.commands, nullptr};
};

TEST_F(InspectorPanelTest, MarksTheBytesOfASegmentThatWasPickedElsewhere) {
    selectSegment(6);
    EXPECT_EQ(bytes().selected(), bytesOf(6));
    selectSegment(14);
    EXPECT_EQ(bytes().selected(), bytesOf(14));
}

TEST_F(InspectorPanelTest, ShowsTheBytesThatWereLookedFor) {
    const auto find = [&](const model::FoundBytes& found) {
        m_stage.commands.selectPacket(found.packet);
        model::Selection selection = m_stage.session.choices().selection;
        selection.found = found;
        m_stage.commands.select(selection);
        refresh();
    };
    const std::uint32_t begin = bytesOf(4).begin + 6; // from one field into the next
    find({0, begin, begin + 7});
    EXPECT_EQ(bytes().selected(), (ByteRange{begin, begin + 7}));
    refresh();
    EXPECT_EQ(bytes().selected(), (ByteRange{begin, begin + 7}));
    selectSegment(14);
    EXPECT_EQ(bytes().selected(), bytesOf(14)) << "something else is of interest now";
    find({0, 2, 4});
    EXPECT_EQ(bytes().selected(), (ByteRange{2, 4})) << "further on in the same packet";
    m_stage.commands.selectPacket(1);
    refresh();
    EXPECT_NE(bytes().selected(), (ByteRange{2, 4})) << "of another packet";
}

TEST_F(InspectorPanelTest, ScrollsToFoundBytesOnce) {
    bytes().resize(300, 60);
    int scrolls = 0;
    QObject::connect(bytes().verticalScrollBar(), &QScrollBar::valueChanged, &bytes(), [&] { ++scrolls; });
    model::Selection selection = m_stage.session.choices().selection;
    const std::uint32_t begin = bytesOf(14).begin + 20; // rows away from where its segment begins
    selection.packet = 0;
    selection.found = {0, begin, begin + 7};
    m_stage.commands.select(selection);
    refresh();
    EXPECT_EQ(scrolls, 1);
}

TEST_F(InspectorPanelTest, PickingAByteSelectsItsFieldAndSegment) {
    const std::uint32_t offset = bytesOf(4).begin + 9; // the second coordinate of the position
    bytes().scrollTo(offset);
    QTest::mouseClick(bytes().viewport(), Qt::LeftButton, {}, bytes().centreOf(offset));
    EXPECT_EQ(bytes().selected(), (ByteRange{offset - 1, offset + 3}));
    EXPECT_EQ(m_stage.session.choices().selection.segment, 4);
    EXPECT_TRUE(fields().currentIndex().isValid());
}

TEST_F(InspectorPanelTest, TellsWhatIsMissingBeforeThePacketAndWhy) {
    performer::Performer performer(sending(1, {2, 20}));
    Stage stage;
    stage.perform(performer, 0, 100);
    const std::uint64_t next = stage.log.figures().end;
    const auto frame = performer.frame(100);
    stage.send(frame.back(), Stage::kStart + 417ms); // its type 02 is lost
    stage.perform(performer, 101, 200);
    stage.follow();
    InspectorPanel panel(stage.session, stage.commands, nullptr);
    std::uint64_t number = next;
    while (stage.session.accounts().digests().find(number) != nullptr &&
           stage.session.accounts().digests().find(number)->gap == 0) {
        ++number;
    }
    stage.commands.selectPacket(number);
    panel.refresh();
    const QString text = panel.findChild<QLabel*>("problems")->text();
    EXPECT_TRUE(text.contains("1 sample is missing just before it. Cause: network. Type 20 of the same "
                              "sender brought sample"))
        << text.toStdString();
}

TEST_F(InspectorPanelTest, ComparesTwoPacketsOfOneType) {
    m_panel.setReference();
    m_stage.commands.selectPacket(2);
    refresh();
    m_panel.compare(InspectorPanel::Comparison::Reference);
    const auto& model = dynamic_cast<FieldModel&>(*fields().model());
    ASSERT_NE(model.other(), nullptr);
    EXPECT_EQ(model.other()->number, 1U);
    EXPECT_GT(model.differences(), 0U);
}

TEST_F(InspectorPanelTest, ShowsBytesOfASegmentAlsoWhereNoFieldDiffers) {
    m_panel.setReference();
    m_panel.compare(InspectorPanel::Comparison::Reference);
    auto& model = dynamic_cast<FieldModel&>(*fields().model());
    model.setOnlyDifferences(true);
    ASSERT_EQ(model.rowCount(), 0);
    EXPECT_EQ(fields().accessibleDescription(), "No field differs.");
    selectSegment(9);
    EXPECT_EQ(bytes().selected(), bytesOf(9));
    m_panel.compare(InspectorPanel::Comparison::None);
    EXPECT_EQ(model.document().node(fields().currentNode()).offset, bytesOf(9).begin);
}

TEST_F(InspectorPanelTest, WithoutAPacketThereIsOneEmptyPlaceAndNothingToPress) {
    Stage empty;
    InspectorPanel panel(empty.session, empty.commands, nullptr);
    panel.resize(420, 500);
    panel.show();
    panel.refresh();
    EXPECT_FALSE(panel.findChild<ByteView*>()->isVisible());
    for (const QToolButton* button : panel.findChildren<QToolButton*>()) {
        EXPECT_FALSE(button->isEnabled()) << button->accessibleName().toStdString();
    }
    EXPECT_TRUE(bytes().isVisible());
}

TEST_F(InspectorPanelTest, LineEndsInATextAreNoBoxes) {
    m_stage.sendMetadata("name:Mira\ncolor:2f72c4\n", m_stage.now + 1ms);
    m_stage.commands.selectPacket(m_stage.session.end() - 1);
    m_stage.follow();
    m_stage.commands.selectPacket(m_stage.session.end() - 1);
    refresh();
    QString all = fields().allText();
    EXPECT_TRUE(all.contains(QStringLiteral("Mira"))) << all.toStdString();
    for (const QChar letter : std::as_const(all)) {
        EXPECT_TRUE(letter.unicode() < 0x2400 || letter.unicode() > 0x2426) << all.toStdString();
    }
}

} // namespace
} // namespace posewire::gui
