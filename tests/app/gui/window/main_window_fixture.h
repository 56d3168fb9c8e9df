// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/window/docks.h"
#include "app/gui/window/main_window.h"

#include <QAction>
#include <QDockWidget>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace posewire::gui {

/// Windows with settings of their own, which receive nothing.
class MainWindowTest : public testing::Test {
protected:
    std::unique_ptr<MainWindow> makeWindow(const Settings& settings = {}) {
        auto window = std::make_unique<MainWindow>(driver, file, settings);
        window->resize(1280, 800);
        window->show();
        QTest::qWait(1);
        return window;
    }
    static QDockWidget* dock(MainWindow& window, const QString& name) {
        return window.findChild<QDockWidget*>(name);
    }

    /// Both of them, the second before the first.
    static std::pair<QDockWidget*, QDockWidget*> tabbed(MainWindow& window, const QString& behind,
                                                        const QString& front) {
        const std::pair docks{dock(window, behind), dock(window, front)};
        docks.first->show();
        docks.second->show();
        window.tabifyDockWidget(docks.first, docks.second);
        docks.second->raise();
        QTest::qWait(1);
        return docks;
    }

    static QAction* action(MainWindow& window, const QString& id) { return window.findChild<QAction*>(id); }

    QTemporaryDir folder;
    SettingsFile file{folder.filePath("settings.json")};
    log::SystemClock clock;
    SessionDriver driver{clock};
};

} // namespace posewire::gui
