// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/models/nominal_rate.h"
#include "app/gui/models/stream_tree_model.h"

#include <optional>
#include <vector>

namespace posewire::gui {

/// Characters with their streams: rates, and what is wrong with them.
class CharacterModel : public StreamTreeModel {
    Q_OBJECT

public:
    enum Column : int { kName, kRate, kState, kColumnCount };

    CharacterModel(model::SessionView& view, Commands& commands, QObject* parent = nullptr);

    void refresh();

    /// Rate of a stream by the sender's own clock, where it can be told.
    [[nodiscard]] std::optional<double> nominalHz(const model::Stream& stream) const;

    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    void readRates();

    [[nodiscard]] QString senderWords(const model::Sender& sender) const;
    [[nodiscard]] QVariant senderData(const model::Sender& sender, int column, int role) const;
    [[nodiscard]] QVariant characterData(const model::Character& character, int column, int role) const;
    [[nodiscard]] QVariant characterName(const model::Character& character, int role) const;
    [[nodiscard]] QVariant streamData(const model::Stream& stream, int column, int role) const;

    model::SessionView& m_view;
    Commands& m_commands;
    struct CharacterRate {
        NominalRate rate;
        std::uint64_t packet = 0; ///< the newest that was taken in
    };
    std::vector<CharacterRate> m_rates; ///< by place of the character
};

} // namespace posewire::gui
