// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/models/statistics_model.h"
#include "app/gui/theme/widgets.h"
#include "core/log/time.h"
#include "core/model/session/session_view.h"

#include <QRectF>
#include <QWidget>

#include <optional>
#include <vector>

class QToolButton;

namespace posewire::gui {

/// The whole history in a rectangle: datagrams a second, and where samples were lost.
void paintOverview(QPainter& painter, const RangeOverview& overview, const QRectF& rect);

/// The whole history as a small picture, datagrams a second with the losses marked, in which a range is
/// dragged. Dragging an edge moves that edge.
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
    bool event(QEvent* event) override;

private:
    void paintRange(QPainter& painter) const;
    void paintCursor(QPainter& painter) const;
    void choose(log::Stamp from, log::Stamp to);
    /// The end of the range that stays where the other one, which is at `place`, is dragged; nothing
    /// elsewhere.
    [[nodiscard]] std::optional<log::Stamp> otherEnd(double place) const;
    [[nodiscard]] QString partText(double place) const;

    model::SessionView& m_view;
    Commands& m_commands;
    RangeOverview m_overview;
    std::optional<log::Stamp> m_anchor; ///< while dragging: the end that stays
    double m_pressed = 0;
    bool m_isMoved = false;
};

/// The choice of the time that figures are of: one for the session, so that all docks show the same.
class SpanBar final : public QWidget {
    Q_OBJECT

public:
    SpanBar(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh();

private:
    struct Button {
        QToolButton* button;
        std::optional<model::RangeChoice> choice; ///< nothing: the range that was dragged
    };

    void add(const QString& text, const QString& toolTip, const std::optional<model::RangeChoice>& choice);

    model::SessionView& m_view;
    Commands& m_commands;
    std::vector<Button> m_buttons;
};

/// The strip of the history, and the choice of the time that figures are of; the verdict of a range.
class RangeBar : public QWidget {
    Q_OBJECT

public:
    RangeBar(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh();

private:
    model::SessionView& m_view;
    RangeStrip* m_strip;
    SpanBar* m_span;
    QLabel* m_verdict = plainLabel(this);
};

} // namespace posewire::gui
