// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/logging.h"
#include "app/gui/base/options.h"
#include "app/gui/base/saving.h"
#include "app/gui/plots/time_plot.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/language.h"
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/character_import.h"
#include "app/gui/viewport/presenter.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/guide.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/opening.h"
#include "app/outlets/metrics.h"
#include "app/system/interruption.h"
#include "app/system/process_figures.h"
#include "app/system/standard_streams.h"
#include "app/usage/usage.h"

#include <QApplication>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <QStorageInfo>
#include <QTimer>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

namespace {

using namespace posewire;
using namespace posewire::gui;

/// Help, version and mistakes need no display: they are dealt with before a window system is asked for.
tl::expected<Options, usage::EarlyExit> readOptions(int& argc, char** argv) {
    const QCoreApplication application(argc, argv);
    return parseOptions(QCoreApplication::arguments(), [] {
        return QStringLiteral("\n%1\n%2\nOpenGL %3")
            .arg(importerName(), plottingName(), windowlessOpenGlName())
            .toStdString();
    });
}

/// Qt ends a program that finds no display with a core dump, and words of its own.
void endWithoutDisplay(QtMsgType type, const QMessageLogContext& /*place*/, const QString& text) {
    if (type == QtFatalMsg) {
        std::fputs(
            "posewire: There is no display to open a window on (DISPLAY or WAYLAND_DISPLAY says which). "
            "'posewire-cli monitor' needs none, and QT_QPA_PLATFORM=offscreen draws pictures without.\n",
            stderr);
        std::_Exit(2);
    }
    if (type == QtCriticalMsg) {
        std::fprintf(stderr, "%s\n", qUtf8Printable(text));
    }
}

/// On a full disk, shaders that are kept end the program: their file is mapped, and has no room.
void keepShadersWhereThereIsRoom() {
    constexpr qint64 kRoom = 64 << 20;
    QDir folder(QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation));
    while (!folder.exists() && folder.cdUp()) {
    }
    if (const QStorageInfo disk(folder); disk.isValid() && disk.bytesAvailable() < kRoom) {
        qputenv("MESA_SHADER_CACHE_DISABLE", "true");
    }
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

/// Nothing that tells what to show: it is what was shown when the program ended.
bool isToRestore(const Options& options) {
    const bool asksForInputs = !options.udpPorts.empty() || !options.tcpInputs.empty() ||
                               options.demoCharacters > 0 || options.stage.isAsked();
    return options.file.isEmpty() && options.comparedFile.isEmpty() && !asksForInputs;
}

void openComparison(MainWindow& window, const Options& options, const Settings& settings) {
    const QString file = isToRestore(options) ? settings.comparedFile : options.comparedFile;
    if (file.isEmpty()) {
        return;
    }
    if (!isToRestore(options)) {
        window.opening().compareWith(file);
    } else if (QFileInfo(file).isFile()) {
        window.driver().files().comparing().open(file); // docks are as they were
    } else {
        window.say(QCoreApplication::translate(
                       "main",
                       "%1 is not there any more, so that nothing is compared with it. File > Compare "
                       "with a recording takes another one.")
                       .arg(file));
    }
}

/// Serves the figures of what is received; null if the options do not ask for it.
net::NetResult<std::unique_ptr<outlets::Metrics>> serveMetrics(SessionDriver& driver, const QString& place) {
    if (place.isEmpty()) {
        return nullptr;
    }
    auto served = outlets::Metrics::serve(place.toStdString(), std::string(usage::version()));
    if (served) {
        std::fprintf(stderr, "posewire: metrics are at %s\n", (*served)->address().c_str());
        QObject::connect(&driver, &SessionDriver::tableTick, &driver, [&driver, &metrics = **served] {
            const model::SessionView& live = driver.commands().live();
            if (metrics.isDue(live.now())) {
                metrics.update(live, {driver.health().health().bufferFill,
                                      driver.receiving().state().refusedDatagrams,
                                      system::processCpuSeconds(), system::processMemoryBytes()});
            }
        });
    }
    return served;
}

/// What takes its time waits until the window can be seen.
void openInputs(MainWindow& window, const Options& options, const Settings& settings) {
    SessionDriver& driver = window.driver();
    const InputChoices& choices = settings.inputs;
    driver.receiving().listenTo(allowedAtStart(options, choices)); // before the first port is open
    if (options.stage.isAsked()) {
        driver.receiving().readStage(options.stage);
        window.docks().show(QStringLiteral("probes"));
    }
    for (const InputAddress& input : inputsToOpen(options, choices)) {
        driver.receiving().addPort(input);
    }
    for (const WayOut& way : choices.waysOut) {
        driver.receiving().waysOut().add(way);
    }
    if (options.demoCharacters > 0) {
        driver.demo().setCharacters(options.demoCharacters);
    }
    // A file that was asked for, else the one that was shown last, if it is still there.
    const QString file =
        isToRestore(options) && QFileInfo(settings.file).isFile() ? settings.file : options.file;
    if (!file.isEmpty()) {
        window.opening().open(file);
        if (OpenedFile* opened = driver.files().file(); isToRestore(options) && opened != nullptr) {
            opened->session().setDisplayFilter(settings.fileFilter.toStdString());
        }
        if (options.seekSeconds) {
            QObject::connect(
                &driver.files(), &Files::opened, &window,
                [&driver, seconds = *options.seekSeconds](bool isRead) {
                    if (isRead) {
                        driver.playback().seek(seconds);
                    }
                },
                Qt::SingleShotConnection);
        }
    } else if (isToRestore(options) && !settings.file.isEmpty()) {
        window.say(QCoreApplication::translate("main", "%1, which was open last, is not there any more.")
                       .arg(settings.file));
    }
    openComparison(window, options, settings);
}

void saveScreenshot(MainWindow& window, const Options& options) {
    QWidget* part =
        options.screenshotPart.isEmpty() ? &window : window.docks().showPart(options.screenshotPart);
    const QString problem =
        part == nullptr
            ? QStringLiteral("--part: there is no '%1' in the window.").arg(options.screenshotPart)
            : savePicture(part->grab(), options.screenshotFile);
    if (!problem.isEmpty()) {
        std::fprintf(stderr, "posewire: %s\n", qUtf8Printable(problem));
    }
    QCoreApplication::exit(problem.isEmpty() ? 0 : 1);
}

/// Takes the picture once the file is open and the viewport has one to show; after some seconds without, as
/// it is. Waits until all parts of the window show one tick, so that their numbers agree.
void takeScreenshot(MainWindow& window, const Options& options, int attempts) {
    constexpr int kAgainMs = 50;
    constexpr int kPaintedMs = 30; // the docks follow the tick, and the next one is later
    const bool isOpening = window.driver().files().isOpening();
    const bool isUnsettled =
        window.viewport().pictures().failure().isEmpty() && !window.viewport().pictures().isSettled();
    if (isOpening || (attempts > 0 && isUnsettled)) {
        const int left = isOpening ? attempts : attempts - 1;
        QTimer::singleShot(kAgainMs, &window,
                           [&window, options, left] { takeScreenshot(window, options, left); });
        return;
    }
    QObject::connect(
        &window.driver(), &SessionDriver::tableTick, &window,
        [&window, options] {
            QTimer::singleShot(kPaintedMs, &window, [&window, options] { saveScreenshot(window, options); });
        },
        Qt::SingleShotConnection);
}

void begin(MainWindow& window, const Options& options, const Settings& settings) {
    if (options.printsStartupTime) {
        std::printf("window on screen after %.0f ms\n", system::processAgeMs());
        std::fflush(stdout);
    }
    openInputs(window, options, settings);
    window.viewport().pictures().start();
    window.driver().start();
    if (options.screenshotFile.isEmpty()) {
        auto* writing = new QTimer(&window);
        QObject::connect(writing, &QTimer::timeout, &window, &MainWindow::writeSettings);
        writing->start(std::chrono::seconds(1));
        if (!window.opening().tellRecovery(settings.take) && !options.skipsTour) {
            window.guide().offerFirstSteps();
        }
    } else {
        constexpr int kAttempts = 100;
        if (!options.screenshotPart.isEmpty()) {
            static_cast<void>(
                window.docks().showPart(options.screenshotPart)); // what it shows comes in meanwhile
        }
        QTimer::singleShot(static_cast<int>(options.screenshotAfterSeconds * 1000), &window,
                           [&window, options] { takeScreenshot(window, options, kAttempts); });
    }
}

} // namespace

