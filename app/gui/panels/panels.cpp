// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/panels.h"

#include "app/gui/panels/characters_panel.h"
#include "app/gui/panels/compare_panel.h"
#include "app/gui/panels/faults_panel.h"
#include "app/gui/panels/incidents_panel.h"
#include "app/gui/panels/inspector_panel.h"
#include "app/gui/panels/joints_panel.h"
#include "app/gui/panels/metadata_panel.h"
#include "app/gui/panels/nullpose_panel.h"
#include "app/gui/panels/packets_panel.h"
#include "app/gui/panels/plots_panel.h"
#include "app/gui/panels/probes_panel.h"
#include "app/gui/panels/statistics_panel.h"
#include "app/gui/panels/timecode_panel.h"
#include "app/gui/panels/timeline_panel.h"
#include "app/gui/panels/trackers_panel.h"

#include <type_traits>

namespace posewire::gui {

namespace {

using Parts = const PanelParts&;

template <class T>
Panel* make(Parts parts, QWidget* parent) {
    if constexpr (std::is_same_v<T, CharactersPanel> || std::is_same_v<T, ProbesPanel>) {
        return new T(parts.view, parts.commands, parts.receiving, parent);
    } else if constexpr (std::is_same_v<T, StatisticsPanel>) {
        return new T(parts.view, parts.commands, parts.receiving, parts.health, parent);
    } else if constexpr (std::is_same_v<T, ComparePanel>) {
        return new T(parts.view, parts.commands, parts.playback, parts.comparing, parent);
    } else if constexpr (std::is_same_v<T, TimelinePanel> || std::is_same_v<T, PlotsPanel>) {
        return new T(parts.view, parts.commands, parts.playback, parent);
    } else {
        return new T(parts.view, parts.commands, parent);
    }
}

template <class T>
constexpr PanelInfo dock(const char* id, const char* title, Qt::DockWidgetArea area) {
    return {id, title, area, make<T>, &T::actionTable};
}

constexpr auto kLeft = Qt::LeftDockWidgetArea;
constexpr auto kRight = Qt::RightDockWidgetArea;
constexpr auto kBottom = Qt::BottomDockWidgetArea;

constexpr PanelInfo kPanels[] = {
    dock<CharactersPanel>("characters", QT_TRANSLATE_NOOP("Panel", "Characters"), kLeft),
    dock<MetadataPanel>("metadata", QT_TRANSLATE_NOOP("Panel", "Metadata"), kLeft),
    dock<TimecodePanel>("timecode", QT_TRANSLATE_NOOP("Panel", "Time code"), kLeft),
    dock<StatisticsPanel>("statistics", QT_TRANSLATE_NOOP("Panel", "Statistics"), kRight),
    dock<InspectorPanel>("inspector", QT_TRANSLATE_NOOP("Panel", "Inspector"), kRight),
    dock<TrackersPanel>("trackers", QT_TRANSLATE_NOOP("Panel", "Trackers"), kRight),
    dock<JointsPanel>("joints", QT_TRANSLATE_NOOP("Panel", "Joints"), kRight),
    dock<ComparePanel>("compare", QT_TRANSLATE_NOOP("Panel", "Comparison"), kRight),
    dock<PacketsPanel>("packets", QT_TRANSLATE_NOOP("Panel", "Packets"), kBottom),
    dock<NullPosePanel>("nullpose", QT_TRANSLATE_NOOP("Panel", "Null pose"), kRight),
    dock<IncidentsPanel>("events", QT_TRANSLATE_NOOP("Panel", "Incidents"), kBottom),
    dock<FaultsPanel>("faults", QT_TRANSLATE_NOOP("Panel", "Faults"), kBottom),
    dock<ProbesPanel>("probes", QT_TRANSLATE_NOOP("Panel", "Probes"), kBottom),
    dock<TimelinePanel>("timeline", QT_TRANSLATE_NOOP("Panel", "Timeline"), kBottom),
    dock<PlotsPanel>("plots", QT_TRANSLATE_NOOP("Panel", "Plots"), kBottom),
    {"plots2", QT_TRANSLATE_NOOP("Panel", "Plots 2"), kBottom, make<PlotsPanel>, &Panel::actionTable},
};

} // namespace

std::span<const PanelInfo> panelTable() {
    return kPanels;
}

} // namespace posewire::gui
