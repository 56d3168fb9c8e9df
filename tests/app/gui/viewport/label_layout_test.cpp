// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/label_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace posewire::gui {
namespace {

constexpr QRectF kViewport(0, 0, 640, 400);

LabelPlace labelAt(qreal x, qreal y, double depth, int weight = 0) {
    const qreal head = 60 / depth;
    return {{x, y}, QRectF(x - head / 2, y + 4, head, head * 1.3), depth, weight, {190, 24}, {64, 24}};
}

std::vector<LabelPlace> crowd(unsigned seed, std::size_t count) {
    std::mt19937 random(seed);
    std::vector<LabelPlace> places;
    for (std::size_t i = 0; i < count; ++i) {
        const auto upTo = [&random](unsigned end) { return static_cast<double>(random() % end); };
        const double depth = 3 + upTo(90) / 10;
        const double y = 100 + upTo(200);
        const double x = 10 + upTo(620);
        places.push_back(labelAt(x, y, depth));
    }
    return places;
}

TEST(LabelLayout, StandsAboveTheHeadWhereThereIsRoom) {
    const auto placed = placeLabels(std::vector{labelAt(300, 200, 5)}, kViewport, {});
    EXPECT_EQ(placed[0].form, LabelForm::Whole);
    EXPECT_NEAR(placed[0].plate.center().x(), 300, 1);
    EXPECT_NEAR(placed[0].plate.bottom(), 200, 1);
    EXPECT_FALSE(leaderOf(placed[0], std::vector{labelAt(300, 200, 5)}, 0));
}

TEST(LabelLayout, StandsAboveRaisedArmsOrBesideThem) {
    for (const double x : {30.0, 300.0, 610.0}) {
        LabelPlace raised = labelAt(x, 200, 5);
        raised.arms = {QRectF(x - 25, 150, 15, 60), QRectF(x + 10, 140, 15, 70)};
        const auto placed = placeLabels(std::vector{raised, labelAt(x, 230, 8)}, kViewport, {});
        for (const PlacedLabel& label : placed) {
            EXPECT_LE(label.form, LabelForm::Brief);
            EXPECT_FALSE(label.plate.intersects(raised.arms[0]) || label.plate.intersects(raised.arms[1]));
        }
        EXPECT_EQ(placed[0].form, LabelForm::Whole);
    }
}

TEST(LabelLayout, NeverLiesOnAnotherLabelOnButtonsOrOnItsOwnOrANearerHead) {
    const QRectF buttons(10, 10, 260, 30);
    for (unsigned seed = 1; seed <= 60; ++seed) {
        const auto places = crowd(seed, 20);
        const auto placed = placeLabels(places, kViewport, {buttons});
        for (std::size_t i = 0; i < placed.size(); ++i) {
            if (placed[i].form > LabelForm::Brief) {
                continue;
            }
            EXPECT_TRUE(kViewport.contains(placed[i].plate)) << seed;
            EXPECT_FALSE(buttons.intersects(placed[i].plate)) << seed;
            EXPECT_FALSE(places[i].head.intersects(placed[i].plate)) << seed;
            for (std::size_t k = 0; k < placed.size(); ++k) {
                if (k == i) {
                    continue;
                }
                EXPECT_FALSE(placed[k].form <= LabelForm::Brief &&
                             placed[k].plate.intersects(placed[i].plate))
                    << seed;
                EXPECT_FALSE(places[k].depth < places[i].depth && places[k].head.intersects(placed[i].plate))
                    << "the label of " << i << " on the head of " << k << ", seed " << seed;
            }
        }
    }
}

TEST(LabelLayout, GetsShorterBeforeItLiesOnAnyHead) {
    const QRectF buttons(10, 10, 400, 80);
    std::size_t covered = 0;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        const auto places = crowd(seed, 4);
        const auto placed = placeLabels(places, kViewport, {buttons});
        for (const PlacedLabel& label : placed) {
            covered += label.form == LabelForm::Whole &&
                               std::ranges::any_of(places,
                                                   [&](const LabelPlace& place) {
                                                       return place.head.intersects(label.plate);
                                                   })
                           ? 1
                           : 0;
        }
    }
    EXPECT_LE(covered, 1U) << "only where not even initials have room";
}

TEST(LabelLayout, KeepsPartOfTheNameWhereThereIsRoomForThat) {
    LabelPlace place = labelAt(300, 200, 5);
    place.named = {120, 24};
    const QRectF leftOf(0, 100, 220, 130);
    const QRectF rightOf(380, 100, 260, 130);
    EXPECT_EQ(placeLabels(std::vector{place}, kViewport, {leftOf, rightOf})[0].form, LabelForm::Named);
    place.named = {};
    EXPECT_EQ(placeLabels(std::vector{place}, kViewport, {leftOf, rightOf})[0].form, LabelForm::Brief);
    const auto few = [](const std::vector<LabelPlace>& places) {
        const auto placed = placeLabels(places, kViewport, {});
        return std::ranges::count_if(placed,
                                     [](const PlacedLabel& label) { return label.form == LabelForm::Brief; });
    };
    std::ptrdiff_t without = 0;
    std::ptrdiff_t with = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        auto places = crowd(seed, 12);
        without += few(places);
        for (LabelPlace& one : places) {
            one.named = {110, 24};
        }
        with += few(places);
    }
    EXPECT_LT(2 * with, without);
}

