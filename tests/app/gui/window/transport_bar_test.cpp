// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/transport_bar.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "tests/app/gui/models/stage.h"

#include <QAction>
#include <QLabel>
#include <QMenu>
#include <QTest>
#include <QToolButton>

#include <array>
#include <vector>

namespace posewire::gui {
namespace {

class TransportBarTest : public testing::Test {
protected:
    QAction* named(const char* text) { return new QAction(text, &m_actions); }
    void showTwoSeconds() {
        performer::Performer one(sending(1, {2}, 60.0));
        m_stage.perform(one, 0, 120);
        m_stage.follow();
        m_bar.resize(1280, 40);
        m_bar.show();
        m_bar.refresh();
    }

    Stage m_stage;
    QObject m_actions;
    QMenu m_speeds;
    TransportBar m_bar{m_stage.session,
                       {named("record"), named("pause"), named("live"), named("inputs"), named("back"),
                        named("on"), named("playBack"), named("loop"), &m_speeds}};
};

TEST_F(TransportBarTest, TheClockGoesOnWhenTheFirstCharacterFallsSilent) {
    performer::Performer both(sending(2, {2}, 60.0));
    for (std::uint64_t frame = 0; frame < 600; ++frame) {
        for (const wire::Datagram& datagram : both.frame(frame)) {
            if (datagram.header.character == 1 || frame < 120) {
                m_stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / 60));
            }
        }
    }
    m_stage.follow();
    m_bar.refresh();
    EXPECT_EQ(m_bar.findChild<QLabel*>("transportTime")->text(),
              timeOfDay(m_stage.session.wallOf(m_stage.now)));
}

TEST_F(TransportBarTest, TheClockGoesOnWhereOnlyThePoseOfTheFirstCharacterIsNotSentAnyMore) {
    performer::Performer both(sending(2, {2, 24}, 60.0));
    for (std::uint64_t frame = 0; frame < 600; ++frame) {
        for (const wire::Datagram& datagram : both.frame(frame)) {
            if (datagram.header.character == 1 || frame < 120 || datagram.header.type() != 2) {
                m_stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / 60));
            }
        }
    }
    m_stage.follow();
    m_bar.refresh();
    EXPECT_EQ(m_bar.findChild<QLabel*>("transportTime")->text(),
              timeOfDay(m_stage.session.wallOf(m_stage.now)));
}

TEST_F(TransportBarTest, ButtonsAreWithoutTheirKeysInANarrowBar) {
    m_bar.resize(2000, 40);
    m_bar.show();
    auto* record = m_bar.findChild<QToolButton*>("recordButton");
    EXPECT_TRUE(record->text().endsWith("   R")) << qPrintable(record->text());
    const int wide = m_bar.minimumSizeHint().width();
    m_bar.resize(800, 40);
    EXPECT_EQ(record->text(), "Record");
    EXPECT_LT(m_bar.minimumSizeHint().width(), wide);
    m_bar.resize(2000, 40);
    EXPECT_TRUE(record->text().endsWith("   R"));
}

TEST_F(TransportBarTest, ANarrowBarHasRoomForWhatIsShownBesideSeveralInputs) {
    performer::Performer one(sending(1, {2}, 60.0));
    m_stage.perform(one, 0, 120);
    m_stage.follow();
    ReceivingState receiving;
    for (const std::uint16_t port : std::array<std::uint16_t, 3>{41'000, 41'001, 41'002}) {
        receiving.ports.emplace_back().port.port = port;
    }
    receiving.ports.back().problem = "taken";
    m_bar.resize(960, 40);
    m_bar.show();
    m_bar.setReceiving(receiving);
    m_bar.refresh();
    const auto isShown = [this](const char* name) { return m_bar.findChild<QWidget*>(name)->isVisible(); };
    EXPECT_FALSE(isShown("inputPill0"));
    EXPECT_TRUE(isShown("inputPill2")) << "in trouble";
    auto* controls = m_bar.findChild<QWidget*>("timeControls");
    QTest::qWait(1); // the layout follows
    EXPECT_GE(controls->width(), controls->sizeHint().width());
}

TEST_F(TransportBarTest, SaysThatARangeIsSelectedAndMovesNothing) {
    showTwoSeconds();
    const auto* detail = m_bar.findChild<ElidedLabel*>();
    EXPECT_FALSE(detail->text().contains("selection"));
    const QRect place = detail->geometry();
    m_stage.commands.selectRange({.fixed = model::TimeRange{Stage::kStart + 500ms, Stage::kStart + 1500ms}});
    m_bar.refresh();
    EXPECT_TRUE(detail->text().startsWith(spanText(m_stage.session)));
    EXPECT_EQ(detail->geometry(), place);
}

TEST_F(TransportBarTest, PausingAndRecordingMoveNothing) {
    showTwoSeconds();
    const std::array parts{"timeControls", "modeButton", "transportTime"};
    const auto places = [&] {
        QTest::qWait(1); // the layout follows
        std::vector<int> all;
        for (const char* part : parts) {
            all.push_back(m_bar.findChild<QWidget*>(part)->x());
        }
        return all;
    };
    const std::vector<int> live = places();
    m_stage.session.setCursor({model::Cursor::Mode::Paused, m_stage.session.end() - 1});
    m_bar.refresh();
    EXPECT_EQ(places(), live);
    for (const double seconds : {3.0, 83.0, 5'999.0}) {
        m_bar.showTake(TakeState{"take.pcapng", seconds, {}});
        EXPECT_EQ(places(), live) << seconds;
    }
}

} // namespace
} // namespace posewire::gui
