// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/bone_table.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QHeaderView>
#include <QSignalBlocker>
#include <QStyledItemDelegate>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

enum Column : std::uint8_t { SegmentColumn, BoneColumn, FoundColumn };
constexpr int kName = Qt::UserRole; ///< of the bone, as the file has it

QString foundText(render::FoundBy by) {
    switch (by) {
    case render::FoundBy::Naming:
        return BoneTable::tr("name");
    case render::FoundBy::Word:
        return BoneTable::tr("word in its name");
    case render::FoundBy::Shape:
        return BoneTable::tr("guess by shape");
    case render::FoundBy::Operator:
        return BoneTable::tr("by hand");
    }
    return {};
}

/// Chooses a bone from those of the file.
class BoneDelegate final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;

    /// False if it had them.
    bool setNames(const QStringList& names) { return std::exchange(m_names, names) != names; }

    QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& /*option*/,
                          const QModelIndex& /*index*/) const override {
        auto* box = new ComboBox(parent);
        box->addItem(BoneTable::tr("no bone"), QString());
        for (const QString& name : m_names) {
            box->addItem(shown(model::ForeignText(name.toStdString())), name);
        }
        connect(box, &QComboBox::activated, this, [this, box] {
            auto* self = const_cast<BoneDelegate*>(this); // createEditor is const, its signals are not
            emit self->commitData(box);
            emit self->closeEditor(box);
        });
        return box;
    }
    void setEditorData(QWidget* editor, const QModelIndex& index) const override {
        auto* box = static_cast<QComboBox*>(editor);
        box->setCurrentIndex(std::max(0, box->findData(index.data(kName))));
    }
    void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override {
        model->setData(index, static_cast<QComboBox*>(editor)->currentData(), kName);
    }

private:
    QStringList m_names;
};

} // namespace

BoneTable::BoneTable(QWidget* parent) : QTreeWidget(parent) {
    setAccessibleName(tr("Bones of the segments"));
    setHeaderLabels({tr("Segment"), tr("Bone"), tr("Found by")});
    setRootIsDecorated(false);
    setUniformRowHeights(true);
    setEditTriggers(SelectedClicked | DoubleClicked | EditKeyPressed | AnyKeyPressed);
    setItemDelegate(new BoneDelegate(this));
    for (std::size_t i = 0; i < render::kMappableCount; ++i) {
        auto* row = new QTreeWidgetItem(this, {fromUtf8(render::mappableTitle(i))});
        row->setFlags(row->flags() | Qt::ItemIsEditable);
    }
    header()->setStretchLastSection(false);
    header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    header()->setSectionResizeMode(BoneColumn, QHeaderView::Stretch);
    setMinimumWidth(fontMetrics().averageCharWidth() * 60);
    connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* row, int column) {
        if (column == BoneColumn) {
            emit corrected(static_cast<std::size_t>(indexOfTopLevelItem(row)),
                           row->data(BoneColumn, kName).toString());
        }
    });
}

bool BoneTable::edit(const QModelIndex& index, EditTrigger trigger, QEvent* event) {
    return QTreeWidget::edit(index.siblingAtColumn(BoneColumn), trigger, event);
}

void BoneTable::setMapping(const render::BoneMapping& mapping, std::span<const render::ImportedBone> bones) {
    const QSignalBlocker quiet(this);
    QStringList names;
    for (const render::ImportedBone& bone : bones) {
        names += fromUtf8(bone.name);
    }
    QTreeWidgetItem* doubtful = topLevelItem(0);
    const std::vector<std::size_t> missing = render::missingSegments(mapping);
    for (std::size_t i = render::kMappableCount; i-- > 0;) {
        QTreeWidgetItem& row = *topLevelItem(static_cast<int>(i));
        const int bone = mapping.bones.at(i);
        const bool isMissing = std::ranges::find(missing, i) != missing.end();
        row.setData(BoneColumn, kName, bone < 0 ? QString() : names[bone]);
        row.setText(BoneColumn, bone >= 0
                                    ? shown(model::ForeignText(bones[static_cast<std::size_t>(bone)].name))
                                : isMissing ? tr("▲ missing")
                                            : QStringLiteral("–"));
        row.setText(FoundColumn, bone < 0 ? QString() : foundText(mapping.foundBy.at(i)));
        const bool isGuess = bone >= 0 && mapping.foundBy.at(i) == render::FoundBy::Shape;
        doubtful = isMissing || isGuess ? &row : doubtful;
        row.setForeground(BoneColumn, isMissing || isGuess ? theme().warning : theme().text);
        row.setForeground(FoundColumn, isGuess ? theme().warning : theme().dim);
    }
    if (static_cast<BoneDelegate*>(itemDelegate())->setNames(names)) { // another file
        scrollToItem(doubtful, PositionAtTop);
    }
}

} // namespace posewire::gui
