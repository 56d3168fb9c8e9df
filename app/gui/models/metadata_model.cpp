// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/metadata_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/wire/messages.h"

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

constexpr quintptr kTop = ~quintptr{0}; ///< internal id of rows at the top; of others, the row above them

QVariant swatchOf(const std::string& tagName, const std::string& value) {
    const auto colour = tagName == "color" ? model::parseColour(value) : std::nullopt;
    return colour ? QVariant(QColor::fromRgbF(colour->red, colour->green, colour->blue)) : QVariant();
}

using MetadataColumn = TableColumn<MetadataRow>;

QString suffixOf(const MetadataRow& row) {
    QStringList parts;
    if (!row.tag->isKnown) {
        parts += tr("· unknown");
    }
    if (row.changes != 0) {
        parts += tr("· %n changes", nullptr, static_cast<int>(row.changes));
    }
    return parts.join(QLatin1Char(' '));
}

QString labelOf(const MetadataRow& row) {
    if (row.fact != nullptr) {
        return row.fact->label;
    }
    if (row.place != nullptr) {
        return tr("Tag %1").arg(row.place->id);
    }
    return row.isEarlier ? tr("before") : shown(row.tag->name);
}

MetadataColumn nameColumn() {
    const auto isTag = [](const MetadataRow& row) { return row.tag != nullptr && !row.isEarlier; };
    const auto toolTip = [isTag](const MetadataRow& row) {
        return isTag(row) && !row.tag->isKnown
                   ? tr("Neither in the specification nor known from real senders; kept and shown as sent")
                   : QString();
    };
    const auto suffix = [isTag](const MetadataRow& row, int role) {
        const QString text = isTag(row) && role == kSuffixRole ? suffixOf(row) : QString();
        return text.isEmpty() ? QVariant() : text;
    };
    return MetadataColumn::words(tr("Tag"), {}, labelOf)
        .in({QStringLiteral("name · 22 changes")})
        .dimmed()
        .withToolTip(toolTip)
        .withMore(suffix);
}

PropertyValue shownValue(const model::SessionView& view, const MetadataRow& row) {
    if (row.fact != nullptr) {
        PropertyValue value = row.fact->read();
        value.toolTip = value.toolTip.isEmpty() ? value.text : value.toolTip;
        return value;
    }
    if (row.place != nullptr) {
        const Eigen::Vector3d& at = row.place->position;
        return {tr("%1, %2, %3 m").arg(fixed(at.x(), 3), fixed(at.y(), 3), fixed(at.z(), 3)), Health::Unknown,
                tr("MotionGrid tag: its latest place, x, y and z, Z-up")};
    }
    if (row.value == nullptr) {
        return {tr("not sent yet")};
    }
    return {shown(row.value->text), Health::Unknown,
            row.isEarlier ? QString() : tr("First sent at %1").arg(timeOfDay(view.wallOf(row.value->stamp)))};
}

/// Stamp of the newest message with a tag before the moment that is shown; 0 if that is no longer kept.
log::Stamp lastSent(model::SessionView& view, const MetadataRow& row) {
    const auto key = shownCharacter(view);
    if (row.tag->lastSeen <= view.cursorStamp() || !key) {
        return row.tag->lastSeen;
    }
    const log::Stamp newest =
        view.messages().newestStamp({key->sender, key->character, wire::MetaData::kType});
    const log::Stamp known = row.value != nullptr ? std::max(newest, row.value->stamp) : newest;
    return known < view.keptSince() ? log::Stamp() : known;
}

MetadataColumn sentColumn(model::SessionView& view) {
    const auto text = [&view](const MetadataRow& row) {
        if (row.fact != nullptr || (row.place == nullptr && row.value == nullptr)) {
            return QString();
        }
        const log::Stamp sent = row.place != nullptr ? row.place->stamp : lastSent(view, row);
        const double age = log::secondsOf(view.cursorStamp() - sent);
        return row.isEarlier          ? timeOfDay(view.wallOf(row.value->stamp))
               : sent == log::Stamp() ? dash()
                                      : duration(std::max(0.0, age));
    };
    const auto toolTip = [&view](const MetadataRow& row) {
        return row.tag == nullptr || row.isEarlier || lastSent(view, row) == log::Stamp()
                   ? QString()
                   : tr("Last sent at %1, changed or not. Earlier values are below the tag.")
                         .arg(timeOfDay(view.wallOf(lastSent(view, row))));
    };
    return MetadataColumn::numbers(tr("Sent"), {}, text)
        .in({.usual = QStringLiteral("99 min"), .order = 1})
        .dimmed()
        .withToolTip(toolTip);
}

std::vector<MetadataColumn> metadataColumns(model::SessionView& view) {
    const auto read = [&view](const MetadataRow& row) { return shownValue(view, row); };
    MetadataColumn value = valueColumn(MetadataColumn{.title = tr("Value"), .isNumber = true}, read);
    value.room = {.usual = QStringLiteral("12345678"), .isOpen = true};
    value.colour = [read](const MetadataRow& row) {
        return row.isEarlier ? QVariant(theme().dim) : read(row).colour();
    };
    value.more = [](const MetadataRow& row, int role) {
        return role == kSwatchRole && row.value != nullptr
                   ? swatchOf(row.tag->name.shown(), row.value->text.shown())
                   : QVariant();
    };
    return {nameColumn(), std::move(value), sentColumn(view)};
}

