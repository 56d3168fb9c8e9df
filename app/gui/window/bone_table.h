// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/own_characters.h"

#include <QTreeWidget>

#include <span>

namespace posewire::gui {

/// A row for each segment: its bone, which can be chosen, and how that was found.
class BoneTable final : public QTreeWidget {
    Q_OBJECT

public:
    explicit BoneTable(QWidget* parent);

    void setMapping(const render::BoneMapping& mapping, std::span<const render::ImportedBone> bones);

protected:
    /// The bone, whichever column the current cell is in.
    bool edit(const QModelIndex& index, EditTrigger trigger, QEvent* event) override;

signals:
    /// The operator gives a segment another bone; no bone if the name is empty.
    void corrected(std::size_t mappable, const QString& bone);
};

} // namespace posewire::gui
