// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "render/mesh/bone_mapping.h"

#include <QTreeWidget>

#include <vector>

class QComboBox;
class QStringListModel;

namespace posewire::gui {

/// Which bone follows which segment, to be changed: a row for each segment, those of the hands folded away.
class BoneTable final : public QTreeWidget {
    Q_OBJECT

public:
    explicit BoneTable(QWidget* parent);

    void setBones(std::span<const render::ImportedBone> bones);
    void setMapping(const render::BoneMapping& mapping);
    [[nodiscard]] const render::BoneMapping& mapping() const { return m_mapping; }

signals:
    /// The operator has chosen another bone.
    void mappingChanged();

private:
    void choose(std::size_t mappable, int entry);
    void mark(std::size_t mappable);

    struct Row {
        QTreeWidgetItem* item;
        QComboBox* bone;
    };
    QStringListModel* m_names; ///< "none", then the bones
    std::vector<Row> m_rows;   ///< by mappable segment
    render::BoneMapping m_mapping;
    bool m_hasBones = false; ///< else nothing is missing yet
};

} // namespace posewire::gui
