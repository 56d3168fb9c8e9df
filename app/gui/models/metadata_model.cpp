// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/metadata_model.h"

#include "app/gui/models/character_facts.h"
#include "app/gui/models/roles.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr quintptr kTop = ~quintptr{0}; ///< internal id of rows at the top; of others, the row above them

QString textOf(const std::string& text) {
    return QString::fromStdString(text);
}

QVariant rightAligned() {
    return QVariant::fromValue(Qt::AlignRight | Qt::AlignVCenter);
}

QString changesText(std::size_t changes) {
    return changes == 1 ? MetadataModel::tr("· 1 change") : MetadataModel::tr("· %1 changes").arg(changes);
}

QVariant swatchOf(const std::string& tagName, const std::string& value) {
    const auto colour = tagName == "color" ? model::parseColour(value) : std::nullopt;
    return colour ? QVariant(QColor::fromRgbF(colour->red, colour->green, colour->blue)) : QVariant();
}

} // namespace

MetadataModel::MetadataModel(model::SessionView& view, QObject* parent)
    : QAbstractItemModel(parent), m_view(view), m_facts(characterFacts(m_view, m_key)) {}

void MetadataModel::refresh() {
    const auto key = shownCharacter(m_view);
    if (key != m_key) {
        changeCharacter(key);
    } else if (m_key && !insertTags()) {
        fitHistories();
    }
    if (rowCount() > 0) {
        emit dataChanged(index(0, 0), index(rowCount() - 1, kColumnCount - 1));
    }
}

void MetadataModel::changeCharacter(std::optional<model::CharacterKey> key) {
    if (m_key) {
        beginRemoveRows({}, 0, rowCount() - 1);
        m_key.reset();
        m_earlier.clear();
        endRemoveRows();
    }
    if (!key) {
        return;
    }
    const auto tags = m_view.metadata(*key).tags();
    beginInsertRows({}, 0, static_cast<int>(tags.size() + m_facts.size()) - 1);
    m_key = key;
    for (const model::MetadataTag& tag : tags) {
        m_earlier.push_back(earlierValues(tag));
    }
    endInsertRows();
}

bool MetadataModel::insertTags() {
    const auto tags = m_view.metadata(*m_key).tags();
    const std::size_t first = m_earlier.size();
    if (first == tags.size()) {
        return false;
    }
    beginInsertRows({}, static_cast<int>(first), static_cast<int>(tags.size()) - 1);
    for (const model::MetadataTag& tag : tags.subspan(first)) {
        m_earlier.push_back(earlierValues(tag));
    }
    endInsertRows();
    return true;
}

void MetadataModel::fitHistories() {
    bool hasInserted = false;
    bool hasRemoved = false;
    for (std::size_t row = 0; row < m_earlier.size(); ++row) {
        const std::size_t wanted = earlierValues(*tag(static_cast<int>(row)));
        const std::size_t shown = m_earlier[row];
        const QModelIndex parent = index(static_cast<int>(row), 0);
        if (wanted > shown && !hasInserted) {
            beginInsertRows(parent, 0, static_cast<int>(wanted - shown) - 1);
            m_earlier[row] = wanted;
            endInsertRows();
            hasInserted = true;
        } else if (wanted < shown && !hasRemoved) {
            beginRemoveRows(parent, 0, static_cast<int>(shown - wanted) - 1);
            m_earlier[row] = wanted;
            endRemoveRows();
            hasRemoved = true;
        }
    }
}

std::size_t MetadataModel::earlierValues(const model::MetadataTag& tag) const {
    const model::MetadataTag::Value* current = tag.at(newestVisiblePacket(m_view));
    return current == nullptr ? 0 : static_cast<std::size_t>(current - tag.values.data());
}

const model::MetadataTag* MetadataModel::tag(int row) const {
    const bool isTag = m_key && row >= 0 && static_cast<std::size_t>(row) < m_earlier.size();
    return isTag ? &m_view.metadata(*m_key).tags()[static_cast<std::size_t>(row)] : nullptr;
}

QModelIndex MetadataModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) {
        return {};
    }
    return createIndex(row, column, parent.isValid() ? static_cast<quintptr>(parent.row()) : kTop);
}

QModelIndex MetadataModel::parent(const QModelIndex& index) const {
    return !index.isValid() || index.internalId() == kTop
               ? QModelIndex()
               : createIndex(static_cast<int>(index.internalId()), 0, kTop);
}

int MetadataModel::rowCount(const QModelIndex& parent) const {
    if (!parent.isValid()) {
        return m_key ? static_cast<int>(m_earlier.size() + m_facts.size()) : 0;
    }
    const bool hasHistory =
        parent.internalId() == kTop && parent.column() == 0 && tag(parent.row()) != nullptr;
    return hasHistory ? static_cast<int>(m_earlier[static_cast<std::size_t>(parent.row())]) : 0;
}

