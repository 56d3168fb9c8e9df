// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/choices.h"

#include <QWidget>

class QAction;
class QHBoxLayout;
class QMenu;
class QToolButton;

namespace posewire::gui {

/// What moves through the past: a sample back and on, play either way, its speed, again and again.
class TimeControls final : public QWidget {
    Q_OBJECT

public:
    struct Actions {
        QAction* back;
        QAction* on;
        QAction* playBack;
        QAction* play;
        QAction* loop;
        QMenu* speeds; ///< of which one is checked
    };
    explicit TimeControls(const Actions& actions, QWidget* parent = nullptr);

    void refresh(const model::Cursor& cursor);

private:
    QToolButton* add(QAction* action, const char* icon);
    void restyle();

    const Actions m_actions;
    QHBoxLayout* m_row;
    QToolButton* m_playBack;
    QToolButton* m_play;
    QToolButton* m_speed;
    double m_shownSpeed = 0;
};

} // namespace posewire::gui
