// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/view_look.h"

#include "app/gui/viewport/pose_banner.h"
#include "app/gui/viewport/segment_card.h"
#include "app/gui/viewport/viewport_overlay.h"
#include "app/gui/viewport/viewport_widget.h"
#include "render/offscreen.h"
#include "tests/app/gui/models/stage.h"

#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

constexpr QSize kWidget(801, 601);

TEST(ViewPanes, ShareTheViewWithoutOverlap) {
    ViewPanes panes;
    panes.resize(kWidget);
    EXPECT_EQ(panes.place(0), QRect({}, kWidget));
    for (const int count : {2, 4}) {
        panes.split(count, 0);
        ASSERT_EQ(panes.count(), count);
        for (int one = 0; one < count; ++one) {
            const QRect place = panes.place(one);
            EXPECT_TRUE(QRect({}, kWidget).contains(place));
            EXPECT_EQ(place.size(), panes.place(0).size())
                << "what is kept between pictures fits all of them";
            EXPECT_EQ(panes.paneAt(place.center()), one);
            for (int other = 0; other < one; ++other) {
                EXPECT_FALSE(place.intersects(panes.place(other)));
            }
        }
    }
}

TEST(ViewPanes, BeginWithTheFrontTheSideAndTheTopOrthographically) {
    ViewPanes panes;
    panes.split(4, 0.5F);
    EXPECT_EQ(panes.motionOf(0).camera().projection, render::Projection::Perspective);
    for (int pane = 1; pane < 4; ++pane) {
        EXPECT_EQ(panes.motionOf(pane).camera().projection, render::Projection::Orthographic);
    }
    EXPECT_NEAR(panes.motionOf(1).camera().yaw, 0.5F, 1e-5F) << "from where the character faces";
    EXPECT_NEAR(panes.motionOf(1).camera().pitch, 0, 1e-5F);
    EXPECT_GT(panes.motionOf(3).camera().pitch, 1.5F);
}

TEST(ViewPanes, AreCalledByWhatTheyShowUntilTheyAreTurnedByHand) {
    ViewPanes panes;
    panes.split(4, 0.5F);
    EXPECT_EQ(panes.name(0), "Perspective");
    EXPECT_EQ(panes.name(1), "Front");
    EXPECT_EQ(panes.name(2), "Left side");
    EXPECT_EQ(panes.name(3), "Top");
    ViewPanes again;
    again.restoreState(panes.state());
    EXPECT_EQ(again.name(3), "Top");
    panes.motionOf(1).orbit({40, 0});
    EXPECT_EQ(panes.name(1), "Orthographic");
    panes.motionOf(1).face(render::StandardView::Back);
    EXPECT_EQ(panes.name(1), "Back");
}

TEST(ViewPanes, KeepTheirCamerasWhileFewerAreShown) {
    ViewPanes panes;
    panes.split(4, 0);
    panes.activate(2);
    panes.motion().orbit({40, 0});
    const render::Camera turned = panes.motion().camera();
    panes.split(1, 0);
    EXPECT_EQ(panes.active(), 0);
    panes.split(4, 2.0F);
    EXPECT_EQ(panes.motionOf(2).camera(), turned);
}

TEST(ViewPanes, ComeBackInTheNextRun) {
    ViewPanes panes;
    panes.split(4, 0.3F);
    panes.activate(3);
    panes.motion().pan({10, 20}, {400, 300});
    ViewPanes next;
    next.restoreState(panes.state());
    EXPECT_EQ(next.count(), 4);
    EXPECT_EQ(next.active(), 3);
    for (int pane = 0; pane < 4; ++pane) {
        EXPECT_NEAR(next.motionOf(pane).camera().yaw, panes.motionOf(pane).camera().yaw, 1e-5F);
        EXPECT_EQ(next.motionOf(pane).isFollowing(), panes.motionOf(pane).isFollowing());
    }
    next.restoreState({{"count", 99}, {"active", -7}, {"cameras", "none"}});
    EXPECT_EQ(next.count(), 4);
    EXPECT_EQ(next.active(), 0);
}

