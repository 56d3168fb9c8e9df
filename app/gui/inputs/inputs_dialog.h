// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/receiving.h"

#include <QDialog>
#include <QTabWidget>

namespace posewire::gui {

class ConnectionPage;
class WaysOutPage;
class InputsPage;

/// The dialog of inputs, ways out and connection help. Stays open beside the window and
/// shows what happens.
class InputsDialog final : public QDialog {
    Q_OBJECT

public:
    enum class Page : int { Inputs, WaysOut, Help };

    explicit InputsDialog(Receiving& receiving, QWidget* parent = nullptr);

    void open(Page page);
    /// Shows the state of now; nothing where it is closed.
    void refresh();

    [[nodiscard]] InputsPage& inputs() const { return *m_inputs; }
    [[nodiscard]] WaysOutPage& waysOut() const { return *m_waysOut; }

signals:
    /// Receiving::choices() has been changed by the operator.
    void choicesChanged();
    void openFileRequested();

private:
    void takeOffer(const InputAddress& offer);

    Receiving& m_receiving;
    QTabWidget* m_tabs = new QTabWidget(this);
    InputsPage* m_inputs;
    WaysOutPage* m_waysOut;
    ConnectionPage* m_help;
};

} // namespace posewire::gui
