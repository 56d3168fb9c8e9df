// SPDX-License-Identifier: MIT
#include "core/model/accounting/sample_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;
using Mark = SampleWindow::Mark;

/// What is kept of a sample, the plain way.
struct Kept {
    std::set<unsigned> parts;
    int last = -1;
    [[nodiscard]] bool isComplete() const { return static_cast<int>(parts.size()) == last + 1; }
};

/// A window, and the same by a map of positions without wrap-around.
class WindowModel {
public:
    explicit WindowModel(std::uint32_t origin) : m_origin(origin) {}

    /// Puts a datagram into both and compares what they say.
    void add(std::int64_t position, std::uint8_t part, bool isLast) {
        const std::uint32_t sample = m_origin + static_cast<std::uint32_t>(position);
        auto place = m_window.find(sample);
        ASSERT_EQ(place.isThere, m_samples.contains(position)) << position;
        if (!place.isThere) {
            place.index = m_window.insert(place.index, sample, log::Stamp(log::Duration(position)));
            m_samples[position];
            if (m_samples.size() > AccountingDepth().samples) {
                m_samples.erase(m_samples.begin());
            }
        }
        Kept& kept = m_samples.at(position);
        const bool isNew = kept.parts.insert(part).second;
        ASSERT_EQ(m_window.contains(place.index, part), !isNew) << position;
        const Mark mark = m_window.mark(place.index, part, isLast);
        kept.last = isLast && isNew ? part : kept.last;
        const Mark expected = kept.isComplete() ? Mark::Completing : Mark::Part;
        ASSERT_EQ(mark, isNew ? expected : Mark::Duplicate) << position << ", part " << int{part};
    }
    [[nodiscard]] bool contains(std::int64_t position) const { return m_samples.contains(position); }
    [[nodiscard]] std::int64_t lowest() const { return m_samples.begin()->first; }

    void compareAll() const {
        ASSERT_EQ(m_window.size(), m_samples.size());
        std::size_t index = 0;
        for (const auto& [position, kept] : m_samples) {
            const SampleWindow::Entry& entry = m_window[index];
            ASSERT_EQ(entry.sample, m_origin + static_cast<std::uint32_t>(position));
            ASSERT_EQ(entry.stamp, log::Stamp(log::Duration(position)));
            ASSERT_EQ(entry.isComplete, kept.isComplete()) << position;
            for (unsigned part = 0; part < 128; ++part) {
                ASSERT_EQ(m_window.contains(index, static_cast<std::uint8_t>(part)),
                          kept.parts.contains(part))
                    << position << ", part " << part;
            }
            ++index;
        }
    }
    [[nodiscard]] const SampleWindow& window() const { return m_window; }

private:
    std::uint32_t m_origin;
    SampleWindow m_window;
    std::map<std::int64_t, Kept> m_samples;
};

class RandomWindows : public testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomWindows, KeepWhatAMapKeeps) {
    std::mt19937 random(GetParam());
    WindowModel model(GetParam());
    model.add(0, 0, true);
    for (int i = 0; i < 3'000; ++i) {
        const std::int64_t position = static_cast<std::int64_t>(random() % 800) - 300;
        // Each sample has its own number of parts, so that no two datagrams of it contradict each other.
        const auto parts = static_cast<std::uint32_t>(1 + (position + 300) % 5);
        const auto part = static_cast<std::uint8_t>(random() % parts);
        model.add(position, part, part + 1U == parts);
        if (HasFatalFailure()) {
            return;
        }
    }
    model.compareAll();
}

TEST_P(RandomWindows, ForgetTheLowestOnesOnceTheyAreFull) {
    std::mt19937 random(GetParam() + 1);
    WindowModel model(GetParam());
    for (std::int64_t position = 0; position < 9'000; position += 1 + random() % 2) {
        model.add(position, 0, true);
        // Some of those before come late, in any order, but none that would be below the lowest.
        const std::int64_t late = position - static_cast<std::int64_t>(random() % 50);
        const bool isFull = model.window().size() == AccountingDepth().samples;
        if (late >= 0 && (!isFull || late > model.lowest())) {
            model.add(late, 0, true);
        }
        if (HasFatalFailure()) {
            return;
        }
    }
    EXPECT_EQ(model.window().size(), AccountingDepth().samples);
    EXPECT_TRUE(model.window().hasForgotten());
    model.compareAll();
}

INSTANTIATE_TEST_SUITE_P(Origins, RandomWindows, testing::Values(1'000U, 0U, 0xffffff80U, 0x7fffff00U));

TEST(SampleWindow, NoticesTheLastPartBeforeTheOthers) {
    SampleWindow window;
    window.insert(0, 5, {});
    EXPECT_EQ(window.mark(0, 2, true), Mark::Part);
    EXPECT_EQ(window.mark(0, 0, false), Mark::Part);
    EXPECT_FALSE(window[0].isComplete);
    EXPECT_EQ(window.mark(0, 0, false), Mark::Duplicate);
    EXPECT_EQ(window.mark(0, 1, false), Mark::Completing);
    EXPECT_TRUE(window[0].isComplete);
    EXPECT_EQ(window.mark(0, 2, true), Mark::Duplicate);
}

TEST(SampleWindow, TakesASecondPartOfAWholeSampleForOneMorePart) {
    // A sender that sends one datagram as the whole sample, and then a part of the same one.
    SampleWindow window;
    window.insert(0, 5, {});
    EXPECT_EQ(window.mark(0, 0, true), Mark::Completing);
    EXPECT_TRUE(window[0].isComplete);
    EXPECT_NE(window.mark(0, 1, false), Mark::Duplicate);
    EXPECT_TRUE(window.contains(0, 0));
    EXPECT_TRUE(window.contains(0, 1));
    EXPECT_EQ(window.mark(0, 1, false), Mark::Duplicate);
    EXPECT_EQ(window.mark(0, 0, true), Mark::Duplicate);
}

TEST(SampleWindow, CompletesTheGreatestNumberOfPartsInAnyOrder) {
    std::vector<std::uint8_t> parts(128);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i] = static_cast<std::uint8_t>(i);
    }
    std::mt19937 random(4);
    for (int round = 0; round < 5; ++round) {
        std::shuffle(parts.begin(), parts.end(), random);
        SampleWindow window;
        window.insert(0, 1, {});
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const Mark mark = window.mark(0, parts[i], parts[i] == 127);
            ASSERT_EQ(mark, i + 1 == parts.size() ? Mark::Completing : Mark::Part);
        }
    }
}

TEST(SampleWindow, IsAsNewAfterItIsCleared) {
    SampleWindow window;
    for (std::uint32_t sample = 0; sample < 5'000; ++sample) {
        const std::size_t index = window.insert(window.size(), sample, {});
        window.mark(index, 1, true);
    }
    window.clear();
    EXPECT_TRUE(window.empty());
    EXPECT_FALSE(window.hasForgotten());
    EXPECT_FALSE(window.find(4'999).isThere);
    window.insert(0, 7, {});
    EXPECT_FALSE(window.contains(0, 1));
    EXPECT_EQ(window.mark(0, 1, true), Mark::Part);
}

} // namespace
} // namespace posewire::model
