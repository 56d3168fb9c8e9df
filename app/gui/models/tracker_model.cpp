// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/tracker_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/segments.h"
#include "core/model/body/spaces.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace posewire::gui {

namespace {

constexpr std::size_t kMostMessages = 5'000;
constexpr log::Duration kNormSpacing = std::chrono::milliseconds(50);
constexpr std::size_t kLeastNorms = 20;
constexpr std::size_t kMostTrackers = wire::kMaxItems;
/// A pause this long is a gap whatever the counter says.
constexpr log::Duration kGap = std::chrono::milliseconds(250);

bool reaches(const wire::Vec3& vector, float limit) {
    return std::ranges::any_of(vector, [limit](float value) { return std::abs(value) > limit; });
}

using TrackerColumn = TableColumn<wire::Tracker>;

TrackerColumn normColumn(const QString& title, const QString& help, wire::Vec3 wire::Tracker::*quantity,
                         int order, std::function<bool()> isSent) {
    return TrackerColumn::numbers(title, help,
                                  [quantity, isSent](const wire::Tracker& tracker) {
                                      return isSent() ? fixed(norm(tracker.*quantity), 2) : dash();
                                  })
        .in({.usual = QStringLiteral("99.99"), .order = order});
}

/// Reads the model only where a cell is asked for.
std::vector<TrackerColumn> trackerColumns(const TrackerModel& trackers) {
    const auto always = [] { return true; };
    const auto isInertial = [&trackers] { return trackers.hasInertialData(); };
    std::vector<TrackerColumn> columns{
        TrackerColumn::words(tr("Tracker"), {}, [](const auto& tracker) { return trackerName(tracker.id); })
            .in({QStringLiteral("Right Upper Arm")}),
        normColumn(tr("|f| m/s²"), tr("Norm of the free acceleration: gravity taken away, global"),
                   &wire::Tracker::freeAcceleration, 4, always),
        normColumn(tr("|a| m/s²"), tr("Norm of the acceleration: 9.81 at rest, in the tracker's axes"),
                   &wire::Tracker::acceleration, 3, isInertial),
        normColumn(tr("|ω| rad/s"), tr("Norm of the angular velocity, in the tracker's axes"),
                   &wire::Tracker::angularVelocity, 2, isInertial),
        normColumn(tr("|m|"), tr("Norm of the magnetic field, without unit: about 1 where it is undisturbed"),
                   &wire::Tracker::magneticField, 1, always),
        valueColumn(
            TrackerColumn{
                .title = tr("Flags"),
                .help =
                    tr("Magnetic disturbance: the norm is more than 15 % off its own median of the last "
                       "minute. Saturation: a component of the acceleration was above 156 m/s² or of the "
                       "angular velocity above 34 rad/s in the last 10 s; full scale is assumed to be 16 g "
                       "and 2000 °/s."),
                .room = {.usual = QStringLiteral("▲ magnetic"), .isOpen = true}},
            [&trackers](const wire::Tracker& tracker) { return trackers.state(tracker); }),
    };
    for (TrackerColumn& column : columns) {
        column.colour = [&trackers, own = column.colour](const wire::Tracker& tracker) {
            return trackers.isStale() ? QVariant(theme().dim) : own ? own(tracker) : QVariant();
        };
    }
    return columns;
}

/// Components in columns of equal width, so that they do not dance.
QString componentText(std::span<const float> values, int decimals) {
    constexpr qsizetype kWidest = 6; // "−0.276", "−180.0", "−39.24"
    QStringList texts;
    for (const float value : values) {
        texts += fixed(value, decimals).rightJustified(texts.isEmpty() ? 0 : kWidest, QChar(0x2007));
    }
    return texts.join(QLatin1Char(' '));
}

QString eulerText(const wire::Tracker& tracker) {
    const Eigen::Vector3d radians =
        model::eulerFromQuaternion(model::normalizedOrIdentity(model::toQuaternion(tracker.orientation)));
    return componentText(model::toFloats(Eigen::Vector3d(radians * model::kDegreesPerRadian)), 1);
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

float norm(const wire::Vec3& vector) {
    return std::hypot(vector[0], vector[1], vector[2]);
}

double dipDegrees(const wire::Tracker& tracker) {
    const Eigen::Quaterniond worldFromTracker =
        model::normalizedOrIdentity(model::toQuaternion(tracker.orientation));
    const Eigen::Vector3d field = worldFromTracker * model::toVector(tracker.magneticField);
    return std::atan2(-field.z(), field.head<2>().norm()) * model::kDegreesPerRadian;
}

void TrackerHistory::follow(model::SessionView& view, const std::optional<model::CharacterKey>& key,
                            std::uint32_t trackerId) {
    const auto* newest = key ? view.messages().message(*key, wire::TrackerKinematics::kType) : nullptr;
    const bool wentBack = newest != nullptr && newest->stamp < m_lastStamp;
    if (key != m_key || wentBack) {
        *this = {};
        m_key = key;
    }
    if (trackerId != m_trackerId) {
        m_trackerId = trackerId;
        m_points.clear();
        m_lastStamp = {};
        m_lastSample = 0;
    }
    if (newest == nullptr) {
        return;
    }
    const log::StreamKey stream{key->sender, key->character, wire::TrackerKinematics::kType};
    const model::Stream* figures = view.roster().find(stream);
    const std::uint32_t step = figures == nullptr ? 0 : figures->accounting.step();
    const log::Stamp from = std::max(newest->stamp - kPlot, m_lastStamp + log::Duration(1));
    const std::size_t added =
        view.messages().visit(stream, from, kMostMessages, [&](const auto& message) { add(message, step); });
    if (added != 0) {
        computeMedians();
    }
}

void TrackerHistory::add(const model::Message& message, std::uint32_t step) {
    const auto* body = std::get_if<wire::TrackerKinematics>(&message.datagram.body);
    if (body == nullptr) {
        return;
    }
    const std::uint32_t advanced = message.datagram.header.sampleCounter - m_lastSample;
    const bool followsGap = m_lastStamp != log::Stamp() &&
                            (message.stamp - m_lastStamp > kGap || (step != 0 && advanced > step + step / 2));
    for (const wire::Tracker& tracker : body->trackers) {
        if (m_trackers.size() >= kMostTrackers && !m_trackers.contains(tracker.id)) {
            continue;
        }
        Lately& lately = m_trackers[tracker.id];
        addNorm(lately, message.stamp, norm(tracker.magneticField));
        if (reaches(tracker.acceleration, kSaturatedAcceleration) ||
            reaches(tracker.angularVelocity, kSaturatedAngularVelocity)) {
            lately.saturated = message.stamp;
        }
        if (tracker.id == m_trackerId) {
            m_points.push_back(
                {message.stamp, tracker.freeAcceleration, norm(tracker.magneticField), followsGap});
            while (message.stamp - m_points.front().stamp > kPlot || m_points.size() > kMostMessages) {
                m_points.pop_front();
            }
        }
    }
    m_lastStamp = message.stamp;
    m_lastSample = message.datagram.header.sampleCounter;
}

void TrackerHistory::addNorm(Lately& lately, log::Stamp stamp, float norm) const {
    if (!std::isfinite(norm) || (!lately.norms.empty() && stamp - lately.norms.back().stamp < kNormSpacing)) {
        return;
    }
    lately.norms.push_back({stamp, norm});
    while (stamp - lately.norms.front().stamp > kMedian) {
        lately.norms.pop_front();
    }
}

void TrackerHistory::computeMedians() {
    std::vector<float> sorted;
    for (auto& [id, lately] : m_trackers) {
        sorted.clear();
        std::ranges::transform(lately.norms, std::back_inserter(sorted), &Norm::norm);
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::ranges::nth_element(sorted, middle);
        lately.median = sorted.size() >= kLeastNorms ? std::optional(*middle) : std::nullopt;
    }
}

std::optional<float> TrackerHistory::magneticMedian(std::uint32_t trackerId) const {
    const auto found = m_trackers.find(trackerId);
    return found == m_trackers.end() ? std::nullopt : found->second.median;
}

bool TrackerHistory::isDisturbed(const wire::Tracker& tracker) const {
    const auto median = magneticMedian(tracker.id);
    return median && std::abs(norm(tracker.magneticField) - *median) > kDisturbedShare * *median;
}

bool TrackerHistory::isSaturated(std::uint32_t trackerId) const {
    const auto found = m_trackers.find(trackerId);
    return found != m_trackers.end() && found->second.saturated &&
           m_lastStamp - *found->second.saturated < kPlot;
}

QString trackerName(std::uint32_t id) {
    const auto& segments = model::bodySegments();
    if (id == 0 || id > segments.size()) {
        return tr("Tracker %1").arg(id);
    }
    return fromUtf8(segments[id - 1].displayName);
}

TrackerModel::TrackerModel(model::SessionView& view)
    : TableModel(withHelpInCells(trackerColumns(*this))), m_view(view) {}

void TrackerModel::refresh() {
    m_key = shownCharacter(m_view);
    const auto* message = m_key ? m_view.messages().message(*m_key, wire::TrackerKinematics::kType) : nullptr;
    const auto* body =
        message == nullptr ? nullptr : std::get_if<wire::TrackerKinematics>(&message->datagram.body);
    m_stale.clear();
    std::vector<wire::Tracker> trackers;
    if (body != nullptr) {
        const model::Stream* stream = m_view.roster().find(
            log::StreamKey{m_key->sender, m_key->character, wire::TrackerKinematics::kType});
        m_stale = gui::staleText(log::secondsOf(m_view.cursorStamp() - message->stamp),
                                 stream == nullptr ? 0 : stream->statistics.rateHz());
        trackers.assign(body->trackers.begin(), body->trackers.end());
        m_hasInertialData = body->hasInertialData;
    }
    const auto wanted = std::ranges::find_if(trackers, [this](const wire::Tracker& tracker) {
        return static_cast<int>(tracker.id) - 1 == m_view.choices().selection.segment;
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
    if (isStale()) {
        return {m_stale};
    }
    if (m_history.isSaturated(tracker.id)) {
        return {tr("saturation"), Health::Error};
    }
    if (m_history.isDisturbed(tracker)) {
        return {tr("magnetic disturbance"), Health::Warning};
    }
    return {QString(), m_history.magneticMedian(tracker.id) ? Health::Good : Health::Unknown};
}

std::vector<Property> trackerFacts(const TrackerModel& trackers) {
    using Read = std::function<PropertyValue(const wire::Tracker&)>;
    const auto row = [&trackers](const QString& label, const Read& read) {
        return Property{label, [&trackers, read] {
                            const wire::Tracker* tracker = trackers.shown();
                            return tracker == nullptr ? PropertyValue{} : read(*tracker);
                        }};
    };
    const auto sent = [&row](const QString& label, const QString& help, auto text) {
        return row(label, [text, help](const auto& tracker) {
            return PropertyValue{text(tracker), Health::Unknown, help};
        });
    };
    const auto vector = [&](const QString& label, const QString& help, wire::Vec3 wire::Tracker::*quantity) {
        return sent(label, help,
                    [quantity](const auto& tracker) { return componentText(tracker.*quantity, 2); });
    };
    const auto inertial = [&](const QString& label, const QString& help,
                              wire::Vec3 wire::Tracker::*quantity) {
        return sent(label, help, [&trackers, quantity](const auto& tracker) {
            return trackers.hasInertialData() ? componentText(tracker.*quantity, 2)
                                              : tr("not in the 44-byte form");
        });
    };
    return {sent(tr("Orientation w x y z"), tr("Quaternion w x y z, world from tracker"),
                 [](const auto& tracker) { return componentText(tracker.orientation, 3); }),
            sent(tr("Euler x y z °"), tr("About fixed x, then y, then z, in the Z-up world"), eulerText),
            vector(tr("Free acceleration m/s²"), tr("x y z in the world, gravity taken away"),
                   &wire::Tracker::freeAcceleration),
            inertial(tr("Acceleration m/s²"), tr("x y z in the tracker's axes, gravity included"),
                     &wire::Tracker::acceleration),
            inertial(tr("Angular velocity rad/s"), tr("x y z in the tracker's axes"),
                     &wire::Tracker::angularVelocity),
            vector(tr("Magnetic field"), tr("x y z in the tracker's axes, without unit"),
                   &wire::Tracker::magneticField),
            row(tr("Field norm · dip"),
                [&trackers](const auto& tracker) { return fieldNorm(trackers, tracker); }),
            row(tr("Flags"), [&trackers](const auto& tracker) { return flags(trackers, tracker); })};
}

} // namespace posewire::gui
