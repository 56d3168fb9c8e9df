// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "core/model/session/session_view.h"

#include <QWidget>

#include <optional>
#include <vector>

class QToolButton;

namespace posewire::gui {

/// The choice of the time that figures are of: one for the session, so that all docks show the same.
class SpanBar final : public QWidget {
    Q_OBJECT

public:
    SpanBar(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh();

private:
    struct Button {
        QToolButton* button;
        std::optional<model::RangeChoice> choice; ///< nothing: the range that was dragged
    };

    void add(const QString& text, const QString& toolTip, const std::optional<model::RangeChoice>& choice);

    model::SessionView& m_view;
    Commands& m_commands;
    std::vector<Button> m_buttons;
};

} // namespace posewire::gui
