// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include <functional>

class QLabel;
class QLineEdit;

namespace posewire::gui {

/// Asks for one line of text and shows what is wrong with it.
class TextPrompt final : public QDialog {
    Q_OBJECT

public:
    struct Words {
        QString title;
        QString label;
        QString hint; ///< in the empty line
        QString accept;
        QString text{}; ///< to begin with
    };
    /// `problemOf` says what keeps a text from being taken; empty for nothing.
    TextPrompt(const Words& words, std::function<QString(const QString&)> problemOf, QWidget* parent);

    [[nodiscard]] QString text() const;
    [[nodiscard]] QString problem() const;
    void accept() override;

private:
    std::function<QString(const QString&)> m_problemOf;
    QLineEdit* m_edit;
    QLabel* m_problem;
};

} // namespace posewire::gui
