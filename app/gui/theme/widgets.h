// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QMessageBox>
#include <QTimer>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include <functional>
#include <optional>

/// Small parts that docks, dialogs and bars are made of, in the theme's colours.
namespace posewire::gui {

/// A layout of `parent` without margins and spaces.
[[nodiscard]] QVBoxLayout* tightColumn(QWidget* parent);
/// A layout from left to right, of `parent` or to be put into another layout.
[[nodiscard]] QHBoxLayout* spacedRow(const QMargins& margins, int spacing, QWidget* parent = nullptr);

void setTextColour(QLabel& label, const QColor& colour);

/// A label that shows plain text, whatever is in it. There are no others, but for richLabel().
[[nodiscard]] QLabel* plainLabel(QWidget* parent);
[[nodiscard]] QLabel* plainLabel(const QString& text, QWidget* parent);
/// A label for HTML that we wrote ourselves; what is not ours in it has passed QString::toHtmlEscaped().
[[nodiscard]] QLabel* richLabel(QWidget* parent);

/// A message that shows plain text.
class MessageBox final : public QMessageBox {
    Q_OBJECT

public:
    MessageBox(const QString& title, const QString& text, StandardButtons buttons, QWidget* parent);
};

[[nodiscard]] QLabel* dimLabel(const QString& text, QWidget* parent);
/// The same for sentences: broken into lines where it has to be.
[[nodiscard]] QLabel* dimText(const QString& text, QWidget* parent);

/// The least width at which `text` takes no more lines than at `most`: its lines are then about equally long,
/// and no word is left alone in the last one. Pixels.
[[nodiscard]] qreal balancedWidth(const QFontMetricsF& metrics, const QString& text, qreal most);

class Line : public QWidget {
public:
    explicit Line(QWidget* parent = nullptr) : QWidget(parent) { setFixedHeight(1); }

protected:
    void paintEvent(QPaintEvent* event) override;
};

/// Gives a bar of the window its background and a line below.
void paintAsBar(QWidget* bar);

/// A combo box with the same ▾ as buttons that open a menu.
class ComboBox : public QComboBox {
    Q_OBJECT

public:
    using QComboBox::QComboBox;

protected:
    void paintEvent(QPaintEvent* event) override;
};

/// Covers the part of a strip of time that cannot be looked at any more.
void paintForgotten(QPainter& painter, const QRectF& rect);

/// One line of text and, dimmed, what is added to it. It never asks for room: where there is too little it
/// ends in an ellipsis.
class ElidedLabel final : public QWidget {
    Q_OBJECT

public:
    explicit ElidedLabel(Qt::Alignment alignment, QWidget* parent = nullptr);

    void setText(const QString& text, const QString& dim = {});
    void setAlignment(Qt::Alignment alignment) {
        m_alignment = alignment;
        update();
    }
    [[nodiscard]] QString text() const { return m_text + m_dim; }

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {0, fontMetrics().height()}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Qt::Alignment m_alignment;
    QString m_text;
    QString m_dim;
};

/// A line that is there only while it has something to say; where there is too little room it ends in an
/// ellipsis.
class PassingMessage final : public QLabel {
    Q_OBJECT

public:
    PassingMessage(int milliseconds, QWidget* parent);

    /// Shows a text for its time, nothing for an empty one; a narrow label has it as its tooltip as well.
    void say(const QString& text);
    [[nodiscard]] QString said() const { return isHidden() ? QString() : text(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QTimer m_timer;
};

/// One for the foot of a dock, in the dim colour.
[[nodiscard]] PassingMessage* footMessage(QWidget* parent);

/// A button with an outline. It is called by its text.
[[nodiscard]] QToolButton* framedButton(const QString& text, const QString& toolTip, QWidget* parent);

/// A button that gets its outline from the pointer. Screen readers call it by its tooltip, since its text is
/// often no more than a sign.
[[nodiscard]] QToolButton* flatButton(const QString& text, const QString& toolTip, QWidget* parent);

/// Framed buttons that give way to their neighbours: where there is no room they go into a menu.
class CommandBar final : public QToolBar {
    Q_OBJECT

public:
    explicit CommandBar(QWidget* parent = nullptr);

    /// `name` is the button's object name; it may be empty.
    QAction* addCommand(const QString& name, const QString& text, const QString& toolTip);
};

struct TextPrompt {
    QString title;
    QString label;
    QString hint; ///< in the empty line
    QString accept;
    QString text{}; ///< to begin with
};

/// Asks for one line of text in a dialog and shows there what is wrong with it: what `problemOf` returns,
/// empty for nothing. Nothing if the operator cancels.
[[nodiscard]] std::optional<QString>
askForText(const TextPrompt& words, const std::function<QString(const QString&)>& problemOf, QWidget* parent);

/// Two lines beside what is typed: dim while they explain, in the colour of errors when they say what is
/// wrong. Their room is there from the beginning, so that nothing jumps under the pointer.
class Note final : public QLabel {
    Q_OBJECT

public:
    explicit Note(QWidget* parent);

    void explain(const QString& text);
    void warn(const QString& problem);
};

/// Draws one line in the painter's colour. If it begins with the symbol of a health, only the symbol has that
/// colour; the rest is drawn in `words`.
void paintMarked(QPainter& painter, QRect rect, const QString& text, const QColor& words);

/// A button of one short line after the symbol of its health, as in the bar at the bottom.
class ColourText final : public QAbstractButton {
    Q_OBJECT

public:
    /// Plain is dim text, Pill has an outline about it.
    enum class Look { Plain, Pill };

    explicit ColourText(Look look, QWidget* parent = nullptr);

    /// Unknown is dim text without a symbol.
    void setContent(Health level, const QString& text);
    [[nodiscard]] Health level() const { return m_level; }

    /// Pixels beside the text of a plain one, on both sides together.
    [[nodiscard]] static int marginsOf(const QFontMetrics& metrics) { return 2 * (metrics.height() / 4 + 1); }

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Look m_look;
    Health m_level = Health::Unknown;
};

} // namespace posewire::gui