int main(int argc, char** argv) {
    system::prepareStandardStreams();
    QCoreApplication::setOrganizationName(QStringLiteral("Posewire"));
    QCoreApplication::setApplicationName(QStringLiteral("posewire"));
    QGuiApplication::setDesktopFileName(QStringLiteral("org.posewire.posewire"));
    QCoreApplication::setApplicationVersion(QString::fromUtf8(posewire::usage::version()));
    const auto options = readOptions(argc, argv);
    if (!options) {
        return usage::end(options.error());
    }
    system::leaveFailedWritesToTheWriter();
    if (options->isVerbose) {
        tellVerbosely();
    }
    keepShadersWhereThereIsRoom();
    const QtMessageHandler usual = qInstallMessageHandler(endWithoutDisplay);
#ifdef _WIN32
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) {
        qputenv("QT_QPA_PLATFORM",
                "windows:darkmode=2"); // the palette follows the system, which Qt 6.4 leaves light
    }
#endif
    QApplication application(argc, argv);
    qInstallMessageHandler(usual);
    useLanguage(options->language);
    SettingsFile file(options->settingsFile);
    QString problem;
    const Settings settings = startSettings(file, *options, &problem);
    applyTheme(application, settings.theme);
    QApplication::setWindowIcon(applicationIcon());

    const log::SystemClock clock;
    SessionDriver driver(clock, QStandardPaths::writableLocation(QStandardPaths::CacheLocation));
    driver.commands().setUsual({.up = model::upNamed(options->up)});
    const auto metrics = serveMetrics(driver, options->metrics);
    if (!metrics) {
        return usage::end({2, "posewire: --metrics: " + metrics.error().text + '\n'});
    }
    MainWindow window(driver, file, settings);
    if (options->size.isValid()) {
        window.resize(options->size);
    }
    new EventWatch(&window, QEvent::Paint, [&, isFirst = true]() mutable {
        if (std::exchange(isFirst, false)) {
            QTimer::singleShot(0, &window, [&] { begin(window, *options, settings); });
        }
    });
    const system::Interruption interruption;
    QObject::connect(&driver, &SessionDriver::tableTick, &window, [&, isEnding = false]() mutable {
        if (system::Interruption::hasCome() && !std::exchange(isEnding, true)) {
            window.close(); // settings and layout are saved
            QCoreApplication::quit();
        }
    });
    window.show();
    if (!problem.isEmpty()) {
        window.say(problem, HelpTopic::SettingsUnusable);
    }
    const int status = QApplication::exec();
    if (options->forgetsHistory) {
        driver.history().discardLost(); // its own goes with the driver
    }
    return status;
}
