// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/view_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace posewire::gui {
namespace {

SceneFrame frameOf(render::Camera camera) {
    SceneFrame frame;
    frame.width = 1200;
    frame.height = 800;
    frame.camera = camera;
    addFloorScale(frame);
    return frame;
}

const SceneText* find(const SceneFrame& frame, const QString& text) {
    const auto found = std::ranges::find(frame.texts, text, &SceneText::text);
    return found == frame.texts.end() ? nullptr : &*found;
}

TEST(FloorScale, StepsAreThoseThatPeopleCountIn) {
    EXPECT_DOUBLE_EQ(scaleStep(0.001, 60), 0.1);
    EXPECT_DOUBLE_EQ(scaleStep(0.003, 60), 0.2);
    EXPECT_DOUBLE_EQ(scaleStep(0.006, 60), 0.5);
    EXPECT_DOUBLE_EQ(scaleStep(0.01, 60), 1.0);
    EXPECT_DOUBLE_EQ(scaleStep(0.1, 60), 10.0);
}

TEST(FloorScale, NumbersStandOnTheFloorWhereTheySay) {
    const SceneFrame frame = frameOf({});
    const SceneText* text = find(frame, QStringLiteral("x 1 m"));
    ASSERT_NE(text, nullptr);
    EXPECT_EQ(text->position, glm::vec3(1, 0, 0));
    EXPECT_TRUE(text->isScale);
    EXPECT_NE(find(frame, QStringLiteral("y −2 m")), nullptr);
    EXPECT_TRUE(frame.lines.empty());
}

TEST(FloorScale, AViewAlongTheFloorHasRules) {
    render::Camera camera = render::facing({}, render::StandardView::Front);
    camera.projection = render::Projection::Orthographic;
    const SceneFrame frame = frameOf(camera);
    ASSERT_FALSE(frame.lines.empty());
    EXPECT_EQ(frame.lines[0].from.z, 0.0F);
    EXPECT_EQ(frame.lines[0].to.z, 0.0F);
    const SceneText* height = find(frame, QStringLiteral("z 1.5 m"));
    ASSERT_NE(height, nullptr);
    EXPECT_TRUE(std::ranges::any_of(frame.texts, [](const SceneText& one) {
        return one.text == QStringLiteral("z 1.5 m") && one.position.z == 1.5F;
    }));
}

TEST(FloorScale, RulesAreOfTheAxisThatGoesAcross) {
    for (const auto& [heading, axis, sign] :
         {std::tuple{0.0F, 1, 1}, {90.0F, 0, -1}, {180.0F, 1, -1}, {270.0F, 0, 1}}) {
        render::Camera camera = render::facing({}, render::StandardView::Front);
        camera.projection = render::Projection::Orthographic;
        camera.yaw += glm::radians(heading);
        const SceneFrame frame = frameOf(camera);
        const SceneText* text =
            find(frame, (axis == 0 ? QStringLiteral("x ") : QStringLiteral("y ")) + QStringLiteral("1.0 m"));
        ASSERT_NE(text, nullptr) << heading;
        EXPECT_GT(text->position[axis], 0.5F) << heading;
        EXPECT_EQ(camera.right()[axis] > 0 ? 1 : -1, sign) << heading;
    }
}

TEST(FloorScale, KeepsOutOfFigures) {
    SceneFrame frame;
    frame.width = 1200;
    frame.height = 800;
    Figure figure;
    figure.body = std::make_shared<FigureBody>();
    figure.bounds.add(glm::vec3(0.8F, -0.4F, 0));
    figure.bounds.add(glm::vec3(1.2F, 0.4F, 1.8F));
    frame.figures.push_back(figure);
    addFloorScale(frame);
    EXPECT_EQ(find(frame, QStringLiteral("x 1 m")), nullptr);
    EXPECT_NE(find(frame, QStringLiteral("x 3 m")), nullptr);
}

TEST(FloorScale, NumbersKeepApartAlsoTowardTheHorizon) {
    for (const float pitch : {0.03F, 0.1F, 0.3F}) {
        render::Camera camera;
        camera.pitch = pitch;
        camera.distance = 8;
        const SceneFrame frame = frameOf(camera);
        std::vector<glm::vec2> places;
        for (const SceneText& text : frame.texts) {
            const auto place = camera.project(text.position, 1.5F);
            ASSERT_TRUE(place);
            const glm::vec2 pixel(600 * place->x, 400 * place->y);
            for (const glm::vec2& other : places) {
                EXPECT_TRUE(std::abs(pixel.x - other.x) >= 48 || std::abs(pixel.y - other.y) >= 16)
                    << text.text.toStdString() << " at " << pitch;
            }
            places.push_back(pixel);
        }
        EXPECT_GT(places.size(), 1U) << pitch;
    }
}

} // namespace
} // namespace posewire::gui
