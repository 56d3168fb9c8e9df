// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/thresholds_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace posewire::gui {

namespace {

constexpr double kPercent = 100;

QLabel* dimLabel(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setForegroundRole(QPalette::PlaceholderText);
    label->setWordWrap(true);
    return label;
}

} // namespace

ThresholdsDialog::ThresholdsDialog(const AlertChoices& choices, QWidget* parent)
    : QDialog(parent),
      m_warningSound(new QCheckBox(tr("at a &warning"), this)),
      m_errorSound(new QCheckBox(tr("at an &error"), this)) {
    setWindowTitle(tr("Thresholds"));
    using T = model::Thresholds;
    auto* form = new QFormLayout;
    addLimit(*form, tr("&Loss above"), &T::lossPercent, tr(" %"),
             tr("Of the samples that should have come; incomplete ones included"));
    addLimit(*form, tr("&Jitter above"), &T::jitterMs, tr(" ms"), tr("As RFC 3550 computes it"));
    addLimit(*form, tr("&Gap above"), &T::gapMs, tr(" ms"), tr("Longest time between two samples"));
    addLimit(*form, tr("&Age above"), &T::ageS, tr(" s"), tr("Since the newest sample"));
    addLimit(*form, tr("&Rate off by more than"), &T::ratePercent, tr(" %"),
             tr("How far the rate is from what was usual"));
    addTimes(*form);
    auto* sounds = new QVBoxLayout;
    sounds->addWidget(m_warningSound);
    sounds->addWidget(m_errorSound);
    form->addRow(tr("Sound"), sounds);
    auto* buttons = new QDialogButtonBox(
        QDialogButtonBox::Ok | QDialogButtonBox::Cancel | QDialogButtonBox::RestoreDefaults, this);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, this,
            [this] { setChoices({}); });
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height());
    column->addWidget(dimLabel(tr("A stream that exceeds one of these is an event, once for an episode, and "
                                  "shows in the health of its character. They hold from now on."),
                               this));
    column->addLayout(form);
    column->addWidget(m_explanation);
    column->addWidget(buttons);
    setChoices(choices);
    setMinimumWidth(fontMetrics().averageCharWidth() * 62);
}

void ThresholdsDialog::addLimit(QFormLayout& form, const QString& label, double model::Thresholds::*limit,
                                const QString& unit, const QString& toolTip) {
    auto* box = new QDoubleSpinBox(this);
    box->setDecimals(1);
    box->setRange(0, 100'000);
    box->setSuffix(unit);
    box->setSpecialValueText(tr("never an alert")); // at 0
    box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    box->setToolTip(toolTip);
    form.addRow(label, box);
    m_fields.push_back({limit, 1, box});
}

void ThresholdsDialog::addTimes(QFormLayout& form) {
    using T = model::Thresholds;
    addLimit(form, tr("&Over the last"), &T::windowS, tr(" s"),
             tr("The past that loss, gap and rate are taken from"));
    m_fields.back().box->setRange(1, 60);
    m_fields.back().box->setSpecialValueText({});
    addLimit(form, tr("Alert ends &below"), &T::hysteresis, tr(" % of its limit"),
             tr("So that a figure that hovers about its limit alerts once"));
    m_hysteresis = m_fields.back().box;
    m_hysteresis->setRange(1, kPercent);
    m_hysteresis->setDecimals(0);
    m_hysteresis->setSpecialValueText({});
    m_fields.back().perUnit = kPercent;
    m_explanation = dimLabel({}, this);
    for (const Field& field : m_fields) {
        connect(field.box, &QDoubleSpinBox::valueChanged, this, &ThresholdsDialog::explainHysteresis);
    }
}

void ThresholdsDialog::explainHysteresis() {
    const AlertChoices shown = choices();
    const double loss = shown.thresholds.lossPercent;
    const QString share = QString::number(shown.thresholds.hysteresis * kPercent, 'f', 0);
    m_explanation->setText(
        loss > 0 ? tr("Hysteresis: a loss alert begins above %1 % and ends below %2 %, so that a figure that "
                      "hovers about its limit alerts once.")
                       .arg(QString::number(loss, 'f', 1),
                            QString::number(loss * shown.thresholds.hysteresis, 'f', 2))
                 : tr("Hysteresis: an alert ends below %1 % of its limit, so that a figure that hovers about "
                      "its limit alerts once.")
                       .arg(share));
}

AlertChoices ThresholdsDialog::choices() const {
    AlertChoices choices;
    for (const Field& field : m_fields) {
        choices.thresholds.*field.limit = field.box->value() / field.perUnit;
    }
    choices.hasWarningSound = m_warningSound->isChecked();
    choices.hasErrorSound = m_errorSound->isChecked();
    return choices;
}

void ThresholdsDialog::setChoices(const AlertChoices& choices) {
    for (const Field& field : m_fields) {
        field.box->setValue(choices.thresholds.*field.limit * field.perUnit);
    }
    m_warningSound->setChecked(choices.hasWarningSound);
    m_errorSound->setChecked(choices.hasErrorSound);
    explainHysteresis();
}

} // namespace posewire::gui
