// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/scene.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/captions.h"
#include "app/gui/viewport/overlays.h"
#include "core/model/body/null_pose_measures.h"
#include "core/model/body/pose_messages.h"
#include "core/model/body/pose_remark.h"
#include "core/model/body/reference_body.h"
#include "core/model/session/messages.h"

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr float kGreatestDim = 0.55F;
constexpr float kGhostOpacity = 0.35F;
constexpr float kBodyAxesLength = 30.0F; ///< logical pixels
constexpr float kPropAxesLength = 46.0F;
constexpr float kShortestAxes = 0.03F; ///< metres
constexpr float kLongestAxes = 0.25F;
constexpr float kUnselectedAxesAlpha = 0.85F;
constexpr float kLabelHeight = 0.24F;

/// That a body's place is assumed is not to be seen on its pelvis.
render::Provenance provenanceOf(const model::CharacterPose& pose, std::size_t segment) {
    const model::SegmentSource& source = pose.sources[segment];
    const bool isPlace = pose.isPlaceAssumed && segment == render::Pelvis;
    switch (isPlace ? std::min(source.orientation, model::Provenance::Solved) : source.weaker()) {
    case model::Provenance::Sent:
        return render::Provenance::Sent;
    case model::Provenance::Solved:
        return render::Provenance::Solved;
    default:
        return render::Provenance::Assumed;
    }
}

/// Of the body, without origins that are far from it: a corrupt one must not lead the camera away.
render::Bounds boundsOf(const std::array<glm::vec3, render::kSegmentCount>& origins) {
    constexpr float kReach = 6; // times the median distance; those of a person are within 3
    const auto medianOf = [&origins](auto valueOf) {
        std::array<float, render::kSegmentCount> values{};
        std::ranges::transform(origins, values.begin(), valueOf);
        std::ranges::nth_element(values, values.begin() + values.size() / 2);
        return values[values.size() / 2];
    };
    const glm::vec3 middle{medianOf([](const glm::vec3& at) { return at.x; }),
                           medianOf([](const glm::vec3& at) { return at.y; }),
                           medianOf([](const glm::vec3& at) { return at.z; })};
    const auto distanceOf = [&middle](const glm::vec3& at) { return glm::distance(at, middle); };
    const float reach = kReach * medianOf(distanceOf);
    render::Bounds bounds;
    for (const glm::vec3& origin : origins) {
        if (distanceOf(origin) <= reach) {
            bounds.add(origin);
        }
    }
    return bounds;
}

/// So much above the head; of who is upside down, above all of the body, which else would lie under it.
glm::vec3 aboveBody(const Figure& figure, const glm::vec3& head, float height) {
    constexpr float kSurely = 0.4F; // metres from the head up to the pelvis; from none on it shifts over
    constexpr float kFlesh = 0.25F; // around the origins of segments
    const glm::vec3 pelvis =
        render::transformPoint(figure.palette[render::Pelvis], figure.body->fit.origins[render::Pelvis]);
    const glm::vec3 middle = figure.bounds.centre();
    const glm::vec3 above(middle.x, middle.y, figure.bounds.max.z + kFlesh);
    return glm::mix(head + glm::vec3(0, 0, height), above, glm::smoothstep(0.0F, kSurely, pelvis.z - head.z));
}

void makePalette(const model::CharacterPose& pose, Figure& figure) {
    std::array<glm::vec3, render::kSegmentCount> positions{};
    std::array<glm::quat, render::kSegmentCount> orientations{};
    for (std::size_t i = 0; i < render::kSegmentCount; ++i) {
        positions[i] = pointOf(pose.segments[i].position);
        orientations[i] = turnOf(pose.segments[i].orientation);
        figure.look.provenance[i] = provenanceOf(pose, i);
    }
    figure.bounds = boundsOf(positions);
    const PosedHands hands = handsOf(pose);
    const render::PaletteJob job{positions,    orientations,  figure.body->fit.origins,      figure.palette,
                                 hands.left(), hands.right(), figure.body->fit.fingerOrigins};
    if (job.validate()) {
        job.run();
    }
}

