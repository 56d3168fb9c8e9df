// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/relay.h"

#include <QEventLoop>
#include <QUdpSocket>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string_view>

namespace posewire::net {
namespace {

/// Packets forwarded before commands get a turn.
constexpr std::uint64_t kAtOnce = 1024;
constexpr std::chrono::milliseconds kNap{2};
/// A packet this much older than the last time the relay had caught up is not live.
constexpr log::Duration kOld = std::chrono::seconds(1);
/// Senders that are known to be forwarded or not.
constexpr std::size_t kMostVerdicts = 4'096;
/// How long to wait for the network to empty the socket's send buffer.
constexpr int kAttempts = 10;
constexpr std::chrono::microseconds kAttemptPause{200};

bool isOfThisComputer(const QHostAddress& address) {
    const std::string text = address.toString().toStdString();
    return address.isLoopback() || address == QHostAddress(QHostAddress::AnyIPv4) ||
           address == QHostAddress(QHostAddress::AnyIPv6) ||
           std::ranges::any_of(localAddresses(),
                               [&](const LocalAddress& local) { return local.address == text; });
}

/// True if data sent there comes back through one of the inputs.
bool isHeardBy(const InputStatus& input, const QHostAddress& address, std::uint16_t port) {
    if (input.kind != InputKind::Udp || input.endpoint.port != port) {
        return false;
    }
    const std::string text = address.toString().toStdString();
    if (address.isMulticast()) {
        return input.endpoint.host == text || std::ranges::find(input.groups, text) != input.groups.end();
    }
    if (!input.endpoint.host.empty() && !address.isEqual(QHostAddress(QHostAddress::AnyIPv4))) {
        return input.endpoint.host == text;
    }
    return address.isBroadcast() || isOfThisComputer(address);
}

} // namespace

std::optional<NetError> loopProblem(const Endpoint& target, const QHostAddress& address,
                                    const std::vector<InputStatus>& inputs) {
    const bool isLoop = std::ranges::any_of(
        inputs, [&](const InputStatus& input) { return isHeardBy(input, address, target.port); });
    if (!isLoop) {
        return std::nullopt;
    }
    return NetError{NetError::Kind::BadEndpoint,
                    textOf(target) + " is where this monitor itself listens: every datagram would come back "
                                     "and circulate forever; choose another host or port"};
}

struct Relay::Target {
    RelayId id;
    Endpoint endpoint;
    QHostAddress address;
    std::atomic<std::uint64_t> sent = 0;
    std::atomic<std::uint64_t> refused = 0;
    std::atomic<std::uint64_t> skipped = 0;
    std::string problem{};  ///< guarded by m_mutex, as the next two
    bool isStopped = false; ///< its datagrams came back
    log::SenderId returner{};

    // Created and used in the relay's thread. Bound, so that its port identifies what comes back from it;
    // connected if it can be, since the system reports refusals to connected sockets alone.
    std::unique_ptr<QUdpSocket> socket{};
    std::optional<log::Moment> opened{};       ///< again
    std::optional<log::Moment> firstRefusal{}; ///< by the other side, of those that went on
    log::Moment newestRefusal{};
    std::uint64_t sentAtRefusal = 0; ///< by then
    bool isUnheard = false;          ///< and `problem` says so

    /// Groups and broadcasts have nobody who would refuse, and their way is chosen for each datagram.
    void open(std::uint16_t ownPort = 0) {
        const bool isIpv4 = address.protocol() == QAbstractSocket::IPv4Protocol;
        socket = std::make_unique<QUdpSocket>();
        socket->bind(isIpv4 ? QHostAddress::AnyIPv4 : QHostAddress::AnyIPv6, ownPort,
                     QUdpSocket::DontShareAddress);
        if (!address.isMulticast() && !address.isBroadcast()) {
            socket->connectToHost(address, endpoint.port);
        }
    }
    /// If nothing can be sent: a connected socket keeps to an address that this computer may have lost.
    void reopen(log::Moment now) {
        constexpr log::Duration kPause = std::chrono::seconds(1);
        if (!opened || now - *opened > kPause) {
            opened = now;
            const std::uint16_t ownPort = socket->localPort();
            socket.reset(); // first: its port is wanted again
            open(ownPort);
        }
    }
    [[nodiscard]] bool isConnected() const { return socket->state() == QAbstractSocket::ConnectedState; }

