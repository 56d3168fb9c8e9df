// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/ending_signals.h"

namespace posewire::gui {

EndingSignals::EndingSignals(QObject* parent)
    : QObject(parent), m_request([this] {
          QMetaObject::invokeMethod(this, &EndingSignals::requested, Qt::QueuedConnection);
      }) {}

} // namespace posewire::gui
