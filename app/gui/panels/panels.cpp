// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panel.h"

#include "app/gui/panels/characters_panel.h"
#include "app/gui/panels/events_panel.h"
#include "app/gui/panels/inspector_panel.h"
#include "app/gui/panels/metadata_panel.h"
#include "app/gui/panels/nullpose_panel.h"
#include "app/gui/panels/packets_panel.h"
#include "app/gui/panels/statistics_panel.h"
#include "app/gui/panels/timecode_panel.h"
#include "app/gui/panels/trackers_panel.h"

#include <array>
#include <type_traits>

namespace posewire::gui {

namespace {

template <class T>
Panel* make(model::SessionView& view, Commands& commands, const ProgramView& program, QWidget* parent) {
    if constexpr (std::is_constructible_v<T, model::SessionView&, Commands&, const ProgramView&, QWidget*>) {
        return new T(view, commands, program, parent);
    } else {
        return new T(view, commands, parent);
    }
}

constexpr std::array<PanelInfo, 9> kPanels{{
    {"characters", QT_TRANSLATE_NOOP("Panel", "Characters"), Qt::LeftDockWidgetArea, make<CharactersPanel>},
    {"metadata", QT_TRANSLATE_NOOP("Panel", "Metadata"), Qt::LeftDockWidgetArea, make<MetadataPanel>},
    {"timecode", QT_TRANSLATE_NOOP("Panel", "Time code"), Qt::LeftDockWidgetArea, make<TimecodePanel>},
    {"statistics", QT_TRANSLATE_NOOP("Panel", "Statistics"), Qt::RightDockWidgetArea, make<StatisticsPanel>},
    {"inspector", QT_TRANSLATE_NOOP("Panel", "Inspector"), Qt::RightDockWidgetArea, make<InspectorPanel>},
    {"trackers", QT_TRANSLATE_NOOP("Panel", "Trackers"), Qt::RightDockWidgetArea, make<TrackersPanel>},
    {"packets", QT_TRANSLATE_NOOP("Panel", "Packets"), Qt::BottomDockWidgetArea, make<PacketsPanel>},
    {"nullpose", QT_TRANSLATE_NOOP("Panel", "Null pose"), Qt::RightDockWidgetArea, make<NullPosePanel>},
    {"events", QT_TRANSLATE_NOOP("Panel", "Events"), Qt::BottomDockWidgetArea, make<EventsPanel>},
}};

} // namespace

std::span<const PanelInfo> panelTable() {
    return kPanels;
}

} // namespace posewire::gui
