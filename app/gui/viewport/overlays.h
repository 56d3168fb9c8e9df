// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene.h"
#include "app/gui/viewport/segment_facts.h"

#include <QColor>

#include <array>
#include <vector>

/// What is drawn over the figures. An overlay is a row in overlays() and its drawing: settings, the
/// viewport's menu and tests follow.
namespace posewire::gui {

struct OverlaySubject : PoseSubject {
    glm::vec3 colour;
    int segment = -1;    ///< the selected one, -1 for none
    bool isAlone = true; ///< no other character has overlays: there is room for words
    float strength = 1;  ///< below 1 for data that have faded
};

struct OverlayEntry {
    Overlay overlay;
    const char* key;   ///< in settings, and the name of its action
    const char* title; ///< in menus
    void (*draw)(const OverlaySubject& subject, SceneFrame& frame);
};

// The entries' own; each takes what the character sends, and draws nothing where that is not on the air.
void drawSegmentNames(const OverlaySubject& subject, SceneFrame& frame);
/// An arc from the line of the parent's bone to the segment's own, with the flexion (type 20 where it is
/// sent): at the selected joint, else at elbows and knees. The angle alone where no one bone follows.
void drawJointAngles(const OverlaySubject& subject, SceneFrame& frame);
/// Type 03, with names.
void drawMarkers(const OverlaySubject& subject, SceneFrame& frame);
/// Type 23: each on its segment, with its own axes, its free acceleration (1 cm for 1 m/s²) and the magnetic
/// field.
void drawTrackers(const OverlaySubject& subject, SceneFrame& frame);
/// Type 24, with its way in the last seconds, the plumb line and where it meets the floor.
void drawCentreOfMass(const OverlaySubject& subject, SceneFrame& frame);
/// Points of the soles on the floor and the base of support that they span.
void drawContacts(const OverlaySubject& subject, SceneFrame& frame);
/// Type 21: 10 cm for 1 m/s.
void drawVelocities(const OverlaySubject& subject, SceneFrame& frame);
/// Type 21: 1 cm for 1 m/s².
void drawAccelerations(const OverlaySubject& subject, SceneFrame& frame);
/// Where the selected segment was in the last 1.5 s; head, hands and feet where none is selected.
void drawTrails(const OverlaySubject& subject, SceneFrame& frame);

/// In the order of Overlay.
inline constexpr std::array<OverlayEntry, kOverlayCount> kOverlayTable{{
    {Overlay::SegmentNames, "segmentNames", QT_TRANSLATE_NOOP("Action", "Segment &names"), drawSegmentNames},
    {Overlay::JointAngles, "jointAngles", QT_TRANSLATE_NOOP("Action", "&Joint angles"), drawJointAngles},
    {Overlay::Markers, "markers", QT_TRANSLATE_NOOP("Action", "&Markers (type 03)"), drawMarkers},
    {Overlay::Trackers, "trackers", QT_TRANSLATE_NOOP("Action", "&Trackers (type 23)"), drawTrackers},
    {Overlay::CentreOfMass, "centreOfMass", QT_TRANSLATE_NOOP("Action", "&Centre of mass (type 24)"),
     drawCentreOfMass},
    {Overlay::Contacts, "contacts", QT_TRANSLATE_NOOP("Action", "Contact of the &feet"), drawContacts},
    {Overlay::Velocity, "velocity", QT_TRANSLATE_NOOP("Action", "&Velocity (type 21)"), drawVelocities},
    {Overlay::Acceleration, "acceleration", QT_TRANSLATE_NOOP("Action", "&Acceleration (type 21)"),
     drawAccelerations},
    {Overlay::Trails, "trails", QT_TRANSLATE_NOOP("Action", "T&rails"), drawTrails},
}};

/// Draws those that are on: of the selected character, of all where none is selected.
void addOverlays(const Overlays& on, const OverlaySubject& subject, SceneFrame& frame);

[[nodiscard]] inline glm::vec3 pointOf(const Eigen::Vector3d& vector) {
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

[[nodiscard]] inline glm::quat turnOf(const Eigen::Quaterniond& rotation) {
    return {static_cast<float>(rotation.w()), static_cast<float>(rotation.x()),
            static_cast<float>(rotation.y()), static_cast<float>(rotation.z())};
}

[[nodiscard]] inline glm::vec4 inkOf(const QColor& colour, float alpha = 1.0F) {
    return {static_cast<float>(colour.redF()), static_cast<float>(colour.greenF()),
            static_cast<float>(colour.blueF()), alpha};
}

/// A line that fades towards its beginning.
void addWay(const std::vector<glm::vec3>& places, const glm::vec4& ink, float width, SceneFrame& frame);

} // namespace posewire::gui
