// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/panels/timeline_thumbnail.h"
#include "app/gui/panels/timeline_view.h"

class QAction;

namespace posewire::gui {

class CommandBar;
class ElidedLabel;

/// Dock `timeline`: the whole history, in which the display is moved through time and ranges are selected.
class TimelinePanel : public Panel {
    Q_OBJECT

public:
    TimelinePanel(model::SessionView& view, Commands& commands, Playback& playback, QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;

    void zoomIn() { m_timeline->zoom(0.5); }
    void zoomOut() { m_timeline->zoom(2); }
    void showAll() { m_timeline->fit(); }
    void showRange() { m_timeline->fitRange(); }
    void toggleStreams() { m_timeline->toggleStreams(); }

private:
    /// Time of day, since the first packet, and by the sender's time code.
    [[nodiscard]] QString momentText() const;

    TimelineView* m_timeline;
    TimelineThumbnail* m_thumbnail;
    CommandBar* m_commandBar;
    ElidedLabel* m_moment;
    QAction* m_live;
    QAction* m_range;
};

} // namespace posewire::gui
