// SPDX-License-Identifier: MIT
#include "core/feed/pose_feed.h"
#include "core/model/session/messages.h"
#include "core/model/session/origin.h"
#include "core/model/session/roster.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <sstream>
#include <thread>

namespace posewire {
namespace {

using namespace std::chrono_literals;

/// An outlet by the steps of CONTRIBUTING.md alone: the writer of one format, fed with poses. Here a line for
/// each sample: character, sample, height of the pelvis, and whether that was sent.
class PelvisLines {
public:
    explicit PelvisLines(std::ostream& out) : m_out(out) {}
    void write(const feed::PoseSample& sample) {
        m_out << sample.character << ' ' << sample.pose.sample << ' '
              << sample.pose.segments.front().position.z() << ' '
              << (sample.pose.sources.front().position == model::Provenance::Sent) << '\n';
    }

private:
    std::ostream& m_out;
};

class OutletTest : public testing::Test {
protected:
    static constexpr int kCharacters = 2;

    static performer::PerformerSettings settings() {
        performer::PerformerSettings settings;
        settings.characters = kCharacters;
        settings.rateHz = 100;
        return settings;
    }

    void receive(std::uint64_t frame) {
        m_now = log::Stamp(100s + frame * 10ms);
        for (const wire::Datagram& datagram : m_performer.frame(frame)) {
            const log::SenderId sender =
                m_origin.log().senders().intern({"10.0.0.5:50000", log::Transport::Udp, 9763});
            m_origin.log().writer().append(*wire::encode(datagram), {.stamp = m_now, .sender = sender});
        }
        m_origin.log().writer().publish();
        m_origin.session().followFile(m_now);
    }
    [[nodiscard]] feed::PoseSource source() {
        std::vector<model::CharacterKey> keys;
        for (const model::Character* one : m_origin.session().roster().listed()) {
            keys.push_back(one->key);
        }
        feed::PoseSource source = feed::poseSourceOf(m_origin.session(), model::kAllTime, keys);
        source.firstPacket = m_origin.session().end();
        source.endPacket = UINT64_MAX;
        return source;
    }

    performer::Performer m_performer{settings()};
    model::Origin m_origin;
    log::Stamp m_now{};
};

TEST_F(OutletTest, WritesEachSampleAsItIsDrawnWhileMoreIsReceived) {
    constexpr std::uint64_t kFrames = 50;
    receive(0);
    const feed::PoseSource from = source();
    ASSERT_EQ(from.characters.size(), kCharacters);
    std::stringstream lines;
    std::atomic<bool> isDone = false;
    std::thread outlet([&] {
        feed::PoseFeed poses(from, feed::PoseContent::Segments, 50ms);
        PelvisLines writer(lines);
        const feed::TakePose take = [&](const feed::PoseSample& sample) { writer.write(sample); };
        while (!isDone) {
            poses.advance(take);
        }
        while (poses.advance(take, log::Stamp::max() - 1s)) {
        }
    });
    std::map<std::pair<std::size_t, std::uint32_t>, double> drawn;
    for (std::uint64_t frame = 1; frame <= kFrames; ++frame) {
        receive(frame);
        for (std::size_t character = 0; character < kCharacters; ++character) {
            const auto* pose = m_origin.session().messages().pose(from.characters[character].key);
            ASSERT_NE(pose, nullptr);
            drawn[{character, pose->sample}] = pose->segments.front().position.z();
        }
    }
    isDone = true;
    outlet.join();
    std::size_t written = 0;
    std::size_t character = 0;
    std::uint32_t sample = 0;
    double height = 0;
    bool isSent = false;
    for (; lines >> character >> sample >> height >> isSent; ++written) {
        EXPECT_NEAR(height, drawn.at({character, sample}), 1e-5);
        EXPECT_TRUE(isSent);
    }
    EXPECT_EQ(written, kCharacters * kFrames);
}

} // namespace
} // namespace posewire
