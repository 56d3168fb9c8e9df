// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"
#include "app/gui/viewport/captions.h"

#include <QWidget>

#include <vector>

namespace posewire::gui {

class ViewportWidget;

/// Lays the few choices over the picture: axes, framing, projection.
void addViewportButtons(ViewportWidget& viewport);

/// The label over one character.
struct ViewportLabel {
    QPointF anchor; ///< the label's lower middle
    QColor colour;
    QString name;
    PropertyValue state; ///< how it does
    bool isSelected = false;
};

/// Drawn over the picture: labels, and a card of text where there is no picture to see.
class ViewportOverlay final : public QWidget {
    Q_OBJECT

public:
    explicit ViewportOverlay(QWidget* parent);

    void setLabels(std::vector<ViewportLabel> labels);
    void setCard(const EmptyState& card);
    [[nodiscard]] const EmptyState& card() const { return m_card; }
    [[nodiscard]] const std::vector<ViewportLabel>& labels() const { return m_labels; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void paintLabel(QPainter& painter, const ViewportLabel& label, std::vector<QRectF>& taken) const;
    void paintCard(QPainter& painter) const;

    std::vector<ViewportLabel> m_labels;
    EmptyState m_card;
};

} // namespace posewire::gui
