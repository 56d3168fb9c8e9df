// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/undo_removal.h"

#include "app/gui/theme/theme.h"

#include <QShortcut>
#include <QUndoStack>

#include <utility>

namespace posewire::gui {
namespace {

constexpr int kMostRemovals = 100;

class Removal final : public QUndoCommand {
public:
    Removal(const QString& what, std::function<void()> remove, std::function<void()> restore)
        : QUndoCommand(what), m_remove(std::move(remove)), m_restore(std::move(restore)) {}

    void redo() override { m_remove(); }
    void undo() override { m_restore(); }

private:
    std::function<void()> m_remove;
    std::function<void()> m_restore;
};

} // namespace

UndoRemoval::UndoRemoval(QWidget* page)
    : QPushButton(tr("&Undo"), page),
      m_removals(new QUndoStack(page)) { // outlives the button, which it would call as it ends
    m_removals->setUndoLimit(kMostRemovals);
    setObjectName(QStringLiteral("undoRemoval"));
    connect(this, &QPushButton::clicked, m_removals, &QUndoStack::undo);
    connect(m_removals, &QUndoStack::indexChanged, this, &UndoRemoval::showNext);
    const auto reach = Qt::WidgetWithChildrenShortcut;
    new QShortcut(QKeySequence::Undo, page, m_removals, &QUndoStack::undo, reach);
    new QShortcut(QKeySequence::Redo, page, m_removals, &QUndoStack::redo, reach);
    showNext();
}

void UndoRemoval::carryOut(const QString& what, std::function<void()> remove, std::function<void()> restore) {
    m_removals->push(new Removal(what, std::move(remove), std::move(restore)));
}

void UndoRemoval::showNext() {
    const QString what = m_removals->undoText();
    setEnabled(m_removals->canUndo());
    const QString text = what.isEmpty() ? tr("Nothing was removed") : tr("Put back %1").arg(what);
    setAccessibleName(what.isEmpty() ? tr("Undo") : tr("Undo: put back %1").arg(what));
    setToolTip(toolTipText(text + QStringLiteral(" (%1)").arg(
                                      QKeySequence(QKeySequence::Undo).toString(QKeySequence::NativeText))));
}

} // namespace posewire::gui
