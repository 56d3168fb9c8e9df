// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/viewport_overlay.h"

#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/viewport_widget.h"

#include <QMenu>
#include <QPainter>
#include <QtMath>

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::gui {

namespace {

constexpr QLatin1String kButtons("viewportButtons");
constexpr int kByButtons = 4; // pixels
constexpr double kBackgroundOpacity = 0.9;

/// As in drawings: what is hidden has broken lines.
Qt::PenStyle styleOf(const ViewportLabel& label) {
    return label.isBehind ? Qt::DashLine : Qt::SolidLine;
}

/// Text in one colour at the left; returns where it ends.
qreal paintText(QPainter& painter, qreal left, const QRectF& row, const QString& text, const QColor& colour) {
    painter.setPen(colour);
    const qreal width = painter.fontMetrics().horizontalAdvance(text);
    painter.drawText(QRectF(left, row.top(), width + 2, row.height()), Qt::AlignVCenter | Qt::AlignLeft,
                     text);
    return left + width;
}

qreal markSide(const QFontMetricsF& metrics) {
    return 0.65 * metrics.height();
}

LabelText measured(const ViewportLabel& label, const QFontMetricsF& metrics, qreal width) {
    const qreal unit = metrics.height();
    LabelText text;
    text.status = healthText(label.state.health, label.state.text);
    // However long a name is, how its character does is in sight.
    const qreal frame = 1.6 * unit + markSide(metrics);
    const qreal rest = frame + 0.6 * unit + metrics.horizontalAdvance(text.status);
    text.name = metrics.elidedText(label.name, Qt::ElideRight, std::clamp(width - rest, 3 * unit, 16 * unit));
    text.whole = rest + metrics.horizontalAdvance(text.name);
    const QString symbol = healthSymbol(label.state.health);
    text.brief = frame + 0.4 * unit + metrics.horizontalAdvance(initialsOf(label.name) + symbol);
    // The end tells it from others as well as the beginning does.
    text.shortName = metrics.elidedText(label.name, Qt::ElideMiddle, 8 * unit);
    text.named = frame + 0.4 * unit + metrics.horizontalAdvance(text.shortName + symbol);
    if (text.named <= text.brief) {
        text.named = 0;
    }
    return text;
}

/// Who is selected or in trouble keeps all text for longest.
int weightOf(const ViewportLabel& label) {
    const int trouble = label.state.health == Health::Error     ? 2
                        : label.state.health == Health::Warning ? 1
                                                                : 0;
    return (label.isSelected ? 4 : 0) + trouble;
}

class ViewportButtons final : public QWidget {
    static constexpr int kApart = 8; // pixels

public:
    ViewportButtons(ViewportWidget* viewport, QMenu& axes, QMenu& overlays)
        : QWidget(viewport),
          m_frame(
              framedButton(tr("Frame  F"), tr("Show all characters, and keep them in the picture"), this)) {
        setObjectName(kButtons);
        auto* row = spacedRow({12, 12, 12, 12}, kApart, this);
        for (QToolButton* each : {m_axes, m_overlays, m_frame, m_projection, m_more}) {
            each->setFocusPolicy(Qt::TabFocus);
            row->addWidget(each);
        }
        const auto setMenu = [](QToolButton* button, QMenu* menu) {
            button->setMenu(menu);
            button->setPopupMode(QToolButton::InstantPopup);
        };
        setMenu(m_axes, &axes);
        setMenu(m_overlays, &overlays);
        setMenu(m_more, new QMenu(m_more));
        m_overlays->setAccessibleName(tr("Overlays"));
        m_frame->setAccessibleName(tr("Frame all"));
        connect(m_frame, &QToolButton::clicked, viewport, &ViewportWidget::frameAll);
        connect(m_projection, &QToolButton::clicked, &viewport->choice(), &ViewChoice::toggleProjection);
        m_more->setObjectName(QStringLiteral("moreOfViewport"));
        m_more->setAccessibleName(tr("More"));
        connect(m_more->menu(), &QMenu::aboutToShow, this, &ViewportButtons::listMore);
        connect(&viewport->choice(), &ViewChoice::changed, this,
                [this, viewport] { showOptions(*viewport); });
        new EventWatch(viewport, QEvent::Resize, [this, viewport] { fitInto(viewport->width()); });
        showOptions(*viewport);
    }

private:
    void showOptions(const ViewportWidget& viewport) {
        const std::array names{tr("all"), tr("selected"), tr("none")};
        const QString axes = tr("Axes: %1").arg(names[static_cast<std::size_t>(viewport.choice().axes())]);
        const bool isPerspective = viewport.choice().projection() == render::Projection::Perspective;
        m_axes->setText(axes + QStringLiteral(" ▾"));
        m_axes->setAccessibleName(axes);
        m_projection->setText(isPerspective ? tr("Persp") : tr("Ortho"));
        m_projection->setAccessibleName(isPerspective ? tr("Projection: perspective")
                                                      : tr("Projection: orthographic"));
        fitInto(viewport.width());
    }
    /// The last ones go into a menu where there is no room for all.
    void fitInto(int width) {
        const std::array buttons{m_axes, m_overlays, m_frame, m_projection};
        const QMargins margins = layout()->contentsMargins();
        const auto widthOf = [](const QToolButton* button) { return button->sizeHint().width() + kApart; };
        int room = width - margins.left() - margins.right() + kApart;
        for (const QToolButton* button : buttons) {
            room -= widthOf(button);
        }
        m_more->setVisible(room < 0);
        room -= room < 0 ? widthOf(m_more) : 0;
        for (auto button = buttons.rbegin(); button != buttons.rend(); ++button) {
            (*button)->setVisible(room >= 0);
            room += room < 0 ? widthOf(*button) : 0;
        }
        adjustSize();
    }
    void listMore() {
        m_more->menu()->clear();
        for (QToolButton* button : {m_axes, m_overlays, m_frame, m_projection}) {
            if (button->isVisible()) {
                continue;
            }
            if (button->menu() != nullptr) {
                m_more->menu()->addMenu(button->menu());
            } else {
                m_more->menu()->addAction(button->accessibleName(), button, &QToolButton::click);
            }
        }
    }

    QToolButton* m_axes = framedButton({}, tr("Local axes of the segments: x red, y green, z blue"), this);
    QToolButton* m_overlays = framedButton(tr("Overlays ▾"), tr("What is drawn over the figures"), this);
    QToolButton* m_frame;
    QToolButton* m_projection = framedButton({}, tr("Perspective or orthographic"), this);
    QToolButton* m_more = framedButton(QStringLiteral("»"), tr("More"), this);
};

} // namespace

void paintPlate(QPainter& painter, const QRectF& plate, const QPen& border, double opacity, double radius) {
    painter.setPen(border);
    painter.setBrush(withAlpha(theme().raised, opacity));
    painter.drawRoundedRect(plate.adjusted(0.5, 0.5, -0.5, -0.5), radius, radius);
}

void addViewportButtons(ViewportWidget& viewport, QMenu& axes, QMenu& overlays) {
    new ViewportButtons(&viewport, axes, overlays);
}

/// A few words and a way into the guide over a picture that shows no character.
class MessageCard final : public QWidget {
public:
    explicit MessageCard(QWidget* parent) : QWidget(parent) {
        m_help->setObjectName(QStringLiteral("cardHelp"));
        m_help->setAccessibleName(tr("Help on this message"));
        m_help->setFocusPolicy(Qt::TabFocus);
        connect(m_help, &QToolButton::clicked, this, [this] { openHelp(placeOf(m_state.topic)); });
        const int unit = fontMetrics().height();
        QVBoxLayout* column = tightColumn(this);
        column->setContentsMargins(unit, unit, unit, unit);
        column->setSpacing(unit / 2);
        QFont bold = font();
        bold.setWeight(QFont::DemiBold);
        m_title->setFont(bold);
        for (QLabel* label : {m_title, m_text}) {
            label->setAlignment(Qt::AlignHCenter);
            label->setWordWrap(true);
            column->addWidget(label, 0, Qt::AlignHCenter);
        }
        column->addWidget(m_help, 0, Qt::AlignHCenter);
    }

    void setState(const EmptyState& state) {
        m_state = state;
        const bool isPlain = state.level == Health::Unknown || state.level == Health::Good;
        m_border = isPlain ? theme().line : healthColour(state.level);
        m_title->setText(isPlain ? state.title : healthText(state.level, state.title));
        setTextColour(*m_title, isPlain ? theme().text : m_border);
        m_text->setText(state.lines.join(QLatin1Char('\n')));
        setTextColour(*m_text, theme().dim);
        setVisible(!state.title.isEmpty());
        place();
    }

    /// In the middle, but below the buttons.
    void place() {
        const int unit = fontMetrics().height();
        const QSize room = parentWidget()->size();
        const double most = std::min(0.86 * room.width(), 34.0 * unit) - 2 * unit;
        for (QLabel* label : {m_title, m_text}) {
            label->setFixedWidth(qCeil(balancedWidth(QFontMetricsF(label->font()), label->text(), most)) + 1);
        }
        layout()->activate();
        const int width = std::max(m_title->width(), m_text->width()) + 2 * unit;
        resize(width, layout()->totalHeightForWidth(width));
        const auto* above = parentWidget()->findChild<QWidget*>(kButtons);
        const int least = above == nullptr ? 0 : above->geometry().bottom() - unit / 2;
        const int top = std::min(std::max((room.height() - height()) / 2, least), room.height() - height());
        move((room.width() - width) / 2, top);
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        paintPlate(painter, rect(), m_border, 1, 7); // sentences are read: nothing shines through
    }
    void changeEvent(QEvent* event) override {
        QWidget::changeEvent(event);
        if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
            setState(m_state);
        }
    }

private:
    QLabel* m_title = plainLabel(this);
    QLabel* m_text = plainLabel(this);
    QToolButton* m_help = framedButton(tr("Help"), tr("What this means, and what to do about it"), this);
    QColor m_border;
    EmptyState m_state;
};

