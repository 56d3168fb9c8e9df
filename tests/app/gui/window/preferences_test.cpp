// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/preferences.h"

#include "app/gui/theme/widgets.h"
#include "app/gui/viewport/overlays.h"
#include "app/gui/window/recording_dialogs.h"
#include "tests/app/gui/window/main_window_fixture.h"

#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QTimer>
#include <QWheelEvent>

#include <map>

namespace posewire::gui {
namespace {

class PreferencesTest : public MainWindowTest {
protected:
    void SetUp() override {
        window = makeWindow();
        window->resize(1280, 720);
        open();
    }
    [[nodiscard]] bool isOpen() const { return dialog != nullptr && dialog->isVisible(); }
    void open() {
        delete dialog;
        openPreferences(*window, PreferencesSection::Appearance);
        dialog = window->findChild<QDialog*>();
        dialog->activateWindow();
        QTest::qWait(1);
    }
    void type(const QString& text) {
        auto* search = dialog->findChild<QLineEdit*>(QString(), Qt::FindDirectChildrenOnly);
        search->clear();
        QTest::keyClicks(search, text);
        QTest::qWait(1);
    }
    template <class Field = QWidget>
    Field* field(const char* name) {
        return dialog->findChild<Field*>(QLatin1String(name));
    }
    /// That a label of a form is about.
    template <class Field>
    Field* labelled(const QString& label) {
        for (const auto* rows : dialog->findChildren<QFormLayout*>()) {
            for (int row = 0; row < rows->rowCount(); ++row) {
                const auto* item = rows->itemAt(row, QFormLayout::LabelRole);
                const auto* text = item != nullptr ? qobject_cast<QLabel*>(item->widget()) : nullptr;
                if (text != nullptr && text->text().remove(u'&') == label) {
                    QWidget* found = rows->itemAt(row, QFormLayout::FieldRole)->widget();
                    return qobject_cast<Field*>(found->focusProxy() != nullptr ? found->focusProxy() : found);
                }
            }
        }
        return nullptr;
    }
    QStringList shownTexts() {
        QStringList texts;
        for (const auto* label : dialog->findChildren<QLabel*>()) {
            texts << (label->isVisible() ? label->text() : QString());
        }
        texts.removeAll({});
        return texts;
    }
    static void write(QLineEdit* line, const QString& text) {
        line->setFocus();
        line->selectAll();
        QTest::keyClicks(line, text);
    }

