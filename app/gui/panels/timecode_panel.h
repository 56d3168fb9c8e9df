// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/clock_history.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <map>
#include <memory>

namespace posewire::gui {

/// A clock readable across a room: monospaced figures as large as the widget allows.
class ClockWidget : public QWidget {
    Q_OBJECT

public:
    explicit ClockWidget(QWidget* parent = nullptr);

    /// A clock that does not run is dimmed; `caption`, below the figures, says why.
    enum class Run { Running, Stale, None };
    void setClock(const QString& text, const QString& caption, Run run);
    [[nodiscard]] const QString& text() const { return m_text; }

    [[nodiscard]] QSize sizeHint() const override {
        return {fontMetrics().height() * 16, fontMetrics().height() * 5};
    }
    [[nodiscard]] QSize minimumSizeHint() const override {
        return {fontMetrics().height() * 8, fontMetrics().height() * 3};
    }

signals:
    /// Double click or F: to be shown on the full screen, or no longer.
    void fullScreenToggled();
    /// Escape.
    void left();

protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* /*event*/) override { emit fullScreenToggled(); }
    void keyPressEvent(QKeyEvent* event) override;

private:
    [[nodiscard]] QRect captionPlace() const;

    QString m_text;
    QString m_caption;
    Run m_run = Run::None;
};

/// Dock `timecode`: the sender's clock, large, and how it runs. Full screen by double click or F.
class TimecodePanel : public Panel {
    Q_OBJECT

public:
    TimecodePanel(model::SessionView& view, Commands& commands, QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] bool hasWindow() const override { return m_fullScreen != nullptr; }
    void choose(ClockChoice choice);
    [[nodiscard]] ClockChoice choice() const { return m_choice; }
    [[nodiscard]] QString summary() const override {
        return m_choice == ClockChoice::Header ? tr("header · ms") : tr("type 25");
    }

    /// Shows the clock alone on the whole screen, or ends that.
    void setFullScreen(bool isFullScreen);
    [[nodiscard]] const ClockWidget* fullScreenClock() const { return m_fullScreen.get(); }

private:
    QToolButton* addChoice(const QString& text, ClockChoice choice);
    void showClock();
    [[nodiscard]] QString caption() const;
    [[nodiscard]] double age() const; ///< of the newest sample, s

    ClockHistory m_clock;
    ClockChoice m_choice = ClockChoice::Header;
    std::map<ClockChoice, QToolButton*> m_buttons;
    PropertyModel m_facts;
    ClockWidget* m_large = new ClockWidget(this);
    TableView* m_table = new TableView(tr("Clocks of the sender"), this);
    std::unique_ptr<ClockWidget> m_fullScreen; ///< a window of its own
};

} // namespace posewire::gui
