// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/export/json.h"
#include "core/export/sheets.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/wire/text.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace posewire::gui {

namespace {

using namespace std::chrono_literals;

constexpr int kTimeDecimals = 4;
constexpr double kMsPerSecond = 1000;
constexpr std::uint64_t kMostRows = std::numeric_limits<int>::max() - 1;

using PacketColumn = TableColumn<PacketFacts>;

QVariant warningWhere(bool isOdd) {
    return isOdd ? QVariant(theme().warning) : QVariant();
}

QVariant dimWhereStrange(const PacketFacts& facts) {
    return isStrange(facts.digest) ? QVariant(theme().dim) : QVariant();
}

QVariant typeColour(const PacketFacts& facts) {
    if (packetHealth(facts) == Health::Error) {
        return healthColour(Health::Error);
    }
    const bool describesBody = facts.digest.type >= 10 && facts.digest.type <= 13;
    return isStrange(facts.digest) ? QVariant(theme().dim)
           : describesBody         ? QVariant(theme().accent)
                                   : QVariant();
}

QVariant noteColour(const PacketFacts& facts) {
    const Health health = packetHealth(facts);
    return health == Health::Unknown ? theme().dim : healthColour(health);
}

QString characterText(const PacketFacts& facts) {
    return facts.header ? QString::number(facts.header->character) : QString();
}

QString sampleText(const PacketFacts& facts) {
    return facts.header ? grouped(facts.header->sampleCounter) : QString();
}

QVariant sampleColour(const PacketFacts& facts) {
    const model::PacketDigest& digest = facts.digest;
    return warningWhere(digest.isDuplicate || digest.isReordered || digest.isRestart || digest.isInDoubt);
}

constexpr std::size_t kBytesInLine = 16;
constexpr std::size_t kBytesInRow = 12; // of a C array: 72 columns

QString hexText(wire::Bytes bytes) {
    QString text;
    for (std::size_t begin = 0; begin < bytes.size(); begin += kBytesInLine) {
        const wire::Bytes line = bytes.subspan(begin, std::min(kBytesInLine, bytes.size() - begin));
        const QString digits = QString::fromLatin1(QByteArrayView(line).toByteArray().toHex(' '));
        text += QStringLiteral("%1  %2 %3\n")
                    .arg(begin, 4, 16, QLatin1Char('0'))
                    .arg(digits.leftJustified(kBytesInLine * 3), readable(line));
    }
    return text;
}

QString cArray(wire::Bytes bytes, std::uint64_t number) {
    QString text = QStringLiteral("const unsigned char packet%1[%2] = {").arg(number).arg(bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        text += i % kBytesInRow == 0 ? QStringLiteral("\n    0x") : QStringLiteral(" 0x");
        text += QStringLiteral("%1,").arg(std::to_integer<unsigned>(bytes[i]), 2, 16, QLatin1Char('0'));
    }
    return text + QStringLiteral("\n};\n");
}

QString json(model::SessionView& view, const log::Packet& packet) {
    const auto sender = view.log().senders().find(packet.sender);
    const exporting::DatagramPlace place{packet.number, 0, view.wallOf(packet.stamp),
                                         sender == nullptr ? std::nullopt : std::optional(sender->address)};
    const std::string object = packet.flags.skipped ? exporting::skippedJson(place, packet.bytes.size())
                                                    : exporting::datagramJson(place, packet.bytes);
    return QString::fromStdString(object) + QLatin1Char('\n');
}

} // namespace

