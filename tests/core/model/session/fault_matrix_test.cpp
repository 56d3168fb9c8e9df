// SPDX-License-Identifier: MIT
#include "core/model/session/fault_matrix.h"

#include "core/model/session/listed_incidents.h"
#include "core/model/session/roster.h"
#include "tests/core/model/incidents/incidents_fixture.h"

#include <functional>

namespace posewire::model {
namespace {

constexpr auto kNetwork = static_cast<std::size_t>(LossCause::Network);

class FaultMatrixTest : public IncidentsTest {
protected:
    /// One sample of a character in types 02 and 20, or in the first alone.
    void sample(std::uint8_t character, std::uint32_t number, bool isWhole,
                const std::string& address = "127.0.0.1:40001") {
        one(character, number, swayingAt(0, number), address);
        if (isWhole) {
            one(character, number, wire::JointAngles{}, address);
        }
    }
    void samples(
        std::uint8_t character, std::uint32_t first, std::uint32_t last,
        const std::function<bool(std::uint32_t)>& isWhole = [](std::uint32_t) { return true; },
        const std::string& address = "127.0.0.1:40001") {
        for (std::uint32_t number = first; number <= last; ++number, m_at += 10ms) {
            sample(character, number, isWhole(number), address);
        }
    }
    FaultMatrix matrix(const std::optional<TimeRange>& range = {}) {
        follow();
        return faultMatrix(m_session, range);
    }

