// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/verdict_bar.h"

#include "app/gui/theme/widgets.h"
#include "core/model/session/verdict.h"
#include "tests/app/gui/models/stage.h"

#include <QAction>
#include <QLabel>
#include <QSignalSpy>
#include <QTest>

#include <gmock/gmock.h>

namespace posewire::gui {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class VerdictBarTest : public testing::Test {
protected:
    VerdictBarTest() {
        m_bar.resize(1200, 80);
        m_bar.show();
    }
    /// Samples from one to before another, 60 a second.
    void send(int from, int to) {
        for (int sample = from; sample < to; ++sample) {
            m_stage.now = Stage::kStart + sample * log::Duration(1s) / 60;
            const auto counter = static_cast<std::uint32_t>(sample);
            m_stage.send(smallPose(), counter, counter * 1000 / 60, m_stage.now);
        }
        m_stage.follow();
    }
    void refresh(const ShownFile& file = {}, bool hasInputs = true, const QString& blocked = {}) {
        m_bar.refresh(file, hasInputs, blocked);
    }
    [[nodiscard]] static model::TakeVerdict notGood() {
        return {.state = model::TakeVerdict::State::Bad,
                .said = {words::Kind::Text, {{"text", std::string("Not good")}}}};
    }
    [[nodiscard]] std::string headline() const {
        return m_bar.findChild<Headline*>("headline")->text().toStdString();
    }
    [[nodiscard]] QWidget* strip() const { return m_bar.findChild<QWidget*>("strip"); }
    [[nodiscard]] std::string stripText() const {
        return m_bar.findChild<ElidedLabel*>("stripText")->text().toStdString();
    }
    [[nodiscard]] QToolButton* button(const char* name) const { return m_bar.findChild<QToolButton*>(name); }