std::vector<PacketColumn> PacketModel::columns(const PacketModel& model) {
    const auto sender = [&model](const PacketFacts& facts) { return model.senderText(facts); };
    const auto note = [&model](const PacketFacts& facts) {
        return packetNote(model.m_view, facts, NoteFor::Eye);
    };
    std::vector<PacketColumn> columns{
        PacketColumn::numbers(tr("No."), tr("Number in the order of arrival, from 0"),
                              [](const auto& facts) { return grouped(facts.number); }),
        PacketColumn::numbers(tr("Time s"), tr("When it arrived; the context menu has other ways"),
                              [&model](const auto& facts) { return model.timeText(facts); }),
        PacketColumn::numbers(tr("Δ ms"), tr("Since the packet before it in its stream"),
                              [&model](const auto& facts) { return fixed(model.deltaMs(facts), 2); })
            .withColour([](const PacketFacts& facts) {
                return warningWhere(facts.digest.gap != 0 || facts.digest.followsDrops);
            }),
        PacketColumn::words(tr("Sender"), tr("Address and port of the sender"), sender).withToolTip(sender),
        PacketColumn::words(tr("Type"), tr("Message type"), packetType)
            .withColour(typeColour)
            .withToolTip(packetType),
        PacketColumn::words(tr("Char"), tr("Character ID and name"), characterText),
        PacketColumn::numbers(tr("Sample"), tr("Sample counter"), sampleText).withColour(sampleColour),
        PacketColumn::numbers(tr("Part"), tr("Which of the datagrams of its sample, and of how many"),
                              [&model](const auto& facts) { return packetPart(model.m_view, facts); }),
        PacketColumn::numbers(tr("Size"), tr("Bytes of the datagram, header included"),
                              [](const auto& facts) { return grouped(facts.size); }),
        PacketColumn::words(tr("Note"), tr("What is odd about it, and comments"), note)
            .withColour(noteColour)
            .withToolTip(note),
    };
    const auto give = [&columns](Column column, ColumnRoom room) { columns[column].room = std::move(room); };
    give(kNumber, {.usual = grouped(9'999'999), .order = 3});
    give(kTime, {.usual = QStringLiteral("9999.9999")});
    give(kDelta, {.usual = QStringLiteral("9999.99")});
    give(kSender, {.usual = QStringLiteral("192.168.10.21:52011")});
    give(kType,
         {.usual = QStringLiteral("22 Angular k"), .wish = typeTitle(22), .least = QStringLiteral("22 An")});
    give(kCharacter, {.usual = QStringLiteral("● 0 Mira"),
                      .wish = QStringLiteral("● 10 Mira Lindqvist"),
                      .least = QStringLiteral("● 10")});
    give(kSample, {.usual = grouped(99'999)});
    give(kPart, {.usual = QStringLiteral("1/1"), .order = 1});
    give(kSize, {.usual = QStringLiteral("9 999"), .order = 2});
    give(kNote, {.usual = tr("▲ network: 1 lost"), .order = 4, .isOpen = true});
    columns[kCharacter].more = [&model](const PacketFacts& facts, int role) {
        return model.characterMark(facts, role);
    };
    columns[kSize].colour = [](const PacketFacts& facts) {
        return packetHealth(facts) == Health::Error ? QVariant(theme().error) : QVariant();
    };
    columns[kNote].spoken = [&model](const PacketFacts& facts) {
        return packetNote(model.m_view, facts, NoteFor::Ear);
    };
    for (const Column column : {kNumber, kTime, kSender, kCharacter, kPart}) {
        columns[column].colour = dimWhereStrange;
    }
    return columns;
}

PacketModel::PacketModel(model::SessionView& view) : ColumnModel(columns(*this)), m_view(view) {}

void PacketModel::refresh() {
    m_facts.reset();
    removeDropped();
    if (const int rows = rowsThere(); rows > m_rows) {
        beginInsertRows({}, m_rows, rows - 1);
        m_rows = rows;
        endInsertRows();
    }
    // If everything comes from one sender, its address says nothing, and the note has the room.
    const bool hasSenders = m_view.roster().senders().size() > 1;
    if (std::exchange(m_hasSenders, hasSenders) != hasSenders) {
        emit headerDataChanged(Qt::Horizontal, kSender, kSender);
    }
    const model::Annotations& annotations = m_view.choices().annotations;
    const model::Cursor& cursor = m_view.choices().cursor;
    const bool isChanged =
        annotations != m_annotations || cursor.mode != m_cursor.mode || cursor.packet != m_cursor.packet;
    if (isChanged && rowCount() > 0) {
        m_annotations = annotations;
        m_cursor = cursor;
        announceChange();
    }
}

ColumnRoom PacketModel::room(int column) const {
    ColumnRoom given = ColumnModel::room(column);
    if (column == kTime && m_timeMode == TimeMode::TimeOfDay) {
        given.usual = QStringLiteral("2026-11-21 10:42:17.508123");
    } else if (column == kSender && !m_hasSenders) {
        given.order = ColumnRoom::kOnChoice;
    }
    return given;
}

void PacketModel::removeDropped() {
    const std::uint64_t begin = m_view.accounts().digests().begin();
    const int rows = rowFrom(begin);
    if (rows > 0) {
        beginRemoveRows({}, 0, rows - 1);
    }
    if (m_isFiltered) {
        m_matches.dropBefore(begin);
    } else {
        m_begin = std::max(begin, m_begin);
    }
    m_rows -= rows;
    m_removed += static_cast<std::uint64_t>(rows);
    if (rows > 0) {
        endRemoveRows();
    }
}

int PacketModel::rowsThere() const {
    const std::uint64_t all = m_isFiltered ? m_matches.size() : m_view.accounts().digests().end() - m_begin;
    return static_cast<int>(std::min(all, kMostRows));
}

void PacketModel::startAgain(bool isFiltered) {
    beginResetModel();
    m_facts.reset();
    m_isFiltered = isFiltered;
    m_matches.clear();
    if (!isFiltered) {
        m_begin = m_view.accounts().digests().begin();
        m_removed = m_begin;
    }
    m_rows = rowsThere();
    endResetModel();
}

void PacketModel::setTimeMode(TimeMode mode) {
    m_timeMode = mode;
    announceColumn(kTime);
}

void PacketModel::setDeltaMode(DeltaMode mode) {
    m_deltaMode = mode;
    announceColumn(kDelta);
}

void PacketModel::announceColumn(int column) {
    emit headerDataChanged(Qt::Horizontal, column, column);
    if (rowCount() > 0) {
        emit dataChanged(index(0, column), index(rowCount() - 1, column));
    }
}

std::uint64_t PacketModel::packetAt(int row) const {
    return m_isFiltered ? m_matches[static_cast<std::size_t>(row)]
                        : m_begin + static_cast<std::uint64_t>(row);
}

int PacketModel::rowFrom(std::uint64_t number) const {
    if (!m_isFiltered) {
        return static_cast<int>(std::clamp(number, m_begin, m_begin + static_cast<std::uint64_t>(m_rows)) -
                                m_begin);
    }
    return static_cast<int>(std::min(m_matches.placeOf(number), static_cast<std::size_t>(m_rows)));
}

int PacketModel::rowOf(std::uint64_t number) const {
    const int row = rowFrom(number);
    return row < rowCount() && packetAt(row) == number ? row : -1;
}

int PacketModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : m_rows;
}

const PacketFacts* PacketModel::facts(int row) const {
    const std::uint64_t number = packetAt(row);
    if (!m_facts || m_facts->number != number) {
        m_facts = packetFacts(m_view, number);
    }
    return m_facts ? &*m_facts : nullptr;
}

QString PacketModel::timeText(const PacketFacts& facts) const {
    if (m_timeMode == TimeMode::SinceFirst) {
        return fixed(log::secondsOf(facts.stamp - m_view.firstStamp()), kTimeDecimals);
    }
    const log::WallTime time = m_view.wallOf(facts.stamp);
    const std::int64_t microseconds = (time - std::chrono::floor<std::chrono::milliseconds>(time)) / 1us;
    return dateTimeOf(time).toString(QStringLiteral("yyyy-MM-dd HH:mm:ss.zzz")) +
           QStringLiteral("%1").arg(microseconds, 3, 10, QLatin1Char('0'));
}

double PacketModel::deltaMs(const PacketFacts& facts) const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (m_deltaMode == DeltaMode::Stream) {
        return facts.digest.deltaS < 0 ? kNone : static_cast<double>(facts.digest.deltaS) * kMsPerSecond;
    }
    const int row = rowOf(facts.number);
    const auto above = row > 0 ? m_view.packet(packetAt(row - 1)) : std::nullopt;
    using Milliseconds = std::chrono::duration<double, std::milli>;
    return above ? Milliseconds(facts.stamp - above->stamp).count() : kNone;
}

QString PacketModel::senderText(const PacketFacts& facts) const {
    const auto info = m_view.log().senders().find(facts.sender);
    return info != nullptr ? shownText(info->address) : QString();
}

QVariant PacketModel::characterMark(const PacketFacts& facts, int role) const {
    const model::CharacterKey key{facts.sender, facts.digest.character};
    if ((role != kDotRole && role != kSuffixRole) || !facts.header || m_view.roster().find(key) == nullptr) {
        return {};
    }
    return role == kDotRole ? QVariant::fromValue(gui::characterMark(m_view, key))
                            : characterName(m_view, key);
}

QVariant PacketModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    const int row = index.row();
    if (role == kStripeRole) {
        return (m_removed + static_cast<std::uint64_t>(row)) % 2 != 0;
    }
    if (role == kPausedHereRole) {
        return m_view.choices().cursor.mode == model::Cursor::Mode::Paused &&
               row + 1 == rowFrom(m_view.choices().cursor.packet + 1);
    }
    if (role == Qt::TextAlignmentRole) {
        return headerData(index.column(), Qt::Horizontal, role); // no packet has to be read for that
    }
    if (const PacketFacts* shown = facts(row)) {
        return cell(*shown, index.column(), role);
    }
    return role == Qt::DisplayRole && index.column() == kNumber ? grouped(packetAt(row)) : QVariant();
}

