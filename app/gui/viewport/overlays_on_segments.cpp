// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/overlays.h"

#include <algorithm>
#include <cmath>

/// Names and angles: what is known of the segments themselves.
namespace posewire::gui {
namespace {

constexpr std::size_t kBody = model::kBodySegmentCount;

/// The child that a segment points to; -1 for none, and for those with several.
int onlyChild(int segment) {
    int child = -1;
    int count = 0;
    for (std::size_t i = 0; i < kBody; ++i) {
        if (model::bodySegments()[i].parent == segment) {
            child = static_cast<int>(i);
            ++count;
        }
    }
    return count == 1 ? child : -1;
}

void drawArc(const OverlaySubject& subject, int segment, SceneFrame& frame) {
    constexpr float kRadius = 0.13F;
    constexpr int kSteps = 16;
    const int child = onlyChild(segment);
    const auto joint = jointReading(subject, segment);
    if (!joint) {
        return;
    }
    const QString text = QStringLiteral("%1 °").arg(joint->degrees[2], 0, 'f', 1);
    const int parent = model::bodySegments()[static_cast<std::size_t>(segment)].parent;
    const auto place = [&](int one) {
        return pointOf(subject.pose.segments[static_cast<std::size_t>(one)].position);
    };
    const glm::vec3 at = place(segment);
    if (child < 0) { // the end of a limb, or where it branches: no bone to turn to
        frame.texts.push_back({at, text, theme().warning});
        return;
    }
    const glm::vec3 along = glm::normalize(at - place(parent));
    const glm::vec3 bone = glm::normalize(place(child) - at);
    const glm::vec4 ink = inkOf(theme().warning, subject.strength);
    frame.lines.push_back({at, at + 1.25F * kRadius * along, ink, 1.2F});
    frame.lines.push_back({at, at + 1.25F * kRadius * bone, ink, 1.2F});
    const float angle = std::acos(std::clamp(glm::dot(along, bone), -1.0F, 1.0F));
    glm::vec3 before = at + kRadius * along;
    for (int step = 1; step <= kSteps && angle > 0.01F; ++step) {
        const float share = static_cast<float>(step) / kSteps;
        const glm::vec3 way = (std::sin((1 - share) * angle) * along + std::sin(share * angle) * bone) /
                              std::max(std::sin(angle), 1e-3F);
        const glm::vec3 next = at + kRadius * way;
        frame.lines.push_back({before, next, ink, 2.0F});
        before = next;
    }
    frame.texts.push_back(
        {at + 1.4F * kRadius * glm::normalize(along + bone + glm::vec3(0, 0, 1e-3F)), text, theme().warning});
}

} // namespace

void drawSegmentNames(const OverlaySubject& subject, SceneFrame& frame) {
    for (std::size_t i = 0; subject.isAlone && i < subject.pose.segments.size(); ++i) {
        if (i < kBody + static_cast<std::size_t>(subject.pose.layout.props) && subject.pose.isPresent(i)) {
            const auto name = model::segmentTitle(subject.pose.layout, static_cast<int>(i));
            frame.texts.push_back({pointOf(subject.pose.segments[i].position),
                                   QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())),
                                   theme().text});
        }
    }
}

void drawJointAngles(const OverlaySubject& subject, SceneFrame& frame) {
    if (subject.segment >= 0 && subject.segment < model::kBodySegmentCount) {
        drawArc(subject, subject.segment, frame);
        return;
    }
    for (const int segment : {model::segment::kRightForeArm, model::segment::kLeftForeArm,
                              model::segment::kRightLowerLeg, model::segment::kLeftLowerLeg}) {
        drawArc(subject, segment, frame);
    }
}

} // namespace posewire::gui
