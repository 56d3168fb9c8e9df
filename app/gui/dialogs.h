// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/options.h"

#include <QDialog>

#include <functional>
#include <optional>

class QLabel;
class QLineEdit;
class QTextDocument;

namespace posewire::gui {

/// Asks for a port to listen on and tells inside what is wrong with it, before anything is changed.
class AddPortDialog final : public QDialog {
    Q_OBJECT

public:
    /// `problemOf` says what would keep a port from being opened; empty for nothing.
    AddPortDialog(std::function<QString(const InputAddress&)> problemOf, QWidget* parent);

    /// What was entered and can be opened, once accepted.
    [[nodiscard]] const InputAddress& port() const { return m_port; }

    void accept() override;

private:
    std::function<QString(const InputAddress&)> m_problemOf;
    QLineEdit* m_edit;
    QLabel* m_problem;
    InputAddress m_port;
};

/// Gives Markdown's tables, which come with raised white borders, the look of the theme.
void styleTables(QTextDocument& document);

/// A window with text to read, in Markdown; deletes itself when closed.
void showText(const QString& title, const QString& markdown, QWidget* parent);

/// All keys of actionTable(), in Markdown.
[[nodiscard]] QString shortcutsText();
[[nodiscard]] QString aboutText();

} // namespace posewire::gui
