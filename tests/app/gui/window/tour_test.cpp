// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/tour.h"

#include "app/gui/window/main_window.h"
#include "core/log/clock.h"

#include <QAction>
#include <QApplication>
#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class TourTest : public testing::Test {
protected:
    void SetUp() override {
        window.resize(1280, 800);
        window.show();
        QTest::qWait(1);
    }
    [[nodiscard]] Tour* tour() const { return window.findChild<Tour*>(); }
    [[nodiscard]] QStringList texts() const {
        QStringList texts;
        for (const QLabel* label : tour()->card().findChildren<QLabel*>()) {
            texts += label->text();
        }
        return texts;
    }
    void press(Qt::Key key) { QTest::keyClick(QApplication::focusWidget(), key); }
    /// It deletes itself once it is over.
    [[nodiscard]] bool isOver() const {
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        return tour() == nullptr;
    }

    QTemporaryDir folder;
    SettingsFile file{folder.filePath("settings.json")};
    log::SystemClock clock;
    SessionDriver driver{clock};
    MainWindow window{driver, file, {}};
};

TEST_F(TourTest, IsOfferedUntilItWasSeenOrSkipped) {
    EXPECT_EQ(tour(), nullptr) << "a window shows none by itself";
    window.offerTour();
    ASSERT_NE(tour(), nullptr);
    EXPECT_EQ(window.settings().tour, 0);
    press(Qt::Key_Escape);
    EXPECT_TRUE(isOver());
    EXPECT_EQ(window.settings().tour, Tour::kVersion);
    EXPECT_EQ(parseSettings(jsonOf(window.settings()))->tour, Tour::kVersion) << "the next run knows";
    window.offerTour();
    EXPECT_EQ(tour(), nullptr);
    window.findChild<QAction*>("tour")->trigger();
    EXPECT_NE(tour(), nullptr) << "the menu shows it again";
}

TEST_F(TourTest, EachStepSaysSomethingElseAboutAPartThatCanBeSeen) {
    window.showTour();
    QStringList all;
    for (std::size_t step = 0;; ++step) {
        ASSERT_LT(step, 7U);
        EXPECT_EQ(tour()->step(), step);
        EXPECT_FALSE(all.contains(texts().join('\n')));
        all += texts().join('\n');
        EXPECT_FALSE(texts().join(' ').contains('%')) << texts().join(' ').toStdString();
        EXPECT_TRUE(tour()->rect().contains(tour()->card().geometry())) << step;
        EXPECT_FALSE(tour()->card().accessibleName().isEmpty());
        press(Qt::Key_Return);
        if (isOver()) {
            break;
        }
    }
    EXPECT_GE(all.size(), 4);
    EXPECT_LE(all.size(), 6);
}

TEST_F(TourTest, GoesBack) {
    window.showTour();
    press(Qt::Key_Right);
    press(Qt::Key_Right);
    EXPECT_EQ(tour()->step(), 2U);
    press(Qt::Key_Left);
    EXPECT_EQ(tour()->step(), 1U);
    press(Qt::Key_Left);
    press(Qt::Key_Left);
    EXPECT_EQ(tour()->step(), 0U);
}

TEST_F(TourTest, KeysOfTheWindowMeanNothingMeanwhile) {
    window.showTour();
    press(Qt::Key_R);
    EXPECT_FALSE(driver.takes().isRecording());
    press(Qt::Key_Space);
    EXPECT_FALSE(driver.playback().isPaused());
    EXPECT_EQ(tour()->step(), 1U) << "it pressed the button instead";
}

TEST_F(TourTest, TabStaysOnTheCardAndTheKeyboardGoesBackAfterwards) {
    window.viewport().setFocus();
    window.showTour();
    for (int i = 0; i < 6; ++i) {
        EXPECT_TRUE(tour()->card().isAncestorOf(QApplication::focusWidget()));
        press(Qt::Key_Tab);
    }
    press(Qt::Key_Escape);
    EXPECT_EQ(QApplication::focusWidget(), &window.viewport());
}

TEST_F(TourTest, CoversTheWindowAlsoWhenThatGetsAnotherSize) {
    window.showTour();
    for (const QSize size : {QSize(1024, 700), QSize(1500, 900)}) {
        window.resize(size);
        QTest::qWait(20);
        EXPECT_EQ(tour()->size(), window.size());
        EXPECT_TRUE(tour()->rect().contains(tour()->card().geometry()));
    }
}

} // namespace
} // namespace posewire::gui
