// SPDX-License-Identifier: GPL-3.0-or-later
// Ways from the window into the user guide.
#include "app/gui/help/help_window.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/viewport/viewport_overlay.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/guide.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/preferences.h"
#include "core/log/clock.h"

#include <QAbstractSpinBox>
#include <QAction>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QEnterEvent>
#include <QFile>
#include <QJsonDocument>
#include <QLayout>
#include <QLineEdit>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <QUrl>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class HelpingTest : public testing::Test {
protected:
    void SetUp() override {
        window.resize(1280, 800);
        window.show();
        QTest::qWait(1);
    }
    /// What the guide shows, from the window or from a dialog; empty while it is closed.
    [[nodiscard]] QString place(const QWidget* from = nullptr) const {
        const auto* guide = (from == nullptr ? &window : from)->findChild<HelpWindow*>();
        return guide != nullptr && guide->isVisible() ? guide->place() : QString();
    }
    /// The guide may have the keyboard.
    void focus(QWidget& widget) {
        window.activateWindow();
        QTest::qWait(1);
        widget.setFocus();
    }
    [[nodiscard]] QList<QDockWidget*> docks() const {
        return window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly);
    }

    QTemporaryDir folder;
    SettingsFile file{folder.filePath("settings.json")};
    log::SystemClock clock;
    SessionDriver driver{clock};
    MainWindow window{driver, file, {}};
};

TEST_F(HelpingTest, TheTitleOfEachDockLeadsToItsPage) {
    for (QDockWidget* dock : docks()) {
        auto* button = dock->titleBarWidget()->findChild<QToolButton*>("helpButton");
        ASSERT_NE(button, nullptr);
        EXPECT_FALSE(button->isHidden()) << "the keyboard reaches only what is there";
        EXPECT_NE(button->focusPolicy() & Qt::TabFocus, 0);
        EXPECT_EQ(button->accessibleName(), "Help on " + dock->windowTitle());
        button->click();
        EXPECT_EQ(place(), dock->objectName());
    }
}

TEST_F(HelpingTest, ANarrowDockKeepsItsNameAndTheWayToItsPage) {
    for (QDockWidget* dock : docks()) {
        QWidget* title = dock->titleBarWidget();
        dock->show(); // what is hidden is not laid out
        title->resize(title->minimumSizeHint());
        QTest::qWait(1);
        const auto* button = title->findChild<QToolButton*>("helpButton");
        EXPECT_LE(button->geometry().right(), title->width()) << dock->objectName().toStdString();
    }
}

TEST_F(HelpingTest, TheWayToItsPageStaysWhereItIsWhenThePointerComes) {
    for (QDockWidget* dock : docks()) {
        QWidget* title = dock->titleBarWidget();
        title->layout()->activate();
        const auto* button = title->findChild<QToolButton*>("helpButton");
        const QPoint pointer = button->geometry().center();
        QEnterEvent enter(pointer, pointer, pointer);
        QCoreApplication::sendEvent(title, &enter);
        title->layout()->activate();
        EXPECT_TRUE(button->geometry().contains(pointer)) << dock->objectName().toStdString();
    }
}

TEST_F(HelpingTest, F1OpensThePageOfThePartThatHasTheKeyboard) {
    QAction* here = window.findChild<QAction*>("helpHere");
    EXPECT_EQ(here->shortcut(), QKeySequence("F1"));
    for (const char* name : {"packets", "characters", "statistics"}) {
        window.docks().show(name);
        auto* dock = window.findChild<QDockWidget*>(name);
        focus(*dock->titleBarWidget()->findChild<QToolButton*>("helpButton"));
        here->trigger();
        EXPECT_EQ(place(), name);
    }
    focus(window.viewport());
    here->trigger();
    EXPECT_EQ(place(), "viewport");
    focus(*window.findChild<QWidget*>("headline"));
    here->trigger();
    EXPECT_EQ(place(), "bars#verdict-bar");
}

TEST_F(HelpingTest, AboutListsTheLibrariesWithTheirLicences) {
    window.findChild<QAction*>("about")->trigger();
    const auto* box = window.findChild<QMessageBox*>();
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(box->informativeText().contains(", QCustomPlot (GPL‑3.0‑or‑later), "))
        << box->informativeText().toStdString();
    EXPECT_TRUE(box->informativeText().contains("Eigen (MPL‑2.0)"));
}

TEST_F(HelpingTest, TheMenuOpensTheGuideItsCausesAndItsShortcuts) {
    for (const auto& [action, page] : {std::pair{"guide", "index"},
                                       {"causes", "causes"},
                                       {"shortcuts", "shortcuts"},
                                       {"tour", "index#first-steps"},
                                       {"reference", "protocol"}}) {
        window.findChild<QAction*>(action)->trigger();
        EXPECT_EQ(place(), page);
    }
    EXPECT_EQ(window.findChildren<HelpWindow*>().size(), 1) << "one guide, whatever is asked";
    EXPECT_FALSE(window.findChild<HelpWindow*>()->isModal());
}