    /// The first of several datagrams of a sample of type 02.
    void part(std::uint32_t number) { one(0, number, swayingAt(0, number), "127.0.0.1:40001", 0x00); }

private:
    void one(std::uint8_t character, std::uint32_t number, wire::Body body, const std::string& address,
             std::uint8_t datagramCounter = 0x80) {
        wire::Datagram datagram{{}, std::move(body), {}};
        datagram.header.sampleCounter = number;
        datagram.header.datagramCounter = datagramCounter;
        datagram.header.character = character;
        datagram.header.timeCode = static_cast<std::uint32_t>(m_at.time_since_epoch() / 1ms);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, address);
    }
};

TEST_F(FaultMatrixTest, IsEmptyBeforeAnythingCame) {
    EXPECT_TRUE(matrix().characters.empty());
    EXPECT_FALSE(matrix().unconfirmed.has_value());
    EXPECT_EQ(matrix().sum.total(), 0U);
}

TEST_F(FaultMatrixTest, SumsStreamsByCauseAmongWhatWasExpected) {
    samples(0, 1, 400, [](std::uint32_t number) { return number % 100 != 50; });
    const FaultMatrix all = matrix();
    ASSERT_EQ(all.characters.size(), 1U);
    const CharacterFaults& character = all.characters[0];
    ASSERT_EQ(character.streams.size(), 2U);
    EXPECT_EQ(character.streams[0].type, 2);
    EXPECT_EQ(character.streams[0].counts.total(), 0U);
    EXPECT_EQ(character.streams[1].counts.lost[kNetwork], 4U);
    EXPECT_EQ(character.streams[1].counts.expected, 400U);
    EXPECT_DOUBLE_EQ(character.streams[1].counts.shareOf(4), 0.01);
    EXPECT_EQ(character.counts.lost[kNetwork], 4U);
    EXPECT_EQ(all.sum.total(), 4U);
    EXPECT_EQ(all.sum.expected, 800U);
}

TEST_F(FaultMatrixTest, LeavesOutASampleOfWhichTheRestMayJustCome) {
    samples(0, 1, 100);
    part(101);
    EXPECT_EQ(matrix().sum.total(), 0U);
    EXPECT_EQ(matrix(TimeRange{m_at - 500ms, m_at + 1s}).sum.total(), 0U);
    EXPECT_EQ(matrix().sum.expected, 200U);
    EXPECT_TRUE(listedIncidents(m_session).empty());
    m_at += 10ms;
    samples(0, 102, 102);
    EXPECT_EQ(matrix().characters[0].counts.pending, 2U) << "and type 20 has none at all";
    m_at += 10ms;
    samples(0, 103, 200);
    EXPECT_EQ(matrix().sum.lost[kNetwork], 2U);
}

TEST_F(FaultMatrixTest, CountsOnlyWhatIsInTheRange) {
    samples(0, 1, 400, [](std::uint32_t number) { return number != 100 && number != 300; });
    const FaultMatrix half = matrix(TimeRange{log::Stamp(102s), log::Stamp(104s)});
    EXPECT_EQ(half.sum.lost[kNetwork], 1U);
    EXPECT_EQ(half.sum.expected, 400U);
}

TEST_F(FaultMatrixTest, WhoseLossTheRestOfASampleWasIsKnownInARangeToo) {
    samples(0, 1, 300);
    send(standingAt(0), 301, m_at, 0x00); // its second part never comes
    send(wire::ScaleInformation{}, 0, m_at, 0x00);
    m_at += 10ms;
    samples(0, 302, 400);
    const auto ofAll = matrix().sum.lost;
    EXPECT_EQ(ofAll[kNetwork], 2U) << "part of a sample, and its other type";
    EXPECT_EQ(matrix().characters[0].streams[1].counts.total(), 1U) << "a message is no sample";
    EXPECT_EQ(matrix(TimeRange{log::Stamp(0s), m_now + 1s}).sum.lost, ofAll);
}

TEST_F(FaultMatrixTest, ACharacterIsOneRowThroughARestartOfItsSender) {
    const auto isWhole = [](std::uint32_t number) { return number != 100; };
    samples(0, 1, 200, isWhole);
    m_at += 2s;
    samples(0, 1, 200, isWhole, "127.0.0.1:40002");
    const FaultMatrix all = matrix();
    ASSERT_EQ(all.characters.size(), 1U);
    EXPECT_EQ(all.characters[0].first, key());
    EXPECT_EQ(all.characters[0].current, (CharacterKey{sender("127.0.0.1:40002"), 0}));
    ASSERT_EQ(all.characters[0].streams.size(), 2U);
    EXPECT_EQ(all.characters[0].streams[1].counts.total(), 2U);
    EXPECT_EQ(all.characters[0].streams[1].streams.size(), 2U);
    EXPECT_EQ(all.sum.expected, 800U);
}

TEST_F(FaultMatrixTest, WhoIsNotConfirmedCountsApart) {
    samples(0, 1, 300);
    sample(66, 301, false);
    samples(0, 302, 400);
    const FaultMatrix all = matrix();
    ASSERT_EQ(all.characters.size(), 1U);
    ASSERT_TRUE(all.unconfirmed.has_value());
    EXPECT_EQ(all.unconfirmed->counts.expected, 1U);
}

TEST_F(FaultMatrixTest, WhatIsNotHereYetIsNobodysLoss) {
    samples(0, 1, 300);
    m_at += 50ms;
    samples(0, 306, 306);
    FaultMatrix all = matrix();
    EXPECT_EQ(all.sum.total(), 0U);
    EXPECT_EQ(all.sum.pending, 10U);
    const Stream& stream = m_session.roster().streams().front();
    const StreamFigures figures = Losses(m_session, {}).figuresOf(stream);
    EXPECT_EQ(figures.count(Figure::LostUnknown), 0U) << "statistics and report say no more than the matrix";
    for (const Figure figure : {Figure::Lost, Figure::Missing, Figure::LossShare, Figure::LongestGap}) {
        EXPECT_EQ(figures.orZero(figure), 0) << rowOf(figure).title;
        EXPECT_GT(figuresOf(stream).orZero(figure), 0) << rowOf(figure).title;
    }
    EXPECT_EQ(figuresOf(stream).count(Figure::LostUnknown), 5U) << "causes of scripts sum up to what is lost";
    EXPECT_EQ(matrix(TimeRange{log::Stamp(100s), log::Stamp(102s)}).sum.pending, 0U);
    samples(0, 307, 360);
    all = matrix();
    EXPECT_EQ(all.sum.total(), 10U);
    EXPECT_EQ(all.sum.pending, 0U);
}

TEST_F(FaultMatrixTest, WhatIsNotHereYetIsNoLossOverTimeEither) {
    samples(0, 1, 100);
    samples(0, 103, 300);
    m_at += 50ms;
    samples(0, 306, 306);
    follow();
    const Stream& stream = m_session.roster().streams().front();
    const RangeParts parts = partsOf({log::Stamp(100s), m_at}, 100, 100ms, stream.accounting.resolution());
    std::vector<RangePart> counted(parts.count);
    const Losses losses(m_session, {});
    losses.addParts(stream, parts, counted);
    std::uint32_t lost = 0;
    std::uint32_t came = 0;
    for (const RangePart& part : counted) {
        lost += part.lost;
        came += part.samples;
    }
    EXPECT_EQ(came, 299U);
    EXPECT_EQ(lost, 2U) << "those that are settled";
    EXPECT_EQ(losses.longestGapOf(stream), 2U);
    EXPECT_EQ(stream.accounting.counts().longestGapSamples, 5U);
}

TEST_F(FaultMatrixTest, SumsUpToWhatTheStreamsLostWhateverTheCause) {
    samples(0, 1, 300, [](std::uint32_t number) { return number % 7 != 0; });
    m_at += 100ms;
    samples(0, 311, 600);
    LossesByCause lost{};
    follow();
    for (const Stream& stream : m_session.roster().streams()) {
        std::ranges::transform(lost, stream.lostByCause(), lost.begin(), std::plus());
    }
    const FaultMatrix all = matrix();
    EXPECT_EQ(all.sum.lost, lost);
    EXPECT_EQ(all.sum.lost[static_cast<std::size_t>(LossCause::Sender)], 20U);
}

} // namespace
} // namespace posewire::model