ViewportOverlay::ViewportOverlay(QWidget* parent) : QWidget(parent) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
}

void ViewportOverlay::setLabels(std::vector<ViewportLabel> labels) {
    m_labels = std::move(labels);
    update();
}

void ViewportOverlay::setTexts(std::vector<ViewportText> texts) {
    m_texts = std::move(texts);
    update();
}

void ViewportOverlay::setCard(const EmptyState& card) {
    if (card.title != m_card.title || card.lines != m_card.lines) {
        m_card = card;
        setAccessibleName(card.title);
        setAccessibleDescription(card.lines.join(QLatin1Char(' ')));
        if (m_message == nullptr) {
            m_message = new MessageCard(parentWidget());
        }
        m_message->setState(card);
    }
}

const LabelText& ViewportOverlay::textOf(const ViewportLabel& label, const QFontMetricsF& metrics) {
    constexpr qsizetype kMost = 2048; // entries pile up because ages change
    const QString key = healthSymbol(label.state.health) + label.state.text + QChar() + label.name;
    auto known = m_labelTexts.find(key);
    if (known == m_labelTexts.end()) {
        if (m_labelTexts.size() >= kMost) {
            m_labelTexts.clear();
        }
        known = m_labelTexts.insert(key, measured(label, metrics, width()));
    }
    return *known;
}

