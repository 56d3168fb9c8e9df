// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/tour.h"

#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QAccessible>
#include <QApplication>
#include <QFrame>
#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QTimer>

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::gui {

namespace {

constexpr int kGap = 12; ///< between the part and the card
constexpr int kMargin = 4;
constexpr qreal kRadius = 6;
constexpr double kShade = 0.62;

/// Where a card of that size is beside a part: below it, above it, at its sides, or in its middle.
QPoint besides(const QRect& part, const QSize& card, const QRect& window) {
    const QRect room = window.adjusted(kGap, kGap, -kGap, -kGap);
    const QPoint middle = part.center() - QRect(QPoint(), card).center();
    const std::array places{
        QPoint(middle.x(), part.bottom() + kGap), QPoint(middle.x(), part.top() - kGap - card.height()),
        QPoint(part.right() + kGap, middle.y()), QPoint(part.left() - kGap - card.width(), middle.y())};
    for (QPoint place : places) {
        QRect rect(place, card);
        rect.moveLeft(
            std::clamp(rect.left(), room.left(), std::max(room.left(), room.right() - card.width())));
        rect.moveTop(std::clamp(rect.top(), room.top(), std::max(room.top(), room.bottom() - card.height())));
        if (!rect.intersects(part)) {
            return rect.topLeft();
        }
    }
    return middle;
}

} // namespace

Tour::Tour(std::vector<TourStep> steps, QWidget* window)
    : QWidget(window),
      m_steps(std::move(steps)),
      m_focusBefore(QApplication::focusWidget()),
      m_card(new QFrame(this)),
      m_title(plainLabel(m_card)),
      m_text(plainLabel(m_card)),
      m_count(dimLabel({}, m_card)),
      m_skip(new QPushButton(tr("&Skip"), m_card)),
      m_back(new QPushButton(tr("&Back"), m_card)),
      m_next(new QPushButton(m_card)) {
    setObjectName(QStringLiteral("tour"));
    makeCard();
    restyle();
    new EventWatch(this, QEvent::PaletteChange, [this] { restyle(); });
    for (QWidget* watched : std::initializer_list<QWidget*>{window, m_skip, m_back, m_next}) {
        watched->installEventFilter(this);
    }
    goTo(0);
}

void Tour::makeCard() {
    m_card->setObjectName(QStringLiteral("tourCard"));
    m_text->setWordWrap(true);
    auto* buttons = spacedRow({}, 6);
    buttons->addWidget(m_count);
    buttons->addStretch(1);
    for (QPushButton* button : {m_skip, m_back, m_next}) {
        button->setAutoDefault(false);
        buttons->addWidget(button);
    }
    auto* column = new QVBoxLayout(m_card);
    const int unit = fontMetrics().height();
    column->setContentsMargins(unit, unit * 3 / 4, unit, unit * 3 / 4);
    column->setSpacing(unit / 2);
    column->addWidget(m_title);
    column->addWidget(m_text);
    column->addLayout(buttons);
    connect(m_skip, &QPushButton::clicked, this, &Tour::end);
    connect(m_back, &QPushButton::clicked, this, [this] { goTo(m_step - 1); });
    connect(m_next, &QPushButton::clicked, this, &Tour::next);
    new EventWatch(m_card, QEvent::Paint, [this] {
        QPainter painter(m_card);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(theme().line);
        painter.setBrush(theme().raised);
        painter.drawRoundedRect(QRectF(m_card->rect()).adjusted(0.5, 0.5, -0.5, -0.5), kRadius, kRadius);
    });
}

void Tour::restyle() {
    QFont font = this->font();
    font.setWeight(QFont::DemiBold);
    font.setPointSizeF(font.pointSizeF() * 1.15);
    m_title->setFont(font);
    update();
}

void Tour::goTo(std::size_t step) {
    m_step = std::min(step, m_steps.size() - 1);
    const TourStep& now = m_steps[m_step];
    const bool isLast = m_step + 1 == m_steps.size();
    m_title->setText(now.title);
    m_text->setText(now.text);
    m_count->setText(tr("%1 of %2").arg(m_step + 1).arg(m_steps.size()));
    m_back->setEnabled(m_step > 0);
    m_next->setText(isLast ? tr("&Done") : tr("&Next"));
    m_skip->setVisible(!isLast);
    place();
    show();
    raise();
    m_next->setFocus();
    m_card->setAccessibleName(m_count->text() + QStringLiteral(": ") + now.title);
    m_card->setAccessibleDescription(now.text);
    m_next->setAccessibleDescription(now.title + QStringLiteral(". ") + now.text);
    QAccessibleEvent spoken(m_card, QAccessible::Alert);
    QAccessible::updateAccessibility(&spoken);
}

QRect Tour::part() const {
    const QWidget* widget = m_steps[m_step].part;
    if (widget == nullptr || !widget->isVisible()) {
        return {};
    }
    return QRect(mapFromGlobal(widget->mapToGlobal(QPoint())), widget->size()) & rect();
}

void Tour::place() {
    setGeometry(parentWidget()->rect());
    const int width = std::min(fontMetrics().averageCharWidth() * 58, this->width() - 2 * kGap);
    m_card->setFixedWidth(width);
    m_card->setFixedHeight(m_card->layout()->totalHeightForWidth(width));
    const QRect about = part();
    m_card->move(about.isEmpty() ? rect().center() - m_card->rect().center()
                                 : besides(about, m_card->size(), rect()));
    update();
}

void Tour::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QPainterPath shade;
    shade.addRect(rect());
    const QRect about = part();
    if (!about.isEmpty()) {
        const QRectF hole = QRectF(about).adjusted(-kMargin, -kMargin, kMargin, kMargin) &
                            QRectF(rect()).adjusted(1, 1, -1, -1);
        shade.addRoundedRect(hole, kRadius, kRadius);
        painter.setPen(QPen(theme().accent, 2));
        painter.drawRoundedRect(hole, kRadius, kRadius);
    }
    painter.fillPath(shade, withAlpha(theme().isDark ? QColor(Qt::black) : theme().text, kShade));
}

