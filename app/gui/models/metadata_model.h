// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "core/model/session/session_view.h"

#include <QAbstractItemModel>

#include <optional>
#include <vector>

namespace posewire::gui {

/// What is known about the shown character: every tag of its metadata with its earlier values as children,
/// newest first, and below them what was concluded from headers and scale messages. Reads at the cursor.
class MetadataModel : public QAbstractItemModel {
    Q_OBJECT

public:
    enum Column : int { kName, kValue, kSent, kColumnCount };

    explicit MetadataModel(model::SessionView& view, QObject* parent = nullptr);

    void refresh();
    [[nodiscard]] std::optional<model::CharacterKey> character() const { return m_key; }

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    void changeCharacter(std::optional<model::CharacterKey> key);
    bool insertTags();
    void fitHistories();
    [[nodiscard]] std::size_t earlierValues(const model::MetadataTag& tag) const;
    [[nodiscard]] const model::MetadataTag* tag(int row) const;
    [[nodiscard]] QVariant nameSuffix(const model::MetadataTag& tag) const;
    [[nodiscard]] QVariant tagName(const model::MetadataTag& tag, int role) const;
    [[nodiscard]] QVariant tagValue(const model::MetadataTag& tag, int role) const;
    [[nodiscard]] QVariant tagSent(const model::MetadataTag& tag, int role) const;
    [[nodiscard]] QVariant historyData(const QModelIndex& index, int role) const;
    [[nodiscard]] QVariant factData(const Property& fact, int column, int role) const;

    model::SessionView& m_view;
    std::optional<model::CharacterKey> m_key;
    std::vector<std::size_t> m_earlier; ///< rows under each tag
    std::vector<Property> m_facts;
};

} // namespace posewire::gui
