// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/alert_choices.h"
#include "core/model/session/session_view.h"

#include <QDialog>

#include <map>
#include <vector>

class QCheckBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;

namespace posewire::gui {

/// Decides which sounds are due: one for an episode, and none for what happened before.
class AlertSounds {
public:
    /// True where an incident began, or became worse, since the last call that the operator wants to hear.
    [[nodiscard]] bool isDue(const model::Incidents& incidents, const AlertChoices& choices);

private:
    std::map<std::uint64_t, model::IncidentSeverity> m_seen; ///< how bad each was at worst
    std::uint64_t m_version = 0;
    bool m_isFirst = true;
};

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
