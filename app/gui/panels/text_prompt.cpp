// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/text_prompt.h"

#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QLineEdit>
#include <QPushButton>

namespace posewire::gui {

std::optional<QString> askForText(const TextPrompt& words,
                                  const std::function<QString(const QString&)>& problemOf, QWidget* parent) {
    QDialog dialog(parent);
    dialog.setWindowTitle(words.title);
    auto* edit = new QLineEdit(words.text, &dialog);
    edit->setPlaceholderText(words.hint);
    edit->selectAll();
    auto* label = new QLabel(words.label, &dialog);
    label->setBuddy(edit);
    auto* problem = new QLabel(&dialog);
    problem->setWordWrap(true);
    problem->setMinimumWidth(dialog.fontMetrics().averageCharWidth() * 56);
    // The room is there from the beginning, so that the dialog does not jump under the pointer.
    problem->setMinimumHeight(2 * dialog.fontMetrics().lineSpacing());
    problem->setAlignment(Qt::AlignTop);
    setTextColour(*problem, theme().error);
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
            problem->setText(healthText(Health::Error, wrong));
        }
    });
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    QObject::connect(edit, &QLineEdit::textChanged, problem, &QLabel::clear);
    return dialog.exec() == QDialog::Accepted ? std::optional(edit->text().trimmed()) : std::nullopt;
}

} // namespace posewire::gui
