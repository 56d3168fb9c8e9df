// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

class QKeyEvent;

namespace posewire::gui {

/// Space and Enter press what has the focus, in the whole program: a button, a list of choices, a box in a
/// table. Elsewhere they are what the menus say.
class PressingKeys final : public QObject {
public:
    /// From now on, as long as the parent lives.
    explicit PressingKeys(QObject* parent);

    bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace posewire::gui