int MetadataModel::columnCount(const QModelIndex&) const {
    return kColumnCount;
}

QVariant MetadataModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    if (role == Qt::TextAlignmentRole) {
        return index.column() == kName ? QVariant() : rightAligned();
    }
    if (index.internalId() != kTop) {
        return historyData(index, role);
    }
    const model::MetadataTag* found = tag(index.row());
    if (found == nullptr) {
        return factData(m_facts[static_cast<std::size_t>(index.row()) - m_earlier.size()], index.column(),
                        role);
    }
    switch (index.column()) {
    case kName:
        return tagName(*found, role);
    case kValue:
        return tagValue(*found, role);
    default:
        return tagSent(*found, role);
    }
}

QVariant MetadataModel::nameSuffix(const model::MetadataTag& tag) const {
    const std::size_t changes = earlierValues(tag);
    if (!tag.isKnown) {
        return changes == 0 ? tr("· unknown") : tr("· unknown %1").arg(changesText(changes));
    }
    return changes == 0 ? QVariant() : changesText(changes);
}

QVariant MetadataModel::tagName(const model::MetadataTag& tag, int role) const {
    switch (role) {
    case Qt::DisplayRole:
        return textOf(tag.name);
    case kSuffixRole:
        return nameSuffix(tag);
    case Qt::ForegroundRole:
        return theme().dim;
    case Qt::ToolTipRole:
        return tag.isKnown ? QVariant()
                           : tr("Neither in the specification nor known from real senders; "
                                "kept and shown as sent");
    default:
        return {};
    }
}

QVariant MetadataModel::tagValue(const model::MetadataTag& tag, int role) const {
    const model::MetadataTag::Value* value = tag.at(newestVisiblePacket(m_view));
    if (value == nullptr) {
        return role == Qt::DisplayRole ? tr("not sent yet") : QVariant();
    }
    switch (role) {
    case Qt::DisplayRole:
        return textOf(value->text);
    case kSwatchRole:
        return swatchOf(tag.name, value->text);
    case Qt::ToolTipRole:
        return tr("First sent at %1").arg(timeOfDay(value->stampNs));
    default:
        return {};
    }
}

QVariant MetadataModel::tagSent(const model::MetadataTag& tag, int role) const {
    const double age = static_cast<double>(m_view.cursorStampNs() - tag.lastSeenNs) * 1e-9;
    switch (role) {
    case Qt::DisplayRole:
        return duration(std::max(0.0, age));
    case Qt::ForegroundRole:
        return theme().dim;
    case Qt::ToolTipRole:
        return tr("Last sent at %1, changed or not. Earlier values stand below the tag.")
            .arg(timeOfDay(tag.lastSeenNs));
    default:
        return {};
    }
}

QVariant MetadataModel::historyData(const QModelIndex& index, int role) const {
    const model::MetadataTag* found = tag(static_cast<int>(index.internalId()));
    const std::size_t earlier = found == nullptr ? 0 : earlierValues(*found);
    if (static_cast<std::size_t>(index.row()) >= earlier) {
        return {};
    }
    const model::MetadataTag::Value& value =
        found->values[earlier - 1 - static_cast<std::size_t>(index.row())];
    if (role == Qt::ForegroundRole) {
        return theme().dim;
    }
    if (role == kSwatchRole && index.column() == kValue) {
        return swatchOf(found->name, value.text);
    }
    if (role != Qt::DisplayRole) {
        return {};
    }
    switch (index.column()) {
    case kName:
        return tr("before");
    case kValue:
        return textOf(value.text);
    default:
        return timeOfDay(value.stampNs);
    }
}

QVariant MetadataModel::factData(const Property& fact, int column, int role) const {
    if (column == kName) {
        return role == Qt::DisplayRole      ? QVariant(fact.label)
               : role == Qt::ForegroundRole ? QVariant(theme().dim)
                                            : QVariant();
    }
    if (column == kSent) {
        return role == kSpanRole ? QVariant(true) : QVariant();
    }
    const PropertyValue value = fact.read();
    switch (role) {
    case Qt::DisplayRole:
        return value.display();
    case Qt::ForegroundRole:
        return value.colour();
    case Qt::ToolTipRole:
        return value.toolTip.isEmpty() ? QVariant(value.text) : value.toolTip;
    default:
        return {};
    }
}

QVariant MetadataModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) {
        return {};
    }
    if (role == Qt::TextAlignmentRole) {
        return section == kName ? QVariant() : rightAligned();
    }
    if (role != Qt::DisplayRole) {
        return {};
    }
    switch (section) {
    case kName:
        return tr("Tag");
    case kValue:
        return tr("Value");
    default:
        return tr("Sent");
    }
}

} // namespace posewire::gui
