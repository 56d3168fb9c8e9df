// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/passing_message.h"

namespace posewire::gui {

PassingMessage::PassingMessage(int milliseconds, QWidget* parent) : QLabel(parent) {
    hide();
    m_timer.setSingleShot(true);
    m_timer.setInterval(milliseconds);
    connect(&m_timer, &QTimer::timeout, this, &QWidget::hide);
}

void PassingMessage::say(const QString& text) {
    setText(text);
    setToolTip(text);
    show();
    m_timer.start();
}

} // namespace posewire::gui