    std::unique_ptr<MainWindow> window;
    QPointer<QDialog> dialog;
};

TEST_F(PreferencesTest, SearchShowsTheRowsThatAreMeantAndNoOthers) {
    EXPECT_TRUE(dialog->focusWidget()->accessibleName().startsWith("Search"));
    type("angle joint");
    EXPECT_TRUE(field("jointAngles")->isVisible());
    EXPECT_FALSE(field("segmentNames")->isVisible());
    EXPECT_EQ(shownTexts(), (QStringList{"Viewport", "Overlays"}));
    type("viewport");
    EXPECT_TRUE(field("jointAngles")->isVisible()) << "the title of its section";
    EXPECT_FALSE(shownTexts().contains("Recording"));
    type("RFC 3550");
    EXPECT_TRUE(labelled<QWidget>("Jitter above")->isVisible()) << "its tooltip";
    EXPECT_FALSE(labelled<QWidget>("Loss above")->isVisible());
    type("dark");
    EXPECT_TRUE(field("themeSystem")->isVisible()) << "a choice of a list";
    EXPECT_EQ(shownTexts(), (QStringList{"Appearance", "Theme"}));
    type("every");
    EXPECT_TRUE(labelled<QWidget>("New file every")->isVisible()) << "whatever the letter to press";
    type("dark every");
    EXPECT_EQ(shownTexts(), QStringList{"Nothing found"});
    type("multicast udp cable");
    ASSERT_EQ(shownTexts().size(), 1) << "no preference";
    EXPECT_EQ(shownTexts()[0], "Nothing found");
    type("cable");
    ASSERT_EQ(shownTexts().size(), 1) << "no preference";
    EXPECT_TRUE(shownTexts()[0].contains("Input › Inputs")) << "but in the menus";
    type({});
    EXPECT_TRUE(field("segmentNames")->isVisible());
    EXPECT_FALSE(shownTexts().contains("Nothing found"));
}

TEST_F(PreferencesTest, WhatIsFoundInTheMenusCanBeChosen) {
    type("units");
    QLabel* found = nullptr;
    for (QLabel* label : dialog->findChildren<QLabel*>()) {
        found = label->isVisible() && label->text().contains("<a href=") ? label : found;
    }
    ASSERT_NE(found, nullptr);
    const QString text = found->text();
    emit found->linkActivated(text.section("href=\"", 1, 1).section('"', 0, 0));
    EXPECT_FALSE(dialog != nullptr && dialog->isVisible());
    EXPECT_TRUE(window->findChild<QDockWidget*>("metadata")->isVisible());
}

TEST_F(PreferencesTest, SearchKnowsTheOtherWordsThatCommandsHave) {
    type("limits");
    EXPECT_TRUE(labelled<QWidget>("Loss above")->isVisible()) << "as Tools > Thresholds";
    type("mute error");
    EXPECT_EQ(shownTexts(), (QStringList{"Thresholds and alerts", "Sound"}));
    type("smooth");
    EXPECT_TRUE(field("interpolation")->isVisible());
    EXPECT_EQ(shownTexts(), (QStringList{"Viewport", "View"}));
}

TEST_F(PreferencesTest, AGroupHasItsNameOnceAtTheFirstRowThatIsShown) {
    EXPECT_EQ(shownTexts().count("Overlays"), 1);
    type("trails");
    EXPECT_EQ(shownTexts(), (QStringList{"Viewport", "Overlays"}));
    type({});
    EXPECT_EQ(shownTexts().count("Overlays"), 1);
}

TEST_F(PreferencesTest, FieldsStayInTheirPlaceWhileOneSearches) {
    const int x = field("trails")->x();
    EXPECT_EQ(labelled<QWidget>("Loss above")->x(), x);
    type("trails");
    EXPECT_EQ(field("trails")->x(), x);
}

TEST_F(PreferencesTest, BoxesAndListsFollowTheMenusAndMoveThem) {
    for (const OverlayEntry& overlay : kOverlayTable) {
        ASSERT_NE(field<QCheckBox>(overlay.key), nullptr) << overlay.key;
    }
    auto* box = field<QCheckBox>("trails");
    QAction* trails = action(*window, "trails");
    box->click();
    EXPECT_TRUE(trails->isChecked());
    EXPECT_TRUE(window->viewport().choice().isOn(Overlay::Trails));
    trails->trigger();
    EXPECT_FALSE(box->isChecked());
    auto* axes = field<QComboBox>("axesOfAll");
    EXPECT_EQ(axes->currentText(), "Selected character");
    QTest::keyClick(axes, Qt::Key_Down);
    EXPECT_EQ(window->viewport().choice().axes(), AxesMode::None);
    EXPECT_TRUE(action(*window, "axesOfNone")->isChecked());
    action(*window, "axes")->trigger();
    EXPECT_EQ(axes->currentText(), "All segments");
    auto* theme = field<QComboBox>("themeSystem");
    QTest::keyClick(theme, Qt::Key_End);
    EXPECT_EQ(window->kept().theme, ThemeChoice::Light);
    EXPECT_EQ(theme->currentText(), "Light");
    QTest::keyClick(theme, Qt::Key_Home);
    EXPECT_EQ(window->kept().theme, ThemeChoice::System);
}

TEST_F(PreferencesTest, AChoiceOfADockKeepsAndLeavesTheDocksAsTheyAre) {
    delete dialog;
    window->useLayout("Check");
    dock(*window, "packets")->hide();
    open();
    auto* times = field<QComboBox>("timeSinceFirst");
    QTest::keyClick(times, Qt::Key_Down);
    EXPECT_EQ(times->currentText(), "Date and time of day");
    dialog->close();
    EXPECT_TRUE(action(*window, "timeOfDay")->isChecked());
    EXPECT_TRUE(dock(*window, "packets")->isHidden()) << "it would come up behind the dialog";
    EXPECT_EQ(window->settings().panels["packets"].toObject()["time"].toString(), "day");
}

TEST_F(PreferencesTest, ThresholdsApplyAtOnce) {
    auto* loss = labelled<QDoubleSpinBox>("Loss above");
    loss->setFocus();
    loss->selectAll();
    QTest::keyClicks(loss, "2.5");
    EXPECT_EQ(window->kept().alerts.thresholds.lossPercent, 1) << "not before the number is complete";
    QTest::keyClick(loss, Qt::Key_Return);
    EXPECT_EQ(window->kept().alerts.thresholds.lossPercent, 2.5);
    EXPECT_TRUE(isOpen()) << "Enter presses no button";
    labelled<QCheckBox>("Notification")->click();
    EXPECT_TRUE(window->kept().alerts.hasNotification);
    EXPECT_EQ(window->settings().alerts, window->kept().alerts);
}

TEST_F(PreferencesTest, RecordingKeepsWhatCanBeUsedAndMarksWhatCannot) {
    auto* name = labelled<QLineEdit>("Name");
    write(name, "Stage {take}");
    const auto* note = dialog->findChild<Note*>();
    EXPECT_TRUE(note->text().startsWith("Next: Stage 001")) << note->text().toStdString();
    EXPECT_EQ(window->kept().recording.pattern, "") << "not before the name is complete";
    labelled<QSpinBox>("Keep before")->setFocus();
    labelled<QSpinBox>("Keep before")->setValue(30);
    EXPECT_EQ(window->kept().recording.pattern, "Stage {take}");
    EXPECT_EQ(window->kept().recording.preRollSeconds, 30);
    write(name, "a/b {takes}");
    labelled<QSpinBox>("Leave free")->setFocus();
    EXPECT_EQ(note->text(), healthText(Health::Error, patternProblem("a/b {takes}")));
    EXPECT_EQ(note->foregroundRole(), QPalette::BrightText);
    EXPECT_EQ(window->kept().recording.pattern, "Stage {take}") << "the last that can be used";
    labelled<QSpinBox>("Leave free")->setValue(2'000);
    EXPECT_EQ(window->kept().recording.pattern, "Stage {take}");
    EXPECT_EQ(window->kept().recording.freeMegabytes, 2'000);
    write(labelled<QLineEdit>("Folder"), folder.path());
    EXPECT_NE(window->kept().recording.folder, folder.path());
    dialog->close();
    EXPECT_EQ(window->kept().recording.folder, folder.path()) << "what was typed last counts";
    EXPECT_EQ(window->kept().recording.pattern, "Stage {take}");
    open();
    EXPECT_EQ(labelled<QLineEdit>("Name")->text(), "Stage {take}");
}

TEST_F(PreferencesTest, HistoryIsKeptAndSaysHowFarBackItGoes) {
    type("history");
    EXPECT_FALSE(shownTexts().filter("In memory: ").isEmpty());
    EXPECT_FALSE(shownTexts().filter("Nothing was received yet.").isEmpty());
    auto* most = labelled<QSpinBox>("At most");
    EXPECT_TRUE(most->accessibleName().contains("history"));
    most->setValue(3);
    EXPECT_EQ(window->kept().history, (HistoryChoice{true, 3}));
    for (auto* box : dialog->findChildren<QCheckBox*>()) {
        if (box->text().contains("disk")) {
            box->click();
        }
    }
    EXPECT_EQ(window->kept().history, (HistoryChoice{false, 3}));
    EXPECT_FALSE(most->isEnabled());
}

TEST_F(PreferencesTest, EscapeLeavesTheSearchAndThenTheDialog) {
    type("trails");
    field("trails")->setFocus();
    QTest::keyClick(field("trails"), Qt::Key_Escape);
    EXPECT_TRUE(isOpen());
    EXPECT_TRUE(field("segmentNames")->isVisible()) << "all is shown again";
    EXPECT_TRUE(dialog->focusWidget()->accessibleName().startsWith("Search"));
    QTest::keyClick(dialog->focusWidget(), Qt::Key_Return);
    EXPECT_TRUE(isOpen()) << "Enter presses no button";
    QTest::keyClick(dialog->focusWidget(), Qt::Key_Escape);
    EXPECT_FALSE(isOpen());
    open();
    type("trails");
    dialog->close();
    EXPECT_FALSE(isOpen()) << "only the key clears the search first";
}

TEST_F(PreferencesTest, TabGoesFromTopToBottomToAllThatIsShown) {
    auto* area = dialog->findChild<QScrollArea*>();
    for (const char* typed : {"", "name"}) {
        type(typed);
        QWidget* first = dialog->focusWidget();
        int bottom = -1;
        int steps = 0;
        QStringList order;
        QSet<QWidget*> reached;
        for (QWidget* now = first;; ++steps) {
            QTest::keyClick(now, Qt::Key_Tab);
            now = dialog->focusWidget();
            ASSERT_LT(steps, 100);
            if (now == first) {
                break;
            }
            reached << now;
            order << now->metaObject()->className() + (u' ' + now->accessibleName()) +
                         now->property("text").toString();
            if (area->isAncestorOf(now)) {
                const QRect place(now->mapTo(area->widget(), QPoint(0, 0)), now->size());
                EXPECT_GE(place.bottom(), bottom) << order.last().toStdString();
                EXPECT_TRUE(now->isVisible());
                EXPECT_FALSE(now->visibleRegion().isEmpty()) << "scrolled to: " << order.last().toStdString();
                bottom = place.top();
            }
        }
        EXPECT_EQ(order.filter("QPushButton Close").size() + order.filter("QPushButton Help").size(), 2)
            << order.join("\n").toStdString();
        EXPECT_TRUE(reached.contains(labelled<QWidget>("Name"))) << order.join("\n").toStdString();
        EXPECT_EQ(order.size() > 50, QString(typed).isEmpty()) << order.join("\n").toStdString();
    }
}

TEST_F(PreferencesTest, NoTwoFieldsHaveTheSameLetterToPress) {
    std::map<QString, QString> taken;
    for (const auto* each : dialog->findChildren<QWidget*>()) {
        const QString text =
            qobject_cast<const QLineEdit*>(each) == nullptr ? each->property("text").toString() : QString();
        const QString key = QKeySequence::mnemonic(text).toString();
        if (!key.isEmpty()) {
            const auto [other, isNew] = taken.emplace(key, text);
            EXPECT_TRUE(isNew) << key.toStdString() << " is of " << other->second.toStdString() << " and of "
                               << text.toStdString();
        }
    }
    EXPECT_GT(taken.size(), 10U);
}

TEST_F(PreferencesTest, TheEntriesOfTheMenusOpenItAtTheirSection) {
    delete dialog;
    const std::map<QString, QString> firstFields{{"preferences", "Search preferences"},
                                                 {"recordingOptions", "Folder"},
                                                 {"history", ""},
                                                 {"thresholds", " %"}};
    for (const auto& [id, name] : firstFields) {
        action(*window, id)->trigger();
        QTest::qWait(20);
        const auto* opened = window->findChild<QDialog*>();
        ASSERT_NE(opened, nullptr);
        const QWidget* has = opened->focusWidget();
        EXPECT_EQ(has->accessibleName() + has->property("suffix").toString(), name) << id.toStdString();
        EXPECT_FALSE(has->visibleRegion().isEmpty()) << id.toStdString();
        EXPECT_EQ(qobject_cast<const QCheckBox*>(has) != nullptr, id == "history");
        delete opened;
    }
}

TEST_F(PreferencesTest, TheWheelChangesNoField) {
    const auto turnOver = [](QWidget* over) {
        const QPointF middle = over->rect().center();
        QWheelEvent wheel(middle, over->mapToGlobal(middle), {}, {0, -120}, Qt::NoButton, Qt::NoModifier,
                          Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(over, &wheel);
    };
    auto* axes = field<QComboBox>("axesOfAll");
    turnOver(axes);
    EXPECT_EQ(axes->currentText(), "Selected character");
    auto* loss = labelled<QDoubleSpinBox>("Loss above");
    loss->setFocus();
    turnOver(loss);
    EXPECT_EQ(loss->value(), 1);
}

TEST_F(PreferencesTest, HasRoomForAllOfItOnASmallScreen) {
    EXPECT_LE(dialog->height(), 720);
    EXPECT_LE(dialog->width(), 1280);
    const auto* area = dialog->findChild<QScrollArea*>();
    EXPECT_LE(area->widget()->width(), area->viewport()->width());
    for (const auto* part : area->widget()->findChildren<QWidget*>()) {
        if (part->isVisible() && part->sizePolicy().horizontalPolicy() != QSizePolicy::Ignored) {
            EXPECT_GE(part->height(), part->minimumSizeHint().height())
                << part->metaObject()->className() << " " << part->objectName().toStdString();
            EXPECT_GE(part->width(), part->minimumSizeHint().width())
                << part->metaObject()->className() << " " << part->objectName().toStdString();
        }
    }
}

} // namespace
} // namespace posewire::gui
