// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/field_model.h"

#include "app/gui/models/field_text.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <unordered_map>

namespace posewire::gui {

namespace {

using wire::NodeKind;

bool isStructure(NodeKind kind) {
    return kind == NodeKind::Group || kind == NodeKind::Item;
}

} // namespace

std::vector<TableColumn<std::int32_t>> FieldModel::columns(const FieldModel& model) {
    using Text = QString (*)(const FieldDocument&, std::int32_t);
    const auto here = [&model](Text text) {
        return [&model, text](std::int32_t node) { return text(*model.m_document, node); };
    };
    using Cells = TableColumn<std::int32_t>;
    const auto difference = [&model](std::int32_t node) {
        const bool isCompared = model.m_other && !isStructure(model.m_document->node(node).kind);
        return isCompared ? model.differenceText(node) : QString();
    };
    std::vector<Cells> columns{
        Cells::words(tr("Field"), {}, [&model](std::int32_t node) { return model.titleOf(node); }),
        Cells::numbers(tr("Value"), tr("Z-up metres, degrees, clocks and names, whatever the wire has"),
                       here(convertedValue)),
        Cells::numbers(tr("On the wire"), tr("As sent: shortest digits that read back the same"),
                       here(wireValue)),
        Cells::numbers(tr("Other"), tr("The same field of the packet to compare with"),
                       [&model](std::int32_t node) { return model.otherText(node); }),
        Cells::numbers(tr("Difference"),
                       tr("This less other; of vectors the distance, of orientations the angle"), difference),
        Cells::words(tr("Meaning"), {}, here(fieldMeaning)),
        Cells::words(tr("Section"), tr("Of the specification"), here(fieldSection))};
    for (int column = 0; column < kColumnCount; ++column) {
        Cells& each = columns[static_cast<std::size_t>(column)];
        each.colour = [&model, column](std::int32_t node) { return model.colour(node, column); };
        each.toolTip = [&model](std::int32_t node) { return model.helpOf(node); };
    }
    return columns;
}

/// A narrow tree shows fields and values; a wide one all there is, or two packets beside each other. Without
/// room for a vector, its components below it can still be read.
ColumnRoom FieldModel::room(int column) const {
    const bool isComparing = m_other != nullptr;
    const int onCompare = isComparing ? 0 : ColumnRoom::kOnChoice;
    const QString value =
        isComparing ? QStringLiteral("−0.00  −0.00 m") : QStringLiteral("−0.000  −0.000  −0.000 m");
    const QString least = tr("23 × 736 bytes");
    switch (column) {
    case kField:
        return {.usual = QStringLiteral("Segment 10 · Right Upper Armxx"),
                .least = QStringLiteral("12345678"),
                .isOpen = true};
    case kValue:
        return {.usual = value, .least = least};
    case kWire:
        return {.usual = QStringLiteral("-0.00000001  -0.0000"),
                .wish = QStringLiteral("-0.00000001  -0.00000001  -0.00000001 m"),
                .least = least,
                .order = isComparing ? ColumnRoom::kOnChoice : 3};
    case kOther:
        return {.usual = value, .least = least, .order = onCompare};
    case kDifference:
        return {.usual = QStringLiteral("−0.0000 m"), .least = QStringLiteral("−0.0 m"), .order = onCompare};
    case kMeaning:
        return {.usual = tr("quaternion w x y z, not of unit length"), .order = 2, .isOpen = true};
    default:
        return {.usual = QStringLiteral("§ N 2.5.10"), .order = 1};
    }
}

void FieldModel::setDocument(std::shared_ptr<const FieldDocument> document) {
    if (m_other == nullptr && m_document->hasSameRows(*document) && !document->bytes.empty()) {
        m_document = std::move(document);
        announceChange();
        return;
    }
    beginResetModel();
    m_document = std::move(document);
    match();
    arrange();
    endResetModel();
}

void FieldModel::setOther(std::shared_ptr<const FieldDocument> other) {
    beginResetModel();
    m_other = std::move(other);
    match();
    arrange();
    endResetModel();
}

void FieldModel::setOnlyDifferences(bool isOnly) {
    if (isOnly != m_onlyDifferences) {
        beginResetModel();
        m_onlyDifferences = isOnly;
        arrange();
        endResetModel();
    }
}

void FieldModel::match() {
    const std::int32_t count = m_document->count();
    m_counterparts.assign(nodeIndex(count), -1);
    m_differs.assign(nodeIndex(count), false);
    m_differences = 0;
    if (m_other == nullptr) {
        return;
    }
    std::unordered_map<std::string, std::int32_t> places;
    for (std::int32_t i = 0; i < m_other->count(); ++i) {
        places.emplace(m_other->lastingPath(i), i);
    }
    for (std::int32_t i = 0; i < count; ++i) {
        const auto found = places.find(m_document->lastingPath(i));
        m_counterparts[nodeIndex(i)] = found == places.end() ? -1 : found->second;
        if (!isStructure(m_document->node(i).kind) && !differenceText(i).isEmpty()) {
            m_differences += m_document->node(i).kind == NodeKind::Part ? 0 : 1;
            for (std::int32_t k = i; k >= 0; k = m_document->node(k).parent) {
                m_differs[nodeIndex(k)] = true;
            }
        }
    }
}

void FieldModel::arrange() {
    clearPlaces();
    for (std::int32_t i = 0; i < m_document->count(); ++i) {
        if (m_other == nullptr || !m_onlyDifferences || m_differs[nodeIndex(i)]) {
            place(i, m_document->node(i).parent);
        }
    }
}

QString FieldModel::differenceText(std::int32_t node) const {
    const std::int32_t other = m_counterparts[nodeIndex(node)];
    return other < 0 ? tr("only here") : difference(*m_document, node, *m_other, other);
}

QString FieldModel::titleOf(std::int32_t node) const {
    const QString title = fieldTitle(*m_document, node);
    const Health health = m_document->worstWithin(node);
    return health == Health::Unknown ? title : healthText(health, title);
}

QString FieldModel::otherText(std::int32_t node) const {
    return m_other == nullptr || m_counterparts[nodeIndex(node)] < 0
               ? QString()
               : convertedValue(*m_other, m_counterparts[nodeIndex(node)]);
}

QString FieldModel::helpOf(std::int32_t node) const {
    return tr("%1\n%2\n%3")
        .arg(
            shownText(m_document->tree.path(node)), fieldPlace(*m_document, node),
            (fieldMeaning(*m_document, node) + QLatin1Char(' ') + fieldSection(*m_document, node)).trimmed());
}

QVariant FieldModel::colour(std::int32_t node, int column) const {
    // The sign of what is wrong below has its colour.
    const Health own = column == kField ? m_document->worstWithin(node) : m_document->health(node);
    if (own != Health::Unknown && column <= kWire) {
        return healthColour(own);
    }
    if (column == kDifference || (column == kValue && m_other != nullptr && m_differs[nodeIndex(node)])) {
        return theme().warning;
    }
    const NodeKind kind = m_document->node(node).kind;
    const bool isQuiet = column == kMeaning || column == kSection || column == kOther ||
                         (column != kField && isStructure(kind)) || kind == NodeKind::Unread ||
                         (column == kField && kind == NodeKind::Part);
    return isQuiet ? QVariant(theme().dim) : QVariant();
}

QVariant FieldModel::data(const QModelIndex& index, int role) const {
    return checkIndex(index, CheckIndexOption::IndexIsValid) ? cell(node(index), index.column(), role)
                                                             : QVariant();
}

} // namespace posewire::gui
