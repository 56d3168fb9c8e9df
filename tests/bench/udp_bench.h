// SPDX-License-Identifier: MIT
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

/// What the receive benchmarks share: clocks, a plain socket, a sender that costs little.
namespace posewire::bench {

inline constexpr std::size_t kDatagramSize = 760; ///< a pose of 23 segments
inline constexpr int kReceiveBuffer = 4 << 20;

inline double seconds(clockid_t clock) {
    timespec time{};
    ::clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}
inline double threadCpuSeconds() {
    return seconds(CLOCK_THREAD_CPUTIME_ID);
}

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// One line that people and scripts read; the exit status of a benchmark that is asked to check.
inline int verdict(const char* name, double ratio, double limit, bool isChecked) {
    std::printf("%s %.3f %.3f\n", name, ratio, limit);
    return isChecked && ratio > limit ? 1 : 0;
}

inline sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

/// A plain UDP socket on a port of loopback that the system chooses.
class PlainSocket {
public:
    PlainSocket() : m_descriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        ::setsockopt(m_descriptor, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
        sockaddr_in address = loopback(0);
        socklen_t size = sizeof address;
        if (::bind(m_descriptor, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
            ::getsockname(m_descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
            std::perror("bind");
            std::exit(2);
        }
        m_port = ntohs(address.sin_port);
    }
    ~PlainSocket() { ::close(m_descriptor); }
    PlainSocket(const PlainSocket&) = delete;
    PlainSocket& operator=(const PlainSocket&) = delete;

    [[nodiscard]] int descriptor() const { return m_descriptor; }
    [[nodiscard]] std::uint16_t port() const { return m_port; }

private:
    int m_descriptor;
    std::uint16_t m_port = 0;
};

/// Sends numbered datagrams of 760 bytes, 32 with a system call.
class LoopbackSender {
public:
    explicit LoopbackSender(std::uint16_t port)
        : m_descriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        const sockaddr_in address = loopback(port);
        if (::connect(m_descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
            std::perror("connect");
            std::exit(2);
        }
        for (std::size_t i = 0; i < kBatch; ++i) {
            m_parts[i] = {m_bytes[i].data(), kDatagramSize};
            m_messages[i].msg_hdr.msg_iov = &m_parts[i];
            m_messages[i].msg_hdr.msg_iovlen = 1;
        }
    }
    ~LoopbackSender() { ::close(m_descriptor); }
    LoopbackSender(const LoopbackSender&) = delete;
    LoopbackSender& operator=(const LoopbackSender&) = delete;

    void send(std::size_t count) {
        while (count > 0) {
            const std::size_t batch = std::min(count, kBatch);
            for (std::size_t i = 0; i < batch; ++i, ++m_sent) {
                std::memcpy(m_bytes[i].data(), &m_sent, sizeof m_sent);
            }
            for (std::size_t done = 0; done < batch;) {
                const int sent =
                    ::sendmmsg(m_descriptor, &m_messages[done], static_cast<unsigned>(batch - done), 0);
                done += sent > 0 ? static_cast<std::size_t>(sent) : 0;
            }
            count -= batch;
        }
    }

    /// So many datagrams a second for so long, in equal bursts, on a schedule that does not drift.
    void sendPaced(double rate, double duration, double burstInterval) {
        const double start = seconds(CLOCK_MONOTONIC);
        const std::uint64_t before = m_sent;
        for (double next = burstInterval; next <= duration; next += burstInterval) {
            send(static_cast<std::size_t>(next * rate) - static_cast<std::size_t>(m_sent - before));
            const double until = start + next;
            const timespec time{
                static_cast<time_t>(until),
                static_cast<long>((until - static_cast<double>(static_cast<time_t>(until))) * 1e9)};
            ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
        }
    }

    [[nodiscard]] std::uint64_t sent() const { return m_sent; }

private:
    static constexpr std::size_t kBatch = 32;
    int m_descriptor;
    std::uint64_t m_sent = 0; ///< each datagram begins with its number, from 0
    std::array<std::array<std::byte, kDatagramSize>, kBatch> m_bytes{};
    std::array<iovec, kBatch> m_parts{};
    std::array<mmsghdr, kBatch> m_messages{};
};

} // namespace posewire::bench