using Key = model::CharacterKey;

QString withEvidence(words::Kind conclusion, const words::Fact& evidence) {
    const QString text = said(conclusion, words::Form::Headline);
    return evidence.isNothing() ? text : text + QStringLiteral(" · ") + said(evidence, words::Form::Headline);
}

PropertyValue concluded(const QString& detected, const std::optional<QString>& said, const QString& toolTip) {
    if (!said) {
        return {detected, Health::Unknown, toolTip};
    }
    return {tr("%1 · as you said").arg(*said), Health::Unknown,
            toolTip + QLatin1Char('\n') + tr("Detected: %1").arg(detected)};
}

PropertyValue revision(const model::Sender& sender) {
    const model::Detection& found = sender.detector.result();
    const auto own = sender.overrides.revision
                         ? std::optional(said(model::revisionName(sender.revision()), words::Form::Headline))
                         : std::nullopt;
    return concluded(withEvidence(model::revisionName(found.revision), found.revisionEvidence), own,
                     tr("Revision of the specification that this sender follows · the evidence"));
}

PropertyValue units(const model::Sender& sender) {
    const model::Detection& found = sender.detector.result();
    const auto own = sender.overrides.positionUnit
                         ? std::optional(said(model::unitName(sender.positionUnit()), words::Form::Headline))
                         : std::nullopt;
    return concluded(
        found.unitEvidence.isNothing()
            ? tr("not known before type 02")
            : withEvidence(model::unitName(found.positionUnit), found.unitEvidence),
        own, tr("Unit of positions in types 02, 05, 21 and 24, judged by the size of a body · the evidence"));
}

PropertyValue upAxis(const model::Sender& sender) {
    const model::Detection& found = sender.detector.result();
    const auto own = sender.overrides.up
                         ? std::optional(said(model::upName(*sender.overrides.up), words::Form::Headline))
                         : std::nullopt;
    return concluded(found.upEvidence.isNothing() ? tr("Z-up · not known yet")
                                                  : withEvidence(model::upName(found.up), found.upEvidence),
                     own, tr("Axis that is up in types 02, 21 and 22 as sent · the evidence"));
}

PropertyValue address(const model::Sender& sender) {
    return {shown(sender.address())};
}

PropertyValue segments(model::SessionView& view, const Key& key) {
    const model::CharacterPose* pose = view.messages().pose(key);
    if (pose == nullptr) {
        return {tr("no pose yet")};
    }
    const model::SegmentLayout& layout = pose->layout;
    return {tr("%1 body · %n props · %2 fingers", nullptr, layout.props).arg(layout.body).arg(layout.fingers),
            Health::Unknown, tr("Items of a pose datagram, from the header's counts or their number")};
}

PropertyValue nullPose(model::SessionView& view, const Key& key) {
    const model::NullPose* pose = view.messages().nullPose(key);
    if (pose == nullptr || pose->segments.empty()) {
        return {tr("not received · reference body"), Health::Unknown,
                tr("Type 13 has not arrived: proportions of a reference body are used.")};
    }
    const QString expected =
        pose->partsExpected == 0 ? QStringLiteral("?") : QString::number(pose->partsExpected);
    const QString text =
        tr("%1 of %2 parts · %3 points").arg(pose->partsReceived).arg(expected).arg(pose->points.size());
    return {
        text, pose->isComplete() ? Health::Good : Health::Warning,
        tr("Datagrams of the scale message (type 13) received of those sent, with %1 segments; last at %2")
            .arg(pose->segments.size())
            .arg(timeOfDay(view.wallOf(pose->stamp)))};
}

/// Reads `key` whenever a value is read.
std::vector<Property> characterFacts(model::SessionView& view, const std::optional<Key>& key) {
    const auto ofSender = [&view, &key](const QString& label, PropertyValue (*read)(const model::Sender&)) {
        return Property{label, [&view, &key, read] {
                            const model::Sender* sender = key ? view.roster().find(key->sender) : nullptr;
                            return sender == nullptr ? PropertyValue{} : read(*sender);
                        }};
    };
    const auto ofCharacter = [&view, &key](const QString& label,
                                           PropertyValue (*read)(model::SessionView&, const Key&)) {
        return Property{label, [&view, &key, read] { return key ? read(view, *key) : PropertyValue{}; }};
    };
    return {ofSender(tr("Revision"), revision),    ofSender(tr("Units"), units),
            ofSender(tr("Up axis"), upAxis),       ofSender(tr("Sender"), address),
            ofCharacter(tr("Segments"), segments), ofCharacter(tr("Null pose"), nullPose)};
}

} // namespace

MetadataModel::MetadataModel(model::SessionView& view)
    : ColumnModel(metadataColumns(view)), m_view(view), m_facts(characterFacts(m_view, m_key)) {}

