// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/alerts.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/words.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QPushButton>
#include <QSystemTrayIcon>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

bool isWanted(const model::Incident& event, const AlertChoices& choices) {
    return (choices.hasErrorSound && event.severity() == model::IncidentSeverity::Error) ||
           (choices.hasWarningSound && event.severity() == model::IncidentSeverity::Warning);
}

} // namespace

bool AlertSounds::isDue(const model::Incidents& incidents, const AlertChoices& choices) {
    if (!m_isFirst && m_version == incidents.version()) {
        return false;
    }
    std::map<std::uint64_t, model::IncidentSeverity> seen;
    bool isDue = false;
    for (const model::Incident& incident : incidents.all()) {
        const model::IncidentSeverity severity = incident.severity();
        const auto before = m_seen.find(incident.number);
        const bool isWorse = before == m_seen.end() || severity > before->second;
        isDue = isDue || (isWorse && isWanted(incident, choices));
        seen.emplace_hint(seen.end(), incident.number,
                          before == m_seen.end() ? severity : std::max(severity, before->second));
    }
    m_seen = std::move(seen);
    m_version = incidents.version();
    return !std::exchange(m_isFirst, false) && isDue;
}

bool BadTurns::isDue(const model::TakeVerdict& verdict) {
    constexpr std::size_t kMost = 1'000;
    if (verdict.state != model::TakeVerdict::State::Bad) {
        return false;
    }
    if (m_told.size() > kMost) {
        m_told.erase(m_told.begin());
    }
    return m_told.insert(verdict.incident.value_or(0)).second;
}

QString notificationText(const QString& text) {
    QString plain = text;
    return plain.replace(u'<', u'‹').replace(u'>', u'›').replace(u'&', u'＆');
}

void VerdictNotifier::look(const model::TakeVerdict& verdict, bool isWanted) {
    if (!m_turns.isDue(verdict) || !isWanted) {
        return;
    }
    if (m_tray == nullptr) {
        m_tray = new QSystemTrayIcon(m_window->windowIcon(), m_window);
        m_tray->show();
        const auto comeForward = [this] {
            m_window->show();
            m_window->raise();
            m_window->activateWindow();
        };
        QObject::connect(m_tray, &QSystemTrayIcon::activated, m_window, comeForward);
        QObject::connect(m_tray, &QSystemTrayIcon::messageClicked, m_window, comeForward);
    }
    QApplication::alert(m_window); // where the desktop has no place for notifications
    m_tray->showMessage(m_window->windowTitle(), notificationText(said(verdict.said, words::Form::Headline)),
                        QSystemTrayIcon::Warning);
}

ThresholdsDialog::ThresholdsDialog(const AlertChoices& choices, QWidget* parent) : QDialog(parent) {
    setWindowTitle(tr("Thresholds"));
    auto* form = new QFormLayout;
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        auto* box = new QDoubleSpinBox(this);
        box->setDecimals(row.shownPerUnit == 1 ? 1 : 0);
        box->setRange(row.least * row.shownPerUnit, row.most * row.shownPerUnit);
        box->setSuffix(translatedText(row.unit));
        box->setSpecialValueText(row.least == 0 ? tr("never an alert") : QString()); // at the least
        box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
        box->setToolTip(toolTipText(translatedText(row.help)));
        form->addRow(translatedText(row.label), box);
        m_fields.push_back({&row, box});
        connect(box, &QDoubleSpinBox::valueChanged, this, &ThresholdsDialog::explainHysteresis);
    }
    auto* sounds = new QVBoxLayout;
    sounds->addWidget(m_warningSound);
    sounds->addWidget(m_errorSound);
    form->addRow(tr("Sound"), sounds);
    form->addRow(tr("Notification"), m_notification);
    auto* buttons = new QDialogButtonBox(
        QDialogButtonBox::Ok | QDialogButtonBox::Cancel | QDialogButtonBox::RestoreDefaults, this);
    connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, this,
            [this] { setChoices({}); });
    layOut(*this,
           {dimText(tr("A stream that exceeds one of these raises one incident per episode, which also "
                       "shows in the health of its character. Changes apply from now on."),
                    this),
            form, m_explanation},
           *buttons, placeOf(HelpTopic::Thresholds), 62);
    setChoices(choices);
    const int width = std::max(minimumWidth(), layout()->minimumSize().width());
    setMinimumSize(width,
                   layout()->totalHeightForWidth(width)); // a dialog does not ask for lines of wrapped text
}

void ThresholdsDialog::explainHysteresis() {
    const AlertChoices shown = choices();
    const double loss = shown.thresholds.lossPercent;
    const QString share = QString::number(shown.thresholds.hysteresis * 100, 'f', 0);
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
        choices.thresholds.*field.row->limit = field.box->value() / field.row->shownPerUnit;
    }
    choices.hasWarningSound = m_warningSound->isChecked();
    choices.hasErrorSound = m_errorSound->isChecked();
    choices.hasNotification = m_notification->isChecked();
    return choices;
}

void ThresholdsDialog::setChoices(const AlertChoices& choices) {
    for (const Field& field : m_fields) {
        field.box->setValue(choices.thresholds.*field.row->limit * field.row->shownPerUnit);
    }
    m_warningSound->setChecked(choices.hasWarningSound);
    m_errorSound->setChecked(choices.hasErrorSound);
    m_notification->setChecked(choices.hasNotification);
    explainHysteresis();
}

} // namespace posewire::gui