TEST(LabelLayout, StaysByItsHeadInACrowdAndGetsShorterInstead) {
    std::size_t briefs = 0;
    std::size_t shown = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        const auto places = crowd(seed, 20);
        const auto placed = placeLabels(places, kViewport, {});
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const QRectF& plate = placed[i].plate;
            const qreal x =
                std::max({plate.left() - places[i].anchor.x(), places[i].anchor.x() - plate.right(), 0.0});
            const qreal y =
                std::max({plate.top() - places[i].anchor.y(), places[i].anchor.y() - plate.bottom(), 0.0});
            EXPECT_LE(std::hypot(x, y), 6 * 24) << seed;
            briefs += placed[i].form == LabelForm::Brief ? 1 : 0;
            shown += placed[i].form <= LabelForm::Brief ? 1 : 0;
        }
    }
    EXPECT_GT(briefs, 60U);
    EXPECT_GT(shown, 60U * 17U) << "nearly all have text";
}

/// Only heads of nearer people can take its room, never the labels of others.
TEST(LabelLayout, TheHeaviestKeepsItsText) {
    int whole = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        auto places = crowd(seed, 20);
        const std::size_t heaviest = seed % 20;
        places[heaviest].weight = 2;
        const LabelForm form = placeLabels(places, kViewport, {})[heaviest].form;
        whole += form == LabelForm::Whole ? 1 : 0;
        for (LabelPlace& place : places) {
            place.whole = place.weight == 2 ? place.whole : QSizeF(1, 1);
        }
        EXPECT_EQ(form, placeLabels(places, kViewport, {})[heaviest].form) << seed;
    }
    EXPECT_GE(whole, 38);
}

TEST(LabelLayout, StaysWhereItWasWhileThatIsFree) {
    auto places = crowd(7, 12);
    auto before = placeLabels(places, kViewport, {});
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i].before = before[i];
        places[i].anchor += QPointF(0.4, 0.3);
        places[i].head.translate(0.4, 0.3);
    }
    const auto after = placeLabels(places, kViewport, {});
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(after[i].form, before[i].form) << i;
        EXPECT_LT(std::abs(after[i].plate.left() - before[i].plate.left()), 3) << i;
    }
}

TEST(LabelLayout, ComesBackToItsHeadWhenThereIsRoom) {
    std::vector places{labelAt(300, 200, 5)};
    const QRectF above(200, 170, 200, 28);
    places[0].before = placeLabels(places, kViewport, {above})[0];
    EXPECT_TRUE(leaderOf(*places[0].before, places, 0));
    const PlacedLabel back = placeLabels(places, kViewport, {})[0];
    EXPECT_FALSE(leaderOf(back, places, 0));
}

TEST(LabelLayout, HasALineToAHeadThatItIsAwayFrom) {
    const QRectF above(200, 100, 200, 97);
    const QRectF below(200, 200, 200, 60);
    const auto placed = placeLabels(std::vector{labelAt(300, 195, 5)}, kViewport, {above, below});
    ASSERT_LE(placed[0].form, LabelForm::Brief);
    EXPECT_TRUE(leaderOf(placed[0], std::vector{labelAt(300, 195, 5)}, 0));
}

TEST(LabelLayout, HasNoLineOnANearerHead) {
    std::vector places{labelAt(300, 195, 5), labelAt(300, 130, 2)};
    const PlacedLabel placed{QRectF(260, 90, 80, 24), LabelForm::Brief, {}};
    const auto leader = leaderOf(placed, places, 0);
    ASSERT_TRUE(leader);
    EXPECT_NEAR(leader->y1(), 114, 0.1);
    EXPECT_NEAR(leader->y2(), places[1].head.top(), 0.1) << "it goes on behind";
    places[1].depth = 5;
    EXPECT_NEAR(leaderOf(placed, places, 0)->y2(), 195, 0.1) << "no nearer";
    places[1] = {{}, QRectF(400, 100, 40, 60), 2};
    EXPECT_NEAR(leaderOf(placed, places, 0)->y2(), 195, 0.1);
    places[1].head = QRectF(250, 80, 100, 200);
    EXPECT_FALSE(leaderOf(placed, places, 0));
}

TEST(LabelLayout, IsNotThereWhereTheHeadIsOutOfSight) {
    EXPECT_EQ(placeLabels(std::vector{labelAt(-5, 200, 5)}, kViewport, {})[0].form, LabelForm::None);
}

TEST(LabelLayout, StandsBesideAHeadThatReachesUpToTheButtons) {
    const QRectF buttons(0, 0, 640, 50);
    LabelPlace close = labelAt(320, 45, 0.3);
    close.head = QRectF(230, 60, 180, 240);
    const auto placed = placeLabels(std::vector{close}, kViewport, {buttons});
    EXPECT_EQ(placed[0].form, LabelForm::Whole);
    EXPECT_FALSE(placed[0].plate.intersects(close.head));
    EXPECT_FALSE(placed[0].plate.intersects(buttons));
}

TEST(LabelLayout, HasNoMarkUnderAButton) {
    const QRectF everything(0, 0, 640, 390);
    EXPECT_EQ(placeLabels(std::vector{labelAt(300, 200, 5)}, kViewport, {everything})[0].form,
              LabelForm::None);
}

TEST(LabelLayout, InitialsTellNamesApart) {
    EXPECT_EQ(initialsOf("Mira Lindqvist"), "ML");
    EXPECT_EQ(initialsOf("Mira Lindqvist 2"), "ML2");
    EXPECT_EQ(initialsOf("Character 17"), "C17");
    EXPECT_EQ(initialsOf("jonas"), "J");
    EXPECT_EQ(initialsOf(QString::fromUtf8("jonas · 0 · :40002")), "J0");
    EXPECT_EQ(initialsOf("a b c d"), "AB");
    EXPECT_EQ(initialsOf(""), "");
    EXPECT_LE(initialsOf("1 2 3 4 5 6 7 8 9").size(), 5);
    EXPECT_EQ(initialsOf(QString::fromUtf8("𝔐ira")).size(), 2) << "no half of a character";
}

} // namespace
} // namespace posewire::gui
