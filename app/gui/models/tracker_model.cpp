// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/tracker_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/segments.h"
#include "core/model/session/ingest.h"

#include <algorithm>

namespace posewire::gui {

namespace {

using TrackerColumn = TableColumn<wire::Tracker>;

TrackerColumn normColumn(const QString& title, const QString& help, wire::Vec3 wire::Tracker::*quantity,
                         std::function<bool()> isSent) {
    return {.title = title,
            .help = help,
            .isNumber = true,
            .text =
                [quantity, isSent](const wire::Tracker& tracker) {
                    return isSent() ? fixed(norm(tracker.*quantity), 2) : QStringLiteral("–");
                },
            .sortKey = [quantity](const wire::Tracker& tracker) { return norm(tracker.*quantity); }};
}

/// Reads the model only where a cell is asked for.
std::vector<TrackerColumn> trackerColumns(const TrackerModel& trackers) {
    const auto always = [] { return true; };
    const auto isInertial = [&trackers] { return trackers.hasInertialData(); };
    return {
        {.title = tr("Tracker"),
         .text = [](const wire::Tracker& tracker) { return trackerName(tracker.id); }},
        normColumn(tr("|f| m/s²"), tr("Norm of the free acceleration: gravity taken away, global"),
                   &wire::Tracker::freeAcceleration, always),
        normColumn(tr("|a| m/s²"), tr("Norm of the acceleration: 9.81 at rest, in the tracker's axes"),
                   &wire::Tracker::acceleration, isInertial),
        normColumn(tr("|ω| rad/s"), tr("Norm of the angular velocity, in the tracker's axes"),
                   &wire::Tracker::angularVelocity, isInertial),
        normColumn(tr("|m|"), tr("Norm of the magnetic field, without unit: about 1 where it is undisturbed"),
                   &wire::Tracker::magneticField, always),
        valueColumn(
            TrackerColumn{
                .title = tr("Flags"),
                .help =
                    tr("Magnetic disturbance: the norm is more than 15 % off its own median of the last "
                       "minute. Saturation: a component of the acceleration was above 156 m/s² or of the "
                       "angular velocity above 34 rad/s in the last 10 s; full scale is assumed to be 16 g "
                       "and 2000 °/s.")},
            [&trackers](const wire::Tracker& tracker) { return trackers.state(tracker); }),
    };
}

} // namespace

QString trackerName(std::uint32_t id) {
    const auto& segments = model::bodySegments();
    if (id == 0 || id > segments.size()) {
        return tr("Tracker %1").arg(id);
    }
    return fromUtf8(segments[id - 1].displayName);
}

TrackerModel::TrackerModel(model::SessionView& view, QObject* parent)
    : TableModel(withHelpInCells(trackerColumns(*this)), parent), m_view(view) {}

void TrackerModel::refresh() {
    m_key = shownCharacter(m_view);
    const auto* message = m_key ? m_view.message(*m_key, wire::TrackerKinematics::kType) : nullptr;
    const auto* body =
        message == nullptr ? nullptr : std::get_if<wire::TrackerKinematics>(&message->datagram.body);
    std::vector<wire::Tracker> trackers;
    if (body != nullptr) {
        trackers.assign(body->trackers.begin(), body->trackers.end());
        m_hasInertialData = body->hasInertialData;
    }
    const auto wanted = std::ranges::find_if(trackers, [this](const wire::Tracker& tracker) {
        return static_cast<int>(tracker.id) - 1 == m_view.selection().segment;
    });
    if (wanted != trackers.end()) {
        m_shownRow = static_cast<int>(wanted - trackers.begin());
    }
    m_shownRow = std::clamp(m_shownRow, trackers.empty() ? -1 : 0, static_cast<int>(trackers.size()) - 1);
    m_history.follow(m_view, m_key, m_shownRow < 0 ? 0 : trackers[static_cast<std::size_t>(m_shownRow)].id);
    setRows(std::move(trackers));
}

const wire::Tracker* TrackerModel::shown() const {
    return m_shownRow < 0 ? nullptr : &tracker(m_shownRow);
}

PropertyValue TrackerModel::state(const wire::Tracker& tracker) const {
    if (m_history.isSaturated(tracker.id)) {
        return {tr("saturation"), Health::Error};
    }
    if (m_history.isDisturbed(tracker)) {
        return {tr("magnetic disturbance"), Health::Warning};
    }
    return {QString(), m_history.magneticMedian(tracker.id) ? Health::Good : Health::Unknown};
}

} // namespace posewire::gui
