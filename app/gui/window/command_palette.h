// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QString>
#include <QTreeWidget>

#include <vector>

class QAction;
class QMenuBar;

namespace posewire::gui {

struct Command {
    QAction* action;
    QString name;       ///< as people read it, without the letter to press
    QString menu;       ///< "View › Camera"
    QString synonyms{}; ///< words for it that people type
    QString keys{};     ///< "Ctrl+Home", which they may type as well
};

/// Other words for an action, a dock or a part of the preferences, by its object name; empty if there are
/// none.
[[nodiscard]] QString synonymsOf(const QString& id);

/// All entries of the menus as they are now, in their order.
[[nodiscard]] std::vector<Command> commandsOf(const QMenuBar& bar);

/// Whether each word that was typed begins a word of the name or of the menu, in any order, whatever the
/// case.
[[nodiscard]] bool isMeant(const Command& command, const QString& typed);

/// All commands of the menus, to be found by their words: typing narrows the list, Enter carries out the
/// current one, Escape leaves.
class CommandPalette final : public QDialog {
    Q_OBJECT

public:
    CommandPalette(const QMenuBar& bar, QWidget* window);

    /// Null for nothing. Still to be carried out.
    [[nodiscard]] QAction* chosen() const { return m_chosen; }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void list(const QString& typed);
    void choose();

    const std::vector<Command> m_commands;
    QLineEdit* m_line = new QLineEdit(this);
    QTreeWidget* m_list = new QTreeWidget(this);
    int m_choices = 0; ///< the first so many rows can be carried out
    QAction* m_chosen = nullptr;
};

} // namespace posewire::gui
