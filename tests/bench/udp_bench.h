// SPDX-License-Identifier: MIT
#pragma once

#include <netinet/in.h>
#include <pthread.h>
#include <sched.h>
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
#include <span>
#include <vector>

/// What the receive benchmarks share: clocks, a plain socket, a sender that costs little.
namespace posewire::bench {

inline constexpr std::size_t kDatagramSize = 760; ///< a pose of 23 segments
inline constexpr std::size_t kBatch = 32;         ///< datagrams to a system call
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

/// recvmmsg into the same few buffers again and again; if asked to, with what no receiver can do without: who
/// sent it and when.
class BareLoop {
public:
    explicit BareLoop(bool hasSenderAndStamp) : m_hasSenderAndStamp(hasSenderAndStamp) {
        for (std::size_t i = 0; i < kBatch; ++i) {
            m_parts[i] = {m_bytes[i].data(), m_bytes[i].size()};
            m_messages[i].msg_hdr.msg_iov = &m_parts[i];
            m_messages[i].msg_hdr.msg_iovlen = 1;
        }
    }
    std::size_t drain(int descriptor) {
        std::size_t total = 0;
        while (true) {
            for (std::size_t i = 0; m_hasSenderAndStamp && i < kBatch; ++i) {
                msghdr& header = m_messages[i].msg_hdr;
                header.msg_name = &m_senders[i];
                header.msg_namelen = sizeof m_senders[i];
                header.msg_control = m_controls[i].data();
                header.msg_controllen = m_controls[i].size();
            }
            const int count = ::recvmmsg(descriptor, m_messages.data(), kBatch, MSG_DONTWAIT, nullptr);
            total += count > 0 ? static_cast<std::size_t>(count) : 0;
            if (count < static_cast<int>(kBatch)) {
                return total;
            }
        }
    }

private:
    bool m_hasSenderAndStamp;
    std::array<sockaddr_in6, kBatch> m_senders{};
    std::array<std::array<std::byte, 64>, kBatch> m_controls{};
    std::array<std::array<std::byte, 2304>, kBatch> m_bytes{};
    std::array<iovec, kBatch> m_parts{};
    std::array<mmsghdr, kBatch> m_messages{};
};

/// Keeps the calling thread on the first or the last processor that this program may use. Left to the
/// scheduler, a loop that waits for its socket runs beside the sender, in warm caches, and one that naps on a
/// processor that sleeps: the figures would compare processors and not loops.
inline void stayOn(bool isLast) {
    // Asked for once, by the first thread: the others inherit what it is kept on.
    static const cpu_set_t allowed = [] {
        cpu_set_t set;
        ::sched_getaffinity(0, sizeof set, &set);
        return set;
    }();
    int chosen = -1;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (CPU_ISSET(cpu, &allowed) && (chosen < 0 || isLast)) {
            chosen = cpu;
        }
    }
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(chosen, &one);
    ::pthread_setaffinity_np(::pthread_self(), sizeof one, &one);
}

/// Writes the number of a datagram into its bytes.
using Numbering = void (*)(std::span<std::byte, kDatagramSize> bytes, std::uint64_t number);

inline void numberAtBegin(std::span<std::byte, kDatagramSize> bytes, std::uint64_t number) {
    std::memcpy(bytes.data(), &number, sizeof number);
}

/// Sends numbered datagrams of 760 bytes, many with a system call.
class LoopbackSender {
public:
    explicit LoopbackSender(std::uint16_t port, std::array<std::byte, kDatagramSize> bytes = {},
                            Numbering numbering = numberAtBegin)
        : m_descriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)), m_numbering(numbering) {
        m_bytes.fill(bytes);
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
                m_numbering(m_bytes[i], m_sent);
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
    int m_descriptor;
    Numbering m_numbering;
    std::uint64_t m_sent = 0;
    std::array<std::array<std::byte, kDatagramSize>, kBatch> m_bytes{};
    std::array<iovec, kBatch> m_parts{};
    std::array<mmsghdr, kBatch> m_messages{};
};

} // namespace posewire::bench
