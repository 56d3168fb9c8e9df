// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/field_problems.h"

#include "app/gui/models/field_text.h"
#include "app/gui/models/text.h"

#include <QCoreApplication>

namespace posewire::gui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("FieldProblems", text);
}

QString number(std::uint64_t value) {
    return grouped(value);
}

/// "Segment 16 · Left Upper Leg, orientation".
QString place(const FieldDocument& document, std::int32_t node) {
    const std::int32_t item = document.itemOf(node);
    const QString field = fieldTitle(document, node);
    return item < 0 || item == node ? field : tr("%1, %2").arg(fieldTitle(document, item), field.toLower());
}

/// What the field that reading ended in lacks.
QString cutText(const FieldDocument& document) {
    const wire::FieldTree& tree = document.tree();
    const wire::WireError& error = tree.cutError;
    if (tree.cutNode < 0) {
        return {};
    }
    const QString where = place(document, tree.cutNode);
    const auto length = static_cast<std::int32_t>(error.need);
    switch (error.code) {
    case wire::ErrorCode::FieldTruncated:
        return error.have == 0
                   ? tr("%1 needs %2 bytes, none is left").arg(where, number(error.need))
                   : tr("%1 needs %2 bytes, %3 are there").arg(where, number(error.need), number(error.have));
    case wire::ErrorCode::BadLength:
        return length < 0 ? tr("the length of %1 is negative (%2)").arg(where).arg(length)
                          : tr("%1 is announced with %2 bytes, %3 are left")
                                .arg(where, number(error.need), number(error.have));
    case wire::ErrorCode::CountTooLarge:
        return tr("%1 is %2, the rest can hold at most %3")
            .arg(where, number(error.need), number(error.have));
    case wire::ErrorCode::BadSequence:
        return tr("%1 is not UTF-8").arg(where);
    case wire::ErrorCode::UnterminatedText:
        return tr("%1 has no terminating zero byte").arg(where);
    default:
        return {};
    }
}

QString datagramText(const FieldDocument& document) {
    const wire::WireError& fault = *document.tree().fault;
    const QString size = number(document.bytes().size());
    switch (fault.code) {
    case wire::ErrorCode::HeaderTruncated:
        return tr("the datagram ends at byte %1, within its header of 24").arg(size);
    case wire::ErrorCode::PayloadTruncated:
        return tr("the datagram ends at byte %1, its header announces %2").arg(size, number(fault.need));
    case wire::ErrorCode::ItemsTruncated:
        return tr("the %1 announced items do not fit, %2 bytes are missing")
            .arg(number(document.header().items), number(fault.need - fault.have));
    case wire::ErrorCode::BadType:
        return tr("MXTP is not followed by two digits");
    case wire::ErrorCode::TooLong:
        return tr("longer than any datagram can be");
    default:
        return {};
    }
}

} // namespace

QString faultText(const FieldDocument& document) {
    const QString whole = datagramText(document);
    const QString near = cutText(document);
    const std::int32_t cut = document.tree().cutNode;
    const std::uint32_t offset = cut >= 0 ? document.node(cut).offset : document.tree().fault->offset;
    const QString both = whole.isEmpty() || near.isEmpty() ? whole + near : tr("%1; %2").arg(whole, near);
    return tr("malformed: %1 (byte %2)").arg(both, number(offset));
}

QString unreadText(const FieldDocument& document) {
    const wire::FieldNode& rest = document.tree().nodes.back();
    return tr("%1 bytes from byte %2 are unread").arg(number(rest.length), number(rest.offset));
}

QString outsideText(const FieldDocument& document) {
    return document.kind() == model::PacketKind::Skipped
               ? tr("skipped: bytes of a byte stream that belong to no datagram")
               : tr("foreign: does not begin with MXTP, so no sender of motion capture data sent this");
}

QString cutByReceiverText(const FieldDocument& document) {
    return tr("longer than what could be received: only the first %1 bytes are here")
        .arg(number(document.bytes().size()));
}

QString noticeWords(const wire::Notice& notice) {
    return QString::fromStdString(wire::noticeText(notice));
}

} // namespace posewire::gui