    Stage m_stage;
    QObject m_actions;
    QAction* named(const char* name) {
        auto* action = new QAction(&m_actions);
        action->setObjectName(name);
        return action;
    }
    VerdictBar m_bar{m_stage.session,
                     {named("resetForTake"), named("live"), named("showFile"), named("closeFile"),
                      named("endComparison"), named("recovered")}};
};

TEST_F(VerdictBarTest, SaysNeitherGoodNorBadBeforeAnythingCame) {
    refresh();
    EXPECT_EQ(headline(), "No data yet");
    EXPECT_TRUE(strip()->isHidden());
    EXPECT_FALSE(button("resetForTakeButton")->isEnabled());
}

TEST_F(VerdictBarTest, IsAboutTheWireAlsoWhileTheDisplayIsPaused) {
    send(0, 120);
    refresh();
    EXPECT_THAT(headline(), StartsWith("Good for the take"));
    m_stage.session.setCursor({model::Cursor::Mode::Paused, m_stage.session.end() - 1});
    m_stage.now += 1'025ms; // the sender dies
    m_stage.follow();
    refresh();
    EXPECT_THAT(headline(), StartsWith("Not good: no data from"));
    EXPECT_THAT(headline(), HasSubstr("going on"));
    EXPECT_TRUE(strip()->isHidden()) << "pausing moves nothing";
}

TEST_F(VerdictBarTest, SaysWhichRecordingIsShownAndWhatIsLiveBehindIt) {
    send(0, 120);
    refresh({"take.pcapng", true, notGood(), {"Memory is full."}});
    EXPECT_THAT(headline(), StartsWith("Live: Good for the take"));
    EXPECT_EQ(stripText(), "Recording take.pcapng · Not good · Memory is full.");
    EXPECT_EQ(button("liveButton")->text(), "Back to live (1 good)");
    EXPECT_FALSE(button("closeFileButton")->isHidden());
    refresh({"take.pcapng", false, {}, {}});
    EXPECT_TRUE(strip()->isHidden());
    EXPECT_EQ(button("showFileButton")->text(), "Show take.pcapng");
}

TEST_F(VerdictBarTest, IsOfTheRecordingWhereNothingHasCome) {
    refresh({"take.pcapng", true, notGood(), {"Memory is full."}});
    EXPECT_EQ(headline(), "Not good");
    EXPECT_EQ(stripText(), "Recording take.pcapng · Memory is full.");
    refresh({"take.pcapng", true, notGood(), {}}, true, "UDP 9763 is taken.");
    EXPECT_EQ(headline(), "Live: UDP 9763 is taken.");
    refresh({"take.pcapng", false, notGood(), {}});
    EXPECT_EQ(headline(), "No data yet");
}

TEST_F(VerdictBarTest, TellsOfWhatTheLastRunHasLeftUntilItIsPutOff) {
    m_bar.showRecovery("packets until 15:14:01");
    refresh();
    EXPECT_EQ(stripText(), "packets until 15:14:01");
    EXPECT_FALSE(button("recoveredButton")->isHidden());
    refresh({"take.pcapng", true, {}, {}});
    EXPECT_TRUE(button("recoveredButton")->isHidden());
    refresh();
    const QSignalSpy dismissed(&m_bar, &VerdictBar::recoveryDismissed);
    button("recoveredButton")->click();
    refresh();
    EXPECT_TRUE(strip()->isHidden());
    EXPECT_EQ(dismissed.count(), 1);
}

TEST_F(VerdictBarTest, SaysWhyNothingCanCome) {
    refresh({}, true, "UDP 9763 is taken.");
    EXPECT_EQ(headline(), "UDP 9763 is taken.");
    refresh();
    EXPECT_EQ(headline(), "No data yet");
    send(0, 120);
    refresh({}, true, "UDP 9763 is taken.");
    EXPECT_THAT(headline(), StartsWith("Good for the take")) << "it was, until just now";
}

TEST_F(VerdictBarTest, OffersNothingLiveWithoutAnInput) {
    refresh({"take.pcapng", true, {}, {}}, false);
    EXPECT_TRUE(button("liveButton")->isHidden());
    EXPECT_TRUE(button("resetForTakeButton")->isHidden());
    EXPECT_FALSE(strip()->isHidden());
}

TEST_F(VerdictBarTest, LeadsToItsEvidenceByMouseAndKeyboard) {
    send(0, 60);
    send(70, 120);
    refresh();
    EXPECT_THAT(headline(), HasSubstr("10 samples"));
    std::vector<std::optional<std::uint64_t>> asked;
    QObject::connect(&m_bar, &VerdictBar::evidenceRequested, &m_bar,
                     [&](std::optional<std::uint64_t> incident) { asked.push_back(incident); });
    auto* headline = m_bar.findChild<Headline*>("headline");
    QTest::mouseClick(headline, Qt::LeftButton);
    QTest::keyClick(headline, Qt::Key_Space);
    QTest::keyClick(headline, Qt::Key_Space);
    ASSERT_EQ(asked.size(), 3U);
    ASSERT_TRUE(asked[0]);
    EXPECT_NE(m_stage.session.verdicts().incidents().find(*asked[0]), nullptr);
}

TEST_F(VerdictBarTest, SaysWhichTimeItIsOfAndWhenThereWasAReset) {
    const auto span = [this] { return m_bar.findChild<QLabel*>("verdictSpan")->text().toStdString(); };
    send(0, 60);
    refresh();
    EXPECT_EQ(span(), "now, last 10 s");
    m_stage.session.resetForTake();
    send(60, 120);
    refresh();
    EXPECT_THAT(span(), StartsWith("now, since the reset at "));
    send(120, 900); // it is never of more than the board beside it
    refresh();
    EXPECT_THAT(span(), StartsWith("now, last 10 s · reset at "));
}

TEST_F(VerdictBarTest, AResetForgetsWhatIsOver) {
    send(0, 60);
    send(70, 180);
    refresh();
    EXPECT_THAT(headline(), HasSubstr("10 samples"));
    m_stage.session.resetForTake();
    send(180, 200);
    refresh();
    EXPECT_THAT(headline(), StartsWith("Good for the take"));
}

TEST_F(VerdictBarTest, NamesWhatIsComparedAndOffersToEndIt) {
    send(0, 60);
    refresh();
    EXPECT_TRUE(button("endComparisonButton")->isHidden());
    refresh({.comparison = "compared with b.pcapng · Time code"});
    EXPECT_EQ(stripText(), "What is received, compared with b.pcapng · Time code");
    EXPECT_FALSE(strip()->isHidden());
    EXPECT_FALSE(button("endComparisonButton")->isHidden());
    refresh({.name = "a.pcapng", .isShown = true, .comparison = "compared with b.pcapng · Time code"});
    EXPECT_THAT(stripText(), StartsWith("Recording a.pcapng compared with b.pcapng · Time code"));
}

} // namespace
} // namespace posewire::gui
