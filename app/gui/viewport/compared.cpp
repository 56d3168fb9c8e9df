// SPDX-License-Identifier: GPL-3.0-or-later
// A second recording over what is shown.
#include "app/gui/models/comparison_text.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/overlays.h"
#include "app/gui/viewport/scene.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

namespace posewire::gui {

namespace {

constexpr float kComparedOpacity = 0.45F;
constexpr double kAside = 1.2; // metres, across the room

model::SegmentPose placeOf(const ComparisonState& comparison, const Eigen::Vector3d& moved) {
    const Eigen::Vector3d aside(0, comparison.choice.isBeside ? kAside : 0, 0);
    return model::composed({moved + aside, Eigen::Quaterniond::Identity()}, comparison.atCursor->overlay);
}

model::CharacterPose laid(model::CharacterPose pose, const model::SegmentPose& place) {
    for (model::SegmentPose& segment : pose.segments) {
        segment.position -= pose.moved;
        segment = model::composed(place, segment);
    }
    return pose;
}

} // namespace

void SceneBuilder::addCompared(SceneFrame& frame) {
    if (m_comparison == nullptr || m_comparison->second == nullptr || !m_comparison->atCursor ||
        m_session.roster().isHidden(m_comparison->pair->first)) {
        return;
    }
    const model::SessionView& second = *m_comparison->second;
    const model::CharacterPose* first = m_session.messages().pose(m_comparison->pair->first);
    const bool isAsSent = m_comparison->choice.frame == model::DifferenceFrame::World;
    for (const model::Character* one : second.roster().listed()) {
        const bool isIts = one->key == m_comparison->pair->second;
        const model::CharacterPose* pose = isIts || isAsSent ? second.messages().pose(one->key) : nullptr;
        if (pose == nullptr || pose->isObjects || first == nullptr) {
            continue;
        }
        const model::CharacterPose placed = laid(*pose, placeOf(*m_comparison, first->moved));
        Figure body = bodyOf(second, one->key, placed);
        const model::Colour colour = second.roster().colour(one->key);
        body.look.colour = {colour.red, colour.green, colour.blue};
        body.look.opacity = kComparedOpacity;
        if (isIts) {
            frame.texts.push_back(
                {body.labelPosition + glm::vec3(0, 0, 0.06F),
                 tr("%1 · %2 mm apart")
                     .arg(m_comparison->name, fixed(m_comparison->atCursor->meanMillimetres(), 1)),
                 theme().dim});
            addDifferences(*first, placed, frame);
        }
        frame.ghosts.push_back(std::move(body));
    }
}

void SceneBuilder::addDifferences(const model::CharacterPose& first, const model::CharacterPose& second,
                                  SceneFrame& frame) const {
    constexpr float kLine = 3.0F; // logical pixels
    constexpr float kPoint = 8.0F;
    constexpr float kSelected = 1.6F;
    const DifferenceScale scale = scaleOf(*m_comparison);
    const model::Selection& selection = m_session.choices().selection;
    const bool isBeside = m_comparison->choice.isBeside;
    for (const model::SegmentDifference& one : m_comparison->atCursor->segments) {
        const bool isFinger = one.slot >= model::kBodySegmentCount + model::kMaxPropCount;
        const bool isSelected =
            selection.segment == one.first && m_session.roster().isSelected(m_comparison->pair->first);
        if (isFinger && !isSelected) {
            continue; // a hand is as one
        }
        const glm::vec3 from = pointOf(first.segments[static_cast<std::size_t>(one.first)].position);
        const glm::vec3 to = pointOf(second.segments[static_cast<std::size_t>(one.second)].position);
        const glm::vec4 ink = inkOf(scale.colourOf(one.millimetres));
        const float size = isSelected ? kSelected : 1.0F;
        frame.points.push_back({from, ink, size * kPoint, 0.6F});
        if (isBeside) {
            frame.points.push_back({to, ink, size * kPoint, 0.6F});
        } else {
            frame.lines.push_back({from, to, ink, size * kLine, 0.6F});
        }
        if (isSelected) {
            frame.texts.push_back({0.5F * (from + (isBeside ? from : to)) + glm::vec3(0, 0, 0.03F),
                                   tr("%1 mm, %2 °").arg(fixed(one.millimetres, 1), fixed(one.degrees, 1)),
                                   theme().text});
        }
    }
}

} // namespace posewire::gui
