// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/models/clock_history.h"
#include "app/gui/models/stream_tree_model.h"

#include <optional>
#include <vector>

namespace posewire::gui {

/// Characters with their streams: rates, and what is wrong with them.
class CharacterModel : public StreamTreeModel {
public:
    enum Column : int { kName, kRate, kState };

    CharacterModel(model::SessionView& view, Commands& commands, QObject* parent = nullptr);

    void refresh();

    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;

private:
    /// Rate of a stream by the sender's own clock, where that is known.
    [[nodiscard]] std::optional<double> nominalHz(const model::Stream& stream) const;

    /// Read the model only where a cell is asked for.
    [[nodiscard]] static std::vector<TableColumn<StreamRow>> columns(const CharacterModel& model);
    [[nodiscard]] QString rateOf(const StreamRow& row) const;
    [[nodiscard]] QString rateHelp(const StreamRow& row) const;
    [[nodiscard]] PropertyValue stateOf(const StreamRow& row) const;

    Commands& m_commands;
    std::unordered_map<model::CharacterKey, NominalRate> m_rates;
};

} // namespace posewire::gui
