// SPDX-License-Identifier: MIT
#include "tests/core/model/session/session_fixture.h"

#include "core/model/session/memory_figures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/wire/messages.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

/// Samples that come in several datagrams: the newest one of which all have come is the state.
namespace posewire::model {
namespace {

class SplitMessages : public SessionTest {
protected:
    /// Segments [from, to) of a pose whose pelvis is at x = sample.
    static wire::PoseQuaternion partOf(std::uint32_t sample, std::size_t from, std::size_t to) {
        const wire::PoseQuaternion whole = standingAt(static_cast<float>(sample));
        wire::PoseQuaternion part;
        for (std::size_t i = from; i < std::min(to, whole.segments.size()); ++i) {
            part.segments.push_back(whole.segments[i]);
        }
        return part;
    }
    /// One of three datagrams of a sample.
    void sendThird(std::uint32_t sample, std::uint8_t index, log::Stamp stamp) {
        const std::size_t from = std::size_t{8} * index;
        send(partOf(sample, from, from + 8), sample, stamp,
             static_cast<std::uint8_t>(index | (index == 2 ? 0x80 : 0x00)));
    }
    /// The sample that is shown; 0 for none.
    std::uint32_t shown() {
        const Message* message = m_session.messages().message(key(), wire::PoseQuaternion::kType);
        return message == nullptr ? 0 : message->datagram.header.sampleCounter;
    }
};

TEST_F(SplitMessages, AreWholeInWhateverOrderTheirPartsCome) {
    std::vector<std::uint8_t> order{0, 1, 2};
    std::uint32_t sample = 0;
    do {
        ++sample;
        for (std::size_t i = 0; i < order.size(); ++i) {
            sendThird(sample, order[i], at(sample * 1s));
            follow();
            EXPECT_EQ(shown(), i == 2 ? sample : sample - 1) << "part " << i << " of sample " << sample;
        }
        const Message* message = m_session.messages().message(key(), wire::PoseQuaternion::kType);
        ASSERT_NE(message, nullptr);
        const auto& body = std::get<wire::PoseQuaternion>(message->datagram.body);
        EXPECT_EQ(body, standingAt(static_cast<float>(sample)));
    } while (std::ranges::next_permutation(order).found);
    const StreamCounts counts =
        m_session.roster().find({sender(), 0, wire::PoseQuaternion::kType})->accounting.counts();
    EXPECT_EQ(counts.samples, 6U);
    EXPECT_EQ(counts.incomplete, 0U);
}

TEST_F(SplitMessages, AreShownAsAPlainModelShowsThemWhereSomeAreLostOrCome) {
    // Parts in random order among those of the next samples, some lost, some twice.
    std::mt19937 random(14);
    struct Part {
        std::uint32_t sample;
        std::uint8_t index;
        std::uint32_t order;
    };
    std::vector<Part> parts;
    for (std::uint32_t sample = 1; sample <= 60; ++sample) {
        for (std::uint8_t index = 0; index < 3; ++index) {
            const std::uint32_t copies = random() % 8 == 0 ? 0 : 1 + (random() % 8 == 0 ? 1 : 0);
            for (std::uint32_t copy = 0; copy < copies; ++copy) {
                parts.push_back({sample, index, sample * 10 + static_cast<std::uint32_t>(random() % 15)});
            }
        }
    }
    std::ranges::stable_sort(parts, {}, &Part::order);
    std::map<std::uint32_t, std::set<int>> arrived;
    std::uint32_t newest = 0; // whole, and its last part arrived last
    std::vector<std::uint32_t> expected;
    std::map<std::uint32_t, std::size_t> lastPartAt;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        sendThird(parts[i].sample, parts[i].index, at(10s) + static_cast<std::int64_t>(i) * 1ms);
        arrived[parts[i].sample].insert(parts[i].index);
        if (parts[i].index == 2) {
            lastPartAt[parts[i].sample] = i;
        }
        std::size_t best = 0;
        newest = 0;
        for (const auto& [sample, indices] : arrived) {
            if (indices.size() == 3 && lastPartAt[sample] >= best) {
                best = lastPartAt[sample];
                newest = sample;
            }
        }
        expected.push_back(newest);
    }
    follow();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        m_session.setCursor({Cursor::Mode::Paused, i});
        ASSERT_EQ(shown(), expected[i]) << "packet " << i;
    }
    EXPECT_GT(newest, 50U);
}

