// SPDX-License-Identifier: GPL-3.0-or-later
// The whole window under design load: four characters in every type at 240 Hz, 9,600 datagrams a second and
// more, for ten minutes, with the window's thread blocked for a second every 30 s. Nothing may be dropped in
// this computer; receiving and accounting together stay under a tenth of a core; memory stays flat once the
// history is full.
//   design_load [--check] [--brief]
#include "app/gui/window/main_window.h"
#include "app/system/process_figures.h"
#include "tests/bench/udp_bench.h"

#include <QApplication>
#include <QProcess>
#include <QTemporaryDir>
#include <QTimer>

#include <cstring>
#include <thread>

namespace {

using namespace posewire;
using namespace posewire::gui;
using namespace posewire::bench;

constexpr double kMostCpu = 0.10;    ///< of a core
constexpr double kMostGrowth = 1.05; ///< of the memory in the second half
constexpr int kBlockedMs = 1000;
constexpr int kSampleMs = 500;

struct Plan {
    int seconds = 600;
    int blockedEveryMs = 30'000;
};

/// What the window says about itself, a few times a second.
class Watch {
public:
    explicit Watch(SessionDriver& driver) : m_driver(driver) {}

    void look() {
        const MonitorHealth& health = m_driver.health().health();
        m_share += health.receiverShare.value_or(0) + health.followShare;
        m_memory.push_back(static_cast<double>(system::processMemoryBytes().value_or(0)));
    }
    [[nodiscard]] double share() const { return m_share / static_cast<double>(m_memory.size()); }
    /// The most memory in the last tenth against the most in the tenth before the middle.
    [[nodiscard]] double growth() const {
        const auto size = static_cast<std::ptrdiff_t>(m_memory.size());
        const auto most = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
            return *std::max_element(m_memory.begin() + from, m_memory.begin() + std::max(from + 1, to));
        };
        return most(size - size / 10 - 1, size) / most(size / 2 - size / 10, size / 2);
    }
    [[nodiscard]] double memory() const { return m_memory.back(); }

private:
    SessionDriver& m_driver;
    double m_share = 0;
    std::vector<double> m_memory;
};

QStringList senderArguments(std::uint16_t port, const Plan& plan) {
    return {"send",         "--to",       QStringLiteral("127.0.0.1:%1").arg(port),
            "--characters", "4",          "--rate",
            "240",          "--duration", QString::number(plan.seconds)};
}

/// The number in "sent N datagrams".
std::uint64_t sentBy(QProcess& sender) {
    const QList<QByteArray> words = sender.readAllStandardOutput().trimmed().split(' ');
    return words.size() > 1 ? words[1].toULongLong() : 0;
}

} // namespace

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    Plan plan;
    bool isChecked = false;
    for (int i = 1; i < argc; ++i) {
        isChecked |= std::strcmp(argv[i], "--check") == 0;
        plan = std::strcmp(argv[i], "--brief") == 0 ? Plan{4, 2000} : plan;
    }
    const QTemporaryDir folder;
    SettingsFile file(folder.filePath("settings.json"));
    const log::SystemClock clock;
    SessionDriver driver(clock);
    MainWindow window(driver, file, {});
    window.resize(1600, 1000);
    window.show();
    driver.receiving().addPort({QStringLiteral("127.0.0.1"), 0});
    window.viewport().pictures().start();
    driver.start();

    QProcess sender;
    sender.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    QTimer blocking;
    QObject::connect(&blocking, &QTimer::timeout,
                     [] { std::this_thread::sleep_for(std::chrono::milliseconds(kBlockedMs)); });
    Watch watch(driver);
    QTimer sampling;
    QObject::connect(&sampling, &QTimer::timeout, [&watch] { watch.look(); });
    QObject::connect(&sender, &QProcess::finished, &application,
                     [] { QTimer::singleShot(1000, [] { QCoreApplication::quit(); }); });
    QObject::connect(&sender, &QProcess::errorOccurred, &application, [] { QCoreApplication::exit(2); });
    sender.start(POSEWIRE_CLI, senderArguments(driver.receiving().openPort(), plan));
    blocking.start(plan.blockedEveryMs);
    sampling.start(kSampleMs);
    if (const int failed = QApplication::exec(); failed != 0) {
        std::fprintf(stderr, "design_load: the sender did not start\n");
        return failed;
    }
    const net::ReceiveTotals totals = driver.receiving().receiver().totals();
    const std::uint64_t sent = sentBy(sender);
    std::fprintf(stderr,
                 "sent %llu, received %llu, followed %llu, dropped by the kernel %llu, memory %.0f MB\n",
                 static_cast<unsigned long long>(sent), static_cast<unsigned long long>(totals.datagrams),
                 static_cast<unsigned long long>(driver.commands().session().end()),
                 static_cast<unsigned long long>(totals.kernelDropped), watch.memory() * 1e-6);
    const auto lost = static_cast<double>(sent) - static_cast<double>(driver.commands().session().end());
    return verdict("design_load_lost", lost, 0, isChecked) |
           verdict("design_load_cpu", watch.share(), kMostCpu, isChecked) |
           verdict("design_load_memory", watch.growth(), kMostGrowth, isChecked);
}
