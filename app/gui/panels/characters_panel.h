// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/character_model.h"
#include "app/gui/panel.h"
#include "app/gui/panels/table_view.h"

namespace posewire::gui {

/// Dock `characters`: who is on the air, how fast and how well. Selects for all docks.
class CharactersPanel : public Panel {
    Q_OBJECT

public:
    CharactersPanel(model::SessionView& view, Commands& commands, const ProgramView& program,
                    QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;

private:
    void showEmptyState();
    void followSelection();
    void select(const QModelIndex& index);
    void frame(const QModelIndex& index);

    const ProgramView& m_program;
    CharacterModel m_model;
    TableView* m_table;
    model::Selection m_followed; ///< the selection that the table shows
    bool m_isFollowing = false;
};

} // namespace posewire::gui
