// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"
#include "app/gui/viewport/label_layout.h"
#include "app/gui/viewport/picking.h"

#include <QFontMetricsF>
#include <QHash>
#include <QWidget>

#include <map>
#include <vector>

class QMenu;

namespace posewire::gui {

class MessageCard;
class ViewportWidget;

/// The background of what lies over a picture: a rectangle with round corners.
void paintPlate(QPainter& painter, const QRectF& plate, const QPen& border, double opacity,
                double radius = 5);

/// Lays the few choices over the picture: axes and overlays, whose menus are those of the window, framing and
/// projection.
void addViewportButtons(ViewportWidget& viewport, QMenu& axes, QMenu& overlays);

/// The text of a label in each length, and the width of its plate.
struct LabelText {
    QString name;
    QString status;
    QString shortName;
    qreal whole = 0; ///< widths of a plate
    qreal named = 0; ///< 0 if the initials are no shorter
    qreal brief = 0;
};

/// Drawn over the picture: labels, words of overlays, and a card of text where there is no picture to see.
class ViewportOverlay final : public QWidget {
    Q_OBJECT

public:
    explicit ViewportOverlay(QWidget* parent);

    void setLabels(std::vector<ViewportLabel> labels);
    /// The first are the last to give way where they would lie on each other.
    void setTexts(std::vector<ViewportText> texts);
    /// The card is a widget of its own beside this one, which lets the mouse through.
    void setCard(const EmptyState& card);
    [[nodiscard]] const EmptyState& card() const { return m_card; }
    [[nodiscard]] const std::vector<ViewportLabel>& labels() const { return m_labels; }
    [[nodiscard]] const std::vector<PlacedLabel>& placed() const { return m_placed; }

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    [[nodiscard]] std::vector<QRectF> takenRoom() const;
    std::vector<LabelPlace> placeAll(const std::vector<QRectF>& taken);
    const LabelText& textOf(const ViewportLabel& label, const QFontMetricsF& metrics);
    void paintLabel(QPainter& painter, const ViewportLabel& label, const PlacedLabel& placed);
    void paintTexts(QPainter& painter, std::vector<QRectF>& taken) const;

    std::vector<ViewportLabel> m_labels;
    std::vector<PlacedLabel> m_placed; ///< by label
    std::map<model::CharacterKey, PlacedLabel> m_before;
    QHash<QString, LabelText> m_labelTexts; ///< by health and name; cleared when the font or width changes
    std::vector<ViewportText> m_texts;
    EmptyState m_card;
    MessageCard* m_message = nullptr; ///< made with the first card
};

} // namespace posewire::gui
