// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/window/alerts.h"

#include <QDialog>

#include <vector>

class QCheckBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;

namespace posewire::model {
struct ThresholdRow;
}

namespace posewire::gui {

/// The limits that streams must keep, and whether a sound announces that one was exceeded.
class ThresholdsDialog final : public QDialog {
    Q_OBJECT

public:
    explicit ThresholdsDialog(const AlertChoices& choices, QWidget* parent = nullptr);

    [[nodiscard]] AlertChoices choices() const;
    void setChoices(const AlertChoices& choices);

private:
    struct Field {
        const model::ThresholdRow* row;
        QDoubleSpinBox* box;
    };
    void addLimit(QFormLayout& form, const model::ThresholdRow& row);
    void explainHysteresis();

    std::vector<Field> m_fields;
    QLabel* m_explanation;
    QCheckBox* m_warningSound;
    QCheckBox* m_errorSound;
};

} // namespace posewire::gui
