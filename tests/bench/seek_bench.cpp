// SPDX-License-Identifier: GPL-3.0-or-later
// Seeking in a recording with the whole window open: from the wish until every dock in sight has the moment
// and the viewport shows it. Makes a recording of 1 GB in the folder for temporary files, or takes one that
// is there. Limits: 33 ms in the middle, 100 ms for all but one in a hundred.
//   seek_bench [--check] [--brief] [FILE]
#include "app/gui/window/main_window.h"
#include "core/log/log_reader.h"
#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <QApplication>
#include <QTemporaryDir>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <optional>
#include <random>
#include <vector>

using namespace posewire;
using namespace posewire::gui;

namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Four characters in every type at 240 Hz.
bool record(const std::string& path, std::uint64_t bytes) {
    performer::PerformerSettings settings;
    settings.characters = 4;
    settings.rateHz = 240.0;
    performer::Performer performer(settings);
    auto sink = log::createFile(path);
    if (!sink) {
        return false;
    }
    log::PcapngWriter writer(**sink);
    bool isWritten = writer.begin({}).has_value();
    const log::Stamp start = log::asStamp(log::WallTime(std::chrono::hours(24 * 365 * 50)));
    for (std::uint64_t frame = 0; isWritten && writer.bytes() < bytes; ++frame) {
        const log::Stamp at = start + log::durationOf(static_cast<double>(frame) / settings.rateHz);
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            const auto encoded = wire::encode(datagram);
            isWritten = isWritten && encoded &&
                        writer.add({writer.packets(), at, {}, 0, {}, *encoded},
                                   {"10.0.0.2:4000", log::Transport::Udp, 9763});
        }
    }
    return isWritten && writer.addStatistics() && (*sink)->flush();
}

class Seeking {
public:
    explicit Seeking(const QString& folder)
        : m_file(folder + QStringLiteral("/settings.json")), m_driver(m_clock, folder) {
        m_window.resize(1280, 720);
        m_window.show();
        m_window.viewport().pictures().start();
        m_driver.start();
        QObject::connect(&m_driver, &SessionDriver::tableTick, &m_window, [this] { ++m_tableTicks; });
    }

    bool open(const QString& path) {
        m_driver.files().open(path);
        while (m_driver.files().isOpening()) {
            QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
        }
        const model::SessionView& session = m_driver.commands().session();
        if (!m_driver.commands().isFileShown() || session.end() == 0) {
            return false;
        }
        log::LogReader reader(session.log());
        m_last = reader.packet(session.end() - 1)->stamp;
        return true;
    }

    /// ms until the window shows a moment; `share` of the recording.
    double seek(double share) {
        const model::SessionView& session = m_driver.commands().session();
        const double length = log::secondsOf(m_last - session.firstStamp());
        const std::uint64_t pictures = m_window.viewport().pictures().count();
        const std::uint64_t ticks = m_tableTicks;
        const Clock::time_point begin = Clock::now();
        m_driver.playback().showMoment(session.firstStamp() + log::durationOf(share * length));
        const auto isShown = [&] {
            return m_tableTicks > ticks && m_window.viewport().pictures().count() > pictures &&
                   m_window.viewport().pictures().isSettled();
        };
        while (!isShown() && msSince(begin) < 5000) {
            QCoreApplication::processEvents(QEventLoop::AllEvents, 1);
        }
        return msSince(begin);
    }

private:
    log::SystemClock m_clock;
    SettingsFile m_file;
    SessionDriver m_driver;
    MainWindow m_window{m_driver, m_file, {}};
    std::uint64_t m_tableTicks = 0;
    log::Stamp m_last{}; ///< of the recording
};

int verdict(const char* name, double value, double limit, bool isChecked) {
    std::printf("%s %.1f %.1f\n", name, value, limit);
    return isChecked && value > limit ? 1 : 0;
}

} // namespace

int main(int argc, char** argv) {
    const QApplication application(argc, argv);
    bool isChecked = false;
    bool isBrief = false;
    std::optional<QString> path;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--check") == 0) {
            isChecked = true;
        } else if (std::strcmp(argv[i], "--brief") == 0) {
            isBrief = true;
        } else {
            path = QString::fromLocal8Bit(argv[i]);
        }
    }
    const QTemporaryDir folder;
    if (!path) {
        path = folder.filePath("take.pcapng");
        if (!record(path->toStdString(), isBrief ? 4'000'000 : 1'000'000'000)) {
            std::fprintf(stderr, "seek_bench: no room for the recording\n");
            return 2;
        }
    }
    Seeking seeking(folder.path());
    if (!seeking.open(*path)) {
        std::fprintf(stderr, "seek_bench: %s was not opened\n", qUtf8Printable(*path));
        return 2;
    }
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share;
    std::vector<double> times;
    for (int i = 0; i < (isBrief ? 5 : 300); ++i) {
        times.push_back(seeking.seek(share(random)));
    }
    std::ranges::sort(times);
    return verdict("seek_median_ms", times[times.size() / 2], 33.0, isChecked) |
           verdict("seek_p99_ms", times[times.size() * 99 / 100], 100.0, isChecked);
}
