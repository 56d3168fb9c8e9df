// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/tree_model.h"
#include "core/model/session/roster.h"
#include "core/model/session/session_view.h"

#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

namespace posewire::gui {

/// A row of a table of senders, characters and streams.
struct StreamRow {
    enum Kind : std::uint8_t { Sender, Character, Stream };
    Kind kind;
    log::StreamKey key; ///< as far as the kind has one
};

[[nodiscard]] model::CharacterKey characterOf(const log::StreamKey& key);

/// The rows of tables that show sender > character > stream, the first two in the order of first appearance,
/// so that rows never jump, streams by their type. What they say is up to the columns.
class StreamTreeModel : public TreeModel<StreamRow> {
public:
    StreamTreeModel(model::SessionView& view, std::vector<TableColumn<StreamRow>> columns)
        : TreeModel(std::move(columns)), m_view(view) {}

    /// Nothing above its own level is filled in for senders.
    [[nodiscard]] std::optional<model::CharacterKey> character(const QModelIndex& index) const;
    [[nodiscard]] std::optional<log::SenderId> sender(const QModelIndex& index) const;
    /// Of the row of a sender: others have taken over all its characters.
    [[nodiscard]] bool isEnded(const QModelIndex& index) const;
    /// Null if the row is not one of a stream.
    [[nodiscard]] const model::Stream* stream(const QModelIndex& index) const;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

protected:
    using Kind = StreamRow::Kind;

    /// Senders and characters that appear under several parents at once arrive over the next calls. Where
    /// senders were retired the model is reset; true then.
    bool insertNew();
    [[nodiscard]] const StreamRow& rowOf(const QModelIndex& index) const;
    [[nodiscard]] const model::Sender& senderOf(const StreamRow& row) const {
        return *m_view.roster().find(row.key.sender);
    }
    [[nodiscard]] const model::Character& characterAt(const StreamRow& row) const {
        return *m_view.roster().find(characterOf(row.key));
    }
    [[nodiscard]] const model::Stream& streamOf(const StreamRow& row) const {
        return *m_view.roster().find(row.key);
    }
    [[nodiscard]] QModelIndex indexOf(const StreamRow& row) const;
    [[nodiscard]] model::SessionView& view() const { return m_view; }
    /// Address of a sender, name of a character, title of a type.
    [[nodiscard]] QString nameOf(const StreamRow& row) const;
    /// Of characters: their colour and, as suffix, their ID; of senders whether they have ended.
    [[nodiscard]] QVariant marksOf(const StreamRow& row, int role) const;

private:
    static constexpr int kNone = -1; ///< of nodes
    using Nodes = std::unordered_map<log::StreamKey, int>;

    [[nodiscard]] std::vector<StreamRow> rowsWithout(Kind kind) const;
    /// Adds the rows without a node that have the same parent as the first of them. False if none has.
    bool insert(Kind kind);
    void insertStreams();
    [[nodiscard]] int placeBelow(int parent, const StreamRow& row) const;
    /// With all that belongs under it.
    void addNode(const StreamRow& row, int parent);
    /// -1 for the top; nothing if the parent has no node yet.
    [[nodiscard]] std::optional<int> parentOf(const StreamRow& row) const;
    [[nodiscard]] bool isThere(const StreamRow& row) const;

    model::SessionView& m_view;
    std::vector<StreamRow> m_rows; ///< by node
    std::array<Nodes, 3> m_nodes;  ///< by kind and key
    std::uint64_t m_retired = 0;   ///< senders whose rows are gone
};

} // namespace posewire::gui
