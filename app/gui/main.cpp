// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/ending_signals.h"
#include "app/gui/logging.h"
#include "app/gui/options.h"
#include "app/gui/saving.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/icons.h"
#include "app/gui/viewport/presenter.h"
#include "app/gui/window/main_window.h"
#include "app/system/process_figures.h"
#include "app/system/standard_streams.h"
#include "app/usage/version.h"

#include <QApplication>
#include <QFileInfo>
#include <QStandardPaths>
#include <QTimer>

#include <cstdio>
#include <utility>

namespace {

using namespace posewire;
using namespace posewire::gui;

/// Help, version and errors need no display: they are dealt with before a window system is asked for.
tl::expected<Options, EarlyExit> readOptions(int& argc, char** argv) {
    const QCoreApplication application(argc, argv);
    auto options = parseOptions(QCoreApplication::arguments());
    if (!options && options.error().isVersion) {
        options.error().text += QStringLiteral("OpenGL %1\n").arg(windowlessOpenGlName());
    }
    return options;
}

Settings startSettings(SettingsFile& file, const Options& options, QString* problem) {
    Settings settings = file.read(problem);
    if (options.resetsLayout) {
        settings.docks.clear();
        settings.window = {};
        settings.isMaximized = false;
    }
    if (!options.layout.isEmpty()) {
        settings.layout = options.layout;
        settings.docks.clear();
    }
    settings.theme = options.theme.value_or(settings.theme);
    return settings;
}

/// What is asked for; where nothing is, what was shown when the program ended, if it is still there.
QString fileToOpen(const Options& options, const Settings& settings) {
    const bool asksForInputs =
        !options.udpPorts.empty() || !options.tcpInputs.empty() || options.demoCharacters > 0;
    const bool isToRestore = options.file.isEmpty() && !asksForInputs && QFileInfo(settings.file).isFile();
    return isToRestore ? settings.file : options.file;
}

/// What takes its time waits until the window can be seen.
void openInputs(MainWindow& window, const Options& options) {
    SessionDriver& driver = window.driver();
    const InputChoices choices = window.settings().inputs;
    driver.receiving().listenTo(allowedAtStart(options, choices)); // before the first port is open
    for (const InputAddress& input : inputsToOpen(options, choices)) {
        driver.receiving().addPort(input);
    }
    for (const RelayChoice& relay : choices.relays) {
        driver.receiving().relaying().add(relay);
    }
    if (options.demoCharacters > 0) {
        driver.setDemo(options.demoCharacters);
    }
    const QString file = fileToOpen(options, window.settings());
    if (!file.isEmpty()) {
        window.openPath(file);
        if (options.seekSeconds) {
            QObject::connect(
                &driver, &SessionDriver::fileOpened, &window,
                [&driver, seconds = *options.seekSeconds](bool isRead) {
                    if (isRead) {
                        driver.seek(seconds);
                    }
                },
                Qt::SingleShotConnection);
        }
    }
}

/// Takes the picture once the file is open and the viewport has one to show; after some seconds without, as
/// it is.
void takeScreenshot(MainWindow& window, const QString& path, int attempts) {
    constexpr int kAgainMs = 50;
    const bool isOpening = window.driver().isOpening();
    const bool isUnsettled = window.viewport().failure().isEmpty() && !window.viewport().isSettled();
    if (isOpening || (attempts > 0 && isUnsettled)) {
        const int left = isOpening ? attempts : attempts - 1;
        QTimer::singleShot(kAgainMs, &window, [&window, path, left] { takeScreenshot(window, path, left); });
        return;
    }
    const QString problem = savePicture(window.grab(), path);
    if (!problem.isEmpty()) {
        std::fprintf(stderr, "posewire: %s\n", qUtf8Printable(problem));
    }
    QCoreApplication::exit(problem.isEmpty() ? 0 : 1);
}

void begin(MainWindow& window, const Options& options) {
    if (options.printsStartupTime) {
        std::printf("window on screen after %.0f ms\n", system::processAgeMs());
        std::fflush(stdout);
    }
    openInputs(window, options);
    window.viewport().start();
    window.driver().start();
    if (options.screenshotFile.isEmpty()) {
        window.offerRecovered();
    } else {
        constexpr int kAttempts = 100;
        QTimer::singleShot(static_cast<int>(options.screenshotAfterSeconds * 1000), &window,
                           [&window, options] { takeScreenshot(window, options.screenshotFile, kAttempts); });
    }
}

} // namespace

int main(int argc, char** argv) {
    QCoreApplication::setOrganizationName(QStringLiteral("Posewire"));
    QCoreApplication::setApplicationName(QStringLiteral("posewire"));
    QCoreApplication::setApplicationVersion(QString::fromUtf8(posewire::usage::version()));
    const auto options = readOptions(argc, argv);
    if (!options) {
        std::fputs(qUtf8Printable(options.error().text), options.error().status == 0 ? stdout : stderr);
        return options.error().status;
    }
    system::leaveFailedWritesToTheWriter();
    if (options->isVerbose) {
        tellVerbosely();
    }
    QApplication application(argc, argv);
    SettingsFile file(options->settingsFile);
    QString problem;
    const Settings settings = startSettings(file, *options, &problem);
    applyTheme(application, settings.theme);
    QApplication::setWindowIcon(applicationIcon());

    const log::SystemClock clock;
    SessionDriver driver(clock, QStandardPaths::writableLocation(QStandardPaths::CacheLocation));
    MainWindow window(driver, file, settings);
    if (options->size.isValid()) {
        window.resize(options->size);
    }
    new EventWatch(&window, QEvent::Paint, [&, isFirst = true]() mutable {
        if (std::exchange(isFirst, false)) {
            QTimer::singleShot(0, &window, [&] { begin(window, *options); });
        }
    });
    const EndingSignals ending;
    QObject::connect(&ending, &EndingSignals::requested, &window, [&window] {
        window.close(); // settings and layout are saved
        QCoreApplication::quit();
    });
    window.show();
    if (!problem.isEmpty()) {
        window.say(problem);
    }
    return QApplication::exec();
}
