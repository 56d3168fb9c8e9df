// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/clock_history.h"
#include "app/gui/panel.h"
#include "app/gui/panels/clock_widget.h"
#include "app/gui/panels/table_view.h"

#include <QToolButton>

#include <memory>

namespace posewire::gui {

/// Dock `timecode`: the sender's clock, large, and how it runs. Full screen by double click or F.
class TimecodePanel : public Panel {
    Q_OBJECT

public:
    TimecodePanel(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;

    /// Shows the clock alone on the whole screen, or ends that.
    void setFullScreen(bool isFullScreen);
    [[nodiscard]] const ClockWidget* fullScreenClock() const { return m_fullScreen.get(); }

private:
    QToolButton* addChoice(const QString& text, ClockChoice choice);
    void showClock();
    [[nodiscard]] QString caption() const;
    [[nodiscard]] double age() const; ///< of the newest sample, s

    model::SessionView& m_view;
    ClockHistory m_clock;
    ClockChoice m_choice = ClockChoice::Header;
    PropertyModel m_facts;
    ClockWidget* m_large;
    TableView* m_table;
    std::unique_ptr<ClockWidget> m_fullScreen; ///< a window of its own
};

} // namespace posewire::gui
