// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/event_model.h"
#include "app/gui/panel.h"
#include "app/gui/theme/passing_message.h"

#include <optional>

class QMenu;
class QPushButton;

namespace posewire::gui {

class EventBar;
class TableView;

/// Dock `events`: what happened and what is still going on, who caused it, and the way to the packets that
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
    /// Saves the listed events in the format that the name's suffix says. The answer is what went wrong,
    /// empty for nothing.
    [[nodiscard]] QString save(const QString& path);
    [[nodiscard]] bool isFollowing() const { return m_isFollowing; }
    /// What was said last below the list.
    [[nodiscard]] QString message() const { return m_message->said(); }

    void exportFile();
    void markSeen();
    void newest();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void layOut();
    void connectParts();
    void addActions(QMenu& menu, const QModelIndex& index);
    void applyFilter(const EventModel::Filter& filter);
    void setFollowing(bool isFollowing);
    void placeChip();
    void keepCurrent();
    void showEmptyState();

    model::SessionView& m_view;
    Commands& m_commands;
    EventModel m_events;
    EventBar* m_bar;
    TableView* m_table;
    QPushButton* m_chip;
    PassingMessage* m_message;
    std::optional<std::uint64_t> m_currentEvent; ///< of the current row, kept while rows come and go
    int m_missed = 0;                            ///< came since following ended
    bool m_isFollowing = true;
    bool m_isRefreshing = false;
};

} // namespace posewire::gui
