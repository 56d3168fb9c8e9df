// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/characters_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "app/gui/theme/widgets.h"

#include <QItemSelectionModel>

#include <algorithm>

namespace posewire::gui {

CharactersPanel::CharactersPanel(model::SessionView& view, Commands& commands, const ProgramView& program,
                                 QWidget* parent)
    : Panel(view, commands, parent),
      m_program(program),
      m_model(view, commands),
      m_table(new TableView(tr("Characters"), commands, this)) {
    tightColumn(this)->addWidget(m_table);
    m_table->setModel(&m_model);
    m_table->setRootIsDecorated(true);
    m_table->setColumnSamples({QString(), QStringLiteral("240/239.9"), QStringLiteral("▲ silent 0.9 s")},
                              QStringLiteral("    02 Pose, qu"));
    showEmptyState();
    m_table->expandNew();
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            &CharactersPanel::select);
    connect(m_table, &QAbstractItemView::doubleClicked, this, &CharactersPanel::frame);
}

void CharactersPanel::showEmptyState() {
    const std::vector<PortState> ports = m_program.receivingState().ports;
    const auto open =
        std::ranges::find_if(ports, [](const PortState& state) { return state.id.has_value(); });
    const auto port = open == ports.end() ? kDefaultPort : open->status.endpoint.port;
    m_table->setEmptyText(
        tr("No character on the air.\nIn MVN: Options > Preferences > Network Streamer, add "
           "this computer with port %1 and tick the stream.")
            .arg(port));
}

void CharactersPanel::refresh() {
    if (m_view.characters().empty()) {
        showEmptyState();
    }
    m_isFollowing = true;
    m_model.refresh();
    followSelection();
    m_isFollowing = false;
}

QString CharactersPanel::summary() const {
    const auto characters = m_view.currentCharacters();
    if (characters.empty()) {
        return {};
    }
    const auto live = std::ranges::count_if(
        characters, [this](const model::Character* character) { return isLive(m_view, *character); });
    return tr("%1 of %2 live").arg(live).arg(characters.size());
}

void CharactersPanel::followSelection() {
    const model::Selection& selection = m_view.selection();
    if (selection == m_followed) {
        return;
    }
    m_followed = selection;
    const QModelIndex current = m_table->currentIndex();
    const bool isAlreadyThere = selection.character ? m_model.character(current) == selection.character
                                                    : m_model.sender(current) == selection.sender;
    if (isAlreadyThere) {
        return;
    }
    const QModelIndex wanted = selection.character ? m_model.indexOf(*selection.character) : QModelIndex();
    m_table->setCurrentIndex(wanted);
    if (!wanted.isValid()) {
        m_table->clearSelection();
    }
}

void CharactersPanel::select(const QModelIndex& index) {
    if (m_isFollowing || !index.isValid()) {
        return;
    }
    const auto key = m_model.character(index);
    model::Selection selection = key ? selectionOf(m_view, *key) : model::Selection{};
    selection.sender = m_model.sender(index);
    m_commands.select(selection);
}

void CharactersPanel::frame(const QModelIndex& index) {
    if (const auto key = m_model.character(index)) {
        m_commands.frameCharacter(*key);
    }
}

} // namespace posewire::gui
