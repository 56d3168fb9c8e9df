// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/keyboard.h"

#include "app/gui/panels/range_bar.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QTabBar>
#include <QToolButton>
#include <QTreeView>

namespace posewire::gui {

namespace {

bool isPressing(const QKeyEvent& event, bool isSpaceOnly) {
    const bool isPlain = (event.modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
    const bool isSpace = event.key() == Qt::Key_Space || event.key() == Qt::Key_Select;
    const bool isEnter = event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter;
    return isPlain && (isSpace || (isEnter && !isSpaceOnly));
}

/// The box in the current row of a table; invalid where it has none.
QModelIndex boxOf(const QAbstractItemView& view) {
    const QModelIndex current = view.currentIndex();
    const int columns = current.isValid() ? current.model()->columnCount(current.parent()) : 0;
    for (int column = 0; column < columns; ++column) {
        const QModelIndex cell = current.siblingAtColumn(column);
        if ((cell.flags() & Qt::ItemIsUserCheckable) != 0 && cell.data(Qt::CheckStateRole).isValid()) {
            return cell;
        }
    }
    return {};
}

void toggle(QAbstractItemView& view, const QModelIndex& box) {
    const bool isOn = box.data(Qt::CheckStateRole).toInt() == Qt::Checked;
    view.model()->setData(box, isOn ? Qt::Unchecked : Qt::Checked, Qt::CheckStateRole);
}

bool isSideways(const QKeyEvent& event) {
    return event.key() == Qt::Key_Left || event.key() == Qt::Key_Right;
}

/// Arrows to the sides step through time, or with Alt go back, where they mean nothing else.
bool wantsArrows(QObject& watched, Qt::KeyboardModifiers modifiers) {
    const auto* tree = qobject_cast<QTreeView*>(&watched);
    const bool isOfMoves =
        tree != nullptr ? tree->rootIsDecorated() : qobject_cast<QTabBar*>(&watched) != nullptr;
    const bool isOfRange =
        qobject_cast<QAbstractSlider*>(&watched) != nullptr || qobject_cast<RangeStrip*>(&watched) != nullptr;
    return isOfMoves ? (modifiers & ~Qt::KeypadModifier) == Qt::NoModifier
                     : isOfRange && !modifiers.testFlag(Qt::AltModifier);
}

void press(QAbstractButton& button) {
    auto* tool = qobject_cast<QToolButton*>(&button);
    if (tool != nullptr && tool->menu() != nullptr && tool->popupMode() == QToolButton::InstantPopup) {
        tool->showMenu();
    } else {
        button.click();
    }
}

} // namespace

PressingKeys::PressingKeys(QObject* parent) : QObject(parent) {
    QCoreApplication::instance()->installEventFilter(this);
}

/// A shortcut takes a key before the widget that has the focus gets it, unless that says that it wants it.
bool PressingKeys::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress) {
        return false;
    }
    auto* key = static_cast<QKeyEvent*>(event);
    if (isSideways(*key) && event->type() == QEvent::ShortcutOverride &&
        wantsArrows(*watched, key->modifiers())) {
        event->accept();
        return true;
    }
    auto* button = qobject_cast<QAbstractButton*>(watched);
    auto* list = qobject_cast<QComboBox*>(watched);
    auto* table = qobject_cast<QAbstractItemView*>(watched);
    if ((button == nullptr && list == nullptr && table == nullptr) || !isPressing(*key, table != nullptr)) {
        return false;
    }
    const QModelIndex box = table != nullptr ? boxOf(*table) : QModelIndex();
    if (table != nullptr && !box.isValid()) {
        return false;
    }
    event->accept();
    if (event->type() == QEvent::KeyPress && !key->isAutoRepeat()) {
        if (button != nullptr) {
            press(*button);
        } else if (list != nullptr) {
            list->showPopup();
        } else {
            toggle(*table, box);
        }
    }
    return true;
}

} // namespace posewire::gui