TEST_F(HelpingTest, TheFirstStepsAreOfferedOnce) {
    auto* about = window.findChild<QToolButton*>("messageHelp");
    window.say("trouble", HelpTopic::SettingsUnusable);
    window.guide().offerFirstSteps();
    about->click();
    EXPECT_EQ(place(), placeOf(HelpTopic::SettingsUnusable)) << "the offer waits for the next start";
    window.say({});
    window.guide().offerFirstSteps();
    about->click();
    EXPECT_EQ(place(), "index#first-steps");
    EXPECT_TRUE(parseSettings(QJsonDocument(jsonOf(window.settings())).toJson())->isGuideOffered)
        << "the next run knows";
    window.say({});
    window.guide().offerFirstSteps();
    EXPECT_TRUE(about->isHidden());
}

TEST_F(HelpingTest, AMessageLeadsToItsPageAsLongAsItIsThere) {
    auto* about = window.findChild<QToolButton*>("messageHelp");
    EXPECT_TRUE(about->isHidden());
    window.useLayout("there is none");
    EXPECT_FALSE(about->isHidden());
    about->click();
    EXPECT_EQ(place(), placeOf(HelpTopic::UnknownLayout));
    window.say("Diagnostics copied");
    EXPECT_TRUE(about->isHidden()) << "this one needs no explanation";
    window.say("trouble", HelpTopic::SavingFailed);
    window.say({});
    EXPECT_TRUE(about->isHidden());
}

TEST_F(HelpingTest, WhatTheViewportSaysLeadsToItsPage) {
    emit driver.tableTick();
    auto* help = window.findChild<QToolButton*>("cardHelp");
    ASSERT_NE(help, nullptr);
    ASSERT_TRUE(help->isVisible()) << "nothing is received";
    EXPECT_TRUE(window.viewport().rect().contains(
        QRect(help->mapTo(&window.viewport(), QPoint(0, 0)), help->size())));
    help->click();
    EXPECT_EQ(place(), placeOf(HelpTopic::NoInput));
}

TEST_F(HelpingTest, AMessageThatWaitsForAnAnswerStaysWhileItsHelpIsRead) {
    MessageBox box("Record", "The disk is full.", QMessageBox::Ok, &window);
    offerHelp(box, placeOf(HelpTopic::RecordingFailed));
    QTimer::singleShot(0, &box, [&] {
        box.button(QMessageBox::Help)->click();
        EXPECT_TRUE(box.isVisible());
        EXPECT_EQ(place(&box), placeOf(HelpTopic::RecordingFailed)) << "else it could not be used";
        box.button(QMessageBox::Ok)->click();
    });
    EXPECT_EQ(box.exec(), QMessageBox::Ok);
}

TEST_F(HelpingTest, ADialogHasAButtonAndF1) {
    openPreferences(window, PreferencesSection::Recording);
    auto* dialog = window.findChild<QDialog*>();
    dialog->activateWindow();
    QTest::qWait(1);
    EXPECT_NE(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Help), nullptr);
    QTest::keyClick(dialog, Qt::Key_F1);
    EXPECT_EQ(place(), placeOf(HelpTopic::Preferences));
    EXPECT_EQ(helpPlaceOf(dialog->findChild<QPushButton*>()), place());
    dialog->findChild<QWidget*>("recordingOptions")->findChild<QToolButton*>("helpButton")->click();
    EXPECT_EQ(place(), placeOf(HelpTopic::RecordingOptions)) << "a section has help of its own";
}

/// Files come with their path as text, too.
TEST_F(HelpingTest, NoLineTakesAFileThatIsDroppedForText) {
    for (const QDockWidget* dock : window.findChildren<QDockWidget*>()) {
        for (const QLineEdit* line : dock->findChildren<QLineEdit*>()) {
            const bool isOfNumbers = qobject_cast<const QAbstractSpinBox*>(line->parent()) != nullptr;
            EXPECT_TRUE(isOfNumbers || !line->acceptDrops()) << qUtf8Printable(line->accessibleName());
        }
    }
}

TEST_F(HelpingTest, AFileThatIsDroppedIsOpened) {
    QFile raw(folder.filePath("take.mxtp"));
    ASSERT_TRUE(raw.open(QIODevice::WriteOnly));
    raw.write("no datagram");
    raw.close();
    const auto offer = [this](const QList<QUrl>& urls) {
        QMimeData data;
        data.setUrls(urls);
        QDragEnterEvent enter(QPoint(400, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        enter.ignore();
        QCoreApplication::sendEvent(&window, &enter);
        if (enter.isAccepted()) {
            QDropEvent drop(QPointF(400, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
            QCoreApplication::sendEvent(&window, &drop);
        }
        return enter.isAccepted();
    };
    EXPECT_FALSE(offer({QUrl("https://example.org/take.pcapng")}));
    EXPECT_FALSE(offer({QUrl::fromLocalFile(folder.path())})) << "a folder is no file";
    EXPECT_FALSE(offer({QUrl::fromLocalFile(raw.fileName()), QUrl::fromLocalFile(raw.fileName())}));
    EXPECT_TRUE(window.settings().recentFiles.isEmpty());
    EXPECT_TRUE(offer({QUrl::fromLocalFile(raw.fileName())}));
    EXPECT_EQ(window.settings().recentFiles, QStringList{raw.fileName()});
}

} // namespace
} // namespace posewire::gui
