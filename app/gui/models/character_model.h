// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/models/nominal_rate.h"
#include "core/model/session.h"

#include <QAbstractItemModel>

#include <optional>
#include <vector>

namespace posewire::gui {

/// Source > character > stream, each in the order of first appearance, so that rows never jump.
///
/// A refresh announces at most one insertion: what appears under several parents at once arrives over the
/// next refreshes. Changed values are announced once, for the sources; views repaint what stands under them
/// too.
class CharacterModel : public QAbstractItemModel {
    Q_OBJECT

public:
    enum Column : int { kName, kRate, kState, kColumnCount };

    CharacterModel(model::SessionView& view, Commands& commands, QObject* parent = nullptr);

    void refresh();

    /// What a row stands for; nothing above its own level is filled in for sources.
    [[nodiscard]] std::optional<model::CharacterKey> character(const QModelIndex& index) const;
    [[nodiscard]] std::optional<log::SourceId> source(const QModelIndex& index) const;
    /// The row of a character, or an invalid index.
    [[nodiscard]] QModelIndex indexOf(const model::CharacterKey& key) const;

    /// Rate of a stream by the sender's own clock, where it can be told.
    [[nodiscard]] std::optional<double> nominalHz(const model::Stream& stream) const;

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    enum class Kind : std::uint8_t { Source, Character, Stream };
    struct Node {
        Kind kind;
        std::size_t entry; ///< in the session's list of its kind
        int parent;        ///< node, -1 for sources
        int row;
        std::vector<int> children;
    };

    bool insertSources();
    bool insertCharacters();
    bool insertStreams();
    /// Adds the entries without a node that have the same parent as the first of them.
    bool insertChildren(const std::vector<int>& nodes, int (CharacterModel::*parentOf)(std::size_t) const,
                        void (CharacterModel::*add)(std::size_t, int));
    int addNode(Kind kind, std::size_t entry, int parent);
    void addSource(std::size_t entry);
    void addCharacter(std::size_t entry, int parent);
    void addStream(std::size_t entry, int parent);
    void readRates();

    [[nodiscard]] const Node& nodeOf(const QModelIndex& index) const;
    [[nodiscard]] QModelIndex indexOfNode(int node) const;
    [[nodiscard]] int parentOfCharacter(std::size_t entry) const;
    [[nodiscard]] int parentOfStream(std::size_t entry) const;
    [[nodiscard]] QVariant sourceData(const model::Source& source, int column, int role) const;
    [[nodiscard]] QVariant characterData(const model::Character& character, int column, int role) const;
    [[nodiscard]] QVariant characterName(const model::Character& character, int role) const;
    [[nodiscard]] QVariant streamData(const model::Stream& stream, int column, int role) const;

    model::SessionView& m_view;
    Commands& m_commands;
    std::vector<Node> m_nodes;
    std::vector<int> m_roots;
    std::vector<int> m_sourceNodes; ///< by place in the session's list; -1 before the row is there
    std::vector<int> m_characterNodes;
    std::vector<int> m_streamNodes;

    struct CharacterRate {
        NominalRate rate;
        std::uint64_t packet = 0; ///< the newest that was taken in
    };
    std::vector<CharacterRate> m_rates; ///< by place of the character
};

} // namespace posewire::gui