void Tour::next() {
    if (m_step + 1 < m_steps.size()) {
        goTo(m_step + 1);
    } else {
        end();
    }
}

void Tour::end() {
    hide();
    if (m_focusBefore != nullptr) {
        m_focusBefore->setFocus();
    }
    emit ended();
    deleteLater();
}

/// The parts of the window get their places after it has got its own. To the buttons, arrows would mean the
/// button beside.
bool Tour::eventFilter(QObject* /*watched*/, QEvent* event) {
    if (event->type() == QEvent::KeyPress) {
        auto* key = static_cast<QKeyEvent*>(event);
        const bool isStep = key->key() == Qt::Key_Left || key->key() == Qt::Key_Right;
        if (isStep) {
            keyPressEvent(key);
        }
        return isStep;
    }
    if (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest) {
        QTimer::singleShot(0, this, &Tour::place);
    }
    return false;
}

/// No key of the window means anything while it lies under this, but for those with Ctrl or Alt.
bool Tour::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if ((key->modifiers() & (Qt::ControlModifier | Qt::AltModifier)) == 0) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void Tour::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
    case Qt::Key_Escape:
        end();
        return;
    case Qt::Key_Right:
    case Qt::Key_PageDown:
        next();
        return;
    case Qt::Key_Left:
    case Qt::Key_PageUp:
        goTo(m_step == 0 ? 0 : m_step - 1);
        return;
    default:
        event->accept();
    }
}

/// What lies under it is not meant.
void Tour::mousePressEvent(QMouseEvent* event) {
    event->accept();
}

/// Tab stays on the card.
bool Tour::focusNextPrevChild(bool isNext) {
    std::vector<QPushButton*> stops{m_skip, m_back, m_next};
    std::erase_if(stops, [](const QPushButton* one) { return !one->isVisible() || !one->isEnabled(); });
    if (stops.empty()) { // it is going: Qt looks for another place for the focus
        return QWidget::focusNextPrevChild(isNext);
    }
    const auto now = std::ranges::find(stops, QApplication::focusWidget());
    const auto at = static_cast<std::size_t>(now == stops.end() ? 0 : now - stops.begin());
    const std::size_t to = (at + (isNext ? 1 : stops.size() - 1)) % stops.size();
    stops[to]->setFocus(isNext ? Qt::TabFocusReason : Qt::BacktabFocusReason);
    return true;
}

} // namespace posewire::gui
