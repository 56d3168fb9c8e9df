// SPDX-License-Identifier: GPL-3.0-or-later

#include "app/gui/panels/filter_bar.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/window/command_palette.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/main_window.h"
#include "core/log/clock.h"

#include <QAbstractItemView>
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenuBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QStandardItemModel>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace posewire::gui {
namespace {

class KeyboardTest : public testing::Test {
protected:
    void SetUp() override {
        m_window.resize(1280, 800);
        m_window.show();
        QTest::qWait(1);
    }
    [[nodiscard]] bool isPaused() { return m_driver.playback().isPaused(); }
    [[nodiscard]] const Command* command(const QString& name) {
        m_commands = commandsOf(*m_window.menuBar());
        const auto found = std::ranges::find(m_commands, name, &Command::name);
        return found == m_commands.end() ? nullptr : &*found;
    }

    QTemporaryDir m_folder;
    SettingsFile m_file{m_folder.filePath("settings.json")};
    log::SystemClock m_clock;
    SessionDriver m_driver{m_clock};
    MainWindow m_window{m_driver, m_file, {}};
    std::vector<Command> m_commands;
};

TEST_F(KeyboardTest, EnterPressesTheButtonThatHasTheFocusAndSpaceOnlyInDialogs) {
    QDialog dialog(&m_window);
    const std::pair<Qt::Key, QWidget*> cases[]{
        {Qt::Key_Space, &dialog}, {Qt::Key_Return, &m_window}, {Qt::Key_Enter, &m_window}};
    for (const auto& [key, window] : cases) {
        QPushButton push(window);
        QToolButton tool(window);
        QCheckBox box(window);
        ColourText entry(ColourText::Look::Plain, window);
        for (QAbstractButton* button : std::initializer_list<QAbstractButton*>{&push, &tool, &box, &entry}) {
            int presses = 0;
            QObject::connect(button, &QAbstractButton::clicked, &m_window, [&] { ++presses; });
            button->show();
            button->setFocus();
            QTest::keyClick(button, key);
            EXPECT_EQ(presses, 1) << button->metaObject()->className() << " " << key;
            EXPECT_FALSE(isPaused());
        }
        EXPECT_TRUE(box.isChecked());
    }
}

TEST_F(KeyboardTest, EnterOnAListIsForTheDefaultButtonOfItsDialog) {
    QDialog dialog(&m_window);
    QComboBox list(&dialog);
    list.addItems({"this", "that"});
    QPushButton button(&dialog);
    button.setDefault(true);
    int presses = 0;
    QObject::connect(&button, &QPushButton::clicked, &m_window, [&] { ++presses; });
    dialog.show();
    QTest::keyClick(&list, Qt::Key_Return);
    EXPECT_EQ(presses, 1);
    EXPECT_FALSE(list.view()->isVisible());
}

TEST_F(KeyboardTest, SpaceInADialogTogglesTheBoxOfTheCurrentRowInWhateverColumn) {
    QDialog dialog(&m_window);
    QStandardItemModel model(3, 2);
    auto* item = new QStandardItem("shown");
    item->setCheckable(true);
    model.setItem(1, 0, item);
    QTableView table(&dialog);
    table.setModel(&model);
    table.show();
    table.setCurrentIndex(model.index(1, 1));
    QTest::keyClick(&table, Qt::Key_Space);
    EXPECT_EQ(item->checkState(), Qt::Checked);
    EXPECT_FALSE(isPaused());
    QTest::keyClick(&table, Qt::Key_Space);
    EXPECT_EQ(item->checkState(), Qt::Unchecked);
}

TEST_F(KeyboardTest, SpacePausesWhereverTheFocusIsInTheWindow) {
    QPushButton push(&m_window);
    QComboBox list(&m_window);
    bool isAsked = false;
    QObject::connect(&push, &QAbstractButton::clicked, &m_window, [&] { isAsked = true; });
    for (QWidget* part : std::initializer_list<QWidget*>{&m_window, &push, &list}) {
        QTest::keyClick(part, Qt::Key_L);
        ASSERT_FALSE(isPaused());
        part->setFocus();
        QTest::keyClick(part, Qt::Key_Space);
        EXPECT_TRUE(isPaused()) << part->metaObject()->className();
    }
    EXPECT_FALSE(isAsked);
}

TEST_F(KeyboardTest, ATreeTakesTheArrowsThatOpenItsRowsAndNotTheKeyThatGoesBack) {
    QTreeWidget tree(&m_window);
    const auto takes = [&](Qt::KeyboardModifiers modifiers) {
        QKeyEvent event(QEvent::ShortcutOverride, Qt::Key_Left, modifiers);
        event.ignore();
        QCoreApplication::sendEvent(&tree, &event);
        return event.isAccepted();
    };
    EXPECT_TRUE(takes(Qt::NoModifier));
    EXPECT_FALSE(takes(Qt::AltModifier)) << "back to before the jump";
    EXPECT_FALSE(takes(Qt::ControlModifier)) << "one second back";
    EXPECT_FALSE(takes(Qt::ShiftModifier)) << "ten samples back";
}

TEST_F(KeyboardTest, GoesAlongWithADockThatIsShownOverTheOneThatHadIt) {
    m_window.useLayout(QStringLiteral("Debug"));
    QTest::qWait(20);
    const auto isIn = [&](const char* dock) {
        return m_window.findChild<QDockWidget*>(QLatin1String(dock))->isAncestorOf(m_window.focusWidget()) &&
               qobject_cast<QAbstractItemView*>(m_window.focusWidget()) != nullptr;
    };
    ASSERT_NE(command("Faults"), nullptr);
    command("Faults")->action->trigger();
    EXPECT_TRUE(isIn("faults")) << "asked for by its name";
    m_window.docks().show(QStringLiteral("packets"));
    EXPECT_TRUE(isIn("packets")) << "else keys would go to a dock that nobody sees";
    m_window.viewport().setFocus();
    m_window.docks().show(QStringLiteral("events"));
    EXPECT_EQ(m_window.focusWidget(), &m_window.viewport()) << "which is seen as before";
}

TEST_F(KeyboardTest, GoesToTheEvidenceOfTheVerdict) {
    for (const QString& layout : {QStringLiteral("Check"), QStringLiteral("Debug")}) {
        m_window.useLayout(layout);
        QTest::qWait(20);
        m_window.viewport().setFocus();
        m_window.findChild<QAction*>("verdictEvidence")->trigger();
        EXPECT_TRUE(m_window.findChild<QDockWidget*>("events")->isAncestorOf(m_window.focusWidget()))
            << layout.toStdString();
    }
}

TEST_F(KeyboardTest, TabGoesOnlyToWhatCanBeSeen) {
    for (const QString& layout :
         {QStringLiteral("Check"), QStringLiteral("Debug"), QStringLiteral("Inspect")}) {
        m_window.useLayout(layout);
        QTest::qWait(20);
        for (const bool isForward : {true, false}) {
            m_window.viewport().setFocus();
            std::set<QWidget*> reached;
            QWidget* before = m_window.focusWidget();
            for (int i = 0; i < 400; ++i) {
                QTest::keyClick(m_window.focusWidget(), isForward ? Qt::Key_Tab : Qt::Key_Backtab);
                QWidget* now = m_window.focusWidget();
                ASSERT_NE(now, nullptr);
                EXPECT_NE(now, before) << "stuck at " << now->objectName().toStdString();
                const QRect place(now->mapTo(&m_window, QPoint(0, 0)), now->size());
                EXPECT_TRUE(m_window.rect().intersects(place))
                    << layout.toStdString() << ": " << now->metaObject()->className() << " "
                    << now->accessibleName().toStdString();
                before = now;
                reached.insert(now);
                if (now == &m_window.viewport()) {
                    break;
                }
            }
            EXPECT_EQ(before, &m_window.viewport()) << "all around";
            EXPECT_GT(reached.size(), 10U);
        }
    }
}

TEST_F(KeyboardTest, NoTwoEntriesOfAMenuHaveTheSameMnemonic) {
    const auto check = [](const auto& self, const QString& menu, const QList<QAction*>& entries) -> void {
        std::map<QString, QString> taken;
        for (const QAction* entry : entries) {
            const QString key = QKeySequence::mnemonic(entry->text()).toString();
            if (!key.isEmpty() && entry->isVisible()) {
                const auto [other, isNew] = taken.emplace(key, entry->text());
                EXPECT_TRUE(isNew) << menu.toStdString() << ": " << key.toStdString() << " is of "
                                   << other->second.toStdString() << " and of "
                                   << entry->text().toStdString();
            }
            if (entry->menu() != nullptr) {
                self(self, menu + u'/' + entry->text(), entry->menu()->actions());
            }
        }
    };
    check(check, {}, m_window.menuBar()->actions());
}

TEST_F(KeyboardTest, EveryEntryOfEveryMenuIsACommand) {
    const std::vector<Command> commands = commandsOf(*m_window.menuBar());
    for (const MenuEntry& entry : menuEntries()) {
        if (entry.action->run != nullptr) {
            EXPECT_TRUE(std::ranges::any_of(commands, [&](const Command& each) {
                return each.action->objectName() == entry.action->id;
            })) << entry.action->id;
        }
    }
    for (const Command& each : commands) {
        EXPECT_FALSE(each.name.contains(QRegularExpression("&\\S"))) << each.name.toStdString();
        EXPECT_FALSE(each.menu.isEmpty()) << each.name.toStdString();
    }
}

TEST_F(KeyboardTest, EverySavedFilterIsACommandThatShowsThePackets) {
    m_window.useLayout("Check");
    const auto isProblems = [](const Command& each) { return each.name == "Problems"; };
    const std::vector<Command> commands = commandsOf(*m_window.menuBar());
    const auto problems = std::ranges::find_if(commands, isProblems);
    ASSERT_NE(problems, commands.end());
    EXPECT_EQ(problems->menu, "Edit › Saved filters");
    problems->action->trigger();
    EXPECT_FALSE(m_window.findChild<FilterBar*>()->line().filter().isEmpty());
    EXPECT_FALSE(m_window.findChild<QDockWidget*>("packets")->isHidden());
}

TEST_F(KeyboardTest, CommandsAreMeantByTheBeginningsOfTheirWordsInAnyOrder) {
    const Command front{nullptr, "Front", "View › Camera"};
    for (const char* typed : {"", "front", "FRO", "cam fr", "view front", "fr, ca"}) {
        EXPECT_TRUE(isMeant(front, typed)) << typed;
    }
    for (const char* typed : {"ront", "front back", "x"}) {
        EXPECT_FALSE(isMeant(front, typed)) << typed;
    }
}

TEST_F(KeyboardTest, ThePaletteHasTheDockOfANameBeforeWhatIsDoneInIt) {
    CommandPalette palette(*m_window.menuBar(), &m_window);
    QTest::keyClicks(palette.findChild<QLineEdit*>(), "null pose");
    const auto* list = palette.findChild<QTreeWidget*>();
    ASSERT_GT(list->topLevelItemCount(), 1);
    EXPECT_TRUE(list->topLevelItem(0)->text(0).endsWith("Null pose"))
        << list->topLevelItem(0)->text(0).toStdString();
}

TEST_F(KeyboardTest, ThePaletteBeginsWithTheCommandOfThatName) {
    for (const char* name : {"Packets", "Statistics", "Timeline", "Incidents", "Metadata", "Null pose"}) {
        CommandPalette palette(*m_window.menuBar(), &m_window);
        QTest::keyClicks(palette.findChild<QLineEdit*>(), QString(name).toLower());
        EXPECT_EQ(palette.findChild<QTreeWidget*>()->topLevelItem(0)->text(0).remove("✓ "), name);
    }
}

TEST_F(KeyboardTest, ThePaletteChoosesWhatWasTypedAndMovesInItsList) {
    CommandPalette palette(*m_window.menuBar(), &m_window);
    palette.show();
    auto* line = palette.findChild<QLineEdit*>();
    auto* list = palette.findChild<QTreeWidget*>();
    const int all = list->topLevelItemCount();
    QTest::keyClicks(line, "theme");
    EXPECT_LT(list->topLevelItemCount(), all);
    QTest::keyClick(line, Qt::Key_Down);
    QTest::keyClick(line, Qt::Key_Return);
    ASSERT_NE(palette.chosen(), nullptr);
    EXPECT_EQ(palette.chosen()->objectName(), "themeDark");
    EXPECT_EQ(palette.result(), QDialog::Accepted);
}

TEST_F(KeyboardTest, WhatCannotBeDoneNowIsListedAndNotChosen) {
    const Command* live = command("Back to live");
    ASSERT_NE(live, nullptr);
    live->action->setEnabled(false);
    CommandPalette palette(*m_window.menuBar(), &m_window);
    QTest::keyClicks(palette.findChild<QLineEdit*>(), "back to live");
    EXPECT_EQ(palette.findChild<QTreeWidget*>()->topLevelItemCount(), 1);
    QTest::keyClick(palette.findChild<QLineEdit*>(), Qt::Key_Return);
    EXPECT_EQ(palette.chosen(), nullptr);
    auto* line = palette.findChild<QLineEdit*>();
    line->setText("back");
    const auto* list = palette.findChild<QTreeWidget*>();
    ASSERT_GT(list->topLevelItemCount(), 1);
    EXPECT_TRUE(list->topLevelItem(list->topLevelItemCount() - 1)->isDisabled()) << "it comes last";
    EXPECT_EQ(list->currentItem(), list->topLevelItem(0));
    line->setText("nonsense");
    EXPECT_EQ(list->topLevelItemCount(), 1);
    EXPECT_EQ(list->topLevelItem(0)->text(0), "No command has these words.");
}

} // namespace
} // namespace posewire::gui
