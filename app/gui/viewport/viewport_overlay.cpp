// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/viewport_overlay.h"

#include "app/gui/theme/widgets.h"
#include "app/gui/viewport/viewport_widget.h"

#include <QMenu>
#include <QPainter>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace posewire::gui {

namespace {

constexpr qreal kRadius = 5;
constexpr QLatin1String kButtons("viewportButtons");
constexpr double kBackgroundOpacity = 0.9;

void paintPlate(QPainter& painter, const QRectF& plate, const QColor& border, qreal radius) {
    painter.setPen(QPen(border, 1));
    painter.setBrush(withAlpha(theme().raised, kBackgroundOpacity));
    painter.drawRoundedRect(plate.adjusted(0.5, 0.5, -0.5, -0.5), radius, radius);
}

/// Text in one colour at the left; returns where it ends.
qreal paintText(QPainter& painter, qreal left, const QRectF& row, const QString& text, const QColor& colour) {
    painter.setPen(colour);
    const qreal width = painter.fontMetrics().horizontalAdvance(text);
    painter.drawText(QRectF(left, row.top(), width + 2, row.height()), Qt::AlignVCenter | Qt::AlignLeft,
                     text);
    return left + width;
}

/// The first of these that a plate lies on; null for none.
const QRectF* touched(const QRectF& plate, const std::vector<QRectF>& taken) {
    const auto found =
        std::ranges::find_if(taken, [&plate](const QRectF& other) { return other.intersects(plate); });
    return found == taken.end() ? nullptr : &*found;
}

/// Up where there is room above, else a little aside, else down.
void giveWay(QRectF& plate, const std::vector<QRectF>& taken, qreal width) {
    constexpr qreal kApart = 3;
    bool isUp = true;
    while (const QRectF* other = touched(plate, taken)) {
        const qreal above = other->top() - kApart - plate.height();
        const qreal aside = other->right() + kApart;
        if (isUp && above >= 0) {
            plate.moveTop(above);
        } else if (aside - plate.left() < plate.width() / 2 && aside + plate.width() <= width) {
            plate.moveLeft(aside);
        } else {
            isUp = false;
            plate.moveTop(other->bottom() + kApart);
        }
    }
}

class ViewportButtons final : public QWidget {
public:
    explicit ViewportButtons(ViewportWidget* viewport)
        : QWidget(viewport),
          m_axes(framedButton({}, tr("Local axes of the segments: x red, y green, z blue"), this)),
          m_frame(
              framedButton(tr("Frame  F"), tr("Show all characters, and keep them in the picture"), this)),
          m_projection(framedButton({}, tr("Perspective or orthographic"), this)) {
        setObjectName(kButtons);
        auto* row = spacedRow({12, 12, 12, 12}, 8, this);
        for (QToolButton* each : {m_axes, m_frame, m_projection}) {
            each->setFocusPolicy(Qt::TabFocus);
            row->addWidget(each);
        }
        const std::array modes{std::pair{AxesMode::All, tr("All segments")},
                               std::pair{AxesMode::Selected, tr("Selected character")},
                               std::pair{AxesMode::None, tr("None")}};
        auto* menu = new QMenu(m_axes);
        for (const auto& [mode, text] : modes) {
            menu->addAction(text, viewport, [viewport, mode = mode] { viewport->setAxes(mode); });
        }
        m_axes->setMenu(menu);
        m_axes->setPopupMode(QToolButton::InstantPopup);
        connect(m_frame, &QToolButton::clicked, viewport, &ViewportWidget::frameAll);
        connect(m_projection, &QToolButton::clicked, viewport, &ViewportWidget::toggleProjection);
        connect(viewport, &ViewportWidget::optionsChanged, this,
                [this, viewport] { showOptions(*viewport); });
        showOptions(*viewport);
    }

private:
    void showOptions(const ViewportWidget& viewport) {
        const std::array names{tr("all"), tr("selected"), tr("none")};
        m_axes->setText(tr("Axes: %1 ▾").arg(names[static_cast<std::size_t>(viewport.axes())]));
        m_projection->setText(viewport.projection() == render::Projection::Perspective ? tr("Persp")
                                                                                       : tr("Ortho"));
        adjustSize();
    }

    QToolButton* m_axes;
    QToolButton* m_frame;
    QToolButton* m_projection;
};

} // namespace

void addViewportButtons(ViewportWidget& viewport) {
    new ViewportButtons(&viewport);
}

ViewportOverlay::ViewportOverlay(QWidget* parent) : QWidget(parent) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
}

void ViewportOverlay::setLabels(std::vector<ViewportLabel> labels) {
    m_labels = std::move(labels);
    update();
}

