// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/line_server.h"

#include "app/net/listening.h"

#include <QFileInfo>
#include <QLocalServer>
#include <QLocalSocket>
#include <QTcpServer>
#include <QTcpSocket>

#include <filesystem>
#include <string_view>
#include <vector>

namespace posewire::net {
namespace {

constexpr std::string_view kUnix = "unix:";

/// Returns whether a path is a socket that a server left when it ended without cleaning up.
bool isLeft(const QString& path) {
    constexpr int kPatience = 200; // milliseconds
    std::error_code error;
    if (!std::filesystem::is_socket(path.toStdString(), error)) {
        return false;
    }
    QLocalSocket probe;
    probe.connectToServer(path, QIODevice::WriteOnly);
    return !probe.waitForConnected(kPatience) && probe.error() == QLocalSocket::ConnectionRefusedError;
}

} // namespace

struct LineServer::Parts {
    NetResult<void> listenAt(const std::string& text) {
        if (const auto listening = listenTcp(tcp, text); !listening) {
            return tl::unexpected(listening.error());
        }
        place = textOf(tcp.serverAddress(), tcp.serverPort());
        QObject::connect(&tcp, &QTcpServer::newConnection, &tcp, [this] {
            while (QTcpSocket* socket = tcp.nextPendingConnection()) {
                admit(socket);
            }
        });
        return {};
    }
    NetResult<void> listenOn(const QString& path) {
        local.setSocketOptions(QLocalServer::UserAccessOption); // Qt replaces what is there then
        if (QFileInfo::exists(path) && !isLeft(path)) {
            return netError(NetError::Kind::PortInUse,
                            path.toStdString() + " is there already; name another path");
        }
        if (!local.listen(path)) {
            return netError(NetError::Kind::Other, path.toStdString() + ": no socket can be made there (" +
                                                       local.errorString().toStdString() +
                                                       "); name another path");
        }
        place = std::string(kUnix) + path.toStdString();
        QObject::connect(&local, &QLocalServer::newConnection, &local, [this] {
            while (QLocalSocket* socket = local.nextPendingConnection()) {
                admit(socket);
            }
        });
        return {};
    }

    template <class Socket>
    void admit(Socket* socket) {
        socket->setReadBufferSize(1); // what it sends must not fill the memory
        if (receivers.size() >= kMostReceivers) {
            socket->deleteLater();
            return;
        }
        receivers.push_back(socket);
        QObject::connect(socket, &Socket::disconnected, socket, [this, socket] {
            std::erase(receivers, socket);
            socket->deleteLater();
        });
    }

    QTcpServer tcp;
    QLocalServer local;
    std::string place;
    std::vector<QIODevice*> receivers; ///< owned by the server
    std::uint64_t sent = 0;
    std::uint64_t skipped = 0;
};

LineServer::LineServer(std::unique_ptr<Parts> parts) : m_parts(std::move(parts)) {}

LineServer::~LineServer() {
    for (QIODevice* receiver : m_parts->receivers) {
        receiver->disconnect();
    }
}

NetResult<std::unique_ptr<LineServer>> LineServer::listen(const std::string& place) {
    auto parts = std::make_unique<Parts>();
    const auto listening = place.starts_with(kUnix)
                               ? parts->listenOn(QString::fromStdString(place.substr(kUnix.size())))
                               : parts->listenAt(place);
    if (!listening) {
        return tl::unexpected(listening.error());
    }
    return std::unique_ptr<LineServer>(new LineServer(std::move(parts)));
}

void LineServer::send(const std::string& line) {
    for (QIODevice* receiver : m_parts->receivers) {
        if (receiver->bytesToWrite() > kMostUnread) {
            ++m_parts->skipped;
            continue;
        }
        receiver->write(line.data(), static_cast<qint64>(line.size()));
        receiver->write("\n", 1);
        ++m_parts->sent;
    }
}

const std::string& LineServer::place() const {
    return m_parts->place;
}

std::size_t LineServer::receivers() const {
    return m_parts->receivers.size();
}

std::uint64_t LineServer::sent() const {
    return m_parts->sent;
}

std::uint64_t LineServer::skipped() const {
    return m_parts->skipped;
}

} // namespace posewire::net
