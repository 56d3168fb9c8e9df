// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"
#include "app/gui/viewport/label_layout.h"
#include "app/gui/viewport/labels.h"

#include <QWidget>

#include <map>
#include <vector>

class QToolButton;

namespace posewire::gui {

class ViewportWidget;

/// Lays the few choices over the picture: axes, framing, projection.
void addViewportButtons(ViewportWidget& viewport);

/// Drawn over the picture: labels, words of overlays, and a card of text where there is no picture to see.
class ViewportOverlay final : public QWidget {
    Q_OBJECT

public:
    explicit ViewportOverlay(QWidget* parent);

    void setLabels(std::vector<ViewportLabel> labels);
    /// The first are the last to give way where they would lie on each other.
    void setTexts(std::vector<ViewportText> texts);
    /// With a button that opens its page of the guide, beside this widget, which lets the mouse through.
    void setCard(const EmptyState& card);
    [[nodiscard]] const EmptyState& card() const { return m_card; }
    [[nodiscard]] const std::vector<ViewportLabel>& labels() const { return m_labels; }
    /// Where each of them was painted last.
    [[nodiscard]] const std::vector<PlacedLabel>& placed() const { return m_placed; }

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    /// Where the card and what is on it are.
    struct CardLayout {
        QRectF card;
        QRectF title;
        QRectF text;
        QPoint button;
    };
    [[nodiscard]] bool isCardPlain() const;
    [[nodiscard]] QString cardTitle() const;
    [[nodiscard]] CardLayout layOutCard() const;
    void makeCardHelp();
    void placeCardHelp();
    [[nodiscard]] std::vector<QRectF> takenRoom() const;
    void placeAll();
    void paintLabel(QPainter& painter, const ViewportLabel& label, const PlacedLabel& placed) const;
    void paintTexts(QPainter& painter, std::vector<QRectF>& taken) const;
    void paintCard(QPainter& painter) const;

    std::vector<ViewportLabel> m_labels;
    std::vector<PlacedLabel> m_placed; ///< by label
    std::map<model::CharacterKey, PlacedLabel> m_before;
    std::vector<ViewportText> m_texts;
    EmptyState m_card;
    QToolButton* m_cardHelp = nullptr; ///< made with the first card
};

} // namespace posewire::gui
