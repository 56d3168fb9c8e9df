// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/event_model.h"
#include "app/gui/panel.h"
#include "app/gui/theme/widgets.h"

#include <array>
#include <optional>

class QLineEdit;
class QMenu;
class QPushButton;

namespace posewire::gui {

class TableView;

/// What the events dock lists: now or all that happened, which severities and groups, and a text.
class EventBar final : public QWidget {
    Q_OBJECT

public:
    explicit EventBar(QWidget* parent = nullptr);

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
    void addSeverities();
    void addCommands();
    void addGroups(CommandBar& commands);
    void change();
    void paintSeverities();

    QToolButton* m_current = nullptr;
    QToolButton* m_history = nullptr;
    std::array<QToolButton*, 3> m_severities{}; ///< by IncidentSeverity
    QLineEdit* m_text = nullptr;
    QAction* m_groupCommand = nullptr;
    QMenu* m_groups = nullptr;
};

/// Dock `events`: what happened and what still lasts, who caused it, and the way to the packets that
/// show it.
class EventsPanel : public Panel {
    Q_OBJECT

public:
    EventsPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

    /// Selects the packet of an event and shows it in the dock of packets, among its like.
    void jump(const QModelIndex& index);
    /// Saves the listed events in the format of the name's suffix. Returns what went wrong, empty for
    /// nothing.
    [[nodiscard]] QString save(const QString& path);
    [[nodiscard]] bool isFollowing() const { return m_isFollowing; }
    /// What was said last below the list.
    [[nodiscard]] QString message() const { return m_message->said(); }

    void exportFile();
    void markSeen() { m_events.markSeen(); }
    void newest();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void connectParts();
    void addActions(QMenu& menu, const QModelIndex& index);
    void applyFilter(const EventModel::Filter& filter);
    void setFollowing(bool isFollowing);
    void placeChip();
    void showAskedFor();
    void keepCurrent();
    void showEmptyState();

    EventModel m_events;
    EventBar* m_bar;
    TableView* m_table;
    QPushButton* m_chip;
    PassingMessage* m_message;
    std::optional<std::uint64_t> m_askedFor;     ///< of what was selected when it was last looked at
    std::optional<std::uint64_t> m_currentEvent; ///< of the current row, kept while rows come and go
    int m_missed = 0;                            ///< came since following ended
    bool m_isFollowing = true;
    bool m_isRefreshing = false;
};

} // namespace posewire::gui
