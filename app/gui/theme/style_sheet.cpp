// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/style_sheet.h"

#include "app/gui/theme/theme.h"

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::gui {

namespace {

constexpr const char* kSheet = R"(
QMainWindow, QDialog, QMessageBox { background: @window; }
QMainWindow::separator { background: @window; width: 3px; height: 3px; }
QMainWindow::separator:hover { background: @accent; }
QToolTip { background: @raised; color: @text; border: 1px solid @line; padding: 4px 6px; }

QMenuBar { background: @window; border: none; border-bottom: 1px solid @line; padding: 2px 4px; }
QToolBar { background: @window; border: none; padding: 0; margin: 0; spacing: 6px; }
QStatusBar { background: @window; border-top: 1px solid @line; }
QStatusBar::item { border: none; }
QDockWidget { border: none; }
QMenuBar::item { background: transparent; padding: @menuv 9px; border-radius: 4px; }
QMenuBar::item:selected { background: @raised; }
QMenu { background: @raised; border: 1px solid @line; padding: 5px 0; }
QMenu::item { padding: @menuv 28px @menuv 26px; }
QMenu::item:selected { background: @selection; color: @text; }
QMenu::item:disabled { color: @dim; }
QMenu::separator { height: 1px; background: @line; margin: 5px 0; }
QMenu::indicator { left: 8px; }

QAbstractItemView { background: @panel; alternate-background-color: @stripe; border: none; outline: none;
  selection-background-color: @selection; selection-color: @text; }
QTreeView, QTableView, QListView { gridline-color: @line; }
QTreeView::item, QListView::item { height: @row; border: none; }
QTableView::item { padding: 0 4px; border: none; }
QTreeView::item:selected, QTableView::item:selected, QListView::item:selected { background: @selection; color: @text; }
QTreeView::item:hover:!selected, QListView::item:hover:!selected { background: @raised; }
QListView[popup="true"] { background: @raised; border: 1px solid @line; }
QHeaderView { background: @panel; border: none; }
QHeaderView::section { background: @panel; color: @dim; border: none; border-bottom: 1px solid @line; padding: 0 6px;
  height: @row; font-weight: normal; }
QTableCornerButton::section { background: @panel; border: none; }

QPushButton, QToolButton[framed="true"], QComboBox { background: @raised; color: @text; border: 1px solid @line;
  border-radius: 5px; padding: @buttonv 10px; }
QPushButton:hover, QToolButton[framed="true"]:hover, QComboBox:hover { border-color: @dim; }
QPushButton:pressed, QToolButton[framed="true"]:pressed { background: @selection; }
QPushButton:disabled, QToolButton[framed="true"]:disabled { color: @dim; }
QPushButton:focus, QToolButton[framed="true"]:focus, QComboBox:focus, QLineEdit:focus { border-color: @accent; }
QComboBox { padding-right: 22px; }
QComboBox::drop-down { border: none; width: 0; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QToolButton[framed="true"]:checked { background: @selection; border-color: @accent; }
QToolButton[framed="true"]::menu-indicator { image: none; width: 0; }
QToolButton[live="true"] { background: @goodfill; color: @good; border: 1px solid @good; border-radius: 5px;
  padding: @buttonv 10px; font-weight: 600; }
QToolButton[live="false"] { background: @raised; color: @dim; border: 1px solid @line; border-radius: 5px;
  padding: @buttonv 10px; font-weight: 600; }
QToolButton[live="false"]:hover { color: @text; border-color: @good; }
QToolButton[flat="true"] { background: transparent; border: 1px solid transparent; border-radius: 4px; padding: 1px; }
QToolButton[flat="true"]::menu-indicator { image: none; width: 0; }
QToolButton[flat="true"]:hover { background: @raised; border-color: @line; }
QToolButton[flat="true"]:focus { border-color: @accent; }
QToolButton[flat="true"]:checked { background: @selection; color: @text; border-color: @accent; }
QLineEdit, QSpinBox, QPlainTextEdit, QTextEdit, QTextBrowser { background: @panel; color: @text; border: 1px solid @line;
  border-radius: 5px; padding: 3px 6px; selection-background-color: @selection; selection-color: @text; }

QTabBar::tab { background: @header; color: @dim; border: none; border-right: 1px solid @line;
  border-top: 2px solid transparent; padding: @menuv 12px; }
QTabBar::tab:selected { background: @panel; color: @text; border-top-color: @accent; }
QTabBar::tab:hover:!selected { color: @text; }
QTabWidget::pane { border: none; }

QScrollBar:vertical { background: transparent; width: 10px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 0; }
QScrollBar::handle { background: @handle; border-radius: 3px; margin: 2px; }
QScrollBar::handle:vertical { min-height: 28px; }
QScrollBar::handle:horizontal { min-width: 28px; }
QScrollBar::handle:hover { background: @dim; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QSplitter::handle { background: @line; }
QScrollArea { background: transparent; border: none; }
)";

} // namespace

QString styleSheet(const Theme& theme, const QFontMetrics& metrics) {
    const auto pixels = [](int value) { return QString::number(value) + QStringLiteral("px"); };
    // Longer names first, so that no name is taken for the beginning of another.
    std::array<std::pair<QString, QString>, 17> values{{
        {"@window", theme.window.name()},
        {"@panel", theme.panel.name()},
        {"@raised", theme.raised.name()},
        {"@header", theme.header.name()},
        {"@handle", mixed(theme.line, theme.dim, 0.35).name()},
        {"@line", theme.line.name()},
        {"@text", theme.text.name()},
        {"@dim", theme.dim.name()},
        {"@accent", theme.accent.name()},
        {"@selection", theme.selection.name()},
        {"@stripe", mixed(theme.panel, theme.window, 0.35).name()},
        {"@goodfill", mixed(theme.panel, theme.good, 0.16).name()},
        {"@good", theme.good.name()},
        {"@row", pixels(metrics.height() + 8)},
        {"@menuv", pixels(std::max(3, metrics.height() / 4))},
        {"@buttonv", pixels(std::max(3, metrics.height() / 4))},
        {"@error", theme.error.name()},
    }};
    QString sheet = QString::fromLatin1(kSheet);
    for (const auto& [name, value] : values) {
        sheet.replace(name, value);
    }
    return sheet;
}

} // namespace posewire::gui
