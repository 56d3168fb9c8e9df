// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLabel;
class QLineEdit;

namespace posewire::gui {

class ComboBox;

enum class Direction { Backward, Forward };

/// A line to look for bytes or text in packets; hidden until it is asked for, Escape hides it again.
class FindBar final : public QWidget {
    Q_OBJECT

public:
    explicit FindBar(QWidget* parent = nullptr);

    /// Shows it with the keyboard in its line.
    void open();
    [[nodiscard]] QString text() const;
    void setText(const QString& text);
    [[nodiscard]] bool isHexadecimal() const;
    /// What came of it; `isProblem` makes it red.
    void say(const QString& text, bool isProblem);
    [[nodiscard]] QString said() const;

signals:
    void findRequested(Direction direction);
    void closed();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void close();
    void showKind();

    ComboBox* m_kind;
    QLineEdit* m_edit;
    QLabel* m_answer;
};

} // namespace posewire::gui
