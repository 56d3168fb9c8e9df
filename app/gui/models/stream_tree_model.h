// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "core/model/session/session_view.h"

#include <optional>
#include <vector>

namespace posewire::gui {

/// A row of a table of senders, characters and streams.
struct StreamRow {
    enum class Kind : std::uint8_t { Sender, Character, Stream };
    Kind kind;
    std::size_t entry; ///< in the session's list of its kind
    int parent;        ///< node, -1 for senders
    int row;
    std::vector<int> children;
};

/// The rows of tables that show sender > character > stream, each in the order of first appearance, so that
/// rows never jump. What they say is up to the columns.
class StreamTreeModel : public ColumnModel<StreamRow, QAbstractItemModel> {
public:
    StreamTreeModel(model::SessionView& view, std::vector<TableColumn<StreamRow>> columns,
                    QObject* parent = nullptr);

    /// What a row is about; nothing above its own level is filled in for senders.
    [[nodiscard]] std::optional<model::CharacterKey> character(const QModelIndex& index) const;
    [[nodiscard]] std::optional<log::SenderId> sender(const QModelIndex& index) const;
    /// Null where the row is not one of a stream.
    [[nodiscard]] const model::Stream* stream(const QModelIndex& index) const;
    /// The row of a character, or an invalid index.
    [[nodiscard]] QModelIndex indexOf(const model::CharacterKey& key) const;

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

protected:
    using Kind = StreamRow::Kind;
    using Node = StreamRow;

    /// Announces at most one insertion: what appears under several parents at once arrives over the next
    /// calls.
    void insertNew();
    /// Announces that anything may have changed, once, for the senders; views repaint what is under them too.
    void announceChange() { ColumnModel::announceChange(0, rowCount() - 1); }
    [[nodiscard]] const Node& nodeOf(const QModelIndex& index) const;
    [[nodiscard]] model::SessionView& view() const { return m_view; }

private:
    bool insertSenders();
    bool insertCharacters();
    bool insertStreams();
    /// Adds the entries without a node that have the same parent as the first of them.
    bool insertChildren(const std::vector<int>& nodes, int (StreamTreeModel::*parentOf)(std::size_t) const,
                        void (StreamTreeModel::*add)(std::size_t, int));
    int addNode(Kind kind, std::size_t entry, int parent);
    void addSender(std::size_t entry);
    void addCharacter(std::size_t entry, int parent);
    void addStream(std::size_t entry, int parent);
    [[nodiscard]] QModelIndex indexOfNode(int node) const;
    [[nodiscard]] int parentOfCharacter(std::size_t entry) const;
    [[nodiscard]] int parentOfStream(std::size_t entry) const;

    model::SessionView& m_view;
    std::vector<Node> m_nodes;
    std::vector<int> m_roots;
    std::vector<int> m_senderNodes; ///< by place in the session's list; -1 before the row is there
    std::vector<int> m_characterNodes;
    std::vector<int> m_streamNodes;
};

} // namespace posewire::gui
