// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/event_model.h"

#include <QWidget>

#include <array>

class QAction;
class QLineEdit;
class QMenu;
class QToolButton;

namespace posewire::gui {

class CommandBar;

/// What the events dock lists: now or all that happened, which severities and groups, and a text.
class EventBar final : public QWidget {
    Q_OBJECT

public:
    explicit EventBar(QWidget* parent = nullptr);

    [[nodiscard]] const EventModel::Filter& filter() const { return m_filter; }
    void setFilter(const EventModel::Filter& filter);
    void showCounts(const EventModel::Counts& counts);

signals:
    void filterChanged(const EventModel::Filter& filter);
    void seenRequested();
    void exportRequested();
    /// The keyboard is wanted in the list.
    void left();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    QToolButton* addButton(const QString& name, const QString& text, const QString& toolTip);
    void addViews();
    void addSeverities();
    void addText();
    void addCommands();
    void addGroups(CommandBar& commands);
    void showFilter();
    void change();
    void paintSeverities();

    EventModel::Filter m_filter;
    QToolButton* m_current = nullptr;
    QToolButton* m_history = nullptr;
    std::array<QToolButton*, 3> m_severities{}; ///< by EventSeverity
    QLineEdit* m_text = nullptr;
    QAction* m_groupCommand = nullptr;
    QMenu* m_groups = nullptr;
};

} // namespace posewire::gui
