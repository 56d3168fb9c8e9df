// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "tests/app/gui/models/recording_files.h"
#include "tests/support/manual_clock.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <thread>

namespace posewire::gui {
namespace {

using exporting::AlignBy;

class ComparingTest : public testing::Test {
protected:
    /// Frames from one to before another of a performer at 60 Hz.
    QString record(const QString& name, std::uint64_t from, std::uint64_t to, std::uint32_t firstSample = 1,
                   float higher = 0, std::uint32_t timeOfDay = 36'000'000) {
        performer::PerformerSettings settings = sending(1, {2, 12, 13}, 60);
        settings.firstSample = firstSample;
        settings.startTimeOfDayMs = timeOfDay;
        performer::Performer performer(settings);
        return recordFrames(m_folder.filePath(name), performer, from, to,
                            [=](auto& datagram) { raise(datagram, model::segment::kHead, higher); });
    }
    bool isSettled() {
        const ComparisonState& state = m_driver.files().comparing().state();
        return !m_driver.files().isOpening() && (!state.isOpen || !state.isWorking) &&
               (!state.isOpen || state.range != nullptr || !state.problem.isEmpty());
    }
    void settle() {
        for (int i = 0; i < 10'000; ++i) {
            m_driver.tick();
            if (isSettled()) {
                m_driver.tick(); // to the cursor
                return;
            }
            std::this_thread::sleep_for(1ms);
        }
        FAIL() << "it goes on and on";
    }
    const ComparisonState& state() { return m_driver.files().comparing().state(); }
    model::CharacterKey key() { return m_driver.commands().session().roster().characters()[0].key; }
    std::uint32_t sampleOf(model::SessionView& session) {
        return session.messages().pose(session.roster().characters()[0].key)->sample;
    }

