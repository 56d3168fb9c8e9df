// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/widgets.h"

#include "app/gui/theme/event_watch.h"

#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>

#include <algorithm>
#include <array>

namespace posewire::gui {

namespace {

QSizeF sizeAt(const QFontMetricsF& metrics, const QString& text, qreal width) {
    constexpr qreal kAnyHeight = 1e6;
    return metrics.boundingRect({0, 0, width, kAnyHeight}, Qt::TextWordWrap, text).size();
}

} // namespace

QVBoxLayout* tightColumn(QWidget* parent) {
    auto* column = new QVBoxLayout(parent);
    column->setContentsMargins({});
    column->setSpacing(0);
    return column;
}

QHBoxLayout* spacedRow(const QMargins& margins, int spacing, QWidget* parent) {
    auto* row = new QHBoxLayout(parent);
    row->setContentsMargins(margins);
    row->setSpacing(spacing);
    return row;
}

void setTextColour(QLabel& label, const QColor& colour) {
    QPalette palette = label.palette();
    palette.setColor(QPalette::WindowText, colour);
    label.setPalette(palette);
}

QLabel* plainLabel(QWidget* parent) {
    return plainLabel({}, parent);
}

QLabel* plainLabel(const QString& text, QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setTextFormat(Qt::PlainText);
    label->setText(text);
    return label;
}

QLabel* richLabel(QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setTextFormat(Qt::RichText);
    return label;
}

MessageBox::MessageBox(const QString& title, const QString& text, StandardButtons buttons, QWidget* parent)
    : QMessageBox(parent) {
    setTextFormat(Qt::PlainText);
    setWindowTitle(title);
    setText(text);
    setStandardButtons(buttons);
}

QLabel* dimLabel(const QString& text, QWidget* parent) {
    auto* label = plainLabel(text, parent);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

QLabel* dimText(const QString& text, QWidget* parent) {
    auto* label = dimLabel(text, parent);
    label->setWordWrap(true);
    return label;
}

qreal balancedWidth(const QFontMetricsF& metrics, const QString& text, qreal most) {
    const qreal height = sizeAt(metrics, text, most).height();
    qreal tooNarrow = 0;
    qreal enough = most;
    while (enough - tooNarrow > 1) {
        const qreal width = (tooNarrow + enough) / 2;
        (sizeAt(metrics, text, width).height() <= height ? enough : tooNarrow) = width;
    }
    // A word that is wider than its line is not broken: it makes the line no higher.
    return std::min(most, std::max(enough, sizeAt(metrics, text, enough).width()));
}

void Line::paintEvent(QPaintEvent* /*event*/) {
    QPainter(this).fillRect(rect(), theme().line);
}

void paintAsBar(QWidget* bar) {
    new EventWatch(bar, QEvent::Paint, [bar] {
        QPainter painter(bar);
        painter.fillRect(bar->rect(), theme().window);
        painter.fillRect(QRect(0, bar->height() - 1, bar->width(), 1), theme().line);
    });
}

void ComboBox::paintEvent(QPaintEvent* event) {
    QComboBox::paintEvent(event);
    QPainter painter(this);
    painter.setPen(isEnabled() ? theme().text : theme().dim);
    const int space = fontMetrics().averageCharWidth();
    painter.drawText(rect().adjusted(0, 0, -space, 0), Qt::AlignRight | Qt::AlignVCenter,
                     QStringLiteral("▾"));
}

ElidedLabel::ElidedLabel(Qt::Alignment alignment, QWidget* parent) : QWidget(parent), m_alignment(alignment) {
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
}

void ElidedLabel::setText(const QString& text, const QString& dim) {
    if (text == m_text && dim == m_dim) {
        return;
    }
    m_text = text;
    m_dim = dim;
    setAccessibleName(this->text());
    updateGeometry();
    update();
}

QSize ElidedLabel::sizeHint() const {
    return {fontMetrics().horizontalAdvance(text()), fontMetrics().height()};
}

void ElidedLabel::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const QFontMetrics metrics = fontMetrics();
    const QString shown = metrics.elidedText(text(), Qt::ElideRight, width());
    const qsizetype bright = std::min(m_text.size(), shown.size());
    QRect room = rect();
    if (m_alignment.testFlag(Qt::AlignRight)) {
        room.setLeft(room.right() + 1 - metrics.horizontalAdvance(shown));
    }
    const auto draw = [&](const QString& part, const QColor& colour) {
        painter.setPen(colour);
        painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine, part);
        room.setLeft(room.left() + metrics.horizontalAdvance(part));
    };
    draw(shown.left(bright), theme().text);
    draw(shown.mid(bright), theme().dim);
}

