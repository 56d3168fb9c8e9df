// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"
#include "app/net/tcp_room.h"
#include "app/net/tcp_thread.h"

#include <QNetworkProxy>
#include <QTcpServer>

namespace posewire::net {
namespace {

class TcpListener final : public TcpInput {
public:
    TcpListener(const TcpContext& context, std::shared_ptr<Input> input)
        : TcpInput(context, std::move(input)), m_room(context, m_input) {
        m_server.setProxy(QNetworkProxy::NoProxy);
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
        while (m_server.hasPendingConnections()) {
            std::unique_ptr<QTcpSocket> socket(m_server.nextPendingConnection());
            socket->setParent(nullptr);
            m_room.admit(std::move(socket), m_server.serverPort());
        }
        return m_room.turn(now);
    }

    [[nodiscard]] std::optional<log::Moment> due() const override { return m_room.due(); }
    void drain() override { m_room.drain(); }
    void heedAllowed() override { m_room.heedAllowed(); }

private:
    QTcpServer m_server;
    TcpRoom m_room;
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
