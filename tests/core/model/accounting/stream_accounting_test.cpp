// SPDX-License-Identifier: MIT
#include "tests/core/model/accounting/accounting_fixture.h"

#include <cmath>

namespace posewire::model {
namespace {

TEST_F(Accounting, CountsASteadyStreamWithoutLoss) {
    sendSteady(7, 506);
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.datagrams, 500U);
    EXPECT_EQ(counts.bytes, 500U * 760);
    EXPECT_EQ(counts.samples, 500U);
    EXPECT_EQ(counts.lost + counts.duplicates + counts.reordered + counts.late + counts.incomplete, 0U);
    EXPECT_EQ(counts.step, 1U);
    EXPECT_EQ(counts.firstSample, 7U);
    EXPECT_EQ(counts.lastSample, 506U);
}

TEST_F(Accounting, IsRightFromTheSecondSampleOn) {
    sendAll({12});
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().step, 0U);
    sendAll({16});
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().step, 4U);
    sendAll({17});
    EXPECT_EQ(stream.counts().step, 1U);
    EXPECT_EQ(stream.counts().lost, 3U);
}

TEST_F(Accounting, TakesSteadySpacingForNoLoss) {
    sendSteady(0, 400, 4);
    sendAll({412, 416});
    EXPECT_EQ(stream.counts().step, 4U);
    EXPECT_EQ(stream.counts().lost, 2U);
    EXPECT_EQ(stream.counts().longestGapSamples, 2U);
}

TEST_F(Accounting, CountsNothingAsLostInAnIrregularStream) {
    constexpr std::uint32_t moves[] = {2, 4, 2, 3, 1, 2, 3, 4, 2, 3};
    std::uint32_t sample = 100;
    for (int i = 0; i < 300; ++i) {
        send(sample += moves[i % 10]);
    }
    EXPECT_EQ(stream.counts().step, 0U);
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().samples, 300U);
    EXPECT_EQ(stream.counts().longestGapSamples, 4U);
    EXPECT_EQ(stream.countsBetween({}, at(100s)).longestGapSamples, 4U);
}

TEST_F(Accounting, TakesAStepForOneWhereNineTenthsAreMultiplesOfIt) {
    // 58 of 64 differences are multiples of 2, then 57.
    constexpr std::uint32_t odd[] = {3, 1, 5, 3, 1, 5, 3};
    std::uint32_t sample = 100;
    const auto sendPattern = [&](std::uint32_t fractions) {
        for (std::uint32_t i = 0; i < 64; ++i) {
            send(sample += i < fractions ? odd[i] : 2 + i % 2 * 2);
        }
    };
    send(sample);
    sendPattern(6);
    EXPECT_EQ(stream.counts().step, 2U);
    stream = StreamAccounting();
    sample = 100;
    send(sample);
    sendPattern(7);
    EXPECT_EQ(stream.counts().step, 0U);
}

TEST_F(Accounting, TakesADifferenceForNoStepThatIsRarerThanTwoFifths) {
    // All are multiples of 1, which is the most frequent with 25 and 26 of 64.
    for (const std::uint32_t ones : {25U, 26U}) {
        stream = StreamAccounting();
        std::uint32_t sample = 100;
        send(sample);
        for (std::uint32_t i = 0; i < 64; ++i) {
            send(sample += i < ones ? 1 : 2 + i % 3);
        }
        EXPECT_EQ(stream.counts().step, ones == 26 ? 1U : 0U) << ones;
    }
}

TEST_F(Accounting, HoldsAStepWhileThreeFifthsAreMultiplesOfIt) {
    sendSteady(0, 400, 2);
    std::uint32_t sample = 400;
    for (std::uint32_t i = 0; i < 25; ++i) { // 39 of 64 are multiples of 2
        send(sample += 3);
    }
    EXPECT_EQ(stream.counts().step, 2U);
    send(sample += 3);
    EXPECT_EQ(stream.counts().step, 0U);
}