TEST_F(SplitMessages, MayHaveAHundredAndTwentyEightParts) {
    for (unsigned index = 0; index < 128; ++index) {
        const bool isLast = index == 127;
        send(partOf(5, index, index + 1), 5, at(1s),
             static_cast<std::uint8_t>(index | (isLast ? 0x80U : 0U)));
        follow();
        EXPECT_EQ(shown(), isLast ? 5U : 0U) << index;
    }
    const Message* message = m_session.messages().message(key(), wire::PoseQuaternion::kType);
    EXPECT_EQ(std::get<wire::PoseQuaternion>(message->datagram.body), standingAt(5));
}

TEST_F(SplitMessages, AreNotMixedFromTwoSamples) {
    sendThird(1, 0, at(1s));
    sendThird(2, 1, at(1s));
    sendThird(2, 2, at(1s));
    follow();
    EXPECT_EQ(shown(), 0U);
    sendThird(1, 1, at(1s));
    sendThird(1, 2, at(1s));
    follow();
    EXPECT_EQ(shown(), 1U);
    sendThird(2, 0, at(1s));
    follow();
    m_session.setCursor({});
    EXPECT_EQ(shown(), 1U) << "the last datagram of 1 came after the last one of 2";
}

TEST_F(SplitMessages, CarryTheStampAndNumberOfTheirLastDatagram) {
    sendThird(1, 0, at(1s));
    sendThird(1, 2, at(2s));
    sendThird(1, 1, at(3s));
    follow();
    const Message* message = m_session.messages().message(key(), wire::PoseQuaternion::kType);
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(message->packet, 1U) << "the one that says it is the last";
    EXPECT_EQ(message->stamp, at(2s));
    EXPECT_EQ(message->sender, sender());
    EXPECT_EQ(m_session.messages().pose(key())->packet, 1U);
    EXPECT_EQ(m_session.messages().pose(key())->segments.size(), 23U);
}

TEST_F(SplitMessages, AreGatheredNoFurtherThanAnyoneNeeds) {
    for (int part = 0; part < 128; ++part) {
        wire::PropInformation props;
        props.props = {{static_cast<std::uint32_t>(part), std::string(50'000, 'x')}};
        send(props, 0, at(1s), static_cast<std::uint8_t>(part | (part == 127 ? 0x80 : 0)));
    }
    follow();
    const Message* message = m_session.messages().message(key(), wire::PropInformation::kType);
    ASSERT_NE(message, nullptr);
    const auto& props = std::get<wire::PropInformation>(message->datagram.body).props;
    EXPECT_GE(props.size(), 5U);
    EXPECT_LE(props.size(), 8U) << "256 KB of them";
}

TEST_F(SplitMessages, KeepMetadataAndNullPosesWithinTheirBudgets) {
    for (std::uint32_t i = 0; i < 2'000; ++i) {
        const std::string name = std::to_string(i) + std::string(2'000, 'x');
        wire::MetaData metadata;
        metadata.text = "name:" + name + "\n" + std::to_string(i % 64) + name + ":" + name + "\n";
        send(metadata, 0, at(i * 1ms));
        wire::NullPose part;
        part.segments.assign(40, {name.substr(0, 300), {0, 0, static_cast<float>(i)}});
        send(part, 0, at(i * 1ms));
        if (i % 500 == 0) {
            follow();
        }
    }
    follow();
    const auto bytesOf = [figures = m_session.memory()](std::string_view part) {
        return std::ranges::find(figures.parts, part, &MemoryFigures::Part::key)->bytes;
    };
    EXPECT_LE(bytesOf("metadata"), Content::kMetadataBudget);
    EXPECT_LE(bytesOf("nullPoses"), Content::kNullPoseBudget);
    EXPECT_TRUE(m_session.roster().displayName(key()).shown().starts_with("1999x"));
}

} // namespace
} // namespace posewire::model