void ViewportOverlay::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    m_labelTexts.clear();
}

void ViewportOverlay::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    m_labelTexts.clear();
    if (m_message != nullptr) {
        m_message->place();
    }
}

/// By what else stands over the picture.
std::vector<QRectF> ViewportOverlay::takenRoom() const {
    std::vector<QRectF> taken;
    for (const QWidget* other : parentWidget()->findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
        const bool isSmall = other->width() < width() || other->height() < height();
        const bool isOverlay = qobject_cast<const ViewportOverlay*>(other) != nullptr;
        if (!isOverlay && other->isVisible() && isSmall) {
            const bool isRow = other->objectName() == kButtons; // with a margin of its own
            const QRect room = isRow ? other->childrenRect().adjusted(-kByButtons, 0, kByButtons, kByButtons)
                                     : other->rect();
            taken.push_back(room.translated(other->pos() - pos()));
        }
    }
    return taken;
}

std::vector<LabelPlace> ViewportOverlay::placeAll(const std::vector<QRectF>& taken) {
    const QFontMetricsF metrics(tabularFont());
    const qreal height = metrics.height() + 8;
    std::vector<LabelPlace> places;
    for (const ViewportLabel& label : m_labels) {
        const LabelText& text = textOf(label, metrics);
        const auto before = m_before.find(label.key);
        places.push_back({label.anchor, label.head, label.depth, weightOf(label), QSizeF(text.whole, height),
                          QSizeF(text.brief, height),
                          before == m_before.end() ? std::nullopt : std::optional(before->second),
                          QSizeF(text.named, height), label.arms});
    }
    m_placed = placeLabels(places, rect(), taken);
    m_before.clear();
    for (std::size_t i = 0; i < m_labels.size(); ++i) {
        m_before[m_labels[i].key] = m_placed[i];
    }
    return places;
}

