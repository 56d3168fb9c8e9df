// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "core/model/body/pose_messages.h"
#include "core/model/session/metadata.h"
#include "core/model/session/session_view.h"

#include <optional>
#include <vector>

namespace posewire::gui {

/// A tag at the cursor (without a value before it was sent), an earlier value, a fact, or a MotionGrid tag.
struct MetadataRow {
    const model::MetadataTag* tag = nullptr;
    const model::MetadataTag::Value* value = nullptr;
    const Property* fact = nullptr;
    const model::TagPlace* place = nullptr; ///< of a MotionGrid tag
    std::size_t changes = 0;                ///< of a tag, up to the cursor
    bool isEarlier = false;
};

/// What is known about the shown character: every tag of its metadata with its earlier values as children,
/// newest first, below them what was concluded from headers and scale messages, and last its MotionGrid tags.
/// Reads at the cursor.
class MetadataModel : public ColumnModel<MetadataRow, QAbstractItemModel> {
public:
    enum Column : int { kName, kValue, kSent };

    explicit MetadataModel(model::SessionView& view);

    void refresh();
    [[nodiscard]] std::optional<model::CharacterKey> character() const { return m_key; }

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

private:
    void changeCharacter(std::optional<model::CharacterKey> key);
    bool insertTags();
    bool fitHistories(); ///< false if all were as they had to be
    void fitPlaces();
    [[nodiscard]] std::size_t earlierValues(const model::MetadataTag& tag) const;
    [[nodiscard]] const model::MetadataTag* tag(int row) const;
    [[nodiscard]] MetadataRow rowAt(const QModelIndex& index) const;

    model::SessionView& m_view;
    std::optional<model::CharacterKey> m_key;
    std::vector<std::size_t> m_earlier; ///< rows under each tag
    std::uint64_t m_dropped = 0;        ///< tags of the character that were given up so far
    std::vector<Property> m_facts;
    std::vector<model::TagPlace> m_places; ///< of MotionGrid tags
};

} // namespace posewire::gui
