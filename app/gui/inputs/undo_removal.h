// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPushButton>

#include <functional>

class QUndoStack;

namespace posewire::gui {

/// The button that takes back what was removed from a list, the newest first; Ctrl+Z does the same wherever
/// the focus is in `page`, and Ctrl+Shift+Z removes it again.
class UndoRemoval final : public QPushButton {
    Q_OBJECT

public:
    explicit UndoRemoval(QWidget* page);

    /// Removes at once. `what` is what is removed: "UDP port 9763".
    void carryOut(const QString& what, std::function<void()> remove, std::function<void()> restore);

private:
    void showNext();

    QUndoStack* m_removals;
};

} // namespace posewire::gui
