// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/bone_table.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QHeaderView>
#include <QSignalBlocker>
#include <QStringListModel>

namespace posewire::gui {

namespace {

enum Column : std::uint8_t { Segment, Bone };

QString nameOf(std::size_t mappable) {
    return QString::fromStdString(render::mappableTitle(mappable));
}

} // namespace

BoneTable::BoneTable(QWidget* parent) : QTreeWidget(parent), m_names(new QStringListModel(this)) {
    setColumnCount(2);
    setHeaderLabels({tr("Segment"), tr("Bone of the file")});
    setAccessibleName(tr("Bones by segment"));
    setUniformRowHeights(true);
    setSelectionMode(NoSelection);
    const std::array groups{new QTreeWidgetItem(this, {tr("Body")}),
                            new QTreeWidgetItem(this, {tr("Left hand")}),
                            new QTreeWidgetItem(this, {tr("Right hand")})};
    for (std::size_t i = 0; i < render::kMappableCount; ++i) {
        const std::size_t finger = i < render::kSegmentCount ? 0 : i - render::kSegmentCount;
        const std::size_t group = i < render::kSegmentCount ? 0 : finger < render::kHandSegmentCount ? 1 : 2;
        auto* item = new QTreeWidgetItem(groups.at(group), {nameOf(i)});
        auto* bone = new ComboBox(this);
        bone->setModel(m_names);
        bone->setAccessibleName(tr("Bone of %1").arg(nameOf(i)));
        bone->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        bone->setMinimumContentsLength(16);
        bone->setFocusPolicy(Qt::StrongFocus);
        setItemWidget(item, Bone, bone);
        connect(bone, &QComboBox::activated, this, [this, i](int entry) { choose(i, entry); });
        m_rows.push_back({item, bone});
    }
    groups[0]->setExpanded(true);
    header()->setSectionResizeMode(Segment, QHeaderView::ResizeToContents);
    header()->setStretchLastSection(true);
    setBones({});
}

void BoneTable::setBones(std::span<const render::ImportedBone> bones) {
    QStringList names{tr("none")};
    for (const render::ImportedBone& bone : bones) {
        names += shown(model::ForeignText(bone.name));
    }
    m_hasBones = !bones.empty();
    m_names->setStringList(names);
    setMapping({});
}

void BoneTable::setMapping(const render::BoneMapping& mapping) {
    m_mapping = mapping;
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        m_rows[i].bone->setCurrentIndex(mapping.bones[i] + 1);
        mark(i);
    }
}

void BoneTable::choose(std::size_t mappable, int entry) {
    m_mapping.bones[mappable] = entry - 1;
    mark(mappable);
    emit mappingChanged();
}

/// What is missing is said by a sign and a word, too.
void BoneTable::mark(std::size_t mappable) {
    const bool isMissing = m_hasBones && m_mapping.bones[mappable] < 0 && render::isRequired(mappable);
    QTreeWidgetItem* item = m_rows[mappable].item;
    item->setText(Segment, isMissing ? tr("▲ %1 (missing)").arg(nameOf(mappable)) : nameOf(mappable));
    item->setForeground(Segment, isMissing ? theme().warning : theme().text);
}

} // namespace posewire::gui