/// As its sender calls it, counted from 0: in the scale message (type 13, props follow the body), else in
/// type 11 (E 2.6). Empty if neither tells.
std::string propName(const model::SessionView& session, const model::CharacterKey& key,
                     const model::SegmentLayout& layout, int prop) {
    const model::NullPose* nullPose = session.messages().nullPose(key);
    const auto place = static_cast<std::size_t>(layout.body + prop);
    if (nullPose != nullptr && nullPose->segments.size() == static_cast<std::size_t>(layout.count())) {
        return nullPose->segments[place].name.shown();
    }
    const model::Message* message = session.messages().message(key, wire::PropInformation::kType);
    const auto* sent =
        message == nullptr ? nullptr : std::get_if<wire::PropInformation>(&message->datagram.body);
    const bool isNamed = sent != nullptr && static_cast<std::size_t>(prop) < sent->props.size();
    return isNamed ? model::ForeignText(sent->props[static_cast<std::size_t>(prop)].name).shown()
                   : std::string();
}

} // namespace

render::SceneColours themedSceneColours() {
    const Theme& colours = theme();
    render::SceneColours scene = colours.isDark ? render::darkSceneColours() : render::lightSceneColours();
    scene.axisX = inkOf(colours.axisX);
    scene.axisY = inkOf(colours.axisY);
    scene.axisZ = inkOf(colours.axisZ);
    scene.selection = inkOf(colours.accent);
    return scene;
}

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
    scene.points = frame.points;
    return scene;
}

void SceneUpload::add(const Figure& figure, render::Renderer& renderer) {
    if (figure.drawn() == nullptr) {
        return;
    }
    const auto [entry, isNew] = m_meshes.try_emplace(figure.drawn());
    Meshes& meshes = entry->second;
    if (isNew && figure.own != nullptr) {
        meshes = {renderer.uploadMesh(figure.own->mesh, figure.own->dress()), render::MeshId::None};
    } else if (isNew) {
        meshes = {renderer.uploadMesh(figure.body->mannequin->mesh),
                  renderer.uploadMesh(figure.body->mannequin->lowMesh)};
    }
    m_instances.push_back({meshes.mesh, meshes.low, figure.drawnPalette(), figure.look, figure.fit()});
    render::CharacterLook look = figure.look; // where it is, is sent; whoever holds it is selected
    look.provenance = {};
    look.isSelected = false;
    look.selectedSegment = -1;
    for (const FigureProp& prop : figure.props) {
        render::MeshId& mesh = m_props[static_cast<std::size_t>(prop.shape)];
        mesh = mesh == render::MeshId::None ? renderer.uploadMesh(prop.shape) : mesh;
        m_instances.push_back({mesh, render::MeshId::None, prop.motion, look});
    }
}

void SceneUpload::releaseUnused(const SceneFrame& frame, render::Renderer& renderer) {
    std::erase_if(m_meshes, [&](const auto& entry) {
        const auto isItsOwn = [&](const Figure& figure) { return figure.drawn() == entry.first; };
        const bool isUsed =
            std::ranges::any_of(frame.figures, isItsOwn) || std::ranges::any_of(frame.ghosts, isItsOwn);
        if (!isUsed) {
            renderer.releaseMesh(entry.second.mesh);
            renderer.releaseMesh(entry.second.low);
        }
        return !isUsed;
    });
}

void sizeAxes(SceneFrame& frame) {
    const float height = static_cast<float>(frame.height) / frame.pixelRatio;
    for (render::AxesInstance& axes : frame.axes) {
        const bool isFlat = frame.camera.projection == render::Projection::Orthographic;
        const float depth = isFlat ? frame.camera.distance
                                   : glm::dot(axes.position - frame.camera.eye(), frame.camera.forward());
        const float pixel = 2.0F * std::max(depth, 0.0F) * std::tan(0.5F * frame.camera.verticalFov) / height;
        axes.length = std::clamp(axes.length * pixel, kShortestAxes, kLongestAxes);
    }
}