void ViewportOverlay::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(tabularFont());
    std::vector<QRectF> taken = takenRoom();
    const std::vector<LabelPlace> places = placeAll(taken);
    for (std::size_t i = 0; i < m_labels.size(); ++i) {
        if (const auto leader = leaderOf(m_placed[i], places, i)) {
            painter.setPen(QPen(theme().panel, 3));
            painter.drawLine(*leader);
            painter.setPen(QPen(m_labels[i].mark.colour, 1.4, styleOf(m_labels[i])));
            painter.drawLine(*leader);
        }
    }
    for (std::size_t i = 0; i < m_labels.size(); ++i) {
        paintLabel(painter, m_labels[i], m_placed[i]);
    }
    for (const PlacedLabel& label : m_placed) {
        if (label.form != LabelForm::None) {
            taken.push_back(label.plate);
        }
    }
    paintTexts(painter, taken);
}

void ViewportOverlay::paintLabel(QPainter& painter, const ViewportLabel& label, const PlacedLabel& placed) {
    const QFontMetricsF metrics(painter.font());
    const qreal unit = metrics.height();
    const qreal side = markSide(metrics);
    if (placed.form == LabelForm::None) {
        return;
    }
    if (placed.form == LabelForm::Mark) {
        paintMark(painter, QRectF(label.anchor - QPointF(side / 2, side), QSizeF(side, side)), label.mark);
        return;
    }
    const QRectF& plate = placed.plate;
    const QColor& border = label.isSelected ? theme().accent : label.isBehind ? theme().dim : theme().line;
    paintPlate(painter, plate, QPen(border, 1, styleOf(label)), kBackgroundOpacity);
    paintMark(painter, QRectF(plate.left() + 0.6 * unit, plate.center().y() - side / 2, side, side),
              label.mark);
    const LabelText& text = textOf(label, metrics);
    const bool isWhole = placed.form == LabelForm::Whole;
    qreal x = plate.left() + unit + side;
    const QString name = isWhole                           ? text.name
                         : placed.form == LabelForm::Named ? text.shortName
                                                           : initialsOf(label.name);
    x = paintText(painter, x, plate, name, label.isBehind ? theme().dim : theme().text);
    const QString symbol = healthSymbol(label.state.health);
    x = paintText(painter, x + (isWhole ? 0.6 : 0.4) * unit, plate, symbol, healthColour(label.state.health));
    if (isWhole) { // dim: the verdict bar shows it in large
        paintText(painter, x, plate, text.status.mid(symbol.size()), theme().dim);
    }
}

