// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/pose_banner.h"

#include "core/model/session/roster.h"
#include "tests/app/gui/models/stage.h"

#include <QToolButton>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class PoseBannerTest : public testing::Test {
protected:
    void perform(int characters, const std::vector<std::uint8_t>& types) {
        performer::Performer performer(sending(characters, types));
        stage.perform(performer, 0, 3);
        stage.follow();
        banner.refresh(stage.session);
    }

    Stage stage;
    QWidget viewport;
    PoseBanner banner{stage.commands, &viewport};
};

TEST_F(PoseBannerTest, IsNotThereWhereAllWasSent) {
    perform(2, {2, 12, 13});
    EXPECT_TRUE(banner.notes().empty());
    EXPECT_TRUE(banner.isHidden());
}

TEST_F(PoseBannerTest, SaysOnceWhatIsTrueOfSeveral) {
    perform(2, {12, 13, 22});
    ASSERT_EQ(banner.notes().size(), 1U);
    EXPECT_EQ(banner.notes()[0].level, Health::Warning);
    EXPECT_EQ(banner.notes()[0].text,
              "Mira Lindqvist and Jonas Adeyemi: Type 22 alone has no positions: where the "
              "body stands is assumed");
    EXPECT_FALSE(banner.isHidden());
    EXPECT_EQ(banner.accessibleDescription(), banner.notes()[0].text);
}

TEST_F(PoseBannerTest, LeavesOutWhatIsHidden) {
    perform(1, {12, 13, 22});
    stage.session.setHidden(stage.key(), true);
    banner.refresh(stage.session);
    EXPECT_TRUE(banner.isHidden());
}

TEST_F(PoseBannerTest, IsAsHighAsItsTextNeedsAlsoAfterALongerOne) {
    performer::Performer performer(sending(4, {22}, 60.0));
    stage.perform(performer, 0, 5);
    stage.follow();
    banner.refresh(stage.session);
    const int tall = banner.height();
    for (std::uint8_t character = 1; character < 4; ++character) {
        stage.session.setHidden(stage.key(character), true);
    }
    banner.refresh(stage.session);
    PoseBanner fresh(stage.commands, &viewport);
    fresh.refresh(stage.session);
    EXPECT_EQ(banner.height(), fresh.height());
    EXPECT_LE(banner.height(), tall);
}

TEST_F(PoseBannerTest, PutsBodiesOnTheFloorThatAreBelow) {
    performer::Performer performer(sending(1, {2, 13}));
    for (wire::Datagram datagram : performer.frame(0)) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            for (auto& segment : pose->segments) {
                segment.position[2] -= 0.95F;
            }
        }
        stage.send(datagram, Stage::kStart);
    }
    stage.follow();
    banner.refresh(stage.session);
    ASSERT_EQ(banner.notes().size(), 1U);
    EXPECT_EQ(banner.notes()[0].text, "Character 0: It was sent below the floor");
    ASSERT_FALSE(banner.findChild<QToolButton*>()->isHidden());
    banner.findChild<QToolButton*>()->click();
    EXPECT_TRUE(stage.session.roster().isLifted(stage.key()));
    banner.refresh(stage.session);
    EXPECT_TRUE(banner.findChild<QToolButton*>()->isHidden());
    EXPECT_EQ(banner.notes()[0].text, "Character 0: Placed on the floor, since it was sent below it");
}

} // namespace
} // namespace posewire::gui
