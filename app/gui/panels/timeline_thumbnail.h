// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/statistics_model.h"

#include <QWidget>

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

    /// Where the history is drawn, and the lens in it.
    [[nodiscard]] QRectF strip() const;
    [[nodiscard]] QRectF lens() const;

    [[nodiscard]] QSize sizeHint() const override;
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

} // namespace posewire::gui
