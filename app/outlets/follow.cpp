// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/follow.h"

#include "app/net/line_server.h"
#include "core/export/motion/pose_lines.h"

#include <utility>

namespace posewire::outlets {
namespace {

class ServedLines final : public PoseWriter {
public:
    ServedLines(const log::PacketLog& log, std::unique_ptr<net::LineServer> server)
        : m_log(log), m_server(std::move(server)) {}

    void take(const feed::PoseCharacter& character, const feed::PoseSample& sample) override {
        if (m_server->receivers() != 0) {
            m_server->send(exporting::poseLine(m_log, character, sample));
        }
    }
    void tell(OutletState& state) const override {
        state.place = m_server->place();
        state.receivers = m_server->receivers();
        state.sent = m_server->sent();
        state.skipped = m_server->skipped();
    }

private:
    const log::PacketLog& m_log;
    std::unique_ptr<net::LineServer> m_server;
};

class WrittenLines final : public PoseWriter {
public:
    WrittenLines(const log::PacketLog& log, std::function<bool(std::string)> write)
        : m_log(log), m_write(std::move(write)) {}

    void take(const feed::PoseCharacter& character, const feed::PoseSample& sample) override {
        ++(m_write(exporting::poseLine(m_log, character, sample)) ? m_sent : m_skipped);
    }
    void tell(OutletState& state) const override {
        state.receivers = 1;
        state.sent = m_sent;
        state.skipped = m_skipped;
    }

private:
    const log::PacketLog& m_log;
    std::function<bool(std::string)> m_write;
    std::uint64_t m_sent = 0;
    std::uint64_t m_skipped = 0;
};

} // namespace

MakeWriter followAt(const OutletChoice& choice) {
    return [place = choice.place](const log::PacketLog& log) -> net::NetResult<std::unique_ptr<PoseWriter>> {
        auto server = net::LineServer::listen(place);
        if (!server) {
            return tl::unexpected(std::move(server.error()));
        }
        return std::make_unique<ServedLines>(log, std::move(*server));
    };
}

MakeWriter followInto(std::function<bool(std::string line)> write) {
    return [write = std::move(write)](const log::PacketLog& log) {
        return net::NetResult<std::unique_ptr<PoseWriter>>(std::make_unique<WrittenLines>(log, write));
    };
}

} // namespace posewire::outlets
