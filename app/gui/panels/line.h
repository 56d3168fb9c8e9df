// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QPainter>
#include <QWidget>

namespace posewire::gui {

/// A thin line in the theme's colour between the parts of a dock.
class Line : public QWidget {
public:
    explicit Line(QWidget* parent = nullptr) : QWidget(parent) { setFixedHeight(1); }

protected:
    void paintEvent(QPaintEvent*) override { QPainter(this).fillRect(rect(), theme().line); }
};

} // namespace posewire::gui
