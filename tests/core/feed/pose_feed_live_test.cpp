// SPDX-License-Identifier: MIT
#include "core/feed/pose_feed.h"
#include "core/model/session/messages.h"
#include "core/model/session/origin.h"
#include "core/model/session/roster.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"
#include "tests/core/export/motion/motion_fixture.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace posewire::feed {
namespace {

using namespace std::chrono_literals;

/// A feed that is told after each frame what its session knows, as an outlet is.
class LiveFeedTest : public testing::Test {
protected:
    static constexpr log::Duration kFrame = 10ms;

    void receive(std::uint64_t frame, std::size_t character, const std::string& address) {
        const log::SenderId sender = m_origin.log().senders().intern({address, log::Transport::Udp, 9763});
        for (const wire::Datagram& datagram : m_performer.frame(frame)) {
            if (datagram.header.character == character) {
                m_origin.log().writer().append(*wire::encode(datagram), {.stamp = m_now, .sender = sender});
            }
        }
    }
    void advance() {
        m_origin.log().writer().publish();
        m_origin.session().followFile(m_now);
        std::vector<model::CharacterKey> keys;
        for (const model::Character* one : m_origin.session().roster().listed()) {
            keys.push_back(one->key);
        }
        m_feed.update(poseSourceOf(m_origin.session(), model::kAllTime, keys));
        const auto take = [this](const PoseSample& sample) {
            const PoseCharacter& character = m_feed.characterOf(sample);
            m_samples[character.key.character].push_back(sample.pose.sample);
            m_names[character.key.character] = character.name.shown();
            const auto* drawn = m_origin.session().messages().pose(character.key);
            ASSERT_NE(drawn, nullptr);
            if (drawn->sample == sample.pose.sample) {
                EXPECT_LT(exporting::differenceOf(drawn->segments, sample.pose.segments), 1e-9);
            } else {
                ++m_late;
            }
        };
        while (m_feed.advance(take, m_now)) {
        }
        m_now += kFrame;
    }

    static performer::PerformerSettings settings() {
        performer::PerformerSettings settings;
        settings.characters = 2;
        settings.rateHz = 100;
        return settings;
    }

    performer::Performer m_performer{settings()};
    model::Origin m_origin;
    log::Stamp m_now{100s};
    PoseFeed m_feed{{&m_origin.log(), 0, UINT64_MAX, {}}, PoseContent::Segments, 50ms};
    std::map<std::uint8_t, std::vector<std::uint32_t>> m_samples; ///< by character
    std::map<std::uint8_t, std::string> m_names;
    std::size_t m_late = 0; ///< handed out when a newer one had come
};

TEST_F(LiveFeedTest, GoesOnWithThoseThatItHadWhenOthersCome) {
    constexpr std::uint64_t kFrames = 100;
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
        if (frame >= kFrames / 2) {
            receive(frame, 0, "10.0.0.4:50000");
        }
        receive(frame, 1, "10.0.0.5:50000");
        advance();
    }
    EXPECT_EQ(m_samples[1].size(), kFrames);
    EXPECT_EQ(m_samples[0].size(), kFrames / 2);
    EXPECT_LE(m_late, 2U * 8U) << "those that came while the first two of each waited";
    EXPECT_TRUE(std::ranges::is_sorted(m_samples[1], std::ranges::less_equal()));
    EXPECT_EQ(m_names.size(), 2U);
    EXPECT_NE(m_names[0], m_names[1]);
}

TEST_F(LiveFeedTest, FollowsACharacterWhoseSenderIsStartedAgain) {
    constexpr std::uint64_t kFrames = 300;
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
        receive(frame, 1, "10.0.0.5:50000");
        advance();
    }
    m_now += 5s;
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
        receive(frame, 1, "10.0.0.5:50001");
        advance();
    }
    EXPECT_EQ(m_samples[1].size(), 2 * kFrames);
    EXPECT_EQ(m_samples[1].front(), m_samples[1][kFrames]);
}

} // namespace
} // namespace posewire::feed
