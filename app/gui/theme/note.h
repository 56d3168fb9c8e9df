// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLabel>

namespace posewire::gui {

/// Two lines beside what is typed: dim while they explain, in the colour of errors when they say what is
/// wrong. Their room is there from the beginning, so that nothing jumps under the pointer.
class Note final : public QLabel {
    Q_OBJECT

public:
    explicit Note(QWidget* parent);

    void explain(const QString& text);
    void warn(const QString& problem);
};

} // namespace posewire::gui
