// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/command_palette.h"

#include "app/gui/theme/theme.h"

#include <QAction>
#include <QCoreApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QVBoxLayout>

#include <algorithm>
#include <iterator>
#include <utility>

namespace posewire::gui {

namespace {

constexpr int kRows = 14; ///< in sight

/// See synonymsOf().
constexpr std::pair<const char*, const char*> kSynonyms[] = {
    {"pause", QT_TRANSLATE_NOOP("Action", "freeze stop hold")},
    {"live", QT_TRANSLATE_NOOP("Action", "now follow end")},
    {"loop", QT_TRANSLATE_NOOP("Action", "repeat cycle")},
    {"rangeIn", QT_TRANSLATE_NOOP("Action", "in mark trim select")},
    {"rangeOut", QT_TRANSLATE_NOOP("Action", "out mark trim select")},
    {"record", QT_TRANSLATE_NOOP("Action", "take capture")},
    {"inputs", QT_TRANSLATE_NOOP("Action", "port network udp tcp address cable connect")},
    {"waysOut", QT_TRANSLATE_NOOP("Action", "relay forward send on osc vmc json outlet")},
    {"thresholds", QT_TRANSLATE_NOOP("Action", "limits alarm sound mute beep notification")},
    {"preferences", QT_TRANSLATE_NOOP("Action", "settings options configure")},
    {"recordingOptions", QT_TRANSLATE_NOOP("Action", "take disk files split")},
    {"themeSystem", QT_TRANSLATE_NOOP("Action", "colours night mode contrast")},
    {"interpolation", QT_TRANSLATE_NOOP("Action", "smooth")},
    {"connectionHelp", QT_TRANSLATE_NOOP("Action", "cable firewall nothing arrives")},
    {"statistics", QT_TRANSLATE_NOOP("Action", "fps rate jitter loss bandwidth cpu")},
    {"metadata", QT_TRANSLATE_NOOP("Action", "units revision up axis tags name colour")},
};

void collect(const QList<QAction*>& actions, const QString& menu, std::vector<Command>& into) {
    static const QRegularExpression mnemonic(QStringLiteral("&(.)"));
    for (QAction* action : actions) {
        const QString name = action->text().replace(mnemonic, QStringLiteral("\\1"));
        if (action->menu() != nullptr) {
            emit action->menu()->aboutToShow(); // its entries are as when it is opened
            collect(action->menu()->actions(), menu.isEmpty() ? name : menu + QStringLiteral(" › ") + name,
                    into);
        } else if (!action->isSeparator() && action->isVisible() && !name.isEmpty()) {
            const QObject* named = action->objectName().isEmpty() ? action->parent() : action;
            into.push_back(
                {action, name, menu, synonymsOf(named->objectName()), action->shortcut().toString()});
        }
    }
}

QStringList wordsOf(const QString& text) {
    static const QRegularExpression between(QStringLiteral("[^\\p{L}\\p{N}]+"));
    return text.split(between, Qt::SkipEmptyParts);
}

} // namespace

QString synonymsOf(const QString& id) {
    const auto found =
        std::ranges::find_if(kSynonyms, [&](const auto& one) { return id == QLatin1String(one.first); });
    return found == std::end(kSynonyms) ? QString() : QCoreApplication::translate("Action", found->second);
}

std::vector<Command> commandsOf(const QMenuBar& bar) {
    std::vector<Command> commands;
    collect(bar.actions(), {}, commands);
    return commands;
}

bool isMeant(const Command& command, const QString& typed) {
    const QStringList words =
        wordsOf(command.name) + wordsOf(command.menu) + wordsOf(command.synonyms) + wordsOf(command.keys);
    return std::ranges::all_of(wordsOf(typed), [&](const QString& wanted) {
        return std::ranges::any_of(
            words, [&](const QString& word) { return word.startsWith(wanted, Qt::CaseInsensitive); });
    });
}

CommandPalette::CommandPalette(const QMenuBar& bar, QWidget* window)
    : QDialog(window), m_commands(commandsOf(bar)) {
    setWindowTitle(tr("Commands"));
    m_line->setPlaceholderText(tr("What to do: words of a command or of its menu"));
    m_line->setAccessibleName(tr("Words of a command"));
    m_line->setClearButtonEnabled(true);
    m_line->installEventFilter(this);
    m_list->setAccessibleName(tr("Commands"));
    m_list->setColumnCount(3);
    m_list->setHeaderLabels({tr("Command"), tr("Menu"), tr("Shortcut")});
    m_list->setRootIsDecorated(false);
    m_list->setUniformRowHeights(true);
    m_list->setAllColumnsShowFocus(true);
    m_list->setFocusPolicy(Qt::NoFocus);
    m_list->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_list->header()->setStretchLastSection(false);
    auto* column = new QVBoxLayout(this);
    column->addWidget(m_line);
    column->addWidget(m_list);
    connect(m_line, &QLineEdit::textChanged, this, &CommandPalette::list);
    connect(m_line, &QLineEdit::returnPressed, this, &CommandPalette::choose);
    connect(m_list, &QTreeWidget::itemClicked, this, &CommandPalette::choose);
    list({});
    const int row = m_list->sizeHintForRow(0);
    const int width = std::min(fontMetrics().averageCharWidth() * 84, window->width() - row);
    const int height = m_line->sizeHint().height() + (kRows + 3) * row;
    resize(width, std::min(height, window->height() - 2 * row));
    move(window->geometry().left() + (window->width() - this->width()) / 2,
         window->geometry().top() + 2 * row);
}

/// The one of that name comes first, then those whose name begins with what is typed. What cannot be carried
/// out now comes last, and is never the current one.
void CommandPalette::list(const QString& typed) {
    m_list->clear();
    std::vector<std::size_t> meant;
    for (std::size_t i = 0; i < m_commands.size(); ++i) {
        if (isMeant(m_commands[i], typed)) {
            meant.push_back(i);
        }
    }
    const auto disabled = std::stable_partition(
        meant.begin(), meant.end(), [this](std::size_t i) { return m_commands[i].action->isEnabled(); });
    std::stable_sort(meant.begin(), disabled, [&](std::size_t a, std::size_t b) {
        const auto rank = [&](const QString& name) {
            const bool isBegin = name.startsWith(typed.trimmed(), Qt::CaseInsensitive);
            return isBegin && name.size() == typed.trimmed().size() ? 0 : isBegin ? 1 : 2;
        };
        return rank(m_commands[a].name) < rank(m_commands[b].name);
    });
    m_choices = static_cast<int>(std::distance(meant.begin(), disabled));
    for (const std::size_t i : meant) {
        const Command& command = m_commands[i];
        const QAction& action = *command.action;
        const QString name = action.isChecked() ? QStringLiteral("✓ ") + command.name : command.name;
        auto* row = new QTreeWidgetItem(
            m_list, {name, command.menu, action.shortcut().toString(QKeySequence::NativeText)});
        row->setData(0, Qt::UserRole, static_cast<qulonglong>(i));
        row->setDisabled(!action.isEnabled());
        row->setForeground(1, theme().dim);
        row->setForeground(2, theme().dim);
    }
    if (meant.empty()) {
        auto* row = new QTreeWidgetItem(m_list, {tr("No command has these words.")});
        row->setDisabled(true);
    }
    m_list->setCurrentItem(m_choices == 0 ? nullptr : m_list->topLevelItem(0));
}

void CommandPalette::choose() {
    const QTreeWidgetItem* row = m_list->currentItem();
    if (row != nullptr && !row->isDisabled()) {
        m_chosen = m_commands[row->data(0, Qt::UserRole).toULongLong()].action;
        accept();
    }
}

/// The keyboard stays in the line; these keys move in the list.
bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
    if (watched == m_line && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Up || key == Qt::Key_Down || key == Qt::Key_PageUp || key == Qt::Key_PageDown) {
            const int step = key == Qt::Key_PageUp || key == Qt::Key_PageDown ? kRows : 1;
            const int sign = key == Qt::Key_Up || key == Qt::Key_PageUp ? -1 : 1;
            const int row = m_list->indexOfTopLevelItem(m_list->currentItem()) + sign * step;
            if (m_choices != 0) {
                m_list->setCurrentItem(m_list->topLevelItem(std::clamp(row, 0, m_choices - 1)));
            }
            return true;
        }
    }
    return QDialog::eventFilter(watched, event);
}

} // namespace posewire::gui
