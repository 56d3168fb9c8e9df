// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/receiving.h"
#include "app/gui/models/receiving_models.h"

#include <QWidget>

class QLabel;
class QPushButton;

namespace posewire::gui {

class SenderSettings;
class InputForm;
class TableView;

/// The inputs with their state; adds, changes and removes them while they run.
class InputsPage final : public QWidget {
    Q_OBJECT

public:
    explicit InputsPage(Receiving& receiving, QWidget* parent = nullptr);

    void refresh();

    // What the buttons do.
    void submit(); ///< adds what is typed, or changes the input that is being edited into it
    void editSelected();
    void removeSelected();
    void endEditing();

    [[nodiscard]] InputForm& form() const { return *m_form; }
    [[nodiscard]] TableView& table() const { return *m_table; }
    [[nodiscard]] const InputModel& model() const { return *m_model; }

signals:
    void choicesChanged();
    void copyRequested(const QString& text);
    void openFileRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void layOut();
    void select(const InputAddress& input);
    void showChoice();
    [[nodiscard]] std::optional<InputAddress> selected() const;

    Receiving& m_receiving;
    InputModel* m_model;
    TableView* m_table;
    InputForm* m_form;
    SenderSettings* m_settings;
    QLabel* m_state; ///< of the selected one, in full
    QPushButton* m_edit;
    QPushButton* m_remove;
    QPushButton* m_openFile;
    QPushButton* m_submit;
    QPushButton* m_cancel;
    std::optional<InputAddress> m_edited;
};

} // namespace posewire::gui
