// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/tracker_model.h"

#include "app/gui/models/columns.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "core/model/body/segments.h"
#include "core/model/session/message.h"

#include <algorithm>
#include <array>

namespace posewire::gui {

namespace {

constexpr std::array<ColumnText, TrackerModel::kColumnCount> kColumns{{
    {QT_TRANSLATE_NOOP("posewire::gui::TrackerModel", "Tracker"), "", false},
    {QT_TRANSLATE_NOOP("posewire::gui::TrackerModel", "|f| m/s²"),
     QT_TRANSLATE_NOOP("posewire::gui::TrackerModel",
                       "Norm of the free acceleration: gravity taken away, global")},
    {QT_TRANSLATE_NOOP("posewire::gui::TrackerModel", "|a| m/s²"),
     QT_TRANSLATE_NOOP("posewire::gui::TrackerModel",
                       "Norm of the acceleration: 9.81 at rest, in the tracker's axes")},
    {QT_TRANSLATE_NOOP("posewire::gui::TrackerModel", "|ω| rad/s"),
     QT_TRANSLATE_NOOP("posewire::gui::TrackerModel", "Norm of the angular velocity, in the tracker's axes")},
    {QT_TRANSLATE_NOOP("posewire::gui::TrackerModel", "|m|"),
     QT_TRANSLATE_NOOP("posewire::gui::TrackerModel",
                       "Norm of the magnetic field, without unit: about 1 where it is undisturbed")},
    {QT_TRANSLATE_NOOP("posewire::gui::TrackerModel", "Flags"),
     QT_TRANSLATE_NOOP(
         "posewire::gui::TrackerModel",
         "Magnetic disturbance: the norm is more than 15 % off its own median of the last minute. "
         "Saturation: a component of the acceleration was above 156 m/s² or of the angular velocity "
         "above 34 rad/s in the last 10 s; full scale is assumed to be 16 g and 2000 °/s."),
     false},
}};

} // namespace

QString trackerName(std::uint32_t id) {
    const auto& segments = model::bodySegments();
    if (id == 0 || id > segments.size()) {
        return TrackerModel::tr("Tracker %1").arg(id);
    }
    const std::string_view name = segments[id - 1].displayName;
    return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

TrackerModel::TrackerModel(model::SessionView& view, QObject* parent)
    : QAbstractTableModel(parent), m_view(view) {}

void TrackerModel::refresh() {
    m_key = shownCharacter(m_view);
    const auto* message = m_key ? m_view.message(*m_key, wire::TrackerKinematics::kType) : nullptr;
    const auto* body =
        message == nullptr ? nullptr : std::get_if<wire::TrackerKinematics>(&message->datagram.body);
    fitRows(body == nullptr ? 0 : body->trackers.size());
    if (body != nullptr) {
        std::ranges::copy(body->trackers, m_trackers.begin());
        m_hasInertialData = body->hasInertialData;
    }
    const auto wanted = std::ranges::find_if(m_trackers, [this](const wire::Tracker& tracker) {
        return static_cast<int>(tracker.id) - 1 == m_view.selection().segment;
    });
    if (wanted != m_trackers.end()) {
        m_shownRow = static_cast<int>(wanted - m_trackers.begin());
    }
    m_shownRow = std::clamp(m_shownRow, m_trackers.empty() ? -1 : 0, rowCount() - 1);
    m_history.follow(m_view, m_key, shown() == nullptr ? 0 : shown()->id);
    if (!m_trackers.empty()) {
        emit dataChanged(index(0, 0), index(rowCount() - 1, kColumnCount - 1));
    }
}

void TrackerModel::fitRows(std::size_t count) {
    const std::size_t rows = m_trackers.size();
    if (count > rows) {
        beginInsertRows({}, static_cast<int>(rows), static_cast<int>(count) - 1);
        m_trackers.resize(count);
        endInsertRows();
    } else if (count < rows) {
        beginRemoveRows({}, static_cast<int>(count), static_cast<int>(rows) - 1);
        m_trackers.resize(count);
        endRemoveRows();
    }
}

int TrackerModel::shownRow() const {
    return m_shownRow;
}

const wire::Tracker* TrackerModel::shown() const {
    return m_shownRow < 0 ? nullptr : &m_trackers[static_cast<std::size_t>(m_shownRow)];
}

const wire::Tracker& TrackerModel::tracker(int row) const {
    return m_trackers[static_cast<std::size_t>(row)];
}

int TrackerModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(m_trackers.size());
}

int TrackerModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(kColumnCount);
}

QString TrackerModel::text(const wire::Tracker& tracker, int column) const {
    const QString none = QStringLiteral("–");
    switch (column) {
    case kName:
        return trackerName(tracker.id);
    case kFree:
        return fixed(norm(tracker.freeAcceleration), 2);
    case kAcceleration:
        return m_hasInertialData ? fixed(norm(tracker.acceleration), 2) : none;
    case kGyro:
        return m_hasInertialData ? fixed(norm(tracker.angularVelocity), 2) : none;
    case kMagnetic:
        return fixed(norm(tracker.magneticField), 2);
    default:
        return {};
    }
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

QVariant TrackerModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    const wire::Tracker& shown = tracker(index.row());
    switch (role) {
    case Qt::DisplayRole:
        if (index.column() == kState) {
            const PropertyValue value = state(shown);
            return value.health == Health::Unknown
                       ? QString()
                       : (healthSymbol(value.health) + QLatin1Char(' ') + value.text).trimmed();
        }
        return text(shown, index.column());
    case Qt::ForegroundRole: {
        const Health health = index.column() == kState ? state(shown).health : Health::Unknown;
        return health == Health::Unknown ? QVariant() : healthColour(health);
    }
    case Qt::TextAlignmentRole:
        return index.column() == kName || index.column() == kState ? QVariant() : numberAlignment();
    case Qt::ToolTipRole:
        return headerData(index.column(), Qt::Horizontal, role);
    default:
        return {};
    }
}

QVariant TrackerModel::headerData(int section, Qt::Orientation orientation, int role) const {
    return orientation == Qt::Horizontal
               ? columnHeader(kColumns, "posewire::gui::TrackerModel", section, role)
               : QVariant();
}

} // namespace posewire::gui
