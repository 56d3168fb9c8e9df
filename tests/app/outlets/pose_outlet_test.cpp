// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/pose_outlet.h"
#include "core/model/session/origin.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <QHostAddress>
#include <QUdpSocket>

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <thread>
#include <vector>

namespace posewire::outlets {
namespace {

/// What writers on the outlet's thread have got.
struct Got {
    std::mutex mutex;
    std::map<std::string, std::vector<std::uint32_t>> samples; ///< by name
    std::atomic<std::uint64_t> poses = 0;
};

class Keeper final : public PoseWriter {
public:
    explicit Keeper(Got& got) : m_got(got) {}
    void take(const feed::PoseCharacter& character, const feed::PoseSample& sample) override {
        const std::lock_guard lock(m_got.mutex);
        m_got.samples[character.name.shown()].push_back(sample.pose.sample);
        ++m_got.poses;
    }
    void tell(OutletState& state) const override {
        state.place = "here";
        state.sent = m_got.poses;
    }

private:
    Got& m_got;
};

class PoseOutletTest : public testing::Test {
protected:
    static performer::PerformerSettings settings() {
        performer::PerformerSettings settings;
        settings.characters = 2;
        settings.rateHz = 100;
        return settings;
    }
    void receive(std::uint64_t frame) {
        const log::Stamp now = m_origin.log().timeline().now(m_clock);
        for (const wire::Datagram& datagram : m_performer.frame(frame)) {
            const log::SenderId sender =
                m_origin.log().senders().intern({"10.0.0.5:50000", log::Transport::Udp, 9763});
            m_origin.log().writer().append(*wire::encode(datagram), {.stamp = now, .sender = sender});
        }
        m_origin.log().writer().publish();
        m_origin.session().followFile(now);
    }

    log::SystemClock m_clock;
    performer::Performer m_performer{settings()};
    model::Origin m_origin;
    std::uint64_t m_frame = 0; ///< the next one, for those that go on
    Got m_got;
    MakeWriter m_make = [this](const log::PacketLog& /*log*/) {
        return net::NetResult<std::unique_ptr<PoseWriter>>(std::make_unique<Keeper>(m_got));
    };
};

TEST_F(PoseOutletTest, HandsOverEachPoseOfAllCharactersInOrder) {
    constexpr std::uint64_t kFrames = 100;
    const auto outlet = PoseOutlet::start(m_origin.log(), m_clock, m_make);
    ASSERT_TRUE(outlet);
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
        receive(frame);
        (*outlet)->update(m_origin.session());
    }
    while ((*outlet)->state().poses < 2 * kFrames) {
        std::this_thread::yield();
    }
    const std::lock_guard lock(m_got.mutex);
    EXPECT_EQ(m_got.samples.size(), 2U);
    for (const auto& [name, samples] : m_got.samples) {
        EXPECT_EQ(samples.size(), kFrames) << name;
        EXPECT_TRUE(std::ranges::is_sorted(samples, std::ranges::less_equal())) << name;
    }
    EXPECT_EQ((*outlet)->state().missed, 0U);
    EXPECT_EQ((*outlet)->state().place, "here");
}

TEST_F(PoseOutletTest, BeginsWithTheNewestPacket) {
    receive(0);
    const auto outlet = PoseOutlet::start(m_origin.log(), m_clock, m_make);
    ASSERT_TRUE(outlet);
    receive(1);
    (*outlet)->update(m_origin.session());
    while ((*outlet)->state().poses < 2) {
        std::this_thread::yield();
    }
    const std::lock_guard lock(m_got.mutex);
    for (const auto& [name, samples] : m_got.samples) {
        EXPECT_EQ(samples, std::vector<std::uint32_t>{m_performer.frame(1).front().header.sampleCounter});
    }
}

TEST_F(PoseOutletTest, SaysWhyItsWriterCannotBegin) {
    const auto outlet = PoseOutlet::start(m_origin.log(), m_clock, [](const log::PacketLog& /*log*/) {
        return net::NetResult<std::unique_ptr<PoseWriter>>(
            net::netError(net::NetError::Kind::PortInUse, "taken"));
    });
    ASSERT_FALSE(outlet);
    EXPECT_EQ(outlet.error().kind, net::NetError::Kind::PortInUse);
}

/// With a receiver, and stopped while it sends; `follow` has none, and the others nobody who reads.
TEST_F(PoseOutletTest, EveryKindHandsOnWhatComesAndStops) {
    QUdpSocket receiver;
    ASSERT_TRUE(receiver.bind(QHostAddress::LocalHost));
    for (const OutletKind& kind : outletKinds()) {
        if (kind.name == "ros2") {
            continue; // DDS starts threads of its own, and looks for others: cli.outlet
        }
        const std::string place = "127.0.0.1:" + std::to_string(kind.place == "-" ? 0 : receiver.localPort());
        const auto outlet = kind.start({place, {}}, {m_origin.log(), m_clock, {}, {}});
        ASSERT_TRUE(outlet) << kind.name;
        const auto isDone = [&] {
            const OutletState state = (*outlet)->state();
            return kind.place == "-" ? state.poses > 4 : state.sent > 4;
        };
        while (!isDone()) {
            receive(m_frame++);
            (*outlet)->update(m_origin.session());
            std::this_thread::yield();
        }
        EXPECT_EQ((*outlet)->state().problem, "") << kind.name;
        if (kind.place != "-") {
            EXPECT_EQ((*outlet)->state().place, place);
        }
    }
    EXPECT_EQ(findOutletKind("carrier pigeon"), nullptr);
}

TEST_F(PoseOutletTest, NoKindOfDatagramsTakesAPlaceWithoutAPort) {
    for (const OutletKind& kind : outletKinds()) {
        EXPECT_FALSE(kind.start({"nowhere:x", {}}, {m_origin.log(), m_clock, {}, {}})) << kind.name;
    }
}

} // namespace
} // namespace posewire::outlets
