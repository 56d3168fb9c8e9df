// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/base/program_state.h"
#include "app/gui/driver/takes.h"
#include "app/gui/theme/widgets.h"
#include "core/model/session/session_view.h"

#include <QHBoxLayout>
#include <QWidget>

#include <vector>

class QAction;
class QMenu;

namespace posewire::gui {

class ColourText;
class TimeControls;

/// The line above the viewport: time stopped or running, which moment is shown, where the data come from.
class TransportBar final : public QWidget {
    Q_OBJECT

public:
    /// `record` begins and ends a take, `pause` stops and plays, `live` goes to the end, `inputs` is for
    /// the list of inputs; the others move through the past.
    struct Actions {
        QAction* record;
        QAction* pause;
        QAction* live;
        QAction* inputs;
        QAction* back;
        QAction* on;
        QAction* playBack;
        QAction* loop;
        QMenu* speeds; ///< one of them is checked
    };
    TransportBar(model::SessionView& session, const Actions& actions, QWidget* parent = nullptr);

    /// Shows another session from now on. One that is not live is all past.
    void showSession(model::SessionView& session, bool isLive);

    void refresh();
    void showTake(const std::optional<TakeState>& take);
    void setReceiving(const ReceivingState& receiving);

signals:
    /// More is wanted about an input.
    void inputRequested(const InputAddress& input);

private:
    /// Waiting: it would follow, but nothing arrives. Idle: and nothing can, for there is no input.
    enum class Mode { Live, Waiting, Idle, Paused, Playing };

    [[nodiscard]] Mode modeNow() const;
    void restyle();
    [[nodiscard]] QString fitting(const QString& text) const;
    void showMode(Mode mode);
    void followMode();
    [[nodiscard]] const model::CharacterPose* timedPose();
    void showDetail(const QString& text);

    model::SessionView* m_session;
    const Actions m_actions;
    QToolButton* m_record;
    QToolButton* m_pause;
    QToolButton* m_live;
    TimeControls* m_past;
    QToolButton* m_add;
    QLabel* m_time = plainLabel(this);
    ElidedLabel* m_detail = new ElidedLabel(Qt::AlignLeft | Qt::AlignVCenter, this);
    QHBoxLayout* m_pillLayout = new QHBoxLayout;
    std::vector<ColourText*> m_pills; ///< of the inputs; a click tells more
    std::vector<InputAddress> m_inputs;
    bool m_hasInputs = false; ///< or probes
    Mode m_mode = Mode::Waiting;
    bool m_isWide = true;
};

} // namespace posewire::gui
