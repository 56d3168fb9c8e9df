// SPDX-License-Identifier: MIT
#include "core/export/motion/skeleton.h"

#include "core/model/body/null_pose_measures.h"
#include "core/model/body/points.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

namespace posewire::exporting {
namespace {

using Eigen::Vector3d;
using model::SegmentPose;

std::optional<Vector3d> sentOrigin(const feed::PoseCharacter& character, std::string_view name,
                                   int position) {
    if (!character.nullPose) {
        return std::nullopt;
    }
    if (position < model::kBodySegmentCount) {
        return character.body().places[static_cast<std::size_t>(position)];
    }
    const auto& segments = character.nullPose->segments;
    const auto found = std::ranges::find_if(segments, [&](const auto& one) { return one.name == name; });
    return found != segments.end() && found->position.allFinite() ? std::optional(found->position)
                                                                  : std::nullopt;
}

Vector3d offsetOf(const feed::PoseCharacter& character, const CharacterSurvey& survey, int position,
                  int parent) {
    const auto nameAt = [&](int one) { return model::segmentName(survey.layout, one); };
    const auto own = sentOrigin(character, nameAt(position), position);
    const auto from = parent >= 0 ? sentOrigin(character, nameAt(parent), parent) : Vector3d::Zero();
    if (own && from) {
        return *own - *from;
    }
    const SegmentPose* pose = poseAt(survey.firstPose, survey.layout, position);
    const SegmentPose* parentPose = parent >= 0 ? poseAt(survey.firstPose, survey.layout, parent) : nullptr;
    if (pose != nullptr && (parent < 0 || parentPose != nullptr)) {
        return parent < 0 ? pose->position : model::relativeTo(*parentPose, *pose).position;
    }
    const auto& places = character.body().places;
    const auto index = static_cast<std::size_t>(position);
    if (index >= places.size()) {
        return Vector3d::Zero();
    }
    return parent < 0 ? places[index] : Vector3d(places[index] - places[static_cast<std::size_t>(parent)]);
}

bool isProp(const model::SegmentLayout& layout, int position) {
    const auto place = model::placeOf(layout, position);
    return !place || place->kind == model::SegmentKind::Prop;
}

} // namespace

const SegmentPose* poseAt(const model::CharacterPose& pose, const model::SegmentLayout& layout,
                          int position) {
    const auto place = model::placeOf(layout, position);
    const int at = place ? model::positionIn(pose.layout, *place) : -1;
    const auto index = static_cast<std::size_t>(std::max(at, 0));
    return at >= 0 && index < pose.segments.size() && pose.isPresent(index) ? &pose.segments[index] : nullptr;
}

model::Provenance provenanceAt(const model::CharacterPose& pose, const model::SegmentLayout& layout,
                               int position) {
    const SegmentPose* segment = poseAt(pose, layout, position);
    return segment != nullptr
               ? pose.sources[static_cast<std::size_t>(segment - pose.segments.data())].weaker()
               : model::Provenance::None;
}

Skeleton skeletonOf(const feed::PoseCharacter& character, const CharacterSurvey& survey, bool hasProps) {
    Skeleton skeleton{survey.layout, {}};
    const int count = survey.layout.count();
    const std::function<void(int, int)> add = [&](int position, int parentJoint) {
        const std::size_t place = skeleton.joints.size();
        const int parent =
            parentJoint < 0 ? -1 : skeleton.joints[static_cast<std::size_t>(parentJoint)].position;
        skeleton.joints.push_back({model::segmentName(survey.layout, position),
                                   position,
                                   parentJoint,
                                   offsetOf(character, survey, position, parent),
                                   {}});
        for (int child = 0; child < count; ++child) {
            if (model::segmentParent(survey.layout, child) == position) {
                skeleton.joints[place].children.push_back(skeleton.joints.size());
                add(child, static_cast<int>(place));
            }
        }
    };
    for (int position = 0; position < count; ++position) {
        if (model::segmentParent(survey.layout, position) < 0 &&
            (hasProps || !isProp(survey.layout, position))) {
            add(position, -1);
        }
    }
    return skeleton;
}

Vector3d endOf(const SkeletonJoint& joint, const feed::PoseCharacter& character) {
    const std::string side = joint.name.starts_with("Right") ? "Right" : "Left";
    const std::string point = joint.name == "Head"           ? "pTopOfHead"
                              : joint.name.ends_with("Hand") ? "p" + side + "TopOfHand"
                              : joint.name.ends_with("Toe")  ? "p" + side + "Toe"
                                                             : "";
    const model::AnatomicalPoint* known = point.empty() ? nullptr : model::findPoint(point);
    if (known == nullptr) {
        return joint.offset * 0.8; // a finger's last bone is about that long
    }
    if (character.nullPose) {
        const auto places = model::bodyPlaces(*character.nullPose);
        if (const auto sent = model::pointOf(*character.nullPose, places, point); sent && sent->allFinite()) {
            return *sent - character.body().places[static_cast<std::size_t>(joint.position)];
        }
    }
    return Vector3d(known->reference[0], known->reference[1], known->reference[2]);
}

JointMotion::JointMotion(const Skeleton& skeleton)
    : m_skeleton(&skeleton), m_local(skeleton.joints.size()), m_world(skeleton.joints.size()) {
    for (std::size_t i = 0; i < m_local.size(); ++i) {
        m_local[i].position = skeleton.joints[i].offset;
    }
}

void JointMotion::set(const model::CharacterPose& pose) {
    static const SegmentPose kWorld;
    for (std::size_t i = 0; i < m_local.size(); ++i) {
        const SkeletonJoint& joint = m_skeleton->joints[i];
        const SegmentPose& parent =
            joint.parent < 0 ? kWorld : m_world[static_cast<std::size_t>(joint.parent)];
        if (const SegmentPose* sent = poseAt(pose, m_skeleton->layout, joint.position)) {
            m_world[i] = *sent;
            m_local[i] = model::relativeTo(parent, *sent);
        } else {
            m_world[i] = model::composed(parent, m_local[i]);
        }
    }
}

} // namespace posewire::exporting
