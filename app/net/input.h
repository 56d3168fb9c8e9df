// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "core/log/time.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace posewire::net {

enum class InputId : std::uint32_t {};

enum class InputKind : std::uint8_t { Udp, TcpListener, TcpConnection };

/// Broadcasts are received if the host is empty.
struct UdpInput {
    Endpoint endpoint; ///< a multicast group as host means that group and an empty host
    /// Multicast groups to join, IPv4 and IPv6, on every capable interface; the host must then be empty.
    std::vector<std::string> groups;

    friend bool operator==(const UdpInput&, const UdpInput&) = default;
};

enum class InputState : std::uint8_t {
    Listening,  ///< UDP, and TCP with or without a connected sender
    Connecting, ///< a TCP connection without an answer so far
    Connected,
    Retrying, ///< a TCP connection that failed or ended; the next attempt follows a pause
};

/// Adds to a counter that only this thread writes: cheaper than an atomic addition.
template <typename Number>
void increase(std::atomic<Number>& counter, std::type_identity_t<Number> amount) {
    counter.store(counter.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
}

/// True if datagrams that the system drops at a socket are counted; else those counters stay 0.
#ifdef __linux__
inline constexpr bool kCountsDrops = true;
#else
inline constexpr bool kCountsDrops = false;
#endif

/// Counters of an input: each written by one thread, read by any.
struct InputCounters {
    std::atomic<std::uint64_t> datagrams = 0;
    std::atomic<std::uint64_t> bytes = 0;
    std::atomic<std::uint64_t> skippedBytes = 0;  ///< TCP: bytes that belong to no datagram
    std::atomic<std::uint64_t> kernelDropped = 0; ///< UDP: lost on this computer because the buffer was full
    std::atomic<std::int64_t> receiveBufferBytes = 0; ///< UDP: what the kernel granted
    std::atomic<std::uint64_t> refusedDatagrams = 0;  ///< UDP: from those who are not listened to
    std::atomic<std::uint64_t> refusedPeers = 0;      ///< TCP: of those who are not listened to, or too many
    std::atomic<std::uint64_t> closedPeers = 0;       ///< TCP: closed because others wanted in
};

struct Peer {
    std::string address; ///< "10.0.0.5:50123"
    log::Stamp connected{};
    std::uint64_t datagrams = 0;
    std::uint64_t bytes = 0;
    std::uint64_t skippedBytes = 0;
};

struct InputStatus {
    InputId id{};
    InputKind kind = InputKind::Udp;
    Endpoint endpoint; ///< with the real port where 0 was requested
    std::vector<std::string> groups;
    InputState state = InputState::Listening;
    std::string text;    ///< the state in words, one line
    std::string problem; ///< what is wrong, with what to do; stays while it is tried again
    std::string note;    ///< TCP: which connections were closed or refused, and why; empty for none
    std::uint64_t datagrams = 0;
    std::uint64_t bytes = 0;
    std::uint64_t skippedBytes = 0;
    std::uint64_t kernelDropped = 0;
    std::int64_t receiveBufferBytes = 0;
    std::uint64_t refusedDatagrams = 0; ///< see InputCounters, as the next two
    std::uint64_t refusedPeers = 0;
    std::uint64_t closedPeers = 0;
    std::vector<Peer> peers; ///< connected now
};

/// An input as its threads share it.
class Input {
public:
    Input(InputId id, InputKind kind, const Endpoint& endpoint, std::vector<std::string> groups = {}) {
        m_status.id = id;
        m_status.kind = kind;
        m_status.endpoint = endpoint;
        m_status.groups = std::move(groups);
    }

    [[nodiscard]] InputId id() const { return m_status.id; }
    [[nodiscard]] InputKind kind() const { return m_status.kind; }
    [[nodiscard]] InputCounters& counters() { return m_counters; }

    // From any thread.
    void setPort(std::uint16_t port) {
        const std::lock_guard lock(m_mutex);
        m_status.endpoint.port = port;
    }
    void setState(InputState state, std::string text) {
        const std::lock_guard lock(m_mutex);
        m_status.state = state;
        m_status.text = std::move(text);
    }
    void setProblem(std::string problem) {
        const std::lock_guard lock(m_mutex);
        m_status.problem = std::move(problem);
    }
    void setPeers(std::vector<Peer> peers, std::string note = {}) {
        const std::lock_guard lock(m_mutex);
        m_status.peers = std::move(peers);
        m_status.note = std::move(note);
    }
    [[nodiscard]] InputStatus status() const {
        const std::lock_guard lock(m_mutex);
        InputStatus status = m_status;
        status.datagrams = m_counters.datagrams.load(std::memory_order_relaxed);
        status.bytes = m_counters.bytes.load(std::memory_order_relaxed);
        status.skippedBytes = m_counters.skippedBytes.load(std::memory_order_relaxed);
        status.kernelDropped = m_counters.kernelDropped.load(std::memory_order_relaxed);
        status.receiveBufferBytes = m_counters.receiveBufferBytes.load(std::memory_order_relaxed);
        status.refusedDatagrams = m_counters.refusedDatagrams.load(std::memory_order_relaxed);
        status.refusedPeers = m_counters.refusedPeers.load(std::memory_order_relaxed);
        status.closedPeers = m_counters.closedPeers.load(std::memory_order_relaxed);
        return status;
    }

private:
    InputCounters m_counters;
    mutable std::mutex m_mutex; ///< guards m_status but for id and kind, which never change
    InputStatus m_status;       ///< but for the counters
};

} // namespace posewire::net