PassingMessage::PassingMessage(int milliseconds, QWidget* parent) : QLabel(parent) {
    setTextFormat(Qt::PlainText);
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    hide();
    m_timer.setSingleShot(true);
    m_timer.setInterval(milliseconds);
    connect(&m_timer, &QTimer::timeout, this, &QWidget::hide);
}

void PassingMessage::say(const QString& text) {
    setText(text);
    setToolTip(toolTipText(text));
    setVisible(!text.isEmpty());
    m_timer.start();
}

void PassingMessage::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const QRect room = contentsRect();
    style()->drawItemText(&painter, room, static_cast<int>(alignment()), palette(), isEnabled(),
                          fontMetrics().elidedText(text(), Qt::ElideRight, room.width()), foregroundRole());
}

PassingMessage* footMessage(QWidget* parent) {
    constexpr int kMilliseconds = 6'000;
    auto* message = new PassingMessage(kMilliseconds, parent);
    message->setForegroundRole(QPalette::PlaceholderText);
    message->setContentsMargins(10, 3, 10, 4);
    return message;
}

QToolButton* framedButton(const QString& text, const QString& toolTip, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setText(text);
    button->setToolTip(toolTipText(toolTip));
    button->setProperty("framed", true);
    return button;
}

QToolButton* flatButton(const QString& text, const QString& toolTip, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setText(text);
    button->setToolTip(toolTipText(toolTip));
    button->setAccessibleName(toolTip);
    button->setProperty("flat", true);
    return button;
}

CommandBar::CommandBar(QWidget* parent) : QToolBar(parent) {
    setToolButtonStyle(Qt::ToolButtonTextOnly);
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Preferred);
    if (auto* more = findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"))) {
        // Text, since the style's icon is black in the dark theme as well.
        more->setToolButtonStyle(Qt::ToolButtonTextOnly);
        more->setText(QStringLiteral("»"));
        more->setToolTip(tr("More"));
        more->setAccessibleName(more->toolTip());
        more->setFocusPolicy(Qt::StrongFocus);
    }
}

QAction* CommandBar::addCommand(const QString& name, const QString& text, const QString& toolTip) {
    QAction* action = addAction(text);
    action->setToolTip(toolTipText(toolTip));
    QWidget* button = widgetForAction(action);
    button->setObjectName(name);
    const bool isWord = text.size() > 1;
    button->setAccessibleName(isWord ? QString(text).replace(QLatin1String("&&"), QLatin1String("&"))
                                     : toolTip);
    button->setAccessibleDescription(isWord ? toolTip : QString());
    button->setProperty("framed", true);
    button->setFocusPolicy(Qt::StrongFocus);
    return action;
}

std::optional<QString> askForText(const TextPrompt& words,
                                  const std::function<QString(const QString&)>& problemOf, QWidget* parent) {
    QDialog dialog(parent);
    dialog.setWindowTitle(words.title);
    auto* edit = new QLineEdit(words.text, &dialog);
    edit->setPlaceholderText(words.hint);
    edit->selectAll();
    auto* label = plainLabel(words.label, &dialog);
    label->setBuddy(edit);
    auto* problem = new Note(&dialog);
    problem->setMinimumWidth(dialog.fontMetrics().averageCharWidth() * 56);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, &dialog);
    buttons->button(QDialogButtonBox::Ok)->setText(words.accept);
    auto* column = new QVBoxLayout(&dialog);
    for (QWidget* part : std::initializer_list<QWidget*>{label, edit, problem, buttons}) {
        column->addWidget(part);
    }
    QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, [&] {
        const QString wrong = problemOf(edit->text().trimmed());
        if (wrong.isEmpty()) {
            dialog.accept();
        } else {
            problem->warn(wrong);
        }
    });
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    QObject::connect(edit, &QLineEdit::textChanged, problem, &QLabel::clear);
    return dialog.exec() == QDialog::Accepted ? std::optional(edit->text().trimmed()) : std::nullopt;
}

