// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLabel>

namespace posewire::gui {

/// A label of secondary importance, in the theme's dim colour.
[[nodiscard]] inline QLabel* dimLabel(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

/// The same for sentences: broken into lines where it has to be.
[[nodiscard]] inline QLabel* dimText(const QString& text, QWidget* parent) {
    auto* label = dimLabel(text, parent);
    label->setWordWrap(true);
    return label;
}

} // namespace posewire::gui