    bool write(const log::Packet& packet) {
        const auto size = static_cast<qint64>(packet.bytes.size());
        const char* bytes = reinterpret_cast<const char*>(packet.bytes.data());
        // The address also if it is connected: Qt sends nowhere on Windows without one.
        return socket->writeDatagram(bytes, size, address, endpoint.port) == size;
    }
    /// True if a datagram was refused since the last call: one report at a time is kept.
    [[nodiscard]] bool takeRefusal() {
        char unused = 0;
        return isConnected() && socket->readDatagram(&unused, 1) < 0 &&
               socket->error() == QAbstractSocket::ConnectionRefusedError;
    }
};

Relay::~Relay() {
    // As a command: a thread that saw a flag earlier would end before a queued command and never answer it.
    m_commands.call([this] { m_isStopping = true; });
    m_thread.join();
}

NetResult<RelayId> Relay::add(const Endpoint& target, const std::vector<InputStatus>& inputs) {
    const auto address = lookUp(target);
    if (!address) {
        return tl::unexpected(address.error());
    }
    if (auto problem = loopProblem(target, *address, inputs)) {
        return tl::unexpected(*problem);
    }
    auto added = std::make_shared<Target>();
    added->endpoint = target;
    added->address = *address;
    m_commands.call([&] {
        const std::lock_guard lock(m_mutex);
        added->id = RelayId{m_nextId++};
        added->open();
        m_verdicts.clear(); // somebody may have had its port before
        if (m_going.empty()) {
            m_follower = log::LogFollower::fromNow(m_log);
            m_caughtUp = m_log.timeline().now(m_clock);
        }
        m_targets.push_back(added);
        m_going.push_back(added);
        m_loops.endTrial();
    });
    return added->id;
}

std::optional<NetError> Relay::problemWith(RelayId id, const std::vector<InputStatus>& inputs) const {
    const std::lock_guard lock(m_mutex);
    const auto target = std::ranges::find(m_targets, id, [](const auto& each) { return each->id; });
    return target == m_targets.end() ? std::nullopt
                                     : loopProblem((*target)->endpoint, (*target)->address, inputs);
}

bool Relay::remove(RelayId id) {
    bool isRemoved = false;
    m_commands.call([&] {
        const std::lock_guard lock(m_mutex);
        const auto isMeant = [id](const auto& target) { return target->id == id; };
        isRemoved = std::erase_if(m_targets, isMeant) != 0;
        std::erase_if(m_going, isMeant);
        m_loops.endTrial();
    });
    return isRemoved;
}

std::vector<RelayTarget> Relay::targets() const {
    const std::lock_guard lock(m_mutex);
    std::vector<RelayTarget> result;
    for (const auto& target : m_targets) {
        result.push_back({target->id, target->endpoint, target->sent, target->refused, target->skipped,
                          target->isStopped ? 0 : m_behind.load(), target->problem, target->isStopped,
                          target->returner});
    }
    return result;
}

void Relay::wake() {
    {
        const std::lock_guard lock(m_wakeMutex);
        m_isWoken = true;
    }
    m_wake.notify_one();
}

void Relay::run() {
    const QEventLoop dispatcher; // sockets need one in their thread
    while (true) {
        m_commands.run();
        if (m_isStopping) {
            break; // before it waits: nobody would wake it afterwards
        }
        if (!m_going.empty() && forwardSome()) {
            continue;
        }
        std::unique_lock lock(m_wakeMutex);
        const auto isWoken = [this] { return m_isWoken; };
        if (m_going.empty()) {
            m_wake.wait(lock, isWoken);
        } else {
            m_wake.wait_for(lock, kNap, isWoken);
        }
        m_isWoken = false;
    }
    for (const auto& target : m_targets) {
        target->socket.reset();
    }
}

/// True if there is more.
bool Relay::forwardSome() {
    m_follower.refresh();
    skipWhatIsOld();
    const std::uint64_t end = m_follower.position() + kAtOnce;
    while (const auto packet = m_follower.next(end)) {
        if (isForwarded(*packet)) {
            forward(*packet);
        }
    }
    countOvertaken();
    m_behind = m_follower.lag();
    for (const auto& target : m_going) {
        heedRefusals(*target);
    }
    stopLoops();
    if (m_follower.lag() == 0) {
        m_caughtUp = m_log.timeline().now(m_clock);
        return false;
    }
    return true;
}

/// Only what would have been forwarded is counted, one by one: other senders are nobody's loss.
void Relay::skipWhatIsOld() {
    if (m_follower.lag() <= kMostBehind) {
        return;
    }
    const std::uint64_t first = m_follower.position() + m_follower.lag() - kMostBehind / 2;
    std::uint64_t skipped = 0;
    while (const auto packet = m_follower.next(first)) {
        skipped += isForwarded(*packet) ? 1 : 0;
    }
    for (const auto& target : m_going) {
        increase(target->skipped, skipped);
    }
}

/// What the log dropped before it could be looked at: nobody knows any more whether it was to be forwarded.
void Relay::countOvertaken() {
    const std::uint64_t overtaken = m_follower.takeOvertaken();
    for (const auto& target : m_going) {
        increase(target->skipped, overtaken);
    }
}

bool Relay::isForwarded(const log::Packet& packet) {
    if (m_verdicts.size() >= kMostVerdicts) {
        m_verdicts.clear();
    }
    const auto [verdict, isNew] = m_verdicts.try_emplace(packet.sender, Verdict::Ignore);
    if (isNew) {
        verdict->second = judge(packet.sender);
    }
    return verdict->second == Verdict::Forward && !packet.flags.skipped && packet.stamp >= m_caughtUp - kOld;
}

/// Leaves out what this relay itself has sent, should it come back by a path that add() did not see.
Relay::Verdict Relay::judge(log::SenderId sender) const {
    const auto info = m_log.senders().find(sender);
    if (info == nullptr ||
        (info->transport != log::Transport::Udp && info->transport != log::Transport::Tcp)) {
        return Verdict::Ignore;
    }
    const auto endpoint = parseEndpoint(info->address);
    const bool hasOurPort = endpoint && std::ranges::any_of(m_targets, [&](const auto& target) {
                                return target->socket->localPort() == endpoint->port;
                            });
    return hasOurPort && isOfThisComputer(QHostAddress(QString::fromStdString(endpoint->host)))
               ? Verdict::Ignore
               : Verdict::Forward;
}

void Relay::forward(const log::Packet& packet) {
    const std::string_view bytes(reinterpret_cast<const char*>(packet.bytes.data()), packet.bytes.size());
    const LoopWatch::Route route = m_loops.route(std::hash<std::string_view>{}(bytes), packet.sender,
                                                 m_clock.monotonic(), m_going.size());
    for (std::size_t i = 0; i < m_going.size(); ++i) {
        if (route.leadsTo(i)) {
            sendTo(*m_going[i], packet);
        } else {
            increase(m_going[i]->skipped, 1);
        }
    }
}

void Relay::stopLoops() {
    const auto loops = m_loops.takeLoops(m_clock.monotonic());
    if (loops.empty()) {
        return;
    }
    const std::lock_guard lock(m_mutex);
    for (const std::size_t index : loops) {
        Target& target = *m_going[index];
        target.isStopped = true;
        target.returner = m_loops.lastReturner();
        target.problem =
            textOf(target.endpoint) +
            " sent back what was relayed there: relaying to it was stopped; have nothing relayed "
            "from there to this computer, then switch it on again";
    }
    std::erase_if(m_going, [](const auto& target) { return target->isStopped; });
}

void Relay::sendTo(Target& target, const log::Packet& packet) {
    std::string problem = "datagrams that were too long to be received whole are not forwarded";
    bool isAfterRefusal = false;
    for (int attempt = 0; attempt < kAttempts && !packet.flags.truncated; ++attempt) {
        if (target.write(packet)) {
            increase(target.sent, 1);
            if (target.takeRefusal() || isAfterRefusal) {
                addRefusal(target);
            }
            return;
        }
        const auto error = target.socket->error();
        problem = target.socket->errorString().toStdString() + "; check the address, and the network to it";
        if (error == QAbstractSocket::TemporaryError) {
            std::this_thread::sleep_for(kAttemptPause);
        } else if (error != QAbstractSocket::NetworkError) {
            break;
        } else if (target.isConnected() && !isAfterRefusal) {
            isAfterRefusal = true; // reported just now, of an earlier one: this one has yet to go
        } else {
            target.reopen(m_clock.monotonic());
            break;
        }
    }
    {
        const std::lock_guard lock(m_mutex);
        target.problem = std::move(problem);
    }
    increase(target.refused, 1); // last: whoever sees it counted sees why
}

/// Counts a datagram that was sent, and that the other computer has sent back as undeliverable.
void Relay::addRefusal(Target& target) {
    const log::Moment now = m_clock.monotonic();
    if (!target.firstRefusal || now - target.newestRefusal > kHeardAfter) {
        target.firstRefusal = now;
    }
    target.newestRefusal = now;
    if (target.sent > 0) {
        target.sent.fetch_sub(1, std::memory_order_relaxed);
    }
    target.sentAtRefusal = target.sent;
    increase(target.refused, 1);
    if (!target.isUnheard && now - *target.firstRefusal >= kUnheardAfter) {
        target.isUnheard = true;
        const std::lock_guard lock(m_mutex);
        target.problem =
            "nobody listens at " + textOf(target.endpoint) + "; start the receiver there, or check the port";
    }
}

/// Those that were reported since the last datagram was sent, and whether they have ended.
void Relay::heedRefusals(Target& target) {
    if (target.takeRefusal()) {
        addRefusal(target);
    }
    if (target.isUnheard && target.sent > target.sentAtRefusal &&
        m_clock.monotonic() - target.newestRefusal > kHeardAfter) {
        target.isUnheard = false;
        target.firstRefusal.reset();
        const std::lock_guard lock(m_mutex);
        target.problem.clear();
    }
}

} // namespace posewire::net
