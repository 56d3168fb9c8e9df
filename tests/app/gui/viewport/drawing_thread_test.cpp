// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/drawing_thread.h"

#include "app/gui/viewport/presenter.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <vector>

namespace posewire::gui {
namespace {

using namespace std::chrono_literals;
using render::Simplification;

class DrawingThreadTest : public testing::Test {
protected:
    void SetUp() override {
        if (!render::OffscreenRenderer::create()) {
            GTEST_SKIP() << "SKIPPED: no OpenGL by EGL on this computer";
        }
    }

    std::shared_ptr<SceneFrame> frame() {
        auto one = std::make_shared<SceneFrame>();
        one->width = 160;
        one->height = 120;
        one->colours = render::lightSceneColours();
        Figure figure;
        figure.body = m_bodies.of(render::kReferenceNullPose);
        one->figures.push_back(std::move(figure));
        return one;
    }

    /// The next that the thread has to say.
    DrawingThread::Result await() {
        std::unique_lock lock(m_mutex);
        EXPECT_TRUE(m_woken.wait_for(lock, 20s, [this] { return m_wakes > 0; }));
        m_wakes = 0;
        return m_thread.take();
    }

    BodyFits m_bodies{render::Detail::Medium};
    std::mutex m_mutex;
    std::condition_variable m_woken;
    int m_wakes = 0;
    DrawingThread m_thread{[this] {
        {
            const std::lock_guard lock(m_mutex);
            ++m_wakes;
        }
        m_woken.notify_one();
    }};
};

TEST_F(DrawingThreadTest, DrawsWhatIsStillOnceMoreAndWell) {
    const auto moving = frame();
    m_thread.draw(moving);
    const DrawingThread::Result first = await();
    ASSERT_TRUE(first.image);
    EXPECT_EQ(first.frame, moving);
    EXPECT_FALSE(first.load.isStill);
    const DrawingThread::Result still = await();
    ASSERT_TRUE(still.image);
    EXPECT_EQ(still.frame, nullptr) << "nobody asked for it";
    EXPECT_TRUE(still.load.isStill);
    EXPECT_NE(still.image->pixels, first.image->pixels);
}

TEST_F(DrawingThreadTest, DrawsNothingAgainThatIsShownAlready) {
    m_thread.draw(frame());
    ASSERT_TRUE(await().image);
    ASSERT_TRUE(await().load.isStill);
    const auto same = frame();
    m_thread.draw(same);
    const DrawingThread::Result result = await();
    EXPECT_FALSE(result.image);
    EXPECT_EQ(result.frame, same);
    const auto other = frame();
    other->figures[0].look.dim = 0.5F;
    m_thread.draw(other);
    EXPECT_TRUE(await().image);
}

TEST_F(DrawingThreadTest, UsesTheRoomThatIsGivenBack) {
    m_thread.draw(frame());
    ASSERT_TRUE(await().image);
    DrawingThread::Result still = await();
    ASSERT_TRUE(still.image);
    const std::uint8_t* room = still.image->pixels.data();
    m_thread.giveBack(std::move(*still.image));
    bool isUsedAgain = false;
    for (int i = 1; i < 6 && !isUsedAgain; ++i) {
        const auto next = frame();
        next->camera.yaw += 0.1F * static_cast<float>(i);
        m_thread.draw(next);
        DrawingThread::Result result = await();
        ASSERT_TRUE(result.image);
        isUsedAgain = result.image->pixels.data() == room;
        m_thread.giveBack(std::move(*result.image));
    }
    EXPECT_TRUE(isUsedAgain);
}

TEST_F(DrawingThreadTest, SurvivesAPictureThatIsTooLarge) {
    const auto large = frame();
    large->width = 1 << 20;
    m_thread.draw(large);
    const DrawingThread::Result result = await();
    ASSERT_TRUE(result.image);
    EXPECT_TRUE(result.image->pixels.empty());
    m_thread.draw(frame());
    EXPECT_EQ(await().image->width, 160);
}

TEST(PictureHealthTest, NamesTheStepAndWhyItIsOnIt) {
    const PictureHealth fine = pictureHealthOf({Simplification::None, 0.011, 0, 0.018, false});
    EXPECT_EQ(fine.state, QStringLiteral("full quality · 11 ms"));
    EXPECT_FALSE(fine.isPoor);
    const PictureHealth coarse = pictureHealthOf({Simplification::LowBodies, 0.015, 0.031, 0.018, false});
    EXPECT_EQ(coarse.state, QStringLiteral("step 3 of 7: coarse bodies · 15 ms"));
    EXPECT_TRUE(coarse.why.contains("since a picture took 31 ms")) << coarse.why.toStdString();
    EXPECT_TRUE(coarse.why.contains("coarse shadows, small shadows, coarse bodies"));
    EXPECT_FALSE(coarse.isPoor);
    EXPECT_TRUE(pictureHealthOf({Simplification::HalfRate, 0.04, 0.05, 0.018, false}).isPoor);
    EXPECT_TRUE(pictureHealthOf({Simplification::LowBodies, 0.15, 0.05, 0.018, false}).isPoor) << "it jerks";
    EXPECT_EQ(pictureHealthOf({Simplification::HalfRate, 0.04, 0.05, 0.018, true}).state,
              QStringLiteral("nothing moves · full quality"));
    EXPECT_EQ(pictureHealthOf({}).state, QStringLiteral("by graphics hardware"));
}

} // namespace
} // namespace posewire::gui