TEST_F(Accounting, HoldsAStepWhileOneFifthIsEqualToIt) {
    sendSteady(1, 200);
    std::uint32_t sample = 200;
    for (std::uint32_t i = 0; i < 51; ++i) { // 13 of 64 are 1
        send(sample += 2);
    }
    EXPECT_EQ(stream.counts().step, 1U);
    EXPECT_EQ(stream.counts().lost, 51U);
    send(sample += 2);
    EXPECT_EQ(stream.counts().step, 0U);
    EXPECT_EQ(stream.counts().lost, 0U);
    for (std::uint32_t i = 0; i < 6; ++i) { // nine tenths are multiples of 2
        send(sample += 2);
    }
    EXPECT_EQ(stream.counts().step, 2U);
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().longestGapSamples, 0U);
}

TEST_F(Accounting, CountsNoLossWhileAStreamIsIrregular) {
    sendSteady(1, 200);
    send(203); // two are lost before
    sendSteady(204, 300);
    std::uint32_t sample = 300;
    for (std::uint32_t i = 0; i < 200; ++i) {
        send(sample += 2 + i * 7 % 3);
    }
    EXPECT_EQ(stream.counts().step, 0U);
    EXPECT_EQ(stream.counts().lost, 2U);
    EXPECT_EQ(stream.counts().longestGapSamples, 4U);
    sendSteady(sample + 1, sample + 150);
    EXPECT_EQ(stream.counts().step, 1U);
    EXPECT_EQ(stream.counts().lost, 2U);
    send(sample + 156);
    EXPECT_EQ(stream.counts().lost, 7U);
    EXPECT_EQ(stream.countsBetween({}, at(100s)).lost, 7U);
}

TEST_F(Accounting, CountsTheFirstSamplesInHindsight) {
    sendAll({10, 13, 15, 16, 17, 18, 19, 20});
    EXPECT_EQ(stream.counts().step, 1U);
    EXPECT_EQ(stream.counts().lost, 3U);
}

TEST_F(Accounting, CountsNoLossInAShortIrregularStretchEither) {
    for (const std::uint32_t rarity : {4U, 10U}) {
        stream = StreamAccounting();
        sendSteady(1, 200);
        std::uint32_t sample = 200;
        for (std::uint32_t i = 0; i < 60; ++i) {
            send(sample += i % rarity == 0 ? 1 : 2 + i % 3);
        }
        const std::uint32_t received = 260;
        EXPECT_EQ(stream.counts().step, rarity == 4 ? 1U : 0U);
        sendSteady(sample + 1, sample + 200);
        EXPECT_EQ(stream.counts().step, 1U);
        EXPECT_EQ(stream.counts().lost, rarity == 4 ? sample - received : 0U);
    }
}

TEST_F(Accounting, ForgetsCountersOfBeforeARestart) {
    sendSteady(90'000, 90'200);
    sendSteady(1, 20);
    sendAll({90'150, 21, 90'151, 22, 23, 24});
    EXPECT_EQ(stream.counts().duplicates, 0U);
    EXPECT_EQ(stream.counts().samples, 201U + 24U);
    sendSteady(90'000, 90'010); // and once more
    EXPECT_EQ(stream.counts().restarts, 2U);
    EXPECT_EQ(stream.counts().duplicates, 0U);
}

TEST_F(Accounting, FindsADecimatedStreamIrregular) {
    for (std::uint32_t i = 0; i < 300; ++i) {
        send(i * 5 / 3);
    }
    EXPECT_EQ(stream.counts().step, 0U);
    EXPECT_EQ(stream.counts().lost, 0U);
}

TEST_F(Accounting, TellsLostDuplicateAndReorderedApart) {
    sendSteady(1, 20);
    sendAll({22, 21, 21, 23, 27});
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.lost, 3U);
    EXPECT_EQ(counts.duplicates, 1U);
    EXPECT_EQ(counts.reordered, 1U);
    EXPECT_EQ(counts.late, 0U);
    EXPECT_EQ(counts.samples, 24U);
}

