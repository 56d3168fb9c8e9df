// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/statistics_model.h"
#include "app/gui/panels/timeline_view.h"
#include "app/gui/theme/widgets.h"

#include <QWidget>
#include <Qt>

class QAction;

namespace posewire::gui {

class TimelineView;

/// The whole history below the timeline, losses marked, with a lens around what the timeline shows: a click
/// or a drag moves it there.
class TimelineThumbnail final : public QWidget {
    Q_OBJECT

public:
    /// The timeline must outlive it.
    TimelineThumbnail(model::SessionView& view, TimelineView& timeline, QWidget* parent);

    void refresh();

    [[nodiscard]] QRectF strip() const;
    [[nodiscard]] QRectF lens() const;

    [[nodiscard]] QSize sizeHint() const override { return {0, fontMetrics().height() * 3 / 2}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {0, sizeHint().height()}; }

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;

private:
    void moveTo(double place);

    TimelineView& m_timeline;
    RangeOverview m_overview;
};

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
    TimelineThumbnail* m_thumbnail = new TimelineThumbnail(m_view, *m_timeline, this);
    CommandBar* m_commandBar = new CommandBar(this);
    ElidedLabel* m_moment = new ElidedLabel(Qt::AlignRight | Qt::AlignVCenter, this);
    QAction* m_live;
    QAction* m_range;
};

} // namespace posewire::gui
