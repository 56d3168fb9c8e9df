// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/combo_box.h"

#include "app/gui/theme/theme.h"

#include <QPainter>

namespace posewire::gui {

void ComboBox::paintEvent(QPaintEvent* event) {
    QComboBox::paintEvent(event);
    QPainter painter(this);
    painter.setPen(isEnabled() ? theme().text : theme().dim);
    const int space = fontMetrics().averageCharWidth();
    painter.drawText(rect().adjusted(0, 0, -space, 0), Qt::AlignRight | Qt::AlignVCenter,
                     QStringLiteral("▾"));
}

} // namespace posewire::gui