void ViewportOverlay::setCard(const EmptyState& card) {
    if (card.title != m_card.title || card.lines != m_card.lines) {
        m_card = card;
        setAccessibleName(card.title);
        setAccessibleDescription(card.lines.join(QLatin1Char(' ')));
        update();
    }
}

void ViewportOverlay::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    std::vector<QRectF> taken;
    if (const auto* buttons = parentWidget()->findChild<QWidget*>(kButtons, Qt::FindDirectChildrenOnly)) {
        taken.push_back(buttons->geometry());
    }
    for (const ViewportLabel& label : m_labels) {
        paintLabel(painter, label, taken);
    }
    if (!m_card.title.isEmpty()) {
        paintCard(painter);
    }
}

void ViewportOverlay::paintLabel(QPainter& painter, const ViewportLabel& label,
                                 std::vector<QRectF>& taken) const {
    painter.setFont(tabularFont());
    const QFontMetricsF metrics(painter.font());
    const qreal unit = metrics.height();
    const qreal dot = 0.6 * unit;
    const QString status = healthText(label.state.health, label.state.text);
    // However long a name is, how its character does is in sight.
    const qreal rest = 2.4 * unit + dot + metrics.horizontalAdvance(status);
    const qreal room = std::clamp(this->width() - rest, 3 * unit, 16 * unit);
    const QString name = metrics.elidedText(label.name, Qt::ElideRight, room);
    const qreal width = rest + metrics.horizontalAdvance(name);
    const qreal height = unit + 8;
    QRectF plate(std::round(label.anchor.x() - width / 2), std::round(label.anchor.y() - height),
                 std::ceil(width), height);
    // With a head that is out of sight it goes out of sight.
    if (!QRectF(rect()).contains(label.anchor)) {
        return;
    }
    constexpr qreal kEdge = 2;
    plate.moveTop(std::max(kEdge, plate.top()));
    plate.moveLeft(std::max(kEdge, std::min(plate.left(), this->width() - kEdge - plate.width())));
    giveWay(plate, taken, this->width());
    taken.push_back(plate);
    paintPlate(painter, plate, label.isSelected ? theme().accent : theme().line, kRadius);
    painter.setPen(Qt::NoPen);
    painter.setBrush(label.colour);
    painter.drawEllipse(QRectF(plate.left() + 0.6 * unit, plate.center().y() - dot / 2, dot, dot));
    qreal x = plate.left() + 0.6 * unit + dot + 0.4 * unit;
    x = paintText(painter, x, plate, name, theme().text) + 0.6 * unit;
    paintText(painter, x, plate, status, healthColour(label.state.health));
}

void ViewportOverlay::paintCard(QPainter& painter) const {
    QFont titleFont = font();
    titleFont.setWeight(QFont::DemiBold);
    const qreal unit = QFontMetricsF(font()).height();
    const qreal most = std::min(0.86 * width(), 34 * unit);
    const QString text = m_card.lines.join(QLatin1Char('\n'));
    const QRectF room(0, 0, most - 3 * unit, height());
    const QRectF titleRoom =
        QFontMetricsF(titleFont).boundingRect(room, Qt::AlignHCenter | Qt::TextWordWrap, m_card.title);
    const QFontMetricsF metrics(font());
    const QRectF narrow(0, 0, balancedWidth(metrics, text, room.width()), height());
    const QRectF textRoom = metrics.boundingRect(narrow, Qt::AlignHCenter | Qt::TextWordWrap, text);
    const qreal cardWidth = std::min(most, std::max(titleRoom.width(), textRoom.width()) + 3.2 * unit);
    const qreal cardHeight = titleRoom.height() + textRoom.height() + 2.4 * unit;
    const QRectF card(std::round((width() - cardWidth) / 2), std::round((height() - cardHeight) / 2),
                      cardWidth, cardHeight);
    const bool isPlain = m_card.level == Health::Unknown || m_card.level == Health::Good;
    paintPlate(painter, card, isPlain ? theme().line : healthColour(m_card.level), 1.4 * kRadius);
    const QRectF inside = card.adjusted(1.2 * unit, 0.9 * unit, -1.2 * unit, -0.9 * unit);
    painter.setFont(titleFont);
    painter.setPen(isPlain ? theme().text : healthColour(m_card.level));
    const QString symbol = isPlain ? QString() : healthSymbol(m_card.level) + QLatin1Char(' ');
    painter.drawText(inside, Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap, symbol + m_card.title);
    painter.setFont(font());
    painter.setPen(theme().dim);
    painter.drawText(inside.adjusted(0, titleRoom.height() + 0.6 * unit, 0, 0),
                     Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap, text);
}

} // namespace posewire::gui
