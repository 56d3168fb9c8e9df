// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/note.h"

#include "app/gui/theme/theme.h"

namespace posewire::gui {

Note::Note(QWidget* parent) : QLabel(parent) {
    setTextFormat(Qt::PlainText);
    setWordWrap(true);
    setAlignment(Qt::AlignTop);
    setMinimumHeight(2 * fontMetrics().lineSpacing());
}

void Note::explain(const QString& text) {
    setForegroundRole(QPalette::PlaceholderText);
    setText(text);
}

void Note::warn(const QString& problem) {
    setForegroundRole(QPalette::BrightText); // the theme's colour of errors
    setText(healthText(Health::Error, problem));
}

} // namespace posewire::gui
