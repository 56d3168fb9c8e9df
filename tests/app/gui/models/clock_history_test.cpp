// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/clock_history.h"

#include "tests/app/gui/models/stage.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace posewire::gui {

namespace {

class ClockHistoryTest : public testing::Test {
protected:
    /// Poses of a sender whose clock runs at `speed`, `hz` frames a second of its own.
    void sendPoses(std::uint32_t from, std::uint32_t to, double speed = 1.0, double hz = 100.0) {
        for (std::uint32_t sample = from; sample < to; ++sample) {
            const double seconds = sample / hz;
            m_stage.send(smallPose(), sample,
                         m_firstMs + static_cast<std::uint32_t>(std::lround(seconds * 1000)),
                         Stage::kStart + log::durationOf(seconds / speed));
        }
    }
    void follow() {
        m_stage.follow();
        m_clock.follow(m_stage.session, m_stage.key());
    }

    [[nodiscard]] QString driftText() const {
        const std::vector<Property> facts = clockFacts(m_clock);
        return std::ranges::find(facts, QString("Drift"), &Property::label)->read().text;
    }

    Stage m_stage;
    ClockHistory m_clock;
    std::uint32_t m_firstMs = 36'000'000;
};

TEST_F(ClockHistoryTest, ShowsDashesBeforeAnythingCame) {
    m_clock.follow(m_stage.session, std::nullopt);
    EXPECT_FALSE(m_clock.headerMs().has_value());
    EXPECT_EQ(clockText(m_clock, ClockChoice::Header), QStringLiteral("--:--:--.---"));
    EXPECT_EQ(clockText(m_clock, ClockChoice::Type25), QStringLiteral("--:--:--.---"));
}

TEST_F(ClockHistoryTest, ShowsTheHeaderClockAndItsFrameRate) {
    sendPoses(0, 201);
    follow();
    EXPECT_EQ(clockText(m_clock, ClockChoice::Header), "10:00:02.000");
    EXPECT_EQ(m_clock.frameHz(), 100.0);
    EXPECT_FALSE(m_clock.lastJump().has_value());
}

TEST_F(ClockHistoryTest, FindsTheDriftOfTheSender) {
    sendPoses(0, 6000, 1.0 + 150e-6);
    follow();
    ASSERT_TRUE(m_clock.drift().has_value());
    EXPECT_NEAR(m_clock.drift()->skewPpm, 150, 3 * m_clock.drift()->errorPpm + 0.5);
    EXPECT_LT(m_clock.drift()->errorPpm, 2.0);
}

TEST_F(ClockHistoryTest, SaysNothingOfADriftThatItCannotKnowYet) {
    std::mt19937 random(5);
    for (std::uint32_t sample = 0; sample < 200; ++sample) { // each held up on its way
        m_stage.send(smallPose(), sample, m_firstMs + 60 * sample,
                     Stage::kStart + sample * 60ms + (random() % 50) * 1ms);
    }
    follow();
    EXPECT_FALSE(m_clock.drift().has_value());
    EXPECT_EQ(driftText(), "not yet known");
    sendPoses(200, 203);
    EXPECT_EQ(driftText(), "not yet known");
}

TEST_F(ClockHistoryTest, SaysThatThereIsNoDriftWhereTheClocksAgree) {
    sendPoses(0, 6000);
    follow();
    ASSERT_TRUE(m_clock.drift().has_value());
    EXPECT_TRUE(driftText().startsWith("none, ± ")) << driftText().toStdString();
}

TEST_F(ClockHistoryTest, SeesAJumpOfTheTimeCodeAndWhenItCame) {
    sendPoses(0, 300);
    m_firstMs -= 508;
    sendPoses(300, 600);
    follow();
    ASSERT_TRUE(m_clock.lastJump().has_value());
    EXPECT_NEAR(m_clock.lastJump()->milliseconds, -508, 1);
    EXPECT_EQ(m_clock.lastJump()->stamp, Stage::kStart + 3s);
    EXPECT_EQ(m_clock.frameHz(), 100.0);
}

TEST_F(ClockHistoryTest, TakesOneCorruptTimeCodeForNoJump) {
    sendPoses(0, 300);
    m_firstMs += 90'000;
    sendPoses(300, 301);
    m_firstMs -= 90'000;
    sendPoses(301, 600);
    follow();
    EXPECT_FALSE(m_clock.lastJump().has_value());
    EXPECT_EQ(m_clock.frameHz(), 100.0);
}

TEST_F(ClockHistoryTest, TakesMissingSamplesForNoJump) {
    sendPoses(0, 300);
    sendPoses(340, 600);
    follow();
    EXPECT_FALSE(m_clock.lastJump().has_value());
}

TEST_F(ClockHistoryTest, TakesReorderingForNoJump) {
    const auto sendOne = [this](std::uint32_t sample, std::uint32_t place) {
        m_stage.send(smallPose(), sample, m_firstMs + 10 * sample, Stage::kStart + place * 10ms);
    };
    for (std::uint32_t place = 0; place < 1200; ++place) {
        const bool isHeldBack = place % 50 == 20;
        const bool isLate = place % 50 == 45; // 250 ms after its turn
        sendOne(isHeldBack ? place + 1 : place, place);
        if (isLate) {
            sendOne(place - 25, place);
        }
    }
    follow();
    EXPECT_FALSE(m_clock.lastJump().has_value());
    EXPECT_EQ(m_clock.frameHz(), 100.0);
}

TEST_F(ClockHistoryTest, TakesWhatComesSecondsLateOrWithACorruptCounterForNoJump) {
    for (std::uint32_t place = 0; place < 1200; ++place) {
        const std::uint32_t off = place == 700 ? 1U << 20U : 0;
        m_stage.send(smallPose(), place ^ off, m_firstMs + 10 * place, Stage::kStart + place * 10ms);
        if (place % 250 == 240) { // 1.7 s after its turn
            m_stage.send(smallPose(), place - 170, m_firstMs + 10 * (place - 170),
                         Stage::kStart + place * 10ms + 1ms);
        }
    }
    follow();
    EXPECT_FALSE(m_clock.lastJump().has_value());
    EXPECT_EQ(m_clock.frameHz(), 100.0);
}

TEST_F(ClockHistoryTest, FollowsACounterThatRestarts) {
    sendPoses(0, 500);
    for (std::uint32_t sample = 1; sample < 300; ++sample) {
        m_stage.send(smallPose(), sample, m_firstMs + 60'000 + 10 * sample,
                     Stage::kStart + 5s + sample * 10ms);
    }
    follow();
    ASSERT_TRUE(m_clock.lastJump().has_value());
    EXPECT_NEAR(m_clock.lastJump()->milliseconds, 55'000, 200);
    EXPECT_EQ(m_clock.frameHz(), 100.0);
}

TEST_F(ClockHistoryTest, ReadsSamplesThatComeInParts) {
    for (std::uint32_t sample = 0; sample < 201; ++sample) {
        for (const std::uint8_t part : std::initializer_list<std::uint8_t>{0x00, 0x01, 0x82}) {
            m_stage.send(smallPose(), sample, m_firstMs + 10 * sample,
                         Stage::kStart + sample * 10ms + part % 0x80 * 1us, part);
        }
    }
    follow();
    EXPECT_EQ(clockText(m_clock, ClockChoice::Header), "10:00:02.000");
    EXPECT_EQ(m_clock.frameHz(), 100.0);
    EXPECT_FALSE(m_clock.lastJump().has_value());
}

TEST_F(ClockHistoryTest, ComparesType25WithItsOwnHeader) {
    sendPoses(0, 10);
    wire::TimeCode code;
    std::ranges::copy(std::string_view("10:42:17.511"), code.text.begin());
    m_stage.send(code, 10, (10 * 3600 + 42 * 60 + 17) * 1000 + 508, m_stage.now);
    follow();
    EXPECT_EQ(clockText(m_clock, ClockChoice::Type25), "10:42:17.511");
    ASSERT_TRUE(m_clock.offsetMs().has_value());
    EXPECT_DOUBLE_EQ(*m_clock.offsetMs(), 3.0);
}

TEST_F(ClockHistoryTest, KeepsTheOffsetShortAcrossMidnight) {
    sendPoses(0, 10);
    wire::TimeCode code;
    std::ranges::copy(std::string_view("00:00:00.100"), code.text.begin());
    m_stage.send(code, 10, 86'399'900, m_stage.now);
    follow();
    EXPECT_DOUBLE_EQ(*m_clock.offsetMs(), 200.0);
}

TEST_F(ClockHistoryTest, IgnoresAType25ThatIsNoTimeCode) {
    sendPoses(0, 10);
    wire::TimeCode code;
    std::ranges::copy(std::string_view("ten to eight"), code.text.begin());
    m_stage.send(code, 10, 5, m_stage.now);
    follow();
    EXPECT_FALSE(m_clock.type25().has_value());
    EXPECT_FALSE(m_clock.offsetMs().has_value());
}

TEST_F(ClockHistoryTest, ReadsAtTheCursor) {
    sendPoses(0, 400);
    follow();
    m_stage.session.setCursor({model::Cursor::Mode::Paused, 100});
    follow();
    EXPECT_EQ(clockText(m_clock, ClockChoice::Header), "10:00:01.000");
    EXPECT_EQ(m_clock.lastStamp(), Stage::kStart + 1s);
}

} // namespace

} // namespace posewire::gui
