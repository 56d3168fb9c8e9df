// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/text_prompt.h"

#include "app/gui/theme/theme.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

namespace posewire::gui {

TextPrompt::TextPrompt(const Words& words, std::function<QString(const QString&)> problemOf, QWidget* parent)
    : QDialog(parent),
      m_problemOf(std::move(problemOf)),
      m_edit(new QLineEdit(words.text, this)),
      m_problem(new QLabel(this)) {
    setWindowTitle(words.title);
    auto* label = new QLabel(words.label, this);
    label->setBuddy(m_edit);
    m_edit->setPlaceholderText(words.hint);
    m_edit->selectAll();
    m_problem->setWordWrap(true);
    m_problem->setMinimumWidth(fontMetrics().averageCharWidth() * 56);
    // The room is there from the beginning, so that the dialog does not jump under the pointer.
    m_problem->setMinimumHeight(2 * fontMetrics().lineSpacing());
    m_problem->setAlignment(Qt::AlignTop);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    buttons->button(QDialogButtonBox::Ok)->setText(words.accept);
    auto* column = new QVBoxLayout(this);
    column->addWidget(label);
    column->addWidget(m_edit);
    column->addWidget(m_problem);
    column->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::accepted, this, &TextPrompt::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &TextPrompt::reject);
    connect(m_edit, &QLineEdit::textChanged, m_problem, &QLabel::clear);
    QPalette palette = m_problem->palette();
    palette.setColor(QPalette::WindowText, theme().error);
    m_problem->setPalette(palette);
}

QString TextPrompt::text() const {
    return m_edit->text().trimmed();
}

QString TextPrompt::problem() const {
    return m_problem->text();
}

void TextPrompt::accept() {
    const QString problem = m_problemOf ? m_problemOf(text()) : QString();
    if (problem.isEmpty()) {
        QDialog::accept();
        return;
    }
    m_problem->setText(healthSymbol(Health::Error) + QLatin1Char(' ') + problem);
}

} // namespace posewire::gui
