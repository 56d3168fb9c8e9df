// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/recording_choice.h"

#include <QDialog>

class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace posewire::gui {

/// Where takes are recorded, and how.
class RecordingDialog final : public QDialog {
    Q_OBJECT

public:
    RecordingDialog(const RecordingChoice& choice, QWidget* parent);

    [[nodiscard]] RecordingChoice choice() const;

private:
    QSpinBox* addNumber(QFormLayout& form, const QString& label, const QString& unit, const QString& none,
                        int value, int most);
    void chooseFolder();
    /// Says what the next file is called, or why it cannot be called so.
    void check();

    QLineEdit* m_folder;
    QLineEdit* m_pattern;
    QSpinBox* m_preRoll;
    QSpinBox* m_megabytes;
    QSpinBox* m_minutes;
    QSpinBox* m_free;
    QLabel* m_next;
    QPushButton* m_ok;
};

} // namespace posewire::gui
