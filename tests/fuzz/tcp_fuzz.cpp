// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_room.h"
#include "core/log/packet_log.h"
#include "tests/support/manual_clock.h"

#include <QHostAddress>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

// Whoever connects to the TCP listener, whatever they send in whatever pieces, whenever they hang up: each
// byte of a connection that was let in is in the log, once and in order, and there is never one connection
// too many.
namespace {

using namespace posewire;

constexpr std::size_t kMostConnections = 300;
constexpr std::size_t kMostPeers = 64;
constexpr std::uint16_t kFirstPort = 10'000;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

/// What a connection is for those who connect.
struct Line {
    std::string sent;
    bool isOpen = true;     ///< on our side: bytes can still arrive
    bool isRefused = false; ///< nothing of it is read
    bool isCutOff = false;  ///< by us: what it had begun may be missing
};

/// A connection without a network.
class LineSocket final : public QTcpSocket {
public:
    LineSocket(Line& line, const QHostAddress& host, std::uint16_t port) : m_line(line) {
        setPeerAddress(host);
        setPeerPort(port);
        setSocketState(ConnectedState);
        setOpenMode(ReadWrite);
    }
    ~LineSocket() override { m_line.isOpen = false; }

    void arrive(const char* bytes, std::size_t size) {
        m_waiting.append(bytes, size);
        m_line.sent.append(bytes, size);
    }
    void hangUp() { setSocketState(UnconnectedState); }
    [[nodiscard]] bool isConnected() const { return state() == ConnectedState; }

    void close() override {
        m_line.isRefused = true;
        setSocketState(UnconnectedState);
    }
    [[nodiscard]] qint64 bytesAvailable() const override {
        return static_cast<qint64>(m_waiting.size()) + QIODevice::bytesAvailable();
    }
    bool waitForReadyRead(int /*ms*/) override { return false; }

protected:
    qint64 readData(char* into, qint64 most) override {
        const std::size_t count = std::min(m_waiting.size(), static_cast<std::size_t>(most));
        std::memcpy(into, m_waiting.data(), count);
        m_waiting.erase(0, count);
        return static_cast<qint64>(count);
    }

private:
    Line& m_line;
    std::string m_waiting;
};

/// A listener and all who connect to it.
class Stage {
public:
    void play(std::span<const std::uint8_t> script) {
        m_script = script;
        while (!m_script.empty()) {
            step();
            require(m_input->status().peers.size() <= kMostPeers);
        }
        end();
        check();
    }

private:
    std::uint8_t take() {
        if (m_script.empty()) {
            return 0;
        }
        const std::uint8_t value = m_script.front();
        m_script = m_script.subspan(1);
        return value;
    }

    void step() {
        const std::uint8_t what = take();
        switch (what % 8) {
        case 0:
            connect(take());
            break;
        case 1:
            for (std::uint8_t i = take() % kMostPeers; i > 0; --i) {
                connect(i);
            }
            break;
        case 2:
            hangUp(take());
            break;
        case 3:
            m_clock.advance(std::chrono::seconds(take()));
            break;
        case 4:
            listenTo(take());
            break;
        case 5:
            m_room.turn(m_clock.monotonic());
            break;
        default:
            send(take(), std::size_t{take()} * (what % 8 == 6 ? 1 : 16));
        }
    }

    void connect(std::uint8_t host) {
        if (m_lines.size() == kMostConnections) {
            return;
        }
        m_lines.push_back(std::make_unique<Line>());
        const QHostAddress address(QStringLiteral("10.0.0.%1").arg(host % 4));
        const auto port = static_cast<std::uint16_t>(kFirstPort + m_lines.size() - 1);
        auto socket = std::make_unique<LineSocket>(*m_lines.back(), address, port);
        m_sockets.push_back(socket.get());
        m_hosts.push_back(address);
        m_room.admit(std::move(socket), 9763);
    }

    /// Null where there is none.
    LineSocket* open(std::uint8_t which) {
        const std::size_t index = m_lines.empty() ? 0 : which % m_lines.size();
        return !m_lines.empty() && m_lines[index]->isOpen ? m_sockets[index] : nullptr;
    }

    void send(std::uint8_t which, std::size_t size) {
        const auto bytes = m_script.first(std::min(size, m_script.size()));
        m_script = m_script.subspan(bytes.size());
        if (LineSocket* socket = open(which); socket != nullptr && socket->isConnected()) {
            socket->arrive(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        }
    }

    void hangUp(std::uint8_t which) {
        if (LineSocket* socket = open(which)) {
            socket->hangUp();
        }
    }

    void listenTo(std::uint8_t whom) {
        const bool isEveryone = whom % 3 == 0;
        m_context.allowed = isEveryone ? net::AllowList()
                                       : net::AllowList::withoutNames({"10.0.0." + std::to_string(whom % 4)});
        for (std::size_t i = 0; i < m_lines.size(); ++i) {
            m_lines[i]->isCutOff |= m_lines[i]->isOpen && !m_context.allowed.allows(m_hosts[i]);
        }
        m_room.heedAllowed();
    }

    void end() {
        for (std::size_t i = 0; i < m_lines.size(); ++i) {
            if (m_lines[i]->isOpen) {
                m_sockets[i]->hangUp();
            }
        }
        while (m_room.turn(m_clock.monotonic())) {
        }
        m_room.publish();
        require(m_input->status().peers.empty());
    }

    void check() {
        std::map<std::string, std::string> received;
        log::LogReader reader(m_log);
        for (std::uint64_t number = reader.begin(); number < reader.end(); ++number) {
            const auto packet = reader.packet(number);
            received[m_log.senders().find(packet->sender)->address].append(
                reinterpret_cast<const char*>(packet->bytes.data()), packet->bytes.size());
        }
        for (std::size_t i = 0; i < m_lines.size(); ++i) {
            const Line& line = *m_lines[i];
            const std::string address =
                m_hosts[i].toString().toStdString() + ':' + std::to_string(kFirstPort + i);
            const std::string& got = received[address];
            require(!line.isOpen);
            require(line.isRefused  ? got.empty()
                    : line.isCutOff ? line.sent.starts_with(got)
                                    : got == line.sent);
        }
    }

    log::ManualClock m_clock{log::WallTime(std::chrono::hours(1)), log::Moment(std::chrono::hours(1))};
    log::PacketLog m_log{{.memoryCap = std::size_t{32} << 20, .chunkSize = std::size_t{1} << 20}};
    net::PacketQueue m_queue{[this] { m_queue.moveTo(m_log); }};
    net::TcpContext m_context{m_clock, m_log.timeline(), m_queue, {}};
    std::shared_ptr<net::Input> m_input = std::make_shared<net::Input>(
        net::InputId{1}, net::InputKind::TcpListener, net::Endpoint{"127.0.0.1", 9763});
    std::vector<std::unique_ptr<Line>> m_lines; ///< as the next two, in the order of connecting
    std::vector<LineSocket*> m_sockets;         ///< valid while the line is open
    std::vector<QHostAddress> m_hosts;
    std::span<const std::uint8_t> m_script;
    net::TcpRoom m_room{m_context, m_input}; // last: its sockets tell the lines that they end
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Stage().play({data, size});
    return 0;
}