class SplitViewport : public testing::Test {
protected:
    void SetUp() override {
        if (!render::OffscreenRenderer::create()) {
            GTEST_SKIP() << "SKIPPED: no OpenGL by EGL on this computer";
        }
        performer::Performer performer(sending(2, {2, 12, 13}));
        m_stage.perform(performer, 0, 3);
        m_stage.follow();
        m_viewport.resize(kWidget);
        m_viewport.show();
        m_viewport.pictures().start();
        ASSERT_TRUE(settle());
        m_viewport.split(4);
        ASSERT_TRUE(QTest::qWaitFor([this] { return shownOverlays().size() == 4; }, 20'000));
    }
    bool settle() {
        return QTest::qWaitFor([this] { return m_viewport.pictures().isSettled(); }, 20'000);
    }
    [[nodiscard]] std::vector<ViewportOverlay*> shownOverlays() const {
        std::vector<ViewportOverlay*> shown;
        for (auto* one : m_viewport.findChildren<ViewportOverlay*>()) {
            if (one->isVisible() && !one->labels().empty()) {
                shown.push_back(one);
            }
        }
        return shown;
    }

    Stage m_stage;
    Commands& m_commands{m_stage.commands};
    ViewportWidget m_viewport{m_stage.session, m_commands};
};

TEST_F(SplitViewport, LabelsTheCharactersInEachView) {
    const auto overlays = shownOverlays();
    ASSERT_EQ(overlays.size(), 4U);
    for (const ViewportOverlay* overlay : overlays) {
        EXPECT_EQ(overlay->labels().size(), 2U);
        EXPECT_LE(overlay->width(), kWidget.width() / 2);
    }
}

TEST_F(SplitViewport, BannerAndCardLieOverTheLabelsOfAllViews) {
    const QObjectList& order = m_viewport.children();
    const auto placeOf = [&order](const QObject* one) { return order.indexOf(const_cast<QObject*>(one)); };
    for (const ViewportOverlay* overlay : m_viewport.findChildren<ViewportOverlay*>()) {
        EXPECT_GT(placeOf(m_viewport.findChild<SegmentCard*>()), placeOf(overlay));
        EXPECT_GT(placeOf(m_viewport.findChild<PoseBanner*>()), placeOf(overlay));
    }
}

TEST_F(SplitViewport, DrawsSomethingElseInEachView) {
    const QImage picture = m_viewport.grab().toImage();
    const QSize size(kWidget.width() / 2 - 20, kWidget.height() / 2 - 20);
    const QImage first = picture.copy(QRect({10, 10}, size));
    const QImage last = picture.copy(
        QRect(QPoint(kWidget.width() - size.width() - 10, kWidget.height() - size.height() - 10), size));
    EXPECT_NE(first, last);
    const auto colours = [](const QImage& image) {
        QSet<QRgb> all;
        for (int y = 0; y < image.height(); y += 3) {
            for (int x = 0; x < image.width(); x += 3) {
                all.insert(image.pixel(x, y));
            }
        }
        return all.size();
    };
    EXPECT_GT(colours(first), 100);
    EXPECT_GT(colours(last), 100);
}

TEST_F(SplitViewport, WhatIsAskedOfTheCameraIsOfTheActiveView) {
    EXPECT_EQ(m_viewport.choice().projection(), render::Projection::Perspective);
    m_viewport.choice().activateNext();
    EXPECT_EQ(m_viewport.choice().projection(), render::Projection::Orthographic);
    const render::Camera before = m_viewport.choice().look().panes.motion().camera();
    QTest::mouseClick(&m_viewport, Qt::LeftButton, {}, QPoint(100, 560));
    EXPECT_EQ(m_viewport.choice().look().panes.active(), 2);
    m_viewport.choice().toggleProjection();
    EXPECT_EQ(m_viewport.choice().projection(), render::Projection::Perspective);
    m_viewport.choice().activateNext();
    m_viewport.choice().activateNext();
    m_viewport.choice().activateNext();
    EXPECT_EQ(m_viewport.choice().look().panes.active(), 1);
    EXPECT_EQ(m_viewport.choice().look().panes.motion().camera(), before) << "the others are as they were";
}

TEST_F(SplitViewport, IsKeptWithTheViewport) {
    m_viewport.choice().activateNext();
    ViewportWidget next(m_stage.session, m_commands);
    next.choice().restoreState(m_viewport.choice().state());
    EXPECT_EQ(next.choice().viewCount(), 4);
    EXPECT_EQ(next.choice().look().panes.active(), 1);
    m_viewport.split(1);
    ASSERT_TRUE(settle());
    EXPECT_EQ(shownOverlays().size(), 1U);
}

} // namespace
} // namespace posewire::gui
