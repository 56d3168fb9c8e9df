// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/segment_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/viewport/camera_motion.h"
#include "app/gui/viewport/picking.h"
#include "app/gui/viewport/segment_card.h"
#include "core/model/session/messages.h"
#include "tests/app/gui/models/stage.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace posewire::gui {
namespace {

class SegmentFactsTest : public testing::Test {
protected:
    void perform(const std::vector<std::uint8_t>& types) {
        performer::Performer performer(sending(1, types));
        stage.perform(performer, 0, 60);
        stage.follow();
    }
    const model::CharacterPose& pose() { return *stage.session.messages().pose(stage.key()); }
    SegmentFacts facts(int segment) { return segmentFacts({stage.session, stage.key(), pose()}, segment); }
    static const SegmentFact* find(const SegmentFacts& facts, const QString& name) {
        const auto found = std::ranges::find(facts.facts, name, &SegmentFact::name);
        return found == facts.facts.end() ? nullptr : &*found;
    }

    Stage stage;
};

TEST_F(SegmentFactsTest, ArePoseMotionAndJointAsSent) {
    perform({2, 13, 20, 21, 22});
    const SegmentFacts known = facts(model::segment::kRightLowerLeg);
    EXPECT_EQ(known.segment, "Right Lower Leg");
    EXPECT_EQ(known.source, "Sent");
    EXPECT_EQ(known.sourceHealth, Health::Unknown);
    const Eigen::Vector3d place = pose().segments[model::segment::kRightLowerLeg].position;
    ASSERT_NE(find(known, "Position"), nullptr);
    EXPECT_EQ(find(known, "Position")->values[3], fixed(place.z(), 3));
    EXPECT_EQ(find(known, "Position")->unit, "m");
    EXPECT_NE(find(known, "Velocity"), nullptr);
    EXPECT_NE(find(known, "Acceleration"), nullptr);
    EXPECT_NE(find(known, "Angular velocity"), nullptr);
    const auto& angles =
        std::get<wire::JointAngles>(stage.session.messages().message(stage.key(), 20)->datagram.body);
    ASSERT_NE(find(known, "Flexion"), nullptr);
    EXPECT_EQ(find(known, "Flexion")->values[1],
              fixed(static_cast<double>(angles.joints[15].rotation[2]), 1));
}

TEST_F(SegmentFactsTest, SayWhatIsComputedAndLeaveOutWhatIsNotSent) {
    perform({2, 13});
    const SegmentFacts known = facts(model::segment::kRightLowerLeg);
    EXPECT_EQ(find(known, "Velocity"), nullptr);
    EXPECT_EQ(find(known, "Flexion"), nullptr);
    EXPECT_NE(find(known, "Flexion (computed)"), nullptr);
    EXPECT_EQ(find(facts(model::segment::kPelvis), "Flexion (computed)"), nullptr);
}

TEST_F(SegmentFactsTest, SayWhatWasSolvedAndWarnOfWhatIsAssumed) {
    perform({13, 21});
    EXPECT_TRUE(facts(model::segment::kRightForeArm).source.startsWith("Position sent, orientation solved"))
        << facts(model::segment::kRightForeArm).source.toStdString();
    Stage other;
    performer::Performer performer(sending(1, {13, 22}));
    other.perform(performer, 0, 60);
    other.follow();
    const SegmentFacts known =
        segmentFacts({other.session, other.key(), *other.session.messages().pose(other.key())}, 0);
    EXPECT_TRUE(known.source.contains("place in the world assumed")) << known.source.toStdString();
    EXPECT_EQ(known.sourceHealth, Health::Warning);
}

TEST_F(SegmentFactsTest, OfALiftedBodyAreWhereItWasSent) {
    perform({2, 13});
    const QString before = find(facts(0), "Position")->values[3];
    model::CharacterPose lifted = pose();
    lifted.moved = Eigen::Vector3d(0, 0, 0.9);
    for (model::SegmentPose& segment : lifted.segments) {
        segment.position += lifted.moved;
    }
    const SegmentFacts known = segmentFacts({stage.session, stage.key(), lifted}, 0);
    EXPECT_EQ(find(known, "Position")->values[3], before);
    EXPECT_TRUE(known.source.contains("shown 0.90 m higher")) << known.source.toStdString();
}

TEST_F(SegmentFactsTest, AreSpokenByTheCard) {
    perform({2, 13});
    QWidget viewport;
    viewport.resize(900, 700);
    QWidget banner(&viewport);
    banner.setGeometry(12, 600, 600, 88);
    SegmentCard card(&viewport, banner);
    card.setFacts(facts(model::segment::kHead));
    EXPECT_TRUE(card.accessibleName().startsWith("Head of "));
    EXPECT_TRUE(card.accessibleDescription().contains("Position "));
    EXPECT_FALSE(card.isHidden());
    EXPECT_TRUE(viewport.rect().contains(card.geometry()));
    viewport.resize(300, 200);
    card.place();
    EXPECT_TRUE(card.isHidden()) << "there is no room";
    viewport.resize(900, 700);
    viewport.show();
    card.place();
    EXPECT_FALSE(card.isHidden());
    EXPECT_LT(card.geometry().bottom(), banner.y());
    card.setFacts({});
    EXPECT_TRUE(card.isHidden());
}

/// A card in a viewport of 900 × 700 without a banner.
struct CardView {
    CardView() {
        viewport.resize(900, 700);
        banner.hide();
    }
    QWidget viewport;
    QWidget banner{&viewport};
    SegmentCard card{&viewport, banner};
};

TEST_F(SegmentFactsTest, StandAsideOfTheBodyThatTheyAreAbout) {
    perform({2, 13});
    CardView view;
    SegmentCard& card = view.card;
    card.keepClearOf({100, 100, 100, 580});
    card.setFacts(facts(model::segment::kHead));
    EXPECT_GT(card.x(), 450) << "at the right, where mostly floor is";
    card.keepClearOf({650, 100, 150, 580});
    card.place();
    EXPECT_LT(card.geometry().right(), 450);
    card.keepClearOf({}); // nowhere near
    card.place();
    EXPECT_LT(card.geometry().right(), 450) << "it does not jump about";
    card.keepClearOf({100, 100, 150, 580});
    card.place();
    EXPECT_GT(card.x(), 450);
}

TEST_F(SegmentFactsTest, NeverLieUnderThePointer) {
    perform({2, 13});
    CardView view;
    SegmentCard& card = view.card;
    card.keepClearOf(view.viewport.rect()); // as near as that, it is on both sides
    for (const QPoint pointer : {QPoint(800, 640), QPoint(100, 640), QPoint(870, 600)}) {
        card.setPointer(pointer);
        card.setFacts(facts(model::segment::kHead));
        EXPECT_FALSE(card.isHidden());
        EXPECT_FALSE(card.geometry().contains(pointer)) << pointer.x();
    }
}

TEST_F(SegmentFactsTest, ATrackedObjectIsPickedByItsOrigin) {
    wire::PoseQuaternion objects;
    objects.segments = {{1, {0.5F, 0, 1}, {1, 0, 0, 0}}, {2, {-0.5F, 0, 1}, {1, 0, 0, 0}}};
    for (std::uint32_t sample = 0; sample < 5; ++sample) {
        stage.send(objects, sample, 4 * sample, Stage::kStart + 4ms * sample);
    }
    stage.follow();
    ASSERT_TRUE(pose().isObjects);
    SceneBuilder builder{stage.session, render::Detail::Medium};
    SceneFrame frame;
    builder.build(AxesMode::None, {}, frame);
    const QSizeF view(640, 480);
    const auto place = frame.camera.project({-0.5F, 0, 1}, 640.0F / 480.0F);
    ASSERT_TRUE(place.has_value());
    const auto picked = pickIn(frame, pointerAt(*place, view) + QPointF(4, 3), view);
    ASSERT_TRUE(picked.has_value());
    EXPECT_EQ(picked->segment, 1);
    EXPECT_FALSE(pickIn(frame, {5, 470}, view).has_value());
    EXPECT_EQ(facts(1).segment, "Object 2");
}

} // namespace
} // namespace posewire::gui
