// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/input.h"

#include <utility>

namespace posewire::net {

void Input::setEndpoint(const Endpoint& endpoint) {
    const std::lock_guard lock(m_mutex);
    m_status.endpoint = endpoint;
}

void Input::setState(InputState state, std::string text) {
    const std::lock_guard lock(m_mutex);
    m_status.state = state;
    m_status.text = std::move(text);
}

void Input::setPeers(std::vector<Peer> peers, std::uint64_t refused) {
    const std::lock_guard lock(m_mutex);
    m_status.peers = std::move(peers);
    m_status.refusedPeers = refused;
}

InputStatus Input::status() const {
    const std::lock_guard lock(m_mutex);
    InputStatus status = m_status;
    status.datagrams = m_counters.datagrams.load(std::memory_order_relaxed);
    status.bytes = m_counters.bytes.load(std::memory_order_relaxed);
    status.skippedBytes = m_counters.skippedBytes.load(std::memory_order_relaxed);
    status.kernelDropped = m_counters.kernelDropped.load(std::memory_order_relaxed);
    status.receiveBufferBytes = m_counters.receiveBufferBytes.load(std::memory_order_relaxed);
    return status;
}

} // namespace posewire::net