TEST_F(Accounting, CallsALateArrivalLateByTheFirstLargerOne) {
    sendSteady(1, 20);
    send(22);
    stamp += 46ms; // 50 ms after 22 arrived: not above 50 ms
    send(21);
    EXPECT_EQ(stream.counts().late, 0U);
    send(24);
    stamp += 46ms + 1ns;
    send(23);
    EXPECT_EQ(stream.counts().late, 1U);
    EXPECT_EQ(stream.counts().reordered, 2U);
    EXPECT_EQ(stream.counts().lost, 0U);
}

TEST_F(Accounting, LowersTheFirstSampleByWhatComesLater) {
    sendAll({10, 8, 11, 12, 13});
    EXPECT_EQ(stream.counts().firstSample, 8U);
    EXPECT_EQ(stream.counts().lost, 1U);
}

TEST_F(Accounting, CountsPartsOfSamples) {
    send(1, 0x00);
    send(1, 0x81);
    send(2, 0x00); // its second part is lost
    send(3, 0x81);
    EXPECT_EQ(stream.counts().samples, 1U);
    EXPECT_EQ(stream.counts().incomplete, 2U);
    send(3, 0x00);
    EXPECT_EQ(stream.counts().samples, 2U);
    EXPECT_EQ(stream.counts().incomplete, 1U);
    EXPECT_EQ(stream.counts().reordered, 0U);
    send(2, 0x81);
    EXPECT_EQ(stream.counts().incomplete, 0U);
    EXPECT_EQ(stream.counts().reordered, 1U);
    send(2, 0x81);
    EXPECT_EQ(stream.counts().duplicates, 1U);
    EXPECT_EQ(stream.counts().datagrams, 7U);
    EXPECT_EQ(stream.counts().lost, 0U);
}

TEST_F(Accounting, CountsSamplesOfManyParts) {
    for (std::uint8_t part = 0; part < 127; ++part) {
        send(5, part);
    }
    EXPECT_EQ(stream.counts().incomplete, 1U);
    send(5, 0xff);
    EXPECT_EQ(stream.counts().samples, 1U);
    EXPECT_EQ(stream.counts().incomplete, 0U);
}

TEST_F(Accounting, TakesAJumpBackForARestartWithoutLoss) {
    sendSteady(50'000, 50'300);
    EXPECT_TRUE(send(7).empty());
    const auto verdicts = send(8);
    ASSERT_EQ(verdicts.size(), 2U);
    EXPECT_TRUE(verdicts[0].isRestart);
    EXPECT_FALSE(verdicts[1].isRestart);
    sendSteady(9, 40);
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.restarts, 1U);
    EXPECT_EQ(counts.lost, 0U);
    EXPECT_EQ(counts.samples, 301U + 34U);
    EXPECT_EQ(counts.firstSample, 50'000U);
    EXPECT_EQ(counts.lastSample, 40U);
}

TEST_F(Accounting, TakesAJumpBackAmongKnownSamplesForARestartToo) {
    sendSteady(1, 480);
    sendSteady(1, 3);
    EXPECT_EQ(stream.counts().restarts, 1U); // likely already
    EXPECT_EQ(stream.counts().samples, 483U);
    sendSteady(4, 480);
    EXPECT_EQ(stream.counts().restarts, 1U);
    EXPECT_EQ(stream.counts().samples, 960U);
    EXPECT_EQ(stream.counts().duplicates, 0U);
}

TEST_F(Accounting, TakesAFarJumpForwardForARestartWithoutLoss) {
    sendSteady(1, 50);
    sendSteady(3'052, 3'100);
    EXPECT_EQ(stream.counts().restarts, 1U);
    EXPECT_EQ(stream.counts().lost, 0U);
}