QVariant PacketModel::headerData(int section, Qt::Orientation orientation, int role) const {
    const bool isTitle = orientation == Qt::Horizontal && role == Qt::DisplayRole;
    const bool isHelp = orientation == Qt::Horizontal && role == Qt::ToolTipRole;
    if (isTitle && section == kTime && m_timeMode == TimeMode::TimeOfDay) {
        return tr("Date and time");
    }
    if ((isTitle || isHelp) && section == kDelta && m_deltaMode == DeltaMode::RowAbove) {
        return isTitle ? tr("Δ row ms") : tr("Since the row above");
    }
    return ColumnModel::headerData(section, orientation, role);
}

QString packetBytesText(model::SessionView& view, std::uint64_t number, ByteFormat format) {
    const auto packet = view.packet(number);
    if (!packet) {
        return {};
    }
    switch (format) {
    case ByteFormat::Text:
        return hexText(packet->bytes);
    case ByteFormat::Raw:
        return QString::fromStdString(wire::hexadecimal(packet->bytes));
    case ByteFormat::CArray:
        return cArray(packet->bytes, number);
    case ByteFormat::Json:
        return json(view, *packet);
    }
    return {};
}

QString packetRowsText(const PacketModel& model, std::span<const int> rows) {
    QString text;
    for (const int row : rows) {
        for (int column = 0; column < model.columnCount(); ++column) {
            text += (column == 0 ? QString() : QStringLiteral("\t")) + cellText(model.index(row, column));
        }
        text += QLatin1Char('\n');
    }
    return text;
}

QString packetRowsCsv(const PacketModel& model, std::span<const int> rows) {
    std::vector<std::string> cells;
    for (int column = 0; column < model.columnCount(); ++column) {
        cells.push_back(model.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString().toStdString());
    }
    std::string text = exporting::csvLine(cells);
    for (const int row : rows) {
        cells.clear();
        for (int column = 0; column < model.columnCount(); ++column) {
            const QModelIndex index = model.index(row, column);
            QString content = cellText(index);
            if (index.data(Qt::TextAlignmentRole).isValid()) {
                content.remove(QChar(0x202f)).replace(QChar(0x2212), QLatin1Char('-'));
                cells.push_back(content.toStdString());
            } else {
                cells.push_back(model::csvText(content.toStdString()));
            }
        }
        text += exporting::csvLine(cells);
    }
    return QString::fromStdString(text);
}

} // namespace posewire::gui
