// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/incident_model.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <QPushButton>

#include <array>
#include <optional>

class QLineEdit;
class QMenu;

namespace posewire::gui {

class IncidentBar final : public QWidget {
    Q_OBJECT

public:
    explicit IncidentBar(QWidget* parent = nullptr);

    void setFilter(const IncidentModel::Filter& filter);
    void showCounts(const IncidentModel::Counts& counts);

signals:
    void filterChanged(const IncidentModel::Filter& filter);
    void seenRequested();
    void exportRequested();
    void left();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QAction* addToggle(const char* name, const QString& text, const QString& toolTip);
    void addSeverities();
    void addGroups();
    void change();
    void paintSeverities();

    CommandBar* m_commands = new CommandBar(this);
    QAction* m_current = nullptr;
    QAction* m_history = nullptr;
    std::array<QAction*, 3> m_severities{}; ///< by IncidentSeverity
    QLineEdit* m_text = nullptr;
    QAction* m_groupCommand = nullptr;
    QMenu* m_groups = nullptr;
};

/// Dock `events`: the incidents, what happened and what still lasts, whose fault it was, each with the
/// streams that it touched, and the way to the packets that show it.
class IncidentsPanel : public Panel {
    Q_OBJECT

public:
    IncidentsPanel(model::SessionView& view, Commands& commands, QWidget* parent);
    ~IncidentsPanel() override;

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

    /// Shows the packets of an incident, or of what it was to one stream, in the dock of packets.
    void jump(const QModelIndex& index, PacketLook look = PacketLook::InContext);
    void showOnlyCurrent();
    /// Opens the guide where it explains the selected incident.
    void explain();
    /// Saves the listed incidents in the format of the name's suffix. Returns what went wrong, empty for
    /// nothing.
    [[nodiscard]] QString save(const QString& path);
    [[nodiscard]] bool isFollowing() const { return m_isFollowing; }
    [[nodiscard]] QString message() const { return m_message->said(); }

    [[nodiscard]] const IncidentModel::Filter& filter() const { return m_incidents.filter(); }
    void setFilter(const IncidentModel::Filter& filter) { m_bar->setFilter(filter); }
    void exportFile();
    void markSeen() { m_incidents.markSeen(); }
    void newest();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void connectParts();
    void addActions(QMenu& menu, const QModelIndex& index);
    void applyFilter(const IncidentModel::Filter& filter);
    void setFollowing(bool isFollowing);
    void placeChip();
    void showAskedFor();
    void keepCurrent();
    void showEmptyState();

    IncidentModel m_incidents{m_view};
    IncidentBar* m_bar = new IncidentBar(this);
    TableView* m_table = new TableView(tr("Incidents"), this);
    QPushButton* m_chip = new QPushButton(m_table);
    PassingMessage* m_message = footMessage(this);
    std::uint64_t m_requests = 0;           ///< that were carried out
    std::optional<std::uint64_t> m_current; ///< of the current row, kept while rows come and go
    int m_missed = 0;                       ///< came since following ended
    bool m_isFollowing = true;
    bool m_isRefreshing = false;
};

} // namespace posewire::gui
