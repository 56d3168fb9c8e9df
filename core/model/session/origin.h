// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"
#include "core/model/session/session.h"

#include <memory>

namespace posewire::model {

/// One place of receiving, with a log, a time line and an account of its own: the inputs of this computer, or
/// a file. Numbers of packets and senders mean something within their origin alone, so two origins may hear
/// the same address and have two senders, and datagrams that one of them dropped explain no gap of the other.
class Origin {
public:
    explicit Origin(const log::LogLimits& limits = {},
                    const std::shared_ptr<log::Scratch>& scratch = std::make_shared<log::Scratch>())
        : m_log(limits, scratch) {}

    [[nodiscard]] log::PacketLog& log() { return m_log; }
    [[nodiscard]] const log::PacketLog& log() const { return m_log; }
    [[nodiscard]] Session& session() { return m_session; }
    [[nodiscard]] const Session& session() const { return m_session; }

private:
    log::PacketLog m_log;
    Session m_session{m_log};
};

} // namespace posewire::model
