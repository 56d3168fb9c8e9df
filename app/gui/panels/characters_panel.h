// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/base/program_state.h"
#include "app/gui/models/character_model.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <QWidget>

namespace posewire::gui {

class BoardDelegate;
class ElidedLabel;
class EndedSenders;
class PassingMessage;

/// Dock `characters`: a board of all performers, a line each, with what each is in detail and which senders
/// have ended below. Selects for all docks.
class CharactersPanel : public Panel {
    Q_OBJECT

public:
    CharactersPanel(model::SessionView& view, Commands& commands, const ReceivingState& receiving,
                    QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

    void setTroubleFirst(bool isFirst);
    [[nodiscard]] bool isTroubleFirst() const { return m_model.order() == BoardOrder::TroubleFirst; }
    void toggleTroubleFirst() { setTroubleFirst(!isTroubleFirst()); }
    void setDetailShown(bool isShown);
    [[nodiscard]] bool isDetailShown() const { return m_detailToggle->isChecked(); }
    void toggleDetail() { setDetailShown(!isDetailShown()); }

    // Says so if no character is selected.
    void frameSelected();
    /// Hides all others; shows all again where that is so already, or none is selected and some are hidden.
    void soloSelected();
    void toggleSelected();
    void showPacketsOfSelected();
    void showIncidentsOfSelected();

    [[nodiscard]] EndedSenders& ended() const { return *m_ended; }

private:
    void addActions(QMenu& menu, const QModelIndex& index);
    void showEmptyState();
    void showDetail();
    void fitRows();
    void followSelection();
    void select(const QModelIndex& index);
    [[nodiscard]] std::optional<model::CharacterKey> selected() const;
    [[nodiscard]] std::optional<model::CharacterKey> selectedOrSay() const;
    [[nodiscard]] bool isSolo(const model::CharacterKey& key) const;

    const ReceivingState& m_receiving;
    CharacterModel m_model{m_view, m_commands};
    CharacterDetailModel m_detailModel{m_view};
    QToolButton* m_troubleFirst;
    QToolButton* m_detailToggle;
    ElidedLabel* m_span; ///< the time that losses are of
    TableView* m_table = new TableView(tr("Characters"), this);
    BoardDelegate* m_rows;
    QWidget* m_detail = new QWidget(this);
    QLabel* m_history = dimText({}, m_detail);
    TableView* m_streams = new TableView(tr("Streams of the selected character"), m_detail);
    EndedSenders* m_ended;
    PassingMessage* m_message = footMessage(this);
    model::Selection m_followed; ///< the selection that the table shows
    bool m_isFollowing = false;
};

} // namespace posewire::gui