void MetadataModel::refresh() {
    const auto key = shownCharacter(m_view);
    const std::uint64_t dropped = key ? m_view.messages().metadata(*key).droppedTags() : 0;
    const std::size_t count = key ? m_view.messages().metadata(*key).tags().size() : 0;
    // Where tags were given up, others are at their places.
    if (key != m_key || std::exchange(m_dropped, dropped) != dropped || count < m_earlier.size()) {
        m_dropped = dropped;
        changeCharacter(key);
    } else if (m_key && !insertTags() && !fitHistories()) {
        fitPlaces();
    }
    announceChange();
}

void MetadataModel::changeCharacter(std::optional<model::CharacterKey> key) {
    if (m_key) {
        beginRemoveRows({}, 0, rowCount() - 1);
        m_key.reset();
        m_earlier.clear();
        m_places.clear();
        endRemoveRows();
    }
    if (!key) {
        return;
    }
    const auto tags = m_view.messages().metadata(*key).tags();
    auto places = m_view.messages().tags(*key);
    beginInsertRows({}, 0, static_cast<int>(tags.size() + m_facts.size() + places.size()) - 1);
    m_key = key;
    m_places = std::move(places);
    for (const model::MetadataTag& tag : tags) {
        m_earlier.push_back(earlierValues(tag));
    }
    endInsertRows();
}

bool MetadataModel::insertTags() {
    const auto tags = m_view.messages().metadata(*m_key).tags();
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

bool MetadataModel::fitHistories() {
    bool hasInserted = false;
    bool hasRemoved = false;
    for (std::size_t row = 0; row < m_earlier.size(); ++row) {
        const std::size_t wanted = earlierValues(*tag(static_cast<int>(row)));
        const std::size_t shown = m_earlier[row];
        const QModelIndex parent = index(static_cast<int>(row), 0);
        if (wanted > shown && !std::exchange(hasInserted, true)) {
            beginInsertRows(parent, 0, static_cast<int>(wanted - shown) - 1);
            m_earlier[row] = wanted;
            endInsertRows();
        } else if (wanted < shown && !std::exchange(hasRemoved, true)) {
            beginRemoveRows(parent, 0, static_cast<int>(shown - wanted) - 1);
            m_earlier[row] = wanted;
            endRemoveRows();
        }
    }
    return hasInserted || hasRemoved;
}

void MetadataModel::fitPlaces() {
    auto places = m_view.messages().tags(*m_key);
    const auto ids = &model::TagPlace::id;
    const auto same = std::ranges::mismatch(m_places, places, {}, ids, ids).in1 - m_places.begin();
    const int before = static_cast<int>(m_earlier.size() + m_facts.size());
    const int first = before + static_cast<int>(same);
    if (first < rowCount()) {
        beginRemoveRows({}, first, rowCount() - 1);
        m_places.resize(static_cast<std::size_t>(same));
        endRemoveRows();
    }
    if (const int end = before + static_cast<int>(places.size()); first < end) {
        beginInsertRows({}, first, end - 1);
        m_places = std::move(places);
        endInsertRows();
    } else {
        m_places = std::move(places);
    }
}

std::size_t MetadataModel::earlierValues(const model::MetadataTag& tag) const {
    const model::MetadataTag::Value* current = tag.at(newestVisiblePacket(m_view));
    return current == nullptr ? 0 : static_cast<std::size_t>(current - tag.values.data());
}

const model::MetadataTag* MetadataModel::tag(int row) const {
    if (!m_key || row < 0 || static_cast<std::size_t>(row) >= m_earlier.size()) {
        return nullptr;
    }
    const auto tags = m_view.messages().metadata(*m_key).tags();
    return static_cast<std::size_t>(row) < tags.size() ? &tags[static_cast<std::size_t>(row)] : nullptr;
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
        return m_key ? static_cast<int>(m_earlier.size() + m_facts.size() + m_places.size()) : 0;
    }
    const bool hasHistory =
        parent.internalId() == kTop && parent.column() == 0 && tag(parent.row()) != nullptr;
    return hasHistory ? static_cast<int>(m_earlier[static_cast<std::size_t>(parent.row())]) : 0;
}

MetadataRow MetadataModel::rowAt(const QModelIndex& index) const {
    const bool isTop = index.internalId() == kTop;
    const model::MetadataTag* found = tag(isTop ? index.row() : static_cast<int>(index.internalId()));
    if (found == nullptr) {
        const std::size_t below = static_cast<std::size_t>(index.row()) - m_earlier.size();
        return !isTop || static_cast<std::size_t>(index.row()) < m_earlier.size() ? MetadataRow{}
               : below < m_facts.size() ? MetadataRow{.fact = &m_facts[below]}
                                        : MetadataRow{.place = &m_places[below - m_facts.size()]};
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
    return row.tag != nullptr || row.fact != nullptr || row.place != nullptr ? cell(row, index.column(), role)
                                                                             : QVariant();
}

} // namespace posewire::gui