TEST_F(Accounting, CountsANearJumpForwardAsLost) {
    sendSteady(1, 50);
    sendSteady(3'050, 3'100);
    EXPECT_EQ(stream.counts().restarts, 0U);
    EXPECT_EQ(stream.counts().lost, 2'999U);
    EXPECT_EQ(stream.counts().longestGapSamples, 2'999U);
}

TEST_F(Accounting, CountsACorruptCounterAsNoSample) {
    sendSteady(1, 50);
    sendAll({0x80000033, 52, 53, 54, 55, 7'000'000, 57, 58, 59});
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.datagrams, 59U);
    EXPECT_EQ(counts.samples, 57U);
    EXPECT_EQ(counts.lost, 2U);
    EXPECT_EQ(counts.restarts, 0U);
}

TEST_F(Accounting, TakesAnOldSampleForReordered) {
    sendSteady(1, 100);
    sendSteady(102, 400);
    sendAll({101, 401, 101, 402, 403, 404});
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.lost, 0U);
    EXPECT_EQ(counts.reordered, 1U);
    EXPECT_EQ(counts.late, 1U);
    EXPECT_EQ(counts.duplicates, 1U);
    EXPECT_EQ(counts.restarts, 0U);
}

TEST_F(Accounting, CountsAStragglerOfBeforeARestartThere) {
    sendSteady(90'000, 90'100);
    sendSteady(90'102, 90'200);
    sendSteady(1, 20);
    sendAll({90'101, 21, 22, 23, 24});
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.restarts, 1U);
    EXPECT_EQ(counts.lost, 0U);
    EXPECT_EQ(counts.samples, 201U + 24U);
    EXPECT_EQ(counts.reordered, 1U);
}

TEST_F(Accounting, SortsARestartThatOvertakesTheEnd) {
    sendSteady(90'000, 90'098);
    sendAll({1, 90'099, 2, 90'100, 3, 4, 5, 6});
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.restarts, 1U);
    EXPECT_EQ(counts.samples, 107U);
    EXPECT_EQ(counts.lost, 0U);
}

TEST_F(Accounting, PassesTheWrapOfTheCounter) {
    sendSteady(0xffffff00U, 0x100U);
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.samples, 513U);
    EXPECT_EQ(counts.lost + counts.restarts, 0U);
    EXPECT_EQ(counts.firstSample, 0xffffff00U);
    EXPECT_EQ(counts.lastSample, 0x100U);
}

TEST_F(Accounting, BeginsANewRunWhereTheStepChanges) {
    sendSteady(1, 200);
    sendSteady(202, 400, 2);
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().step, 2U);
    sendSteady(403, 700, 3);
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().step, 3U);
    sendSteady(701, 800);
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().step, 1U);
    EXPECT_EQ(stream.counts().restarts, 0U);
    EXPECT_EQ(stream.counts().samples, 200U + 100U + 100U + 100U);
}

TEST_F(Accounting, KeepsTheStepThroughHeavyLoss) {
    std::uint32_t random = 1;
    std::uint32_t lost = 0;
    send(0);
    for (std::uint32_t sample = 1; sample < 3'000; ++sample) {
        random = random * 1'664'525 + 1'013'904'223;
        if ((random >> 16 & 1) != 0 || sample == 2'999) {
            send(sample);
        } else {
            ++lost;
        }
    }
    EXPECT_EQ(stream.counts().step, 1U);
    EXPECT_EQ(stream.counts().lost, lost);
}