    QTemporaryDir m_folder;
    log::ManualClock m_clock{log::asWallTime(Stage::kStart + 1h)};
    SessionDriver m_driver{m_clock};
};

TEST_F(ComparingTest, BothRecordingsShowTheSameMomentByTimeCode) {
    m_driver.files().open(record("a.pcapng", 0, 300));
    m_driver.files().comparing().open(record("b.pcapng", 20, 280, 5000, 0.010F));
    settle();
    ASSERT_TRUE(state().alignment);
    EXPECT_EQ(state().alignment->by, AlignBy::TimeCode);
    EXPECT_FALSE(state().atCursor) << "the second one ends before the end of the first";
    for (const double seconds : {1.0, 3.5, 0.5}) {
        m_driver.playback().seek(seconds);
        m_driver.tick();
        ASSERT_TRUE(state().atCursor) << seconds;
        EXPECT_EQ(sampleOf(*state().second), sampleOf(m_driver.commands().session()) + 4999);
        EXPECT_NEAR(state().atCursor->find(model::segment::kHead)->millimetres, 10, 0.05);
        EXPECT_NEAR(state().atCursor->meanMillimetres(), 10.0 / 23, 0.01);
    }
    ASSERT_NE(state().range, nullptr);
    EXPECT_EQ(state().range->pairs, 260U);
    EXPECT_EQ(state().range->outside, 40U);
    EXPECT_EQ(state().range->worst()->slot, model::segment::kHead);
}

TEST_F(ComparingTest, AMomentThatIsAskedForIsThatOfBothAtOnce) {
    m_driver.files().open(record("a.pcapng", 0, 300));
    m_driver.files().comparing().open(record("b.pcapng", 20, 280, 5000));
    settle();
    for (const auto moment : {1s, 3s, 2s}) {
        m_driver.playback().showMoment(Stage::kStart +
                                       moment); // no tick between, as a series of pictures does it
        ASSERT_TRUE(state().atCursor);
        EXPECT_EQ(sampleOf(*state().second), sampleOf(m_driver.commands().session()) + 4999);
    }
}

TEST_F(ComparingTest, TheOperatorMovesTheSecondOneByHand) {
    m_driver.files().open(record("a.pcapng", 0, 200));
    m_driver.files().comparing().open(record("b.pcapng", 0, 200, 301));
    settle();
    m_driver.playback().seek(1);
    m_driver.files().comparing().choose({.by = AlignBy::Sample, .offset = 310});
    settle();
    ASSERT_TRUE(state().atCursor);
    EXPECT_EQ(sampleOf(*state().second), sampleOf(m_driver.commands().session()) + 310);
    EXPECT_EQ(state().range->pairs, 190U);
    m_driver.files().comparing().choose({.by = AlignBy::Sample, .offset = 300});
    m_driver.tick();
    EXPECT_EQ(sampleOf(*state().second), sampleOf(m_driver.commands().session()) + 300) << "at once";
    settle();
    EXPECT_EQ(state().range->pairs, 200U);
    EXPECT_EQ(state().range->all.millimetres.most, 0);
}

TEST_F(ComparingTest, FiguresAreOfTheRangeThatWasChosen) {
    m_driver.files().open(record("a.pcapng", 0, 200));
    m_driver.files().comparing().open(record("b.pcapng", 0, 200));
    settle();
    EXPECT_EQ(state().range->pairs, 200U);
    m_driver.commands().selectRange({.fixed = model::TimeRange{Stage::kStart + 1s, Stage::kStart + 2s}});
    m_clock.advance(1min);
    m_driver.tick();
    settle();
    EXPECT_EQ(state().range->pairs, 60U);
}

TEST_F(ComparingTest, WhatHasNothingInCommonIsAlignedByBeginnings) {
    m_driver.files().open(record("a.pcapng", 0, 60));
    m_driver.files().comparing().open(record("b.pcapng", 0, 60, 9000, 0, 1'000));
    settle();
    EXPECT_EQ(state().alignment->by, AlignBy::Begin);
    EXPECT_EQ(state().range->pairs, 60U);
}

TEST_F(ComparingTest, ClosingEitherRecordingEndsIt) {
    const QString a = record("a.pcapng", 0, 60);
    const QString b = record("b.pcapng", 0, 60);
    for (const bool isFirst : {true, false}) {
        m_driver.files().open(a);
        m_driver.files().comparing().open(b);
        settle();
        if (isFirst) {
            m_driver.files().close();
        } else {
            m_driver.files().comparing().close();
        }
        m_driver.tick();
        EXPECT_FALSE(state().isOpen) << isFirst;
        EXPECT_EQ(state().second, nullptr);
    }
}

TEST_F(ComparingTest, ClosingWhileItIsWorkedOutWaitsForNobody) {
    const QString a = record("a.pcapng", 0, 2000);
    const QString b = record("b.pcapng", 0, 2000);
    m_driver.files().open(a);
    m_driver.files().comparing().open(b);
    while (state().range == nullptr && !state().isWorking) {
        m_driver.tick();
    }
    m_driver.files().close();
    m_driver.files().open(a);
    m_driver.files().comparing().open(b);
    settle();
    EXPECT_EQ(state().range->pairs, 2000U);
    m_driver.files().comparing().choose({.frame = model::DifferenceFrame::Pelvis});
    m_driver.tick();
    m_driver.files().comparing().stop();
    EXPECT_TRUE(state().isStopped);
    m_driver.tick();
    EXPECT_FALSE(state().isWorking);
    m_driver.files().comparing().workAgain();
    settle();
    EXPECT_FALSE(state().isStopped);
    m_driver.files().comparing().close();
}

TEST_F(ComparingTest, WhatWasStoppedStaysSoWhereOnlyTheBodyMovesAside) {
    m_driver.files().open(record("a.pcapng", 0, 2000));
    m_driver.files().comparing().open(record("b.pcapng", 0, 2000));
    settle();
    ComparisonChoice choice = state().choice;
    choice.frame = model::DifferenceFrame::Pelvis;
    m_driver.files().comparing().choose(choice);
    m_driver.tick(); // begins to work it out
    m_driver.files().comparing().stop();
    ASSERT_TRUE(state().isStopped);
    choice.isBeside = true;
    m_driver.files().comparing().choose(choice);
    m_driver.tick();
    EXPECT_TRUE(state().isStopped);
    EXPECT_TRUE(state().choice.isBeside);
    choice.frame = model::DifferenceFrame::World;
    m_driver.files().comparing().choose(choice);
    EXPECT_FALSE(state().isStopped) << "other figures are wanted";
}

TEST_F(ComparingTest, SaysWhatIsWrongWithTheSecondRecording) {
    m_driver.files().open(record("a.pcapng", 0, 60));
    settle();
    QSignalSpy spy(&m_driver.files().comparing(), &Comparing::changed);
    m_driver.files().comparing().open(m_folder.filePath("missing.pcapng"));
    settle();
    EXPECT_FALSE(state().isOpen);
    EXPECT_TRUE(spy.back()[0].toString().contains("missing.pcapng"));

    QFile noise(m_folder.filePath("noise.pcapng"));
    ASSERT_TRUE(noise.open(QIODevice::WriteOnly));
    noise.write(QByteArray(2000, 'x'));
    noise.close();
    m_driver.files().comparing().open(noise.fileName());
    settle();
    EXPECT_TRUE(!state().isOpen || !state().problem.isEmpty());
    EXPECT_EQ(state().range, nullptr);
}

TEST_F(ComparingTest, SaysWhereThereIsNoPose) {
    performer::Performer performer(sending(1, {12, 23}, 60));
    const QString path = recordFrames(m_folder.filePath("names.pcapng"), performer, 0, 30);
    m_driver.files().open(record("a.pcapng", 0, 60));
    m_driver.files().comparing().open(path);
    settle();
    EXPECT_TRUE(state().problem.contains("types 01, 02, 05, 21, 22, 03")) << state().problem.toStdString();
    EXPECT_TRUE(state().problem.contains("names.pcapng"));
}

TEST_F(ComparingTest, SavesTheDifferences) {
    QSignalSpy spy(&m_driver.files().comparing(), &Comparing::changed);
    m_driver.files().comparing().save(m_folder.filePath("none.csv"));
    EXPECT_FALSE(spy.back()[0].toString().isEmpty()) << "there is nothing to save";
    m_driver.files().open(record("a.pcapng", 0, 60));
    m_driver.files().comparing().open(record("b.pcapng", 0, 60, 1, 0.010F));
    settle();
    const QString path = m_folder.filePath("difference.csv");
    spy.clear();
    m_driver.files().comparing().save(path);
    for (int i = 0; i < 5000 && spy.isEmpty(); ++i) {
        m_driver.tick();
        std::this_thread::sleep_for(1ms);
    }
    ASSERT_FALSE(spy.isEmpty());
    EXPECT_TRUE(spy.back()[0].toString().contains("difference.csv"));
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(file.readAll().count("\r\n"), 61);
}

TEST_F(ComparingTest, KeepsHowItIsLaidOverFromOneRecordingToTheNext) {
    m_driver.files().comparing().choose({.frame = model::DifferenceFrame::Heading, .isBeside = true});
    m_driver.files().comparing().open(record("b.pcapng", 0, 60));
    m_driver.files().comparing().choose(
        {.by = AlignBy::Sample, .offset = 3, .frame = model::DifferenceFrame::Heading});
    m_driver.files().comparing().open(record("c.pcapng", 0, 60));
    EXPECT_EQ(state().choice, (ComparisonChoice{.frame = model::DifferenceFrame::Heading}));
}

} // namespace
} // namespace posewire::gui