float dimFor(double ageSeconds) {
    const double share = (ageSeconds - kSilentAge) / (kStaleAge - kSilentAge);
    // That it has begun to fade must be visible: a step first, the rest gradually.
    return share < 0 ? 0.0F : kGreatestDim * static_cast<float>(0.4 + 0.6 * std::min(share, 1.0));
}

std::shared_ptr<const FigureBody> SceneBuilder::fitOf(const model::SessionView& session,
                                                      const model::CharacterKey& key, double scale) {
    render::NullPose performer{};
    const model::BodyOrigins& origins = session.messages().bodyOrigins(key);
    static_assert(std::tuple_size_v<decltype(origins.places)> == std::tuple_size_v<render::NullPose>);
    std::ranges::transform(origins.places, performer.begin(),
                           [&](const Eigen::Vector3d& origin) { return pointOf(scale * origin); });
    const model::NullPose* nullPose = session.messages().nullPose(key);
    return nullPose == nullptr || scale != 1 ? m_bodies.of(performer)
                                             : m_bodies.of(performer, fingerOriginsOf(*nullPose, origins));
}

bool SceneBuilder::isUnderWay() const {
    return std::ranges::any_of(m_motions, [](const auto& one) { return one.second.isUnderWay(); });
}

const model::CharacterPose* SceneBuilder::poseOf(const model::CharacterKey& key) {
    const model::CharacterPose* pose =
        m_session.roster().isHidden(key) ? nullptr : m_session.messages().pose(key);
    const bool isFollowing = m_session.choices().cursor.mode == model::Cursor::Mode::Following;
    if (pose == nullptr || !m_isInterpolating || !isFollowing || m_session.isRecording()) {
        m_motions.erase(key);
        return pose;
    }
    return &m_motions[key].at(*pose, m_session.now());
}

void SceneBuilder::build(AxesMode axes, const Overlays& overlays, SceneFrame& frame) {
    frame.colours = themedSceneColours();
    const model::Selection& selection = m_session.choices().selection;
    const std::vector<const model::Character*> characters = m_session.roster().listed();
    std::erase_if(m_motions, [this](const auto& motion) {
        return m_session.roster().findListed(motion.first) == nullptr;
    });
    const bool isOneSelected = std::ranges::any_of(
        characters, [this](const model::Character* one) { return m_session.roster().isSelected(one->key); });
    for (const model::Character* shown : characters) {
        const model::Character& character = *shown;
        const model::CharacterPose* pose = poseOf(character.key);
        addTags(character.key, pose, frame);
        if (pose == nullptr) {
            continue;
        }
        if (pose->isObjects) {
            addObjects(character, *pose, frame);
            continue;
        }
        addFigure(character, *pose, frame);
        Figure& figure = frame.figures.back();
        const bool isSelected = m_session.roster().isSelected(character.key);
        figure.look.isSelected = isSelected;
        figure.look.selectedSegment =
            isSelected && selection.segment < model::kBodySegmentCount ? selection.segment : -1;
        if (axes == AxesMode::All || (axes == AxesMode::Selected && isSelected)) {
            const std::size_t first = frame.axes.size();
            addAxes(*pose, isSelected ? selection.segment : -1, 1.0F - figure.look.dim, frame);
            if (isSelected) {
                frame.selectedAxes = first;
                frame.selectedAxesCount = frame.axes.size() - first;
            }
        }
        if (overlays.isAny() && (isSelected || !isOneSelected)) {
            addOverlays(overlays,
                        {{m_session, character.key, *pose},
                         figure.look.colour,
                         isSelected ? selection.segment : -1,
                         isSelected || characters.size() == 1,
                         1.0F - figure.look.dim},
                        frame);
        }
        if (m_session.choices().isGhostShown && shownCharacter(m_session) == character.key) {
            addGhost(figure, *pose, frame);
        }
    }
    addCompared(frame);
}

