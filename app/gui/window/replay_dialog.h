// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/driver/replaying.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace posewire::gui {

class RangeBox;

/// Sends what is shown to the network again: where to, what of it and how fast; and how that goes.
class ReplayDialog final : public QDialog {
    Q_OBJECT

public:
    ReplayDialog(Replaying& replaying, const Commands& commands, QWidget* parent);

    /// What the button does: begins, or ends what runs.
    void toggle();

private:
    void begin();
    void refresh();

    Replaying& m_replaying;
    const Commands& m_commands; ///< what is shown
    QLineEdit* m_target;
    QComboBox* m_transport;
    RangeBox* m_range;
    QDoubleSpinBox* m_speed;
    QCheckBox* m_loop;
    QLabel* m_state;
    QPushButton* m_button;
    QString m_problem; ///< why it did not begin
};

/// "Sending to 10.0.0.7:9763: 43 %, 5 883 datagrams", and what went wrong.
[[nodiscard]] QString replayText(const net::Replay& replay);

} // namespace posewire::gui
