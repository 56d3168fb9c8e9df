// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/settings.h"
#include "core/model/session/verdict.h"

#include <QString>

#include <functional>
#include <map>
#include <set>

class QFormLayout;
class QSystemTrayIcon;
class QWidget;

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

/// Decides when the desktop is to be told that the verdict has turned bad: once for each incident.
class BadTurns {
public:
    [[nodiscard]] bool isDue(const model::TakeVerdict& verdict);

private:
    std::set<std::uint64_t> m_told;
};

/// A text for the desktop's notifications, which may take markup: nothing in it is.
[[nodiscard]] QString notificationText(const QString& text);

/// Has the desktop tell that the verdict has turned bad, from a tray icon that comes with the first time.
class VerdictNotifier final {
public:
    /// A click on what is told brings the window forward, which outlives this.
    explicit VerdictNotifier(QWidget* window) : m_window(window) {}

    /// For each new verdict. What turned bad while it was not wanted is not told later.
    void look(const model::TakeVerdict& verdict, bool isWanted);

private:
    QWidget* m_window;
    QSystemTrayIcon* m_tray = nullptr;
    BadTurns m_turns;
};

/// Adds fields for the limits that streams must keep and for what announces that one was exceeded. They write
/// into `choices`, which outlives them, and call `changed`.
void addThresholdRows(QFormLayout& rows, AlertChoices& choices, const std::function<void()>& changed);

} // namespace posewire::gui