void SceneBuilder::addFigure(const model::Character& character, const model::CharacterPose& pose,
                             SceneFrame& frame) {
    Figure figure = bodyOf(m_session, character.key, pose);
    const auto provenance = figure.look.provenance;
    figure.look = lookOf(character.key);
    figure.look.provenance = provenance;
    addProps(pose, figure);
    dress(figure);
    frame.figures.push_back(std::move(figure));
}

void SceneBuilder::addProps(const model::CharacterPose& pose, Figure& figure) const {
    for (int prop = 0; prop < pose.layout.props; ++prop) {
        const auto segment = static_cast<std::size_t>(pose.layout.body + prop);
        if (segment >= pose.segments.size() || !pose.isPresent(segment)) {
            continue;
        }
        const glm::vec3 origin = pointOf(pose.segments[segment].position);
        figure.props.push_back(
            {render::propShapeOf(propName(m_session, figure.key, pose.layout, prop)),
             {render::rigidMotion(turnOf(pose.segments[segment].orientation), glm::vec3(0.0F), origin)}});
        figure.free.push_back({static_cast<int>(segment), origin});
    }
}

Figure SceneBuilder::bodyOf(const model::SessionView& session, const model::CharacterKey& key,
                            const model::CharacterPose& pose) {
    Figure figure;
    figure.key = key;
    figure.body = fitOf(session, key, model::scaleInPose(pose, session.messages().bodyOrigins(key)));
    makePalette(pose, figure);
    const glm::vec3 head = figure.body->fit.origins[render::Head];
    figure.labelPosition =
        aboveBody(figure, render::transformPoint(figure.palette[render::Head], head), kLabelHeight);
    return figure;
}

/// The user's own body in the pose that the mannequin has.
void SceneBuilder::dress(Figure& figure) {
    const auto dressed =
        m_wardrobe.isEmpty() ? nullptr : m_wardrobe.of(shown(m_session.roster().displayName(figure.key)));
    if (dressed == nullptr) {
        return;
    }
    const std::shared_ptr<const OwnFigure> own = m_ownFigures.of(dressed, figure.body->fit.origins);
    std::vector<render::DualQuaternion> bones(dressed->body.joints.size());
    const render::OwnPaletteJob job{&dressed->body, own->scale, figure.palette, figure.body->fit.origins,
                                    bones};
    if (!job.validate()) {
        return;
    }
    job.run();
    constexpr float kAboveHead = 0.06F;
    const auto head = static_cast<std::size_t>(dressed->body.segmentJoints[render::Head]);
    const glm::vec3 top = own->scale * dressed->body.joints[head].origin + glm::vec3(0, 0, own->top);
    figure.labelPosition = aboveBody(figure, render::transformPoint(bones[head], top), kAboveHead);
    figure.own = own;
    figure.bones = std::move(bones);
}

render::CharacterLook SceneBuilder::lookOf(const model::CharacterKey& key) const {
    render::CharacterLook look;
    const model::Colour colour = m_session.roster().colour(key);
    look.colour = {colour.red, colour.green, colour.blue};
    const double age = shownAgeSeconds(m_session, key);
    look.dim = dimFor(age);
    look.isHatched = age >= kStaleAge;
    return look;
}

void SceneBuilder::addTags(const model::CharacterKey& key, const model::CharacterPose* pose,
                           SceneFrame& frame) const {
    if (m_session.roster().isHidden(key)) {
        return;
    }
    const Eigen::Vector3d moved = pose != nullptr ? pose->moved : Eigen::Vector3d::Zero();
    for (const model::TagPlace& tag : m_session.messages().tags(key)) {
        const double age = log::secondsOf(m_session.cursorStamp() - tag.stamp);
        const QString text = age < kStaleAge
                                 ? QString::number(tag.id)
                                 : QStringLiteral("%1 · %2").arg(QString::number(tag.id), duration(age));
        const glm::vec3 place = pointOf(tag.position + moved);
        frame.points.push_back({place, glm::vec4(lookOf(key).colour, 1.0F - dimFor(age)), 9.0F});
        frame.texts.push_back({place, text, theme().dim});
    }
}

