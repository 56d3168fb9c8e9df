// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/receiving.h"
#include "app/gui/inputs/undo_removal.h"
#include "app/gui/models/receiving_models.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"
#include "app/net/endpoint.h"

#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QWidget>

#include <tl/expected.hpp>

#include <vector>

namespace posewire::gui {

class SenderSettings;

/// What the operator typed, made an address; the error says what is wrong with it, in a sentence. Groups may
/// be separated by commas, semicolons or blanks. Nothing is opened or looked up.
[[nodiscard]] tl::expected<InputAddress, QString> readInput(const InputAddress& typed);

/// Protocol, host, port and multicast groups of one input, and a line that explains the protocol or says
/// what is wrong.
class InputForm final : public QWidget {
    Q_OBJECT

public:
    explicit InputForm(QWidget* parent = nullptr);

    /// As it was typed, before it is known to make sense.
    [[nodiscard]] InputAddress typed() const;
    void setInput(const InputAddress& input);

    /// Empty for none. Stays until something is typed.
    void setProblem(const QString& problem);
    [[nodiscard]] const QString& problem() const { return m_problem; }

    void focusHost();

signals:
    void submitted();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void changeKind();

    ComboBox* m_protocol = new ComboBox(this);
    QLineEdit* m_host = new QLineEdit(this);
    QSpinBox* m_port = new QSpinBox(this);
    QLineEdit* m_groups = new QLineEdit(this);
    Note* m_note = new Note(this);
    QString m_problem;
};

/// The addresses that reach an input, the best first: the one it listens at, else those of this computer; its
/// groups where it has any. None where the input connects itself.
[[nodiscard]] std::vector<net::LocalAddress> hostsFor(const InputAddress& input,
                                                      const std::vector<net::LocalAddress>& addresses);

/// The inputs with their state; adds, changes and removes them while they run.
class InputsPage final : public QWidget {
    Q_OBJECT

public:
    explicit InputsPage(Receiving& receiving, QWidget* parent = nullptr);

    void refresh();

    void submit(); ///< adds what is typed, or changes the input that is being edited into it
    void editSelected();
    void removeSelected(); ///< until it is undone
    void endEditing();
    void select(const InputAddress& input); ///< what it is doing, or what is wrong with it, is said below
    void applyAllowed();                    ///< listens to those who are typed, where that makes sense

    [[nodiscard]] InputForm& form() const { return *m_form; }
    [[nodiscard]] QLineEdit& allowedEdit() const { return *m_allowed; }
    [[nodiscard]] QString allowedNote() const { return m_allowedNote->text(); }
    [[nodiscard]] TableView& table() const { return *m_table; }
    [[nodiscard]] const InputModel& model() const { return m_model; }

signals:
    void choicesChanged();
    void openFileRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void layOut();
    void remove(const InputAddress& input);
    void putBack(const InputAddress& input, int row);
    void showChoice();
    void showAllowedNote();
    [[nodiscard]] std::optional<InputAddress> selected() const;

    Receiving& m_receiving;
    InputModel m_model;
    TableView* m_table = new TableView(tr("Inputs"), this);
    InputForm* m_form = new InputForm(this);
    SenderSettings* m_settings;
    QLineEdit* m_allowed = new QLineEdit(this); ///< hosts and nets to listen to
    Note* m_allowedNote = new Note(this);
    QString m_allowedProblem;           ///< with what is typed
    QLabel* m_state = plainLabel(this); ///< of the selected one, in full
    QPushButton* m_edit = new QPushButton(tr("&Edit"), this);
    QPushButton* m_remove = new QPushButton(tr("&Remove"), this);
    UndoRemoval* m_undo = new UndoRemoval(this);
    QPushButton* m_openFile = new QPushButton(tr("&Open file…"), this);
    QPushButton* m_submit = new QPushButton(this);
    QPushButton* m_cancel = new QPushButton(tr("Cancel"), this);
    std::optional<InputAddress> m_edited;
};

} // namespace posewire::gui
