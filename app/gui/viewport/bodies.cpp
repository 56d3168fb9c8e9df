// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/bodies.h"

#include "app/gui/viewport/overlays.h"
#include "core/model/body/segments.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace posewire::gui {

namespace {

constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();
constexpr model::SegmentLayout kWithFingers{model::kBodySegmentCount, 0, model::kFingerSegmentCount};
static_assert(render::kHandSegmentCount == model::kHandSegmentCount);

/// Finger, by its name in scale messages.
const std::map<std::string_view, std::size_t>& fingersByName() {
    static const std::map<std::string_view, std::size_t> kFingers = [] {
        std::map<std::string_view, std::size_t> fingers;
        for (std::size_t finger = 0; finger < render::kFingerJointCount; ++finger) {
            fingers.emplace(
                model::segmentName(kWithFingers, model::kBodySegmentCount + static_cast<int>(finger)),
                finger);
        }
        return fingers;
    }();
    return kFingers;
}

const model::NullPose::Segment* find(const model::NullPose& pose, std::string_view name) {
    const auto found = std::ranges::find_if(
        pose.segments, [&](const auto& segment) { return segment.name.exact() == name; });
    return found == pose.segments.end() ? nullptr : &*found;
}

} // namespace

std::shared_ptr<const FigureBody> BodyFits::of(const render::NullPose& performer,
                                               const render::FingerOrigins& fingers) {
    Body key;
    static_assert(sizeof(key) == sizeof(performer) + sizeof(fingers));
    std::memcpy(key.data(), performer.data(), sizeof(performer));
    std::memcpy(key.data() + 3 * performer.size(), fingers.data(), sizeof(fingers));
    ++m_asked;
    if (const auto known = m_entries.find(key); known != m_entries.end()) {
        known->second.asked = m_asked;
        return known->second.body;
    }
    if (m_mannequin == nullptr) {
        auto meshes = std::make_shared<MannequinMeshes>();
        meshes->mesh = render::loadMannequin(m_detail);
        meshes->lowMesh = render::loadMannequin(render::Detail::Low);
        meshes->capsules = render::segmentCapsules(meshes->mesh);
        m_mannequin = std::move(meshes);
    }
    if (m_entries.size() >= kMost) {
        m_entries.erase(
            std::ranges::min_element(m_entries, {}, [](const auto& entry) { return entry.second.asked; }));
    }
    auto body = std::make_shared<FigureBody>();
    body->mannequin = m_mannequin;
    body->fit = render::fitBody(performer, fingers);
    body->capsules = render::stretched(m_mannequin->capsules, body->fit.stretches);
    return m_entries.emplace(key, Entry{std::move(body), m_asked}).first->second.body;
}

std::size_t BodyFits::mannequinBytes() const {
    if (m_mannequin == nullptr) {
        return 0;
    }
    constexpr std::size_t kHere =
        2 * sizeof(glm::vec3) + sizeof(float) + sizeof(render::JointIndices) + sizeof(glm::vec4);
    std::size_t bytes = 0;
    for (const auto* mesh : {&m_mannequin->mesh, &m_mannequin->lowMesh}) {
        bytes += mesh->vertexCount() * (kHere + render::kGpuVertexBytes) +
                 2 * mesh->indices.size() * sizeof(mesh->indices[0]);
    }
    return bytes;
}

std::size_t BodyFits::memoryBytes() const {
    return mannequinBytes() + m_entries.size() * (sizeof(Body) + sizeof(FigureBody));
}

std::size_t BodyFits::mostBytes() const {
    return m_mannequin == nullptr ? 0 : mannequinBytes() + kMost * (sizeof(Body) + sizeof(FigureBody));
}

std::size_t DressedBody::meshBytes() const {
    constexpr std::size_t kVertex = 2 * sizeof(glm::vec3) + sizeof(float) + sizeof(render::JointIndices) +
                                    sizeof(glm::vec4) + sizeof(glm::vec2);
    return body.mesh.vertexCount() * kVertex + body.mesh.indices.size() * sizeof(std::uint32_t);
}

std::size_t DressedBody::textureBytes() const {
    std::size_t bytes = 0;
    for (const render::TextureImage& image : *textures) {
        bytes += image.texels.size();
    }
    return bytes;
}

std::shared_ptr<const DressedBody> Wardrobe::of(const QString& name) const {
    const auto own = byName.find(name);
    return own == byName.end() ? forAll : own->second;
}

render::MeshDress OwnFigure::dress() const {
    const render::OwnBody& body = dressed->body;
    return {body.jointSegments, body.segmentJoints, body.texturePlaces, body.parts, *dressed->textures};
}

