// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/tracker_model.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/spaces.h"

#include <span>

namespace posewire::gui {

namespace {

/// Components in columns of equal width, so that they do not dance.
QString components(std::span<const float> values, int decimals) {
    constexpr qsizetype kWidest = 6; // "−0.276", "−180.0", "−39.24"
    QStringList texts;
    for (const float value : values) {
        texts += fixed(value, decimals).rightJustified(texts.isEmpty() ? 0 : kWidest, QChar(0x2007));
    }
    return texts.join(QLatin1Char(' '));
}

PropertyValue orientation(const TrackerModel&, const wire::Tracker& tracker) {
    return {components(tracker.orientation, 3), Health::Unknown,
            tr("Quaternion w x y z, world from tracker")};
}

PropertyValue euler(const TrackerModel&, const wire::Tracker& tracker) {
    const Eigen::Vector3d radians =
        model::eulerFromQuaternion(model::normalizedOrIdentity(model::toQuaternion(tracker.orientation)));
    const auto degrees = model::toFloats(Eigen::Vector3d(radians * model::kDegreesPerRadian));
    return {components(degrees, 1), Health::Unknown, tr("About fixed x, then y, then z, in the Z-up world")};
}

PropertyValue freeAcceleration(const TrackerModel&, const wire::Tracker& tracker) {
    return {components(tracker.freeAcceleration, 2), Health::Unknown,
            tr("x y z in the world, gravity taken away")};
}

PropertyValue acceleration(const TrackerModel& trackers, const wire::Tracker& tracker) {
    return {trackers.hasInertialData() ? components(tracker.acceleration, 2) : tr("not in the 44-byte form"),
            Health::Unknown, tr("x y z in the tracker's axes, gravity included")};
}

PropertyValue angularVelocity(const TrackerModel& trackers, const wire::Tracker& tracker) {
    return {trackers.hasInertialData() ? components(tracker.angularVelocity, 2)
                                       : tr("not in the 44-byte form"),
            Health::Unknown, tr("x y z in the tracker's axes")};
}

PropertyValue magneticField(const TrackerModel&, const wire::Tracker& tracker) {
    return {components(tracker.magneticField, 2), Health::Unknown,
            tr("x y z in the tracker's axes, without unit")};
}

PropertyValue fieldNorm(const TrackerModel& trackers, const wire::Tracker& tracker) {
    const auto median = trackers.history().magneticMedian(tracker.id);
    const QString figures =
        tr("%1 · dip %2°").arg(fixed(norm(tracker.magneticField), 2), fixed(dipDegrees(tracker), 0));
    const bool isDisturbed = trackers.history().isDisturbed(tracker);
    const QString toolTip =
        tr("Dip: angle below the horizontal, by the tracker's orientation. Disturbed where the norm "
           "is more than 15 % off its median of the last minute%1.")
            .arg(median ? tr(" (%1)").arg(fixed(*median, 2)) : QString());
    return {figures, isDisturbed ? Health::Warning : Health::Unknown, toolTip};
}

PropertyValue flags(const TrackerModel& trackers, const wire::Tracker& tracker) {
    PropertyValue state = trackers.state(tracker);
    if (state.text.isEmpty()) {
        state.text = state.health == Health::Good ? tr("none") : tr("after 1 s");
    }
    state.toolTip = trackers.headerData(TrackerModel::kState, Qt::Horizontal, Qt::ToolTipRole).toString();
    return state;
}

} // namespace

std::vector<Property> trackerFacts(const TrackerModel& trackers) {
    using Read = PropertyValue (*)(const TrackerModel&, const wire::Tracker&);
    const auto row = [&trackers](const QString& label, Read read) {
        return Property{label, [&trackers, read] {
                            const wire::Tracker* tracker = trackers.shown();
                            return tracker == nullptr ? PropertyValue{} : read(trackers, *tracker);
                        }};
    };
    return {row(tr("Orientation w x y z"), orientation),
            row(tr("Euler x y z °"), euler),
            row(tr("Free acceleration m/s²"), freeAcceleration),
            row(tr("Acceleration m/s²"), acceleration),
            row(tr("Angular velocity rad/s"), angularVelocity),
            row(tr("Magnetic field"), magneticField),
            row(tr("Field norm · dip"), fieldNorm),
            row(tr("Flags"), flags)};
}

} // namespace posewire::gui