namespace {

constexpr qreal kAside = 7;

/// Paints a text with a halo of the background, so that it can be read over anything.
void paintWithHalo(QPainter& painter, const QPointF& place, const QString& text, const QColor& colour) {
    constexpr std::array<QPointF, 8> kAround{
        {{-1.5, 0}, {1.5, 0}, {0, -1.5}, {0, 1.5}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    painter.setPen(withAlpha(theme().window, colour.alphaF()));
    for (const QPointF& around : kAround) {
        painter.drawText(place + around, text);
    }
    painter.setPen(colour);
    painter.drawText(place, text);
}

/// Finds room beside the place of a text; for one of a body also farther aside, row by row. Empty if all is
/// taken.
QRectF roomFor(const ViewportText& text, const QSizeF& size, const QRectF& view,
               const std::vector<QRectF>& taken) {
    constexpr int kRows = 8;
    for (int row = 0; row <= (text.isOfBody ? kRows : 0); ++row) {
        const qreal aside = row == 0 ? kAside : kAside + 0.8 * row * size.height();
        for (const qreal up : {-1.0, 1.0}) {
            for (const bool isRight : {true, false}) {
                const QRectF room(
                    QPointF(isRight ? text.place.x() + aside : text.place.x() - aside - size.width(),
                            text.place.y() - size.height() / 2 + up * row * size.height()),
                    size);
                const bool isTried = (isRight || text.isOfBody) && (row != 0 || up < 0);
                if (isTried && view.contains(room) &&
                    std::ranges::none_of(taken,
                                         [&room](const QRectF& other) { return other.intersects(room); })) {
                    return room;
                }
            }
        }
    }
    return {};
}

} // namespace

void ViewportOverlay::paintTexts(QPainter& painter, std::vector<QRectF>& taken) const {
    QFont small = tabularFont();
    small.setPointSizeF(0.85 * small.pointSizeF());
    painter.setFont(small);
    const QFontMetricsF metrics(small);
    int left = 0;
    QString hint;
    for (const ViewportText& text : m_texts) {
        if (text.isHint) {
            hint = text.text;
            continue;
        }
        const QRectF room =
            roomFor(text, {metrics.horizontalAdvance(text.text), metrics.height()}, rect(), taken);
        if (room.isEmpty()) {
            left += text.isOfBody && rect().contains(text.place.toPoint()) ? 1 : 0;
            continue;
        }
        taken.push_back(room);
        const qreal side = room.left() > text.place.x() ? room.left() - 2 : room.right() + 2;
        const QLineF leader(text.place, {side, room.center().y()});
        if (leader.length() > 2 * kAside) {
            painter.setPen(QPen(withAlpha(text.colour, 0.5 * text.colour.alphaF()), 1));
            painter.drawLine(leader);
        }
        paintWithHalo(painter, {room.left(), room.bottom() - metrics.descent()}, text.text, text.colour);
    }
    if (left != 0) {
        hint = tr("%n names have no room: come closer", nullptr, left);
    }
    const qreal margin = metrics.height();
    QRectF room({0, 0}, QSizeF(metrics.horizontalAdvance(hint), metrics.height()));
    room.moveBottomRight({width() - margin, height() - margin / 2});
    const auto isCovered = [&room](const QRectF& other) { return other.intersects(room); };
    while (room.top() > margin && std::ranges::any_of(taken, isCovered)) {
        room.translate(0, -margin / 2);
    }
    paintWithHalo(painter, {room.left(), room.bottom() - metrics.descent()}, hint, theme().dim);
}

} // namespace posewire::gui
