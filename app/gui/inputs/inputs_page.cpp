// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/inputs_page.h"

#include "app/gui/inputs/input_form.h"
#include "app/gui/inputs/sender_settings.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <QHBoxLayout>
#include <QItemSelectionModel>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QShortcut>
#include <QVBoxLayout>

namespace posewire::gui {

namespace {

constexpr int kTableRows = 6;

} // namespace

InputsPage::InputsPage(Receiving& receiving, QWidget* parent)
    : QWidget(parent),
      m_receiving(receiving),
      m_model(new InputModel(this)),
      m_table(new TableView(tr("Inputs"), this)),
      m_form(new InputForm(this)),
      m_settings(new SenderSettings(this)),
      m_state(new QLabel(this)),
      m_edit(new QPushButton(tr("&Edit"), this)),
      m_remove(new QPushButton(tr("&Remove"), this)),
      m_openFile(new QPushButton(tr("&Open file…"), this)),
      m_submit(new QPushButton(this)),
      m_cancel(new QPushButton(tr("Cancel"), this)) {
    m_table->setModel(m_model);
    m_table->setEmptyText(tr("There are no inputs. Add one below: by default MVN sends to UDP port 9763."));
    const QString address = QStringLiteral("this computer · every address");
    m_table->setColumnSamples({tr("TCP, connecting"), address, QStringLiteral("65535"), QString(),
                               QStringLiteral("10 000"), QStringLiteral("100 000 000"),
                               QStringLiteral("100 000")},
                              tr("listening, nobody has connected"));
    layOut();
    setFocusProxy(m_table);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentChanged, this, &InputsPage::showChoice);
    connect(m_table, &QAbstractItemView::activated, this, &InputsPage::editSelected);
    connect(m_table, &TableView::copyRequested, this, &InputsPage::copyRequested);
    connect(m_settings, &SenderSettings::copyRequested, this, &InputsPage::copyRequested);
    connect(m_edit, &QPushButton::clicked, this, &InputsPage::editSelected);
    connect(m_remove, &QPushButton::clicked, this, &InputsPage::removeSelected);
    connect(m_openFile, &QPushButton::clicked, this, &InputsPage::openFileRequested);
    connect(m_form, &InputForm::submitted, this, &InputsPage::submit);
    connect(m_submit, &QPushButton::clicked, this, &InputsPage::submit);
    connect(m_cancel, &QPushButton::clicked, this, &InputsPage::endEditing);
    auto* removeKey = new QShortcut(QKeySequence::Delete, m_table);
    removeKey->setContext(Qt::WidgetShortcut);
    connect(removeKey, &QShortcut::activated, this, &InputsPage::removeSelected);
    endEditing();
    refresh();
}

void InputsPage::layOut() {
    m_table->setMinimumHeight(m_table->heightForRows(kTableRows));
    m_state->setWordWrap(true);
    m_state->setMinimumHeight(2 * fontMetrics().lineSpacing());
    m_state->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(m_edit);
    buttons->addWidget(m_remove);
    buttons->addSpacing(fontMetrics().height());
    buttons->addWidget(m_state, 1);
    buttons->addWidget(m_openFile);
    auto* formRow = new QHBoxLayout;
    auto* submitColumn = new QVBoxLayout;
    submitColumn->addSpacing(fontMetrics().height() + 6); // beside the fields, not their labels
    submitColumn->addWidget(m_submit);
    submitColumn->addWidget(m_cancel);
    submitColumn->addStretch(1);
    formRow->addWidget(m_form, 1);
    formRow->addLayout(submitColumn);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height() * 2 / 3);
    column->addWidget(m_table, 1);
    column->addLayout(buttons);
    column->addWidget(new Line(this));
    column->addLayout(formRow);
    column->addWidget(new Line(this));
    column->addWidget(m_settings);
}

/// Enter in the table has edited a row already: the dialog is not to press a button besides.
void InputsPage::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) {
        QWidget::keyPressEvent(event);
    }
}

void InputsPage::refresh() {
    m_model->refresh(m_receiving.state());
    if (!m_table->currentIndex().isValid() && m_model->rowCount() > 0) {
        m_table->setCurrentIndex(m_model->index(0, 0));
    }
    showChoice();
}

std::optional<InputAddress> InputsPage::selected() const {
    return m_model->input(m_table->currentIndex().row());
}

void InputsPage::showChoice() {
    const auto input = selected();
    m_edit->setEnabled(input.has_value());
    m_remove->setEnabled(input.has_value());
    const QModelIndex current = m_table->currentIndex();
    const QString state = current.siblingAtColumn(InputModel::kState).data().toString();
    if (state != m_state->text()) { // else a selection in it would be lost
        m_state->setText(state);
    }
    m_settings->showFor(input.value_or(InputAddress{}), m_receiving.state().addresses);
}

void InputsPage::select(const InputAddress& input) {
    if (const int row = m_model->rowOf(input); row >= 0) {
        m_table->setCurrentIndex(m_model->index(row, 0));
    }
}

void InputsPage::submit() {
    const auto input = readInput(m_form->typed());
    if (!input) {
        m_form->setProblem(input.error());
        return;
    }
    const QString problem =
        m_edited ? m_receiving.changePort(*m_edited, *input) : m_receiving.tryPort(*input);
    if (!problem.isEmpty()) {
        m_form->setProblem(problem);
        refresh();
        return;
    }
    endEditing();
    refresh();
    select(*input);
    emit choicesChanged();
}

void InputsPage::editSelected() {
    if (const auto input = selected()) {
        m_edited = input;
        m_form->setInput(*input);
        m_submit->setText(tr("&Apply"));
        m_cancel->setVisible(true);
        m_form->focusHost();
    }
}

void InputsPage::endEditing() {
    m_edited.reset();
    m_form->setInput({});
    m_submit->setText(tr("&Add input"));
    m_cancel->setVisible(false);
}

void InputsPage::removeSelected() {
    const auto input = selected();
    if (!input) {
        return;
    }
    if (m_edited == input) {
        endEditing();
    }
    m_receiving.removePort(*input);
    refresh();
    emit choicesChanged();
}

} // namespace posewire::gui
