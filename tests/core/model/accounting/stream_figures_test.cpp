// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_figures.h"

#include "tests/core/model/accounting/arrivals.h"

#include "core/model/incidents/thresholds.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp kBegin(1'700'000'000s);

/// 100 samples a second, of which every `every`th does not come.
Stream streamOf(std::uint8_t type, std::uint32_t count, std::uint32_t every, std::uint32_t timeCodeStep = 0) {
    Stream stream({log::SenderId{}, 0, type});
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i % every != every / 2) {
            wire::Header header;
            header.sampleCounter = i;
            header.datagramCounter = 0x80;
            header.timeCode = i * timeCodeStep;
            addTo(stream.accounting, kBegin + i * 10ms, 760, header);
            stream.statistics.add(kBegin + i * 10ms);
            stream.statistics.addSample(kBegin + i * 10ms);
        }
    }
    return stream;
}

TEST(StreamFigures, AreNamedOnceAndExplained) {
    std::set<std::string_view> keys;
    for (const FigureRow& row : figureTable()) {
        EXPECT_TRUE(row.key.empty() || keys.insert(row.key).second) << row.key;
        EXPECT_GT(std::string_view(row.help).size(), 20U) << row.title;
        EXPECT_EQ(row.key.empty(), row.figure > Figure::Drift) << row.title;
        EXPECT_EQ(row.condition == nullptr && row.packets != nullptr, false) << row.title;
    }
}

TEST(StreamFigures, AreReadFromTheAccounting) {
    const Stream stream = streamOf(2, 1000, 50);
    const StreamFigures figures = figuresOf(stream);
    EXPECT_EQ(figures.count(Figure::Samples), 980U);
    EXPECT_EQ(figures.count(Figure::Lost), 20U);
    EXPECT_EQ(figures.count(Figure::LostUnknown), 20U);
    EXPECT_DOUBLE_EQ(figures[Figure::LossShare], 2.0);
    EXPECT_NEAR(figures[Figure::RateWhole], 98, 0.1);
    EXPECT_NEAR(figures[Figure::SpacingMost], 20, 1e-6);
    EXPECT_EQ(figures.trouble(Figure::Lost), FigureTrouble::Odd);
    EXPECT_EQ(figures.trouble(Figure::LossShare), FigureTrouble::Warning);
    EXPECT_EQ(figures.trouble(Figure::Late), FigureTrouble::None);
    const TimeRange second{kBegin + 1s, kBegin + 2s};
    EXPECT_EQ(figuresOf(stream, second).count(Figure::Lost), 2U);
    const TimeRange open{kBegin + 5s, kAllTime.to};
    EXPECT_EQ(figuresOf(stream, open).count(Figure::Lost), 10U);
    for (const TimeRange& range : {second, open}) {
        const StreamFigures inRange = figuresOf(stream, range);
        EXPECT_DOUBLE_EQ(inRange[Figure::Rate], inRange[Figure::RateMean]);
        EXPECT_DOUBLE_EQ(inRange[Figure::RateWhole], inRange[Figure::RateMean]);
    }
}

TEST(StreamFigures, TheRateOfMessagesIsOfTheirDatagramsWhateverIsMissing) {
    Stream stream({log::SenderId{}, 0, 13});
    for (std::uint32_t i = 0; i < 11; ++i) { // the second of two parts never comes
        wire::Header part;
        part.datagramCounter = 0;
        addTo(stream.accounting, kBegin + i * 1s, 760, part);
    }
    const StreamFigures figures = figuresOf(stream);
    EXPECT_GT(figures.count(Figure::Incomplete), 0U);
    EXPECT_NEAR(figures[Figure::RateWhole], 1, 1e-9);
}

TEST(StreamFigures, AreTheSameInEveryYearThatAFileMayBeOf) {
    using namespace std::chrono;
    for (const year of : {1741y, 1800y, 1969y, 2117y, 2259y}) {
        const auto begin = log::Stamp(sys_days(of / January / 1).time_since_epoch());
        Stream stream({log::SenderId{}, 0, 2});
        for (std::uint32_t i = 0; i < 100; ++i) {
            wire::Header header;
            header.sampleCounter = i;
            header.datagramCounter = 0x80;
            addTo(stream.accounting, begin + i * 10ms, 760, header);
            stream.statistics.add(begin + i * 10ms);
            stream.statistics.addSample(begin + i * 10ms);
        }
        const StreamFigures figures = figuresOf(stream);
        EXPECT_NEAR(figures[Figure::RateWhole], 100, 1e-6) << static_cast<int>(of);
        EXPECT_EQ(figuresOf(stream, kAllTime).count(Figure::Samples), 100U) << static_cast<int>(of);
    }
}