/// Their axes are all there is of them: they are drawn whatever the choice of axes.
void SceneBuilder::addObjects(const model::Character& character, const model::CharacterPose& pose,
                              SceneFrame& frame) {
    Figure objects;
    objects.key = character.key;
    objects.look = lookOf(character.key);
    for (std::size_t i = 0; i < pose.segments.size(); ++i) {
        if (!pose.isPresent(i)) {
            continue;
        }
        const glm::vec3 position = pointOf(pose.segments[i].position);
        const bool isHighest = objects.bounds.isEmpty() || position.z > objects.labelPosition.z;
        objects.labelPosition = isHighest ? position : objects.labelPosition;
        objects.bounds.add(position);
        objects.free.push_back({static_cast<int>(i), position});
        frame.axes.push_back(
            {position, turnOf(pose.segments[i].orientation), kPropAxesLength, 1.0F - objects.look.dim});
    }
    objects.labelPosition.z += kLabelHeight;
    if (!objects.bounds.isEmpty()) {
        frame.figures.push_back(std::move(objects));
    }
}

void SceneBuilder::addGhost(const Figure& figure, const model::CharacterPose& pose, SceneFrame& frame) {
    const model::NullPose* nullPose = m_session.messages().nullPose(figure.key);
    if (nullPose == nullptr || !pose.isPresent(render::Pelvis)) {
        return;
    }
    const model::SegmentPose& pelvis = pose.segments[render::Pelvis];
    const Eigen::Vector3d ahead = pelvis.orientation * Eigen::Vector3d::UnitX();
    const auto heading = static_cast<float>(std::atan2(ahead.y(), ahead.x()));
    const glm::quat turn = glm::angleAxis(heading, glm::vec3(0, 0, 1));
    const glm::vec3 place(static_cast<float>(pelvis.position.x()), static_cast<float>(pelvis.position.y()),
                          0.0F);
    const std::shared_ptr<const FigureBody> body = fitOf(m_session, figure.key, 1); // as it was sent
    const render::NullPose& origins = body->fit.origins;
    const glm::vec3 stand(origins[render::Pelvis].x, origins[render::Pelvis].y,
                          static_cast<float>(model::measure(*nullPose).floor));
    std::array<glm::vec3, render::kSegmentCount> positions{};
    std::array<glm::quat, render::kSegmentCount> orientations{};
    orientations.fill(turn);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        positions[i] = place + turn * (origins[i] - stand);
    }
    PosedHands hands{{}, {}, true, true};
    hands.orientations.fill(turn);
    for (std::size_t i = 0; i < hands.positions.size(); ++i) {
        hands.positions[i] = place + turn * (body->fit.fingerOrigins[i] - stand);
    }
    Figure ghost;
    ghost.key = figure.key;
    ghost.body = body;
    ghost.look.colour = figure.look.colour;
    ghost.look.opacity = kGhostOpacity;
    ghost.look.selectedSegment = figure.look.selectedSegment;
    const render::PaletteJob job{positions,     orientations,           origins, ghost.palette, hands.left(),
                                 hands.right(), body->fit.fingerOrigins};
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
        if (!pose.isPresent(i)) {
            continue;
        }
        const bool isBody = i < static_cast<std::size_t>(pose.layout.body);
        const bool isSelected = static_cast<int>(i) == selectedSegment;
        const float length = isBody ? kBodyAxesLength : kPropAxesLength;
        frame.axes.push_back({pointOf(pose.segments[i].position), turnOf(pose.segments[i].orientation),
                              isSelected ? 1.6F * length : length,
                              strength * (isSelected ? 1.0F : kUnselectedAxesAlpha)});
    }
}

} // namespace posewire::gui
