// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/scene.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/captions.h"
#include "core/model/body/null_pose_measures.h"
#include "core/model/body/reference_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posewire::gui {

namespace {

constexpr float kGreatestDim = 0.55F;
constexpr float kGhostOpacity = 0.35F;
constexpr float kBodyAxesLength = 0.12F;
constexpr float kPropAxesLength = 0.2F;
constexpr float kUnselectedAxesAlpha = 0.85F;
constexpr float kLabelHeight = 0.24F;

glm::vec3 vectorOf(const Eigen::Vector3d& vector) {
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

glm::quat rotationOf(const Eigen::Quaterniond& rotation) {
    return {static_cast<float>(rotation.w()), static_cast<float>(rotation.x()),
            static_cast<float>(rotation.y()), static_cast<float>(rotation.z())};
}

glm::vec3 vectorOf(const QColor& colour) {
    return {static_cast<float>(colour.redF()), static_cast<float>(colour.greenF()),
            static_cast<float>(colour.blueF())};
}

bool isPresent(const model::CharacterPose& pose, std::size_t position) {
    return position < pose.segments.size() && position < pose.isPresent.size() && pose.isPresent[position];
}

/// Absent segments are left to the palette, which puts what is not finite at its null-pose place.
void makePalette(const model::CharacterPose& pose, Figure& figure) {
    constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();
    std::array<glm::vec3, render::kSegmentCount> positions{};
    std::array<glm::quat, render::kSegmentCount> orientations{};
    for (std::size_t i = 0; i < render::kSegmentCount; ++i) {
        positions[i] = glm::vec3(kAbsent);
        orientations[i] = glm::quat(kAbsent, kAbsent, kAbsent, kAbsent);
        if (isPresent(pose, i)) {
            positions[i] = vectorOf(pose.segments[i].position);
            orientations[i] = rotationOf(pose.segments[i].orientation);
            figure.bounds.add(positions[i]);
        }
    }
    const render::PaletteJob job{positions, orientations, figure.mesh->origins, figure.palette};
    if (job.validate()) {
        job.run();
    }
}

/// The theme's colours as the renderer wants them.
render::SceneColours themedSceneColours() {
    const Theme& colours = theme();
    render::SceneColours scene = colours.isDark ? render::darkSceneColours() : render::lightSceneColours();
    scene.axisX = vectorOf(colours.axisX);
    scene.axisY = vectorOf(colours.axisY);
    scene.axisZ = vectorOf(colours.axisZ);
    scene.selection = vectorOf(colours.accent);
    return scene;
}

} // namespace

render::Scene SceneUpload::prepare(const SceneFrame& frame, render::Renderer& renderer) {
    releaseUnused(frame, renderer);
    m_instances.clear();
    for (const auto* figures : {&frame.figures, &frame.ghosts}) {
        for (const Figure& figure : *figures) {
            add(figure, renderer);
        }
    }
    render::Scene scene;
    scene.camera = frame.camera;
    scene.light = render::keyLight(frame.camera);
    scene.colours = frame.colours;
    scene.characters = m_instances;
    scene.axes = frame.axes;
    scene.lines = frame.lines;
    return scene;
}

void SceneUpload::add(const Figure& figure, render::Renderer& renderer) {
    const auto [entry, isNew] = m_meshes.try_emplace(figure.mesh, render::MeshId::None);
    if (isNew) {
        entry->second = renderer.uploadMesh(figure.mesh->mesh, figure.mesh->templatePositions);
    }
    m_instances.push_back({entry->second, figure.palette, figure.look});
}

void SceneUpload::releaseUnused(const SceneFrame& frame, render::Renderer& renderer) {
    std::erase_if(m_meshes, [&](const auto& entry) {
        const auto isItsOwn = [&](const Figure& figure) { return figure.mesh == entry.first; };
        const bool isUsed =
            std::ranges::any_of(frame.figures, isItsOwn) || std::ranges::any_of(frame.ghosts, isItsOwn);
        if (!isUsed) {
            renderer.releaseMesh(entry.second);
        }
        return !isUsed;
    });
}

float dimFor(double ageSeconds) {
    const double share = (ageSeconds - kSilentAge) / (kStaleAge - kSilentAge);
    // That it has begun to fade must be visible: a step first, the rest gradually.
    return share < 0 ? 0.0F : kGreatestDim * static_cast<float>(0.4 + 0.6 * std::min(share, 1.0));
}

std::shared_ptr<const FigureMesh> SceneBuilder::meshOf(const model::CharacterKey& key) {
    render::NullPose performer{};
    const model::BodyOrigins& origins = m_session.bodyOrigins(key);
    static_assert(std::tuple_size_v<decltype(origins.places)> == std::tuple_size_v<render::NullPose>);
    std::ranges::transform(origins.places, performer.begin(),
                           [](const Eigen::Vector3d& origin) { return vectorOf(origin); });
    return m_meshes.of(performer);
}

void SceneBuilder::build(AxesMode axes, SceneFrame& frame) {
    frame.colours = themedSceneColours();
    m_meshes.beginPicture();
    const model::Selection& selection = m_session.selection();
    for (const model::Character* shown : m_session.currentCharacters()) {
        const model::Character& character = *shown;
        const model::CharacterPose* pose =
            m_session.isHidden(character.key) ? nullptr : m_session.pose(character.key);
        if (pose == nullptr) {
            continue;
        }
        addFigure(character, *pose, frame);
        Figure& figure = frame.figures.back();
        const bool isSelected = m_session.isSelected(character.key);
        figure.look.selectedSegment =
            isSelected && selection.segment < model::kBodySegmentCount ? selection.segment : -1;
        if (axes == AxesMode::All || (axes == AxesMode::Selected && isSelected)) {
            addAxes(*pose, isSelected ? selection.segment : -1, 1.0F - figure.look.dim, frame);
        }
        addFingers(*pose, figure.look.colour, frame);
        if (m_session.isGhostShown() && shownCharacter(m_session) == character.key) {
            addGhost(figure, *pose, frame);
        }
    }
}

void SceneBuilder::addFigure(const model::Character& character, const model::CharacterPose& pose,
                             SceneFrame& frame) {
    Figure figure;
    figure.key = character.key;
    figure.mesh = meshOf(character.key);
    const model::Colour colour = m_session.colour(character.key);
    figure.look.colour = {colour.red, colour.green, colour.blue};
    const double age = shownAgeSeconds(m_session, character.key);
    figure.look.dim = dimFor(age);
    figure.look.isHatched = age >= kStaleAge;
    makePalette(pose, figure);
    const glm::vec3 head = figure.mesh->origins[render::Head];
    figure.labelPosition =
        render::transformPoint(figure.palette[render::Head], head) + glm::vec3(0, 0, kLabelHeight);
    frame.figures.push_back(std::move(figure));
}

void SceneBuilder::addGhost(const Figure& figure, const model::CharacterPose& pose, SceneFrame& frame) const {
    const model::NullPose* nullPose = m_session.nullPose(figure.key);
    if (nullPose == nullptr || !isPresent(pose, render::Pelvis)) {
        return;
    }
    const model::SegmentPose& pelvis = pose.segments[render::Pelvis];
    const Eigen::Vector3d ahead = pelvis.orientation * Eigen::Vector3d::UnitX();
    const auto heading = static_cast<float>(std::atan2(ahead.y(), ahead.x()));
    const glm::quat turn = glm::angleAxis(heading, glm::vec3(0, 0, 1));
    const glm::vec3 place(static_cast<float>(pelvis.position.x()), static_cast<float>(pelvis.position.y()),
                          0.0F);
    const render::NullPose& origins = figure.mesh->origins;
    const glm::vec3 stand(origins[render::Pelvis].x, origins[render::Pelvis].y,
                          static_cast<float>(model::measure(*nullPose).floor));
    std::array<glm::vec3, render::kSegmentCount> positions{};
    std::array<glm::quat, render::kSegmentCount> orientations{};
    orientations.fill(turn);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        positions[i] = place + turn * (origins[i] - stand);
    }
    Figure ghost;
    ghost.key = figure.key;
    ghost.mesh = figure.mesh;
    ghost.look.colour = figure.look.colour;
    ghost.look.opacity = kGhostOpacity;
    ghost.look.selectedSegment = figure.look.selectedSegment;
    const render::PaletteJob job{positions, orientations, origins, ghost.palette};
    if (job.validate()) {
        job.run();
        frame.ghosts.push_back(std::move(ghost));
    }
}

