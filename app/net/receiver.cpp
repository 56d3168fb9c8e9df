// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/receiver.h"

#include "app/net/kernel_counters.h"
#include "app/net/listening.h"
#include "app/net/receive_loop.h"
#include "app/net/tcp_thread.h"
#include "app/system/process_figures.h"

#include <algorithm>

namespace posewire::net {
namespace {

void add(InputCounters& counters, ReceiveTotals& totals) {
    totals.datagrams += counters.datagrams;
    totals.bytes += counters.bytes;
    totals.kernelDropped += counters.kernelDropped;
    totals.refusedDatagrams += counters.refusedDatagrams;
}

} // namespace

Receiver::Receiver(log::PacketLog& log, const log::Clock& clock, const ReceiverOptions& options)
    : m_log(log),
      m_clock(clock),
      m_nap(options.nap),
      m_queue([this] { m_loop->wake(); }),
      m_commands([this] { m_loop->wake(); }),
      m_loop(makeReceiveLoop({log, clock, m_queue, m_commands, m_counters, m_nap, options})),
      m_kernelBefore(readKernelCounters()) {
    m_thread = std::thread([this] { m_loop->run(); });
}

Receiver::~Receiver() {
    m_tcp.reset(); // while its last packets can still reach the log
    m_loop->stop();
    m_thread.join();
    m_queue.close();
}

std::shared_ptr<Input> Receiver::makeInput(InputKind kind, const Endpoint& endpoint,
                                           std::vector<std::string> groups) {
    const std::lock_guard lock(m_mutex);
    return std::make_shared<Input>(InputId{m_nextId++}, kind, endpoint, std::move(groups));
}

void Receiver::keep(const std::shared_ptr<Input>& input) {
    const std::lock_guard lock(m_mutex);
    m_inputs.push_back(input);
}

TcpThread& Receiver::tcp() {
    const std::lock_guard lock(m_mutex);
    if (!m_tcp) {
        m_tcp = std::make_unique<TcpThread>(TcpContext{m_clock, m_log.timeline(), m_queue, m_allowed});
    }
    return *m_tcp;
}

NetResult<InputId> Receiver::addUdp(const UdpInput& where) {
    // Qt's sockets belong to the thread that makes them, so the receiving thread has to open them.
    const auto input = makeInput(InputKind::Udp, where.endpoint, where.groups);
    input->setState(InputState::Listening, "listening");
    NetResult<void> result;
    m_commands.call([&] { result = m_loop->add(input); });
    if (!result) {
        return tl::unexpected(withHolder(result.error(), where.endpoint.port, false));
    }
    keep(input);
    return input->id();
}

NetResult<InputId> Receiver::addTcpListener(const Endpoint& endpoint) {
    const auto input = makeInput(InputKind::TcpListener, endpoint);
    if (const auto result = tcp().listen(input); !result) {
        return tl::unexpected(withHolder(result.error(), endpoint.port, true));
    }
    keep(input);
    return input->id();
}

InputId Receiver::addTcpConnection(const Endpoint& endpoint) {
    const auto input = makeInput(InputKind::TcpConnection, endpoint);
    input->setState(InputState::Connecting, "connecting to " + textOf(endpoint));
    keep(input);
    tcp().connect(input);
    return input->id();
}

void Receiver::listenTo(const AllowList& allowed) {
    m_commands.call([&] { m_loop->listenTo(allowed); });
    TcpThread* tcp = nullptr;
    {
        const std::lock_guard lock(m_mutex);
        m_allowed = allowed;
        tcp = m_tcp.get();
    }
    if (tcp != nullptr) {
        tcp->listenTo(allowed);
    }
}

bool Receiver::remove(InputId id) {
    std::shared_ptr<Input> input;
    {
        const std::lock_guard lock(m_mutex);
        const auto place = std::ranges::find(m_inputs, id, &Input::id);
        if (place == m_inputs.end()) {
            return false;
        }
        input = *place;
    }
    if (input->kind() == InputKind::Udp) {
        m_commands.call([&] { m_loop->remove(id); });
    } else {
        tcp().remove(id);
    }
    const std::lock_guard lock(m_mutex);
    if (std::erase(m_inputs, input) == 0) {
        return false; // another thread has removed it meanwhile
    }
    add(input->counters(), m_past);
    return true;
}

bool Receiver::isHeldUp() const {
    constexpr log::Duration kLate = std::chrono::milliseconds(50);
    constexpr log::Duration kMost = std::chrono::seconds(1);
    const log::Moment until = m_counters.readUntil.load(std::memory_order_acquire);
    const log::Moment now = m_clock.monotonic();
    const log::Duration late = now - std::min(until, now);
    return late > kLate && late < kMost;
}

std::vector<InputStatus> Receiver::inputs() const {
    const std::lock_guard lock(m_mutex);
    std::vector<InputStatus> result;
    result.reserve(m_inputs.size());
    for (const auto& input : m_inputs) {
        result.push_back(input->status());
    }
    return result;
}

ReceiveTotals Receiver::totals() const {
    constexpr log::Duration kStale = std::chrono::milliseconds(250);
    const std::lock_guard lock(m_mutex);
    ReceiveTotals totals = m_past;
    const log::Moment now = m_clock.monotonic();
    if (m_kernelBefore && now - m_kernelRead >= kStale) {
        m_kernelRead = now;
        m_kernel = readKernelCounters().value_or(*m_kernelBefore).since(*m_kernelBefore);
    }
    totals.kernel = m_kernel;
    totals.longestDelay = m_counters.longestDelay;
    for (const auto& input : m_inputs) {
        add(input->counters(), totals);
        const std::int64_t granted = input->counters().receiveBufferBytes;
        if (input->kind() == InputKind::Udp) {
            totals.receiveBufferBytes =
                totals.receiveBufferBytes == 0 ? granted : std::min(totals.receiveBufferBytes, granted);
        }
    }
    return totals;
}

std::optional<double> Receiver::cpuSeconds() {
    return system::threadCpuSeconds(m_thread);
}

std::optional<double> Receiver::takeBufferFill() {
    const std::int32_t fill = m_counters.bufferFill;
    if (fill < 0) {
        return std::nullopt;
    }
    m_counters.bufferFill = 0;
    return fill / 1000.0;
}

} // namespace posewire::net
