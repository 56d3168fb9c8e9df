// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "app/gui/models/field_document.h"

#include <memory>

namespace posewire::gui {

/// The fields of one packet as a tree, or of two packets beside each other. The rows stay as they are where
/// another packet has the same fields on the same bytes.
class FieldModel : public ColumnModel<std::int32_t, QAbstractItemModel> {
public:
    enum Column { kField, kValue, kWire, kOther, kDifference, kMeaning, kSection, kColumnCount };

    explicit FieldModel(QObject* parent = nullptr);

    /// Neither may be null.
    void setDocument(std::shared_ptr<const FieldDocument> document);
    /// A packet to compare with; null ends comparing.
    void setOther(std::shared_ptr<const FieldDocument> other);
    /// While comparing: only fields that differ, with what is around them.
    void setOnlyDifferences(bool isOnly);
    [[nodiscard]] bool isOnlyDifferences() const { return m_onlyDifferences; }

    [[nodiscard]] const FieldDocument& document() const { return *m_document; }
    [[nodiscard]] const FieldDocument* other() const { return m_other.get(); }
    [[nodiscard]] std::size_t differences() const { return m_differences; }

    [[nodiscard]] std::int32_t node(const QModelIndex& index) const;
    /// Invalid where the node is not shown.
    [[nodiscard]] QModelIndex indexOf(std::int32_t node, int column = 0) const;

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

private:
    void match();
    void arrange();
    /// Read the model only where a cell is asked for.
    [[nodiscard]] static std::vector<TableColumn<std::int32_t>> columns(const FieldModel& model);
    [[nodiscard]] QString titleOf(std::int32_t node) const;
    [[nodiscard]] QString otherText(std::int32_t node) const;
    [[nodiscard]] QString helpOf(std::int32_t node) const;
    [[nodiscard]] QVariant colour(std::int32_t node, int column) const;
    [[nodiscard]] QString differenceText(std::int32_t node) const;

    std::shared_ptr<const FieldDocument> m_document = std::make_shared<FieldDocument>();
    std::shared_ptr<const FieldDocument> m_other;
    bool m_onlyDifferences = false;
    std::size_t m_differences = 0;                 ///< fields that differ
    std::vector<std::int32_t> m_counterparts;      ///< of each node in the other packet, -1 for none
    std::vector<bool> m_differs;                   ///< the node, or one below it
    std::vector<std::vector<std::int32_t>> m_rows; ///< shown children; the first element is the top
    std::vector<int> m_rowOf;                      ///< of each node; -1 where it is not shown
};

} // namespace posewire::gui
