// SPDX-License-Identifier: GPL-3.0-or-later
// How late is the window's event loop under what is many, not much: hundreds of characters, unknown tags and
// types, and connections that come and go? Against a picture of 60 in a second (95 %), and the tenth of one
// (the worst).
//   window_bench [--check] [--brief]
#include "app/gui/window/main_window.h"
#include "core/performer/performer.h"
#include "tests/bench/udp_bench.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QTcpServer>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <QTimer>
#include <QUdpSocket>

#include <functional>
#include <memory>
#include <string>

namespace {

using namespace posewire;
using namespace posewire::gui;
using namespace posewire::bench;

constexpr double kMostMs = 100;
constexpr double kUsualMs = 16;
constexpr int kBeatMs = 5;

class Bench {
public:
    explicit Bench(int seconds) : m_seconds(seconds) {
        m_window.resize(1600, 1000);
        m_window.show();
        m_driver.receiving().addPort({QStringLiteral("127.0.0.1"), 0});
        m_window.viewport().pictures().start();
        m_driver.start();
        for (std::unique_ptr<QUdpSocket>& socket : m_sockets) {
            socket = std::make_unique<QUdpSocket>();
            socket->bind(QHostAddress::LocalHost, 0);
        }
    }

    /// Calls `send` so often each second for a while, after a while in which the window gets used to it.
    /// Returns how late the loop came, in ms, in order.
    std::vector<double> measure(double hz, const std::function<void(std::uint64_t)>& send) {
        std::vector<double> late;
        std::uint64_t sent = 0;
        QElapsedTimer time;
        QElapsedTimer beat;
        time.start();
        beat.start();
        QTimer beats;
        beats.setTimerType(Qt::PreciseTimer);
        QObject::connect(&beats, &QTimer::timeout, [&] {
            const double passed = static_cast<double>(beat.nsecsElapsed()) * 1e-6 - kBeatMs;
            if (time.elapsed() > 1000 * m_seconds) {
                late.push_back(std::max(0.0, passed));
            }
            if (time.elapsed() > 2000 * m_seconds) {
                QCoreApplication::quit();
            }
            for (; static_cast<double>(sent) < hz * static_cast<double>(time.elapsed()) * 1e-3; ++sent) {
                send(sent);
            }
            beat.restart(); // sending is not the window's
        });
        beats.start(kBeatMs);
        QApplication::exec();
        std::ranges::sort(late);
        return late;
    }

    void send(const wire::Datagram& datagram, std::size_t from) {
        const std::vector<std::byte> bytes = *wire::encode(datagram);
        m_sockets[from % m_sockets.size()]->writeDatagram(reinterpret_cast<const char*>(bytes.data()),
                                                          static_cast<qint64>(bytes.size()),
                                                          QHostAddress::LocalHost, port());
    }
    [[nodiscard]] std::uint16_t port() { return m_driver.receiving().openPort(); }
    SessionDriver& driver() { return m_driver; }

private:
    int m_seconds;
    QTemporaryDir m_folder;
    SettingsFile m_file{m_folder.filePath("settings.json")};
    log::SystemClock m_clock;
    SessionDriver m_driver{m_clock};
    MainWindow m_window{m_driver, m_file, {}};
    std::array<std::unique_ptr<QUdpSocket>, 16> m_sockets;
};

wire::Datagram of(wire::Body body, std::uint8_t character, std::uint32_t sample) {
    wire::Datagram datagram{{}, std::move(body), {}};
    datagram.header.sampleCounter = sample;
    datagram.header.datagramCounter = 0x80;
    datagram.header.character = character;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    return datagram;
}

/// 16 senders of 32 characters, five samples a second.
std::vector<double> manyCharacters(int seconds) {
    Bench bench(seconds);
    performer::Performer performer({.characters = 32, .rateHz = 5, .types = {2, 12}});
    return bench.measure(5 * 16, [&](std::uint64_t number) {
        for (const wire::Datagram& datagram : performer.frame(number / 16)) {
            bench.send(datagram, number);
        }
    });
}

/// Metadata of 5,000 tags that no specification has.
std::vector<double> manyTags(int seconds) {
    Bench bench(seconds);
    std::string tags = "name:Ana\n";
    for (int i = 0; i < 5000; ++i) {
        tags += 't' + std::to_string(i) + ':' + std::to_string(i) + '\n';
    }
    performer::Performer performer({.characters = 1, .rateHz = 60, .types = {2}});
    return bench.measure(60, [&](std::uint64_t number) {
        if (number % 12 == 0) {
            bench.send(of(wire::MetaData{true, tags + "n:" + std::to_string(number) + '\n'}, 0, 0), 0);
        }
        for (const wire::Datagram& datagram : performer.frame(number)) {
            bench.send(datagram, 0);
        }
    });
}

/// All characters that there can be, in sixty types that no specification has.
std::vector<double> manyTypes(int seconds) {
    Bench bench(seconds);
    return bench.measure(4000, [&](std::uint64_t number) {
        wire::Datagram datagram =
            of(wire::RawBody{std::vector<std::byte>(24)}, static_cast<std::uint8_t>(number % 256),
               static_cast<std::uint32_t>(number / 25600));
        const auto type = static_cast<int>(number / 256 % 60) + 30;
        datagram.header.setType(static_cast<std::uint8_t>(type));
        bench.send(datagram, 0);
    });
}

/// 240 TCP connections a second.
std::vector<double> manyConnections(int seconds) {
    Bench bench(seconds);
    QTcpServer free;
    free.listen(QHostAddress::LocalHost, 0);
    const std::uint16_t port = free.serverPort();
    free.close();
    bench.driver().receiving().addPort({QStringLiteral("127.0.0.1"), port, InputAddress::Kind::TcpListener});
    return bench.measure(240, [&](std::uint64_t) {
        QTcpSocket socket;
        socket.connectToHost(QHostAddress::LocalHost, port);
        static_cast<void>(socket.waitForConnected(20));
    });
}

} // namespace

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    bool isChecked = false;
    bool isBrief = false;
    for (int i = 1; i < argc; ++i) {
        isChecked |= std::strcmp(argv[i], "--check") == 0;
        isBrief |= std::strcmp(argv[i], "--brief") == 0;
    }
    const int seconds = isBrief ? 1 : 10;
    int failed = 0;
    const std::pair<std::string, std::vector<double> (*)(int)> loads[]{{"characters", manyCharacters},
                                                                       {"tags", manyTags},
                                                                       {"types", manyTypes},
                                                                       {"connections", manyConnections}};
    for (const auto& [name, measure] : loads) {
        const std::vector<double> late = measure(seconds);
        failed |= verdict(("window_" + name + "_p95").c_str(), late[late.size() * 95 / 100] / kUsualMs, 1,
                          isChecked);
        failed |= verdict(("window_" + name + "_most").c_str(), late.back() / kMostMs, 1, isChecked);
    }
    return failed;
}
