// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/field_document.h"

/// What is wrong with a packet, in sentences that an operator can act on.
namespace posewire::gui {

/// The document has a fault.
[[nodiscard]] QString faultText(const FieldDocument& document);
/// How far it was read.
[[nodiscard]] QString unreadText(const FieldDocument& document);
/// What bytes are that are no datagram.
[[nodiscard]] QString outsideText(const FieldDocument& document);
[[nodiscard]] QString cutByReceiverText(const FieldDocument& document);
[[nodiscard]] QString noticeWords(const wire::Notice& notice);

} // namespace posewire::gui
