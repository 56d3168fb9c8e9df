// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_text.h"

#include "app/gui/models/packet_model.h"
#include "app/gui/models/text.h"
#include "core/export/json.h"
#include "core/export/sheets.h"
#include "core/wire/text.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr std::size_t kBytesInLine = 16;
constexpr std::size_t kBytesInRow = 12; // of a C array: 72 columns

QString hexByte(std::byte byte) {
    return QStringLiteral("%1").arg(std::to_integer<unsigned>(byte), 2, 16, QLatin1Char('0'));
}

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
        text += hexByte(bytes[i]) + QLatin1Char(',');
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
