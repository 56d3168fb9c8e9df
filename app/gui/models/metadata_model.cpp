// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/metadata_model.h"

#include "app/gui/models/character_facts.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr quintptr kTop = ~quintptr{0}; ///< internal id of rows at the top; of others, the row above them

QString textOf(const std::string& text) {
    return QString::fromStdString(text);
}

QString changesText(std::size_t changes) {
    return changes == 1 ? tr("· 1 change") : tr("· %1 changes").arg(changes);
}

QVariant swatchOf(const std::string& tagName, const std::string& value) {
    const auto colour = tagName == "color" ? model::parseColour(value) : std::nullopt;
    return colour ? QVariant(QColor::fromRgbF(colour->red, colour->green, colour->blue)) : QVariant();
}

using MetadataColumn = TableColumn<MetadataRow>;

QVariant dim(const MetadataRow&) {
    return theme().dim;
}

QString suffixOf(const MetadataRow& row) {
    const QString changes = row.changes == 0 ? QString() : changesText(row.changes);
    if (row.tag->isKnown) {
        return changes;
    }
    return changes.isEmpty() ? tr("· unknown") : tr("· unknown %1").arg(changes);
}

MetadataColumn nameColumn() {
    return {.title = tr("Tag"),
            .text =
                [](const MetadataRow& row) {
                    return row.fact != nullptr ? row.fact->label
                           : row.isEarlier     ? tr("before")
                                               : textOf(row.tag->name);
                },
            .colour = dim,
            .toolTip =
                [](const MetadataRow& row) {
                    const bool isUnknown = row.tag != nullptr && !row.isEarlier && !row.tag->isKnown;
                    return isUnknown
                               ? tr("Neither in the specification nor known from real senders; kept and "
                                    "shown as sent")
                               : QString();
                },
            .more =
                [](const MetadataRow& row, int role) {
                    const bool isTag = row.tag != nullptr && !row.isEarlier;
                    const QString suffix = isTag && role == kSuffixRole ? suffixOf(row) : QString();
                    return suffix.isEmpty() ? QVariant() : suffix;
                }};
}

PropertyValue shownValue(const MetadataRow& row) {
    if (row.fact != nullptr) {
        PropertyValue value = row.fact->read();
        value.toolTip = value.toolTip.isEmpty() ? value.text : value.toolTip;
        return value;
    }
    if (row.value == nullptr) {
        return {tr("not sent yet")};
    }
    return {textOf(row.value->text), Health::Unknown,
            row.isEarlier ? QString() : tr("First sent at %1").arg(timeOfDay(row.value->stamp))};
}

MetadataColumn sentColumn(model::SessionView& view) {
    return {.title = tr("Sent"),
            .isNumber = true,
            .text =
                [&view](const MetadataRow& row) {
                    if (row.fact != nullptr) {
                        return QString();
                    }
                    const double age = log::secondsOf(view.cursorStamp() - row.tag->lastSeen);
                    return row.isEarlier ? timeOfDay(row.value->stamp) : duration(std::max(0.0, age));
                },
            .colour = dim,
            .toolTip =
                [](const MetadataRow& row) {
                    return row.tag == nullptr || row.isEarlier
                               ? QString()
                               : tr("Last sent at %1, changed or not. Earlier values are below the tag.")
                                     .arg(timeOfDay(row.tag->lastSeen));
                },
            .more =
                [](const MetadataRow& row, int role) {
                    return role == kSpanRole && row.fact != nullptr ? QVariant(true) : QVariant();
                }};
}

std::vector<MetadataColumn> metadataColumns(model::SessionView& view) {
    MetadataColumn value = valueColumn(MetadataColumn{.title = tr("Value"), .isNumber = true}, shownValue);
    value.colour = [](const MetadataRow& row) {
        return row.isEarlier ? QVariant(theme().dim) : shownValue(row).colour();
    };
    value.more = [](const MetadataRow& row, int role) {
        return role == kSwatchRole && row.value != nullptr ? swatchOf(row.tag->name, row.value->text)
                                                           : QVariant();
    };
    return {nameColumn(), std::move(value), sentColumn(view)};
}

} // namespace

MetadataModel::MetadataModel(model::SessionView& view, QObject* parent)
    : ColumnModel(metadataColumns(view), parent), m_view(view), m_facts(characterFacts(m_view, m_key)) {}

void MetadataModel::refresh() {
    const auto key = shownCharacter(m_view);
    if (key != m_key) {
        changeCharacter(key);
    } else if (m_key && !insertTags()) {
        fitHistories();
    }
    announceChange(0, rowCount() - 1);
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

MetadataRow MetadataModel::rowAt(const QModelIndex& index) const {
    const bool isTop = index.internalId() == kTop;
    const model::MetadataTag* found = tag(isTop ? index.row() : static_cast<int>(index.internalId()));
    if (found == nullptr) {
        return isTop ? MetadataRow{.fact = &m_facts[static_cast<std::size_t>(index.row()) - m_earlier.size()]}
                     : MetadataRow{};
    }
    const std::size_t earlier = earlierValues(*found);
    if (isTop) {
        return {.tag = found, .value = found->at(newestVisiblePacket(m_view)), .changes = earlier};
    }
    const auto back = static_cast<std::size_t>(index.row());
    return back < earlier
               ? MetadataRow{.tag = found, .value = &found->values[earlier - 1 - back], .isEarlier = true}
               : MetadataRow{};
}

QVariant MetadataModel::data(const QModelIndex& index, int role) const {
    const MetadataRow row = checkIndex(index, CheckIndexOption::IndexIsValid) ? rowAt(index) : MetadataRow{};
    return row.tag != nullptr || row.fact != nullptr ? cell(row, index.column(), role) : QVariant();
}

} // namespace posewire::gui