TEST(StreamFigures, HaveACauseForAllThatIsMissingAlsoInARange) {
    Stream stream = streamOf(2, 1000, 50);
    wire::Header part;
    part.sampleCounter = 1000;
    part.datagramCounter = 0; // the first of several, and the only one that comes
    addTo(stream.accounting, kBegin + 10s, 760, part);
    const auto causes = [&](const std::optional<TimeRange>& range) {
        const StreamFigures figures = figuresOf(stream, range);
        EXPECT_EQ(figures.count(Figure::Incomplete), 1U);
        return figures[Figure::LostHere] + figures[Figure::LostOnNetwork] + figures[Figure::LostAtSender] +
               figures[Figure::LostUnknown] - figures[Figure::Missing];
    };
    EXPECT_EQ(causes({}), 0);
    EXPECT_EQ(causes(TimeRange{kBegin + 5s, kAllTime.to}), 0);
}

TEST(StreamFigures, OfSeveralStreamsAddUpAsTheTableSays) {
    const StreamFigures a = figuresOf(streamOf(2, 1000, 50));
    const StreamFigures b = figuresOf(streamOf(20, 400, 100));
    StreamFigures sum;
    sum.add(a);
    sum.add(b);
    for (const FigureRow& row : figureTable()) {
        const double value = sum[row.figure];
        switch (row.sum) {
        case FigureSum::None:
            EXPECT_FALSE(sum.has(row.figure)) << row.title;
            break;
        case FigureSum::Sum:
            EXPECT_DOUBLE_EQ(value, a[row.figure] + b[row.figure]) << row.title;
            break;
        case FigureSum::Most:
            EXPECT_DOUBLE_EQ(value, std::fmax(a[row.figure], b[row.figure])) << row.title;
            break;
        case FigureSum::Mean:
            EXPECT_NEAR(value, 100.0 * 24 / 1400, 1e-9) << row.title;
            break;
        }
    }
}

TEST(StreamFigures, OfMessagesAreDatagramsAndWhatIsIncomplete) {
    const StreamFigures figures = figuresOf(streamOf(12, 100, 100));
    EXPECT_TRUE(figures.has(Figure::Datagrams));
    EXPECT_TRUE(figures.has(Figure::Incomplete));
    EXPECT_FALSE(figures.has(Figure::Lost));
    EXPECT_FALSE(figures.has(Figure::Jitter));
}

TEST(StreamFigures, OfMessagesAddNothingToSamples) {
    const StreamFigures samples = figuresOf(streamOf(2, 1000, 50));
    Stream messages({log::SenderId{}, 0, 12});
    wire::Header part;
    part.datagramCounter = 0; // the first of several, and the only one that comes
    for (int i = 0; i < 3; ++i) {
        addTo(messages.accounting, kBegin + i * 1s, 760, part);
    }
    ASSERT_EQ(figuresOf(messages).count(Figure::Incomplete), 3U);
    StreamFigures sum;
    sum.add(samples);
    sum.add(figuresOf(messages));
    EXPECT_EQ(sum.count(Figure::Datagrams), samples.count(Figure::Datagrams) + 3);
    EXPECT_EQ(sum.count(Figure::Incomplete), 3U);
    for (const FigureRow& row : figureTable()) {
        if (row.scope == FigureScope::Samples && row.sum != FigureSum::None) {
            EXPECT_EQ(sum.orZero(row.figure), samples.orZero(row.figure)) << row.title;
        }
    }
}

TEST(StreamFigures, AreUnknownWhereNothingIsMeasured) {
    const StreamFigures figures = figuresOf(streamOf(2, 1, 2));
    EXPECT_TRUE(std::isnan(figures[Figure::SpacingMost]));
    EXPECT_EQ(figures.orZero(Figure::SpacingMost), 0);
    EXPECT_TRUE(std::isnan(figures[Figure::Drift]));
    EXPECT_FALSE(figures.isFromTimeCode());
    EXPECT_TRUE(figuresOf(streamOf(2, 1000, 50, 10)).isFromTimeCode());
}

TEST(ThresholdTable, ListsEveryThresholdOnceWithItsDefaultInItsRange) {
    const Thresholds shipped;
    std::set<std::string_view> keys;
    for (const ThresholdRow& row : thresholdTable()) {
        EXPECT_TRUE(keys.insert(row.key).second);
        EXPECT_GE(shipped.*row.limit, row.least) << row.key;
        EXPECT_LE(shipped.*row.limit, row.most) << row.key;
        EXPECT_NE(std::string(row.label).find('&'), std::string::npos) << row.key;
    }
    EXPECT_EQ(keys.size() * sizeof(double), sizeof(Thresholds));
}

} // namespace
} // namespace posewire::model
