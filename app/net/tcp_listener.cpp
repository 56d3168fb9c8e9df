// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"
#include "app/net/tcp_room.h"
#include "app/net/tcp_thread.h"

#include <QNetworkProxy>
#include <QTcpServer>

#include <algorithm>

namespace posewire::net {
namespace {

/// Between attempts where the system lets nobody in.
constexpr log::Duration kAcceptPause = std::chrono::seconds(1);

class TcpListener final : public TcpInput {
public:
    TcpListener(const TcpContext& context, std::shared_ptr<Input> input)
        : TcpInput(context, std::move(input)), m_room(context, m_input) {
        m_server.setProxy(QNetworkProxy::NoProxy);
        QObject::connect(&m_server, &QTcpServer::acceptError, &m_server, [this] {
            m_resume = m_context.clock.monotonic() + kAcceptPause; // Qt accepts nobody until it is told to
            m_input->setProblem("TCP port " + std::to_string(m_server.serverPort()) +
                                ": the system lets nobody in (" + m_server.errorString().toStdString() +
                                "); close other connections and files. Trying again");
        });
    }

    NetResult<void> listen() {
        const Endpoint endpoint = m_input->status().endpoint;
        const auto address = listenAddress(endpoint.host);
        if (!address) {
            return tl::unexpected(address.error());
        }
        if (!m_server.listen(*address, endpoint.port)) {
            return tl::unexpected(
                listenError("TCP", endpoint, m_server.serverError(), m_server.errorString()));
        }
        m_input->setPort(m_server.serverPort());
        m_room.publish();
        return {};
    }

    bool turn(log::Moment now) override {
        if (m_resume && now >= *m_resume) {
            m_resume.reset();
            m_server.resumeAccepting();
        }
        while (m_server.hasPendingConnections()) {
            m_input->setProblem({});
            std::unique_ptr<QTcpSocket> socket(m_server.nextPendingConnection());
            socket->setParent(nullptr);
            m_room.admit(std::move(socket), m_server.serverPort());
        }
        return m_room.turn(now);
    }

    [[nodiscard]] std::optional<log::Moment> due() const override {
        const auto room = m_room.due();
        return m_resume && room ? std::min(*m_resume, *room) : m_resume ? m_resume : room;
    }
    void drain() override { m_room.drain(); }
    void heedAllowed() override { m_room.heedAllowed(); }

private:
    QTcpServer m_server;
    TcpRoom m_room;
    std::optional<log::Moment> m_resume; ///< when to accept again, after the system refused
};

} // namespace

NetResult<std::unique_ptr<TcpInput>> makeTcpListener(const TcpContext& context,
                                                     const std::shared_ptr<Input>& input) {
    auto listener = std::make_unique<TcpListener>(context, input);
    if (const auto listens = listener->listen(); !listens) {
        return tl::unexpected(listens.error());
    }
    return listener;
}

} // namespace posewire::net
