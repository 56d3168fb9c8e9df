// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/base/program_state.h"
#include "app/gui/theme/widgets.h"
#include "core/model/session/session_view.h"

#include <QHBoxLayout>
#include <QPointer>
#include <QWidget>

#include <vector>

namespace posewire::gui {

class ColourText;
class HealthList;

/// The bottom line: how each character does in a few words, the worst first; what this computer receives,
/// keeps and drops.
class HealthBar final : public QWidget {
    Q_OBJECT

public:
    HealthBar(model::SessionView& session, Commands& commands, QWidget* parent = nullptr);

    /// Shows another session from now on.
    void showSession(model::SessionView& session);
    void refresh(const ReceivingState& receiving);

    /// Null without characters.
    [[nodiscard]] QWidget* firstEntry() const;

    /// Shows a line for a while, beside the rest; with the place in the guide that tells more, where there is
    /// one.
    void say(const QString& text, const QString& helpPlace = {});
    [[nodiscard]] QString said() const { return m_message->said(); }

signals:
    void waysOutRequested();

private:
    void showWaysOut(const std::vector<WayOutState>& ways);
    /// Selects a character, and says in a popup why it is as it is.
    void explain(const model::CharacterKey& key, QWidget& anchor);
    [[nodiscard]] static QString byteRateText(double bytesPerSecond);
    void showList();
    void refreshCharacters();
    void fitEntries();
    void measure(const QFontMetrics& metrics);
    /// Pixels; the name has at least its own.
    void showEntry(std::size_t index, int nameWidth, int width);

    model::SessionView* m_session;
    Commands& m_commands;
    QHBoxLayout* m_entriesLayout = new QHBoxLayout;
    QWidget* m_entriesArea = new QWidget(this);
    std::vector<ColourText*> m_entries;       ///< as many as there ever were characters to show
    int m_nameWidth = 0;                      ///< pixels, of what was said so far
    int m_stateWidth = 0;                     ///< likewise
    std::vector<model::CharacterKey> m_shown; ///< all, the worst first; the first entries show them
    ColourText* m_more;                       ///< how many there is no room for
    QPointer<HealthList> m_list;              ///< while it is open
    QPointer<QWidget> m_popup;                ///< likewise, of one character
    PassingMessage* m_message;
    QToolButton* m_about; ///< opens m_helpPlace, while the message is there
    QString m_helpPlace;
    QLabel* m_when = dimLabel(tr("Now"), this); ///< the time that characters are judged by
    ColourText* m_waysOut;                      ///< only while something is handed on, or should be
    QLabel* m_live =
        dimLabel(tr("Now"), this); ///< while a recording is shown: the figures behind it are not its
    QLabel* m_rate = plainLabel(this);
    QLabel* m_history = plainLabel(this);
    QLabel* m_dropped = plainLabel(this);
};

} // namespace posewire::gui
