// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/models/statistics_model.h"
#include "core/log/time.h"

#include <QWidget>

#include <optional>
#include <vector>

class QToolButton;

namespace posewire::gui {

/// The whole history as a small picture, datagrams a second with the losses marked, in which a range is
/// dragged: by the mouse, or by the arrow keys (they move it, with Shift its end, with Ctrl ten times as far;
/// Escape takes it away). Dragging an edge moves that edge.
class RangeStrip : public QWidget {
    Q_OBJECT

public:
    RangeStrip(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh();

    /// Pixels from the left for a stamp, and back.
    [[nodiscard]] double placeOf(log::Stamp stamp) const;
    [[nodiscard]] log::Stamp stampAt(double place) const;

    [[nodiscard]] QSize sizeHint() const override {
        return {fontMetrics().height() * 12, fontMetrics().height() * 2};
    }
    [[nodiscard]] QSize minimumSizeHint() const override {
        return {fontMetrics().height() * 4, sizeHint().height()};
    }

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

private:
    void paintRate(QPainter& painter) const;
    void paintLosses(QPainter& painter) const;
    void paintRange(QPainter& painter) const;
    void choose(log::Stamp from, log::Stamp to);
    /// The end of the range that stays where the other one, which is at `place`, is dragged; nothing
    /// elsewhere.
    [[nodiscard]] std::optional<log::Stamp> otherEnd(double place) const;
    [[nodiscard]] log::Duration keyStep() const;
    [[nodiscard]] QString partText(double place) const;

    model::SessionView& m_view;
    Commands& m_commands;
    RangeOverview m_overview;
    std::optional<log::Stamp> m_anchor; ///< while dragging: the end that stays
    double m_pressed = 0;
    bool m_isMoved = false;
};

/// The strip of the history with buttons for the newest ten seconds, the newest minute and all.
class RangeBar : public QWidget {
    Q_OBJECT

public:
    RangeBar(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh();

    /// "last 10 s", "10:42:17.5 + 2.1 s"; empty for all.
    [[nodiscard]] QString rangeText() const;

private:
    QToolButton* addButton(const QString& text, const QString& toolTip, const model::RangeChoice& choice);

    struct Button {
        QToolButton* button;
        model::RangeChoice choice;
    };

    model::SessionView& m_view;
    Commands& m_commands;
    RangeStrip* m_strip;
    std::vector<Button> m_buttons;
    QToolButton* m_sinceReset; ///< only after a reset
};

} // namespace posewire::gui
