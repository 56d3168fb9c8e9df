// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/alerts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QApplication>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QPushButton>
#include <QSystemTrayIcon>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

bool isWanted(const model::Incident& event, const AlertChoices& choices) {
    return (choices.hasErrorSound && event.severity() == model::IncidentSeverity::Error) ||
           (choices.hasWarningSound && event.severity() == model::IncidentSeverity::Warning);
}

QString hysteresisText(const model::Thresholds& thresholds) {
    const double loss = thresholds.lossPercent;
    return loss > 0
               ? tr("Hysteresis: a loss alert begins above %1 % and ends below %2 %, so that a figure that "
                    "hovers about its limit alerts once.")
                     .arg(QString::number(loss, 'f', 1),
                          QString::number(loss * thresholds.hysteresis, 'f', 2))
               : tr("Hysteresis: an alert ends below %1 % of its limit, so that a figure that hovers about "
                    "its limit alerts once.")
                     .arg(QString::number(thresholds.hysteresis * 100, 'f', 0));
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

void addThresholdRows(QFormLayout& rows, AlertChoices& choices, const std::function<void()>& changed) {
    QWidget* form = rows.parentWidget();
    rows.addRow(dimText(tr("A stream that exceeds one of these raises one incident per episode, which also "
                           "shows in the health of its character. Changes apply from now on."),
                        form));
    auto* explanation = dimText(hysteresisText(choices.thresholds), form);
    auto* defaults = new QPushButton(tr("Re&store as shipped"));
    defaults->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        auto* box = new QDoubleSpinBox(form);
        box->setKeyboardTracking(false); // a number counts once it is complete
        box->setDecimals(row.shownPerUnit == 1 ? 1 : 0);
        box->setRange(row.least * row.shownPerUnit, row.most * row.shownPerUnit);
        box->setSuffix(translatedText(row.unit));
        box->setSpecialValueText(row.least == 0 ? tr("never an alert") : QString()); // at the least
        box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
        box->setToolTip(toolTipText(translatedText(row.help)));
        box->setValue(choices.thresholds.*row.limit * row.shownPerUnit);
        rows.addRow(translatedText(row.label), box);
        QObject::connect(box, &QDoubleSpinBox::valueChanged, form, [=, &row, &choices](double value) {
            choices.thresholds.*row.limit = value / row.shownPerUnit;
            explanation->setText(hysteresisText(choices.thresholds));
            changed();
        });
        QObject::connect(defaults, &QPushButton::clicked, box,
                         [box, &row] { box->setValue(model::Thresholds().*row.limit * row.shownPerUnit); });
    }
    rows.addRow({}, explanation);
    auto* sounds = new QWidget(form);
    tightColumn(sounds)->setSpacing(form->fontMetrics().height() / 2);
    const auto boxFor = [&](bool AlertChoices::*choice, const QString& text) {
        auto* box = new QCheckBox(text, form);
        box->setChecked(choices.*choice);
        QObject::connect(box, &QCheckBox::toggled, form, [=, &choices](bool isOn) {
            choices.*choice = isOn;
            changed();
        });
        QObject::connect(defaults, &QPushButton::clicked, box,
                         [=] { box->setChecked(AlertChoices().*choice); });
        return box;
    };
    sounds->layout()->addWidget(boxFor(&AlertChoices::hasWarningSound, tr("at a &warning")));
    sounds->layout()->addWidget(boxFor(&AlertChoices::hasErrorSound, tr("at an &error")));
    rows.addRow(tr("Sound"), sounds);
    rows.addRow(tr("Notification"),
                boxFor(&AlertChoices::hasNotification, tr("by t&he desktop, when the verdict turns bad")));
    rows.addRow({}, defaults);
}

} // namespace posewire::gui