Note::Note(QWidget* parent) : QLabel(parent) {
    setTextFormat(Qt::PlainText);
    setWordWrap(true);
    setAlignment(Qt::AlignTop);
    setMinimumHeight(2 * fontMetrics().lineSpacing());
}

void Note::explain(const QString& text) {
    setForegroundRole(QPalette::PlaceholderText);
    setText(text);
}

void Note::warn(const QString& problem) {
    setForegroundRole(QPalette::BrightText); // the theme's colour of errors
    setText(healthText(Health::Error, problem));
}

ColourText::ColourText(Look look, QWidget* parent) : QAbstractButton(parent), m_look(look) {
    setFont(tabularFont());
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    setFocusPolicy(Qt::TabFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);
}

void ColourText::setContent(Health level, const QString& text) {
    const QString line = level == Health::Unknown ? text : healthSymbol(level) + QLatin1Char(' ') + text;
    if (line != this->text()) {
        const QSize before = sizeHint();
        setText(line);
        setAccessibleName(text);
        if (sizeHint() != before) {
            updateGeometry();
        }
    }
    if (level != m_level) {
        m_level = level;
        update();
    }
}

QSize ColourText::sizeHint() const {
    const QFontMetrics metrics = fontMetrics();
    const int margin = m_look == Look::Pill ? metrics.height() : metrics.height() / 2;
    return {metrics.horizontalAdvance(text()) + margin + 2, metrics.height() + 6};
}

void ColourText::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool isActive = underMouse() || hasFocus();
    const QRectF frame = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
    if (m_look == Look::Pill || isActive) {
        const QColor plain = m_level == Health::Error ? theme().error : theme().line;
        painter.setPen(hasFocus() ? QPen(theme().accent, 2) : QPen(plain, 1));
        painter.setBrush(isActive ? theme().raised : Qt::transparent);
        const qreal radius = m_look == Look::Pill ? frame.height() / 2 : 4;
        painter.drawRoundedRect(frame, radius, radius);
    }
    painter.setPen(healthColour(m_level));
    if (m_look == Look::Pill) {
        painter.drawText(rect(), Qt::AlignCenter, text());
        return;
    }
    const int margin = marginsOf(fontMetrics()) / 2;
    const QRect room = rect().adjusted(margin, 0, -margin, 0);
    paintMarked(painter, room, fontMetrics().elidedText(text(), Qt::ElideRight, room.width() + 1),
                theme().dim);
}

void paintMarked(QPainter& painter, QRect rect, const QString& text, const QColor& words) {
    constexpr int kFlags = Qt::AlignLeft | Qt::AlignVCenter;
    constexpr std::array kMarked{Health::Good, Health::Warning, Health::Error};
    const bool isMarked = std::ranges::any_of(
        kMarked, [&text](Health health) { return text.startsWith(healthSymbol(health) + QLatin1Char(' ')); });
    const QString mark = isMarked ? text.left(1) : text;
    painter.drawText(rect, kFlags, mark);
    if (isMarked) {
        rect.setLeft(rect.left() + painter.fontMetrics().horizontalAdvance(mark));
        painter.setPen(words);
        painter.drawText(rect, kFlags, text.mid(1));
    }
}

void paintForgotten(QPainter& painter, const QRectF& rect) {
    if (rect.width() < 1) {
        return;
    }
    painter.fillRect(rect, withAlpha(theme().panel, 0.75));
    painter.fillRect(rect, QBrush(withAlpha(theme().dim, 0.5), Qt::FDiagPattern));
    const QString text = QCoreApplication::translate("Strip", "no longer kept");
    const double width = painter.fontMetrics().horizontalAdvance(text) + painter.fontMetrics().height();
    if (width < rect.width()) {
        const QRectF plate(rect.center() - QPointF(width / 2, painter.fontMetrics().height() / 2.0),
                           QSizeF(width, painter.fontMetrics().height()));
        painter.fillRect(plate, theme().panel);
        painter.setPen(theme().dim);
        painter.drawText(plate, Qt::AlignCenter, text);
    }
}

} // namespace posewire::gui
