// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/input.h"

#include <utility>

namespace posewire::net {

void Input::setEndpoint(const Endpoint& endpoint) {
    const std::lock_guard lock(m_mutex);
    m_endpoint = endpoint;
}

void Input::setState(InputState state, std::string text) {
    const std::lock_guard lock(m_mutex);
    m_state = state;
    m_text = std::move(text);
}

void Input::setPeers(std::vector<Peer> peers, std::uint64_t refused) {
    const std::lock_guard lock(m_mutex);
    m_peers = std::move(peers);
    m_refusedPeers = refused;
}

InputStatus Input::status() const {
    InputStatus status;
    status.id = m_id;
    status.kind = m_kind;
    status.groups = m_groups;
    status.datagrams = m_counters.datagrams.load(std::memory_order_relaxed);
    status.bytes = m_counters.bytes.load(std::memory_order_relaxed);
    status.skippedBytes = m_counters.skippedBytes.load(std::memory_order_relaxed);
    status.kernelDropped = m_counters.kernelDropped.load(std::memory_order_relaxed);
    status.receiveBufferBytes = m_counters.receiveBufferBytes.load(std::memory_order_relaxed);
    const std::lock_guard lock(m_mutex);
    status.endpoint = m_endpoint;
    status.state = m_state;
    status.text = m_text;
    status.refusedPeers = m_refusedPeers;
    status.peers = m_peers;
    return status;
}

} // namespace posewire::net