TEST_F(Accounting, KeepsItsMemoryOfManySamples) {
    sendSteady(1, 3'000);
    sendSteady(3'002, 7'000);
    sendAll({3'001, 7'001, 3'001, 7'002, 7'003, 7'004});
    EXPECT_EQ(stream.counts().reordered, 1U);
    EXPECT_EQ(stream.counts().duplicates, 1U);
    EXPECT_EQ(stream.counts().lost, 0U);
}

TEST_F(Accounting, SeesNoRestartInDelayedDatagrams) {
    // Every tenth comes 300 samples late, some of them one right behind the other.
    std::uint64_t sent = 0;
    for (std::uint32_t sample = 1; sample <= 3'000; ++sample) {
        if (sample % 10 > 1 || sample > 2'500) {
            send(sample);
            ++sent;
        }
        if (sample > 320 && sample % 10 == 5) {
            const std::uint32_t old = sample - 305;
            if (old < 2'500) {
                send(old);
                send(old + 1);
                sent += 2;
            }
        }
    }
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.restarts, 0U);
    EXPECT_EQ(counts.samples, sent);
    EXPECT_EQ(counts.duplicates, 0U);
    EXPECT_EQ(counts.late, counts.reordered);
}

TEST(MessagesSentAgain, CountOnlyDatagramsAndIncompleteOnes) {
    StreamAccounting stream(13);
    log::Stamp stamp{};
    const auto send = [&](std::uint8_t datagramCounter) {
        wire::Header header;
        header.datagramCounter = datagramCounter;
        header.timeCode = static_cast<std::uint32_t>((stamp += 1ms).time_since_epoch() / 1ms);
        addTo(stream, stamp, 500, header);
    };
    for (const std::uint8_t counter : std::initializer_list<std::uint8_t>{0x00, 0x82, 0x01}) { // out of order
        send(counter);
    }
    EXPECT_EQ(stream.counts().incomplete, 0U);
    stamp += 1s;
    for (const std::uint8_t counter :
         std::initializer_list<std::uint8_t>{0x00, 0x00, 0x82}) { // one twice, one lost
        send(counter);
    }
    EXPECT_EQ(stream.counts().incomplete, 2U); // the repeated index began a message
    stamp += 1s;
    for (const std::uint8_t counter : std::initializer_list<std::uint8_t>{0x01, 0x82}) {
        send(counter);
    }
    EXPECT_EQ(stream.counts().incomplete, 3U);
    EXPECT_EQ(stream.counts().datagrams, 8U);
    EXPECT_EQ(stream.counts().samples + stream.counts().duplicates + stream.counts().lost, 0U);
}

