// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/program_view.h"
#include "app/gui/theme/widgets.h"
#include "core/model/session/session_view.h"

#include <QWidget>

#include <vector>

class QHBoxLayout;

namespace posewire::gui {

class ColourText;

/// "Lost 12 of 2 400 samples in the last 10 s."
[[nodiscard]] QString lossText(model::SessionView& session, const model::CharacterKey& key);

/// The bottom line: each character in a word, what this computer receives, keeps and drops.
class HealthBar final : public QWidget {
    Q_OBJECT

public:
    HealthBar(model::SessionView& session, Commands& commands, QWidget* parent = nullptr);

    void refresh(const ReceivingState& receiving);

    /// What the keyboard goes to here; null without characters.
    [[nodiscard]] QWidget* firstEntry() const;

    /// Shows a line for a while, beside the rest.
    void say(const QString& text) { m_message->say(text); }

private:
    /// Opens a popup that says why a character is as it is; `entry` counts those that are shown.
    void explain(std::size_t entry);
    void refreshCharacters();
    void fitEntries();
    void addEntry();

    model::SessionView& m_session;
    Commands& m_commands;
    QHBoxLayout* m_entriesLayout;
    QWidget* m_entriesArea;
    std::vector<ColourText*> m_entries;       ///< as many as there ever were characters to show
    std::vector<model::CharacterKey> m_shown; ///< whom the first of them show, in the session's order
    ColourText* m_more;                       ///< how many there is no room for
    PassingMessage* m_message;
    ColourText* m_rate;
    ColourText* m_history;
    ColourText* m_dropped;
};

} // namespace posewire::gui
