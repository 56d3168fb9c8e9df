// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/main_window.h"
#include "core/log/clock.h"
#include "tests/support/random_user.h"

#include <QApplication>
#include <QDir>
#include <QTemporaryDir>
#include <QTimer>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

/// POSEWIRE_SECONDS and POSEWIRE_SEED choose another time and another user.
TEST(RandomUser, EndsNothing) {
    const QTemporaryDir folder;
    const QString before = QDir::currentPath();
    const QByteArray home = qgetenv("HOME");
    qputenv("HOME", QFile::encodeName(folder.path()));
    QDir::setCurrent(folder.path());
    const int seconds = std::max(1, qEnvironmentVariableIntValue("POSEWIRE_SECONDS"));
    SettingsFile file(folder.filePath("settings.json"));
    const log::SystemClock clock;
    SessionDriver driver(clock);
    int done = 0;
    {
        MainWindow window(driver, file, {});
        window.resize(1280, 800);
        window.show();
        driver.receiving().addPort({QStringLiteral("127.0.0.1"), 0});
        driver.demo().setCharacters(2);
        window.viewport().pictures().start();
        driver.start();
        test::RandomUser user(window, static_cast<unsigned>(qEnvironmentVariableIntValue("POSEWIRE_SEED")),
                              [](const QAction& action) { return action.objectName() != u"quit"; });
        user.start();
        QTimer::singleShot(1000 * seconds, &window, [&] {
            user.stop();
            QApplication::quit();
        });
        QApplication::exec();
        done = user.done();
        window.writeSettings();
    }
    RecordProperty("done", done);
    EXPECT_GT(done, 10);
    EXPECT_NE(driver.commands().live().end(), 0U) << "it has received meanwhile";
    QDir::setCurrent(before);
    qputenv("HOME", home);
}

} // namespace
} // namespace posewire::gui