TEST(MessagesSentAgain, BelongTogetherWithinAQuarterOfASecond) {
    StreamAccounting stream(13);
    const auto send = [&](log::Duration time, std::uint8_t datagramCounter) {
        wire::Header header;
        header.datagramCounter = datagramCounter;
        header.timeCode = static_cast<std::uint32_t>(time / 1ms);
        addTo(stream, at(time), 500, header);
        return stream.counts().incomplete;
    };
    send(1'000ms, 0x00);
    send(1'150ms, 0x01);
    EXPECT_EQ(send(1'250ms, 0x82), 0U);
    send(2'000ms, 0x00);
    send(2'150ms, 0x01);
    EXPECT_EQ(send(2'251ms, 0x82), 2U); // too late for the first
    // The next message begins at once where an index comes again.
    send(3'000ms, 0x00);
    send(3'001ms, 0x82);
    send(3'002ms, 0x00);
    send(3'003ms, 0x01);
    EXPECT_EQ(send(3'004ms, 0x82), 3U);
}

TEST_F(Accounting, GivesTheSameFiguresForARangeOfTime) {
    sendSteady(1, 250); // 1 s
    sendSteady(261, 500);
    sendAll({255, 256});
    sendSteady(501, 750);
    const auto before = stream.countsBetween(at(1s), at(2s));
    EXPECT_EQ(before.samples, 250U);
    EXPECT_EQ(before.lost, 0U);
    const auto after = stream.countsBetween(at(2s), at(3s));
    EXPECT_EQ(after.lost, 8U); // those that came late are no loss any more
    EXPECT_EQ(after.longestGapSamples, 10U);
    const auto all = stream.countsBetween({}, at(100s));
    const auto counts = stream.counts();
    EXPECT_EQ(all.samples, counts.samples);
    EXPECT_EQ(all.lost, counts.lost);
    EXPECT_EQ(all.datagrams, counts.datagrams);
    EXPECT_EQ(all.bytes, counts.bytes);
    EXPECT_EQ(all.reordered, 2U);
}

TEST_F(Accounting, KeepsRangesOfALongStreamInBoundedMemory) {
    wire::Header header;
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        header.sampleCounter = i + (i >= 50'000 ? 5 : 0);
        addTo(stream, at(i * 100ms), 100, header);
    }
    EXPECT_GT(stream.resolution(), 4s);
    EXPECT_EQ(stream.countsBetween({}, at(20'000s)).lost, 5U);
    EXPECT_EQ(stream.countsBetween({}, at(4'900s)).lost, 0U);
    EXPECT_EQ(stream.countsBetween(at(4'900s), at(5'100s)).lost, 5U);
    EXPECT_NEAR(stream.interArrival().meanMs, 100, 1e-6);
    EXPECT_NEAR(stream.interArrival().deviationMs, 0, 1e-3);
}

TEST_F(Accounting, TakesTheSpacingOfItsLastSamplesForAStepIfItEndsWithThem) {
    for (const bool isRestart : {false, true}) {
        SCOPED_TRACE(isRestart);
        stream = StreamAccounting(2);
        sendSteady(1, 240);
        sendSteady(242, 300, 2);
        EXPECT_EQ(stream.counts().lost, 30U) << "as far as is known";
        if (isRestart) {
            sendSteady(5000, 5300, 2);
        }
        stream.conclude();
        EXPECT_EQ(stream.counts().lost, 0U);
        EXPECT_EQ(stream.countsBetween(at(0s), at(1h)).lost, 0U);
    }
}

TEST_F(Accounting, TakesAFewEvenGapsAtTheEndForLoss) {
    sendSteady(1, 240);
    sendSteady(242, 248, 2);
    stream.conclude();
    EXPECT_EQ(stream.counts().lost, 4U);
}

TEST_F(Accounting, FindsBurstsAndGapsOfLoss) {
    sendSteady(1, 100);
    sendAll({102, 104, 106}); // a burst of three lost among five
    sendSteady(107, 200);
    sendSteady(202, 300); // one alone
    const LossPattern pattern = stream.lossPattern();
    EXPECT_EQ(pattern.bursts, 1U);
    EXPECT_NEAR(pattern.burstDensity, 3.0 / 5, 1e-9);
    EXPECT_NEAR(pattern.meanBurstSamples, 5, 1e-9);
    EXPECT_NEAR(pattern.gapDensity, 1.0 / 295, 1e-9);
}

TEST_F(Accounting, MeasuresJitterAndSkewOfTheSendersClock) {
    wire::Header header;
    for (std::uint32_t i = 0; i < 6'000; ++i) { // 60 s; the sender's clock gains 200 ppm
        header.sampleCounter = i;
        header.timeCode = static_cast<std::uint32_t>(std::lround(i * 10 * 1.0002));
        const log::Duration delay = i % 2 == 0 ? 0ms : 2ms;
        addTo(stream, at(i * 10ms + delay), 760, header);
    }
    const ClockFigures clock = stream.clock();
    EXPECT_TRUE(clock.isFromTimeCode);
    EXPECT_NEAR(clock.jitterMs, 2, 0.1);
    EXPECT_NEAR(clock.skew.skewPpm, 200, 10);
    EXPECT_NEAR(clock.skew.driftMs, 12, 1);
}

TEST_F(Accounting, TakesTheCounterForAClockWhereThereIsNoTimeCode) {
    wire::Header header;
    for (std::uint32_t i = 0; i < 3'000; ++i) {
        header.sampleCounter = i * 2;
        addTo(stream, at(i * 10ms), 760, header);
    }
    EXPECT_FALSE(stream.clock().isFromTimeCode);
    EXPECT_NEAR(stream.clock().jitterMs, 0, 0.01);
}

} // namespace
} // namespace posewire::model