void SceneBuilder::addAxes(const model::CharacterPose& pose, int selectedSegment, float strength,
                           SceneFrame& frame) const {
    const std::size_t count =
        std::min(pose.segments.size(), static_cast<std::size_t>(pose.layout.body + pose.layout.props));
    for (std::size_t i = 0; i < count; ++i) {
        if (!isPresent(pose, i)) {
            continue;
        }
        const bool isBody = i < static_cast<std::size_t>(pose.layout.body);
        const bool isSelected = static_cast<int>(i) == selectedSegment;
        const float length = isBody ? kBodyAxesLength : kPropAxesLength;
        frame.axes.push_back({vectorOf(pose.segments[i].position), rotationOf(pose.segments[i].orientation),
                              isSelected ? 1.6F * length : length,
                              strength * (isSelected ? 1.0F : kUnselectedAxesAlpha)});
    }
}

/// The mannequin has no fingers of its own: their bones are drawn.
void SceneBuilder::addFingers(const model::CharacterPose& pose, const glm::vec3& colour,
                              SceneFrame& frame) const {
    const auto first = static_cast<std::size_t>(pose.layout.body + pose.layout.props);
    for (std::size_t i = first; i < pose.segments.size(); ++i) {
        const int parent = model::segmentParent(pose.layout, static_cast<int>(i));
        if (parent < 0 || !isPresent(pose, i) || !isPresent(pose, static_cast<std::size_t>(parent))) {
            continue;
        }
        frame.lines.push_back({vectorOf(pose.segments[static_cast<std::size_t>(parent)].position),
                               vectorOf(pose.segments[i].position), glm::vec4(colour, 1.0F), 2.0F});
    }
}

} // namespace posewire::gui
