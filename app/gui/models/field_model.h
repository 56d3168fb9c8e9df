// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/field_document.h"
#include "app/gui/models/tree_model.h"

#include <memory>

namespace posewire::gui {

/// The fields of one packet as a tree, or of two packets beside each other; its nodes are those of the
/// document. The rows stay as they are where another packet has the same fields on the same bytes.
class FieldModel : public TreeModel<std::int32_t> {
public:
    enum Column { kField, kValue, kWire, kOther, kDifference, kMeaning, kSection, kColumnCount };

    FieldModel() : TreeModel(columns(*this)) {}

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

    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

protected:
    [[nodiscard]] ColumnRoom room(int column) const override;

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
    std::size_t m_differences = 0;            ///< fields that differ
    std::vector<std::int32_t> m_counterparts; ///< of each node in the other packet, -1 for none
    std::vector<bool> m_differs;              ///< the node, or one below it
};

} // namespace posewire::gui