std::shared_ptr<const OwnFigure> sized(std::shared_ptr<const DressedBody> dressed, float scale) {
    auto figure = std::make_shared<OwnFigure>();
    const render::OwnBody& body = dressed->body;
    figure->scale = scale;
    figure->mesh = body.mesh;
    float highest = 0.0F;
    for (glm::vec3& position : figure->mesh.positions) {
        position *= scale;
        highest = std::max(highest, position.z);
    }
    figure->capsules = render::segmentCapsules(figure->mesh, body.jointSegments, body.segmentJoints);
    figure->top = std::max(highest - scale * body.head.z, 0.0F);
    figure->dressed = std::move(dressed);
    return figure;
}

std::shared_ptr<const OwnFigure> OwnFigures::of(const std::shared_ptr<const DressedBody>& dressed,
                                                const render::NullPose& origins) {
    constexpr float kSteps = 200.0F; // half a percent is not to be seen
    const float exact = dressed->isScaled ? render::scaleFor(dressed->body, origins) : 1.0F;
    const float scale = std::max(std::round(exact * kSteps), 1.0F) / kSteps;
    ++m_uses;
    for (Entry& entry : m_entries) {
        if (entry.figure->dressed == dressed && entry.figure->scale == scale) {
            entry.used = m_uses;
            return entry.figure;
        }
    }
    if (m_entries.size() >= kMost) {
        m_entries.erase(std::ranges::min_element(m_entries, {}, &Entry::used));
    }
    m_entries.push_back({sized(dressed, scale), m_uses});
    return m_entries.back().figure;
}

std::size_t OwnFigures::memoryBytes() const {
    std::size_t bytes = 0;
    for (const Entry& entry : m_entries) {
        bytes += 2 * entry.figure->dressed->meshBytes() + 2 * entry.figure->dressed->textureBytes();
    }
    return bytes;
}

std::size_t OwnFigures::mostBytes() const {
    std::size_t largest = 0;
    for (const Entry& entry : m_entries) {
        largest =
            std::max(largest, entry.figure->dressed->meshBytes() + entry.figure->dressed->textureBytes());
    }
    return kMost * 2 * largest;
}

render::FingerPose PosedHands::left() const {
    constexpr std::size_t kCount = render::kHandSegmentCount;
    return hasLeft
               ? render::FingerPose{std::span(positions).first(kCount), std::span(orientations).first(kCount)}
               : render::FingerPose{};
}

render::FingerPose PosedHands::right() const {
    constexpr std::size_t kCount = render::kHandSegmentCount;
    return hasRight
               ? render::FingerPose{std::span(positions).last(kCount), std::span(orientations).last(kCount)}
               : render::FingerPose{};
}

PosedHands handsOf(const model::CharacterPose& pose) {
    PosedHands hands;
    const auto first = static_cast<std::size_t>(pose.layout.body + pose.layout.props);
    for (std::size_t i = 0; i < render::kFingerJointCount; ++i) {
        const std::size_t at = first + i;
        const bool isThere = i < static_cast<std::size_t>(pose.layout.fingers) && pose.isPresent(at);
        if (!isThere) {
            hands.positions[i] = glm::vec3(kAbsent);
            hands.orientations[i] = glm::quat(kAbsent, kAbsent, kAbsent, kAbsent);
            continue;
        }
        hands.positions[i] = pointOf(pose.segments[at].position);
        hands.orientations[i] = turnOf(pose.segments[at].orientation);
        (i < render::kHandSegmentCount ? hands.hasLeft : hands.hasRight) = true;
    }
    return hands;
}

render::FingerOrigins fingerOriginsOf(const model::NullPose& nullPose, const model::BodyOrigins& body) {
    render::FingerOrigins origins;
    origins.fill(glm::vec3(kAbsent));
    if (nullPose.segments.size() <= static_cast<std::size_t>(model::kBodySegmentCount)) {
        return origins;
    }
    const model::NullPose::Segment* leftHand = find(nullPose, "LeftHand");
    const model::NullPose::Segment* rightHand = find(nullPose, "RightHand");
    for (const model::NullPose::Segment& segment : nullPose.segments) {
        const auto known = fingersByName().find(segment.name.exact());
        if (known == fingersByName().end()) {
            continue;
        }
        const bool isLeft = known->second < render::kHandSegmentCount;
        const model::NullPose::Segment* hand = isLeft ? leftHand : rightHand;
        if (hand != nullptr) {
            const auto& place = body.places[isLeft ? model::segment::kLeftHand : model::segment::kRightHand];
            origins[known->second] = pointOf(place + segment.position - hand->position);
        }
    }
    return origins;
}

} // namespace posewire::gui
