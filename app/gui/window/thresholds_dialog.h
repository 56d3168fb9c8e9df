// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/window/alerts.h"

#include <QDialog>

#include <vector>

class QCheckBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;

namespace posewire::gui {

/// What a stream must keep, and whether a sound says that it did not.
class ThresholdsDialog final : public QDialog {
    Q_OBJECT

public:
    explicit ThresholdsDialog(const AlertChoices& choices, QWidget* parent = nullptr);

    [[nodiscard]] AlertChoices choices() const;
    void setChoices(const AlertChoices& choices);

private:
    struct Field {
        double model::Thresholds::*limit;
        double perUnit; ///< of what is shown
        QDoubleSpinBox* box;
    };
    void addLimit(QFormLayout& form, const QString& label, double model::Thresholds::*limit,
                  const QString& unit, const QString& toolTip);
    void addTimes(QFormLayout& form);
    void explainHysteresis();

    std::vector<Field> m_fields;
    QDoubleSpinBox* m_hysteresis = nullptr;
    QLabel* m_explanation = nullptr;
    QCheckBox* m_warningSound;
    QCheckBox* m_errorSound;
};

} // namespace posewire::gui
