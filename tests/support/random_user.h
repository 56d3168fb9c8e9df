// SPDX-License-Identifier: MIT
#pragma once

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QMainWindow>
#include <QMenu>
#include <QPointer>
#include <QTest>
#include <QTimer>

#include <array>
#include <functional>
#include <random>

namespace posewire::test {

/// Operates a window at random: triggers actions, presses keys, clicks and drags, also in the dialogs and
/// menus that open, and closes those after a while. The same seed repeats the same steps as long as the
/// window offers the same widgets.
class RandomUser {
public:
    /// `mayChoose` excludes actions that would end the test.
    RandomUser(QMainWindow& window, unsigned seed, std::function<bool(const QAction&)> mayChoose)
        : m_window(window), m_random(seed), m_mayChoose(std::move(mayChoose)) {}

    /// Continues until stop(). Each step is a timer of its own, so that steps also reach a dialog that
    /// blocks.
    void start() {
        m_isActive = true;
        QTimer::singleShot(kPause, &m_window, [this] {
            if (m_isActive) {
                start();
                act();
            }
        });
    }
    void stop() {
        m_isActive = false;
        while (QWidget* open = opened()) {
            open->close();
            QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        }
    }
    [[nodiscard]] int done() const { return m_done; }

private:
    static constexpr int kPause = 5;      ///< milliseconds
    static constexpr int kMostOpened = 8; ///< things done in a dialog or menu before it is closed

    [[nodiscard]] std::size_t upTo(std::size_t count) { return m_random() % count; }
    [[nodiscard]] static QWidget* opened() {
        QWidget* popup = QApplication::activePopupWidget();
        return popup != nullptr ? popup : QApplication::activeModalWidget();
    }

    void act() {
        ++m_done;
        QWidget* open = opened();
        m_inOpened = open == nullptr ? 0 : m_inOpened + 1;
        if (m_inOpened > kMostOpened) {
            m_inOpened = 0;
            open->close();
            return;
        }
        QWidget& place = open != nullptr ? *open : m_window;
        switch (upTo(open == nullptr ? 6 : 4)) {
        case 0:
        case 1:
            press(place);
            break;
        case 2:
        case 3:
            point(place);
            break;
        default:
            choose();
        }
    }
    void choose() {
        QList<QAction*> actions = m_window.findChildren<QAction*>();
        actions.removeIf([this](const QAction* one) { return !one->isEnabled() || !m_mayChoose(*one); });
        if (!actions.isEmpty()) {
            actions[static_cast<qsizetype>(upTo(static_cast<std::size_t>(actions.size())))]->trigger();
        }
    }
    void press(QWidget& place) {
        static constexpr std::array kKeys{Qt::Key_Space, Qt::Key_Return, Qt::Key_Tab,  Qt::Key_Backtab,
                                          Qt::Key_Left,  Qt::Key_Right,  Qt::Key_Up,   Qt::Key_Down,
                                          Qt::Key_Home,  Qt::Key_End,    Qt::Key_F6,   Qt::Key_PageDown,
                                          Qt::Key_A,     Qt::Key_F,      Qt::Key_R,    Qt::Key_1,
                                          Qt::Key_2,     Qt::Key_Equal,  Qt::Key_Menu, Qt::Key_Escape};
        static constexpr std::array kWith{Qt::NoModifier, Qt::NoModifier, Qt::ShiftModifier,
                                          Qt::ControlModifier};
        const Qt::Key key = kKeys[upTo(kKeys.size())];
        QWidget* focus = QApplication::focusWidget();
        QTest::keyClick(focus != nullptr ? focus : &place, key, kWith[upTo(kWith.size())]);
    }
    void point(QWidget& place) {
        QList<QWidget*> widgets = place.findChildren<QWidget*>();
        widgets.removeIf([](const QWidget* one) { return !one->isVisible() || one->size().isEmpty(); });
        QPointer<QWidget> at =
            widgets.isEmpty()
                ? &place
                : widgets[static_cast<qsizetype>(upTo(static_cast<std::size_t>(widgets.size())))];
        const auto somewhere = [&] {
            return QPoint(static_cast<int>(upTo(static_cast<std::size_t>(at->width()))),
                          static_cast<int>(upTo(static_cast<std::size_t>(at->height()))));
        };
        const QPoint from = somewhere();
        const QPoint to = upTo(3) == 0 ? somewhere() : from;
        if (upTo(8) == 0) {
            QTest::mouseDClick(at, Qt::LeftButton, {}, from);
            return;
        }
        QTest::mousePress(at, Qt::LeftButton, {}, from);
        if (at != nullptr && to != from) {
            QTest::mouseMove(at, to);
        }
        if (at != nullptr) {
            QTest::mouseRelease(at, Qt::LeftButton, {}, to);
        }
    }

    QMainWindow& m_window;
    std::mt19937 m_random;
    std::function<bool(const QAction&)> m_mayChoose;
    bool m_isActive = false;
    int m_inOpened = 0;
    int m_done = 0;
};

} // namespace posewire::test
