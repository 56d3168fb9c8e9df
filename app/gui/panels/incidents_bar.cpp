// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/incidents_panel.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"

#include <QActionGroup>
#include <QEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QSignalBlocker>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr std::array kSeverities{model::IncidentSeverity::Error, model::IncidentSeverity::Warning,
                                 model::IncidentSeverity::Info};

std::size_t placeOf(model::IncidentSeverity severity) {
    return static_cast<std::size_t>(severity);
}

} // namespace

IncidentBar::IncidentBar(QWidget* parent) : QWidget(parent) {
    auto* row = spacedRow({8, 6, 8, 6}, 6, this);
    auto* group = new QActionGroup(this);
    m_current = addToggle("currentEvents", tr("Current"), tr("Only what still goes on, or may"));
    m_history = addToggle("eventHistory", tr("History"), tr("All that happened"));
    group->addAction(m_current);
    group->addAction(m_history);
    addSeverities();
    addGroups();
    const auto add = [this](const char* name, const QString& text, const QString& toolTip) {
        return m_commands->addCommand(QLatin1String(name), text, toolTip);
    };
    connect(add("markSeen", tr("Mark seen"),
                tr("Mark all incidents so far as seen: they are dimmed and no longer counted as new")),
            &QAction::triggered, this, &IncidentBar::seenRequested);
    connect(add("exportEvents", tr("Export…"), tr("Save the listed incidents as CSV or JSON")),
            &QAction::triggered, this, &IncidentBar::exportRequested);
    m_text = new QLineEdit(this);
    m_text->setObjectName(QStringLiteral("eventText"));
    m_text->setAccessibleName(tr("Text to filter incidents by"));
    m_text->setPlaceholderText(tr("Filter"));
    m_text->setClearButtonEnabled(true);
    m_text->setMinimumWidth(fontMetrics().averageCharWidth() * 8);
    m_text->setAcceptDrops(false); // a file that is dropped on it is the window's
    m_text->installEventFilter(this);
    connect(m_text, &QLineEdit::textChanged, this, &IncidentBar::change);
    row->addWidget(m_commands);
    row->addWidget(m_text, 1);
    for (QToolButton* button : m_commands->findChildren<QToolButton*>()) {
        button->installEventFilter(this);
    }
    setFilter({});
    new EventWatch(this, QEvent::PaletteChange, [this] { paintSeverities(); });
}

/// In a narrow dock the last ones go into a menu.
QAction* IncidentBar::addToggle(const char* name, const QString& text, const QString& toolTip) {
    QAction* action = m_commands->addCommand(QLatin1String(name), text, toolTip);
    action->setCheckable(true);
    connect(action, &QAction::toggled, this, &IncidentBar::change);
    return action;
}

void IncidentBar::addSeverities() {
    const std::array<std::pair<const char*, QString>, 3> texts{
        {{"notes", tr("Show notes")}, {"warnings", tr("Show warnings")}, {"errors", tr("Show errors")}}};
    for (const model::IncidentSeverity severity : kSeverities) {
        const auto& [name, toolTip] = texts[placeOf(severity)];
        m_severities[placeOf(severity)] = addToggle(name, {}, toolTip);
    }
    showCounts({});
    paintSeverities();
}

void IncidentBar::addGroups() {
    m_groupCommand =
        m_commands->addCommand(QStringLiteral("eventGroups"), {}, tr("Which groups of incidents are listed"));
    m_groups = new QMenu(this);
    for (std::size_t i = 0; i < IncidentModel::Filter().groups.size(); ++i) {
        QAction* action = m_groups->addAction(groupWord(static_cast<model::IncidentGroup>(i)));
        action->setCheckable(true);
        connect(action, &QAction::toggled, this, &IncidentBar::change);
    }
    m_groupCommand->setMenu(m_groups);
    auto* button = qobject_cast<QToolButton*>(m_commands->widgetForAction(m_groupCommand));
    button->setPopupMode(QToolButton::InstantPopup);
    button->setAccessibleName(tr("Groups"));
}

void IncidentBar::setFilter(const IncidentModel::Filter& filter) {
    {
        const QSignalBlocker blocker(this); // each part would announce what is shown so far
        (filter.onlyCurrent ? m_current : m_history)->setChecked(true);
        for (std::size_t i = 0; i < m_severities.size(); ++i) {
            m_severities[i]->setChecked(filter.severities[i]);
        }
        for (std::size_t i = 0; i < filter.groups.size(); ++i) {
            m_groups->actions()[static_cast<qsizetype>(i)]->setChecked(filter.groups[i]);
        }
        m_text->setText(filter.text);
    }
    change();
}

void IncidentBar::change() {
    if (m_text == nullptr) {
        return; // still being made
    }
    IncidentModel::Filter filter;
    filter.onlyCurrent = m_current->isChecked();
    for (std::size_t i = 0; i < m_severities.size(); ++i) {
        filter.severities[i] = m_severities[i]->isChecked();
    }
    for (std::size_t i = 0; i < filter.groups.size(); ++i) {
        filter.groups[i] = m_groups->actions()[static_cast<qsizetype>(i)]->isChecked();
    }
    filter.text = m_text->text().trimmed();
    const auto shown = std::ranges::count(filter.groups, true);
    m_groupCommand->setText(shown == static_cast<std::ptrdiff_t>(filter.groups.size())
                                ? tr("Groups ▾")
                                : tr("Groups %1/%2 ▾").arg(shown).arg(filter.groups.size()));
    m_commands->widgetForAction(m_groupCommand)
        ->setAccessibleName(tr("Groups: %1 of %2").arg(shown).arg(filter.groups.size()));
    emit filterChanged(filter);
}

void IncidentBar::showCounts(const IncidentModel::Counts& counts) {
    for (const model::IncidentSeverity severity : kSeverities) {
        m_severities[placeOf(severity)]->setText(
            healthText(healthOf(severity), grouped(counts.severities[placeOf(severity)])));
    }
}

void IncidentBar::paintSeverities() {
    for (const model::IncidentSeverity severity : kSeverities) {
        const QColor colour =
            severity == model::IncidentSeverity::Info ? theme().dim : healthColour(healthOf(severity));
        const QString sheet =
            QStringLiteral("QToolButton:checked { color: %1; } QToolButton:!checked { color: %2; }")
                .arg(colour.name(), theme().dim.name());
        QWidget* button = m_commands->widgetForAction(m_severities[placeOf(severity)]);
        if (button->styleSheet() != sheet) {
            button->setStyleSheet(sheet);
        }
    }
}

bool IncidentBar::eventFilter(QObject* watched, QEvent* event) {
    const bool isPress = event->type() == QEvent::KeyPress;
    if (!isPress && event->type() != QEvent::ShortcutOverride) {
        return QWidget::eventFilter(watched, event);
    }
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool isEnter = key == Qt::Key_Return || key == Qt::Key_Enter;
    if (auto* button = qobject_cast<QToolButton*>(watched)) {
        if (isPress && isEnter) {
            button->click();
            return true;
        }
    } else if (isPress && key == Qt::Key_Escape && !m_text->text().isEmpty()) {
        m_text->clear();
        return true;
    } else if (isPress && (isEnter || key == Qt::Key_Escape || key == Qt::Key_Down)) {
        emit left();
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace posewire::gui
