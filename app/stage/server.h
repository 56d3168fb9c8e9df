// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

struct __natsConnection;
struct __natsMsg;
struct __natsSubscription;
struct __jsCtx;

/// A stage of many computers, joined by servers of NATS with JetStream. See packaging/stage.md.
namespace posewire::stage {

/// Where the servers are, and what this program shows them. Secrets are in files or in the environment.
struct ServerChoice {
    std::vector<std::string>
        addresses; ///< "nats://HOST:PORT", "tls://HOST:PORT"; one is enough to be connected
    std::string user;
    std::string passwordFile; ///< its first line; else the environment's POSEWIRE_NATS_PASSWORD
    std::string credentials;  ///< file: a JWT and its seed
    std::string nkey;         ///< file: the public key of a user on a line, and its seed on another
    std::string authorities;  ///< file of certificates that a server's must be signed by; empty: the system's
    std::string certificate;  ///< file: of this program, for servers that ask for one
    std::string key;          ///< file: of that certificate
};

struct MessageFreer {
    void operator()(__natsMsg* message) const;
};
using Message = std::unique_ptr<__natsMsg, MessageFreer>;

[[nodiscard]] std::string subjectOf(const Message& message);
[[nodiscard]] std::span<const std::byte> bytesOf(const Message& message);
/// Empty if it has none of that name.
[[nodiscard]] std::string headerOf(const Message& message, const char* name);
/// Where it lies in the stream; 0 for one that is not stored.
[[nodiscard]] std::uint64_t sequenceOf(const Message& message);
/// When it was stored, by the server's clock.
[[nodiscard]] log::WallTime storedAt(const Message& message);

struct SubscriptionEnder {
    void operator()(__natsSubscription* subscription) const;
};
using Subscription = std::unique_ptr<__natsSubscription, SubscriptionEnder>;

/// The stream of a site, which keeps what its probes have published.
struct StreamLimits {
    log::Duration age{};     ///< 0: no limit
    std::int64_t bytes = -1; ///< -1: no limit
    int replicas = 1;        ///< servers that each have all of it
};
struct StreamState {
    StreamLimits limits;
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    std::uint64_t last = 0; ///< sequence number of the newest message
    std::string leader;     ///< empty if the server is alone
};

/// A connection that comes back by itself. Every call may take as long as the servers let it, two seconds at
/// most where not said otherwise; from any thread.
class Server {
public:
    /// Fails if none of the servers answers, or it wants something else of us. `name` is shown to the
    /// servers' operators.
    static net::NetResult<std::unique_ptr<Server>> connect(const ServerChoice& choice,
                                                           const std::string& name);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    using Header = std::pair<const char*, std::string>;
    /// Returns once the stream of the subject has stored it; a message of an ID that it has already is not
    /// stored again.
    net::NetResult<void> store(const std::string& subject, std::span<const std::byte> bytes,
                               std::span<const Header> headers, const std::string& id);
    /// To those who listen just now.
    net::NetResult<void> publish(const std::string& subject, const std::string& text);
    net::NetResult<Message> request(const std::string& subject, const std::string& text,
                                    std::chrono::milliseconds patience);
    /// Answers to a request.
    void reply(const Message& request, const std::string& text);

    net::NetResult<Subscription> listen(const std::string& subject);
    /// In the order of a stream, from a message of it on, or the first one that was stored at a time or
    /// after.
    net::NetResult<Subscription> read(const std::string& site, const std::string& subject, std::uint64_t from,
                                      log::WallTime since);
    /// The next message; none if there was none meanwhile.
    [[nodiscard]] static Message next(const Subscription& subscription, std::chrono::milliseconds patience);

    /// Fails if there is none, or we may not ask.
    net::NetResult<StreamState> stream(const std::string& site);
    /// Makes it, or sets its limits.
    net::NetResult<StreamState> setStream(const std::string& site, const StreamLimits& limits);

    [[nodiscard]] bool isConnected() const;
    /// What we may not do, as the server said last; empty if it has said nothing.
    [[nodiscard]] std::string refusal() const;
    [[nodiscard]] const std::string& place() const { return m_place; }

private:
    explicit Server(std::string place) : m_place(std::move(place)) {}
    /// What went wrong, in words.
    [[nodiscard]] tl::unexpected<net::NetError> failure(int status, int streamError) const;

    std::string m_place;
    __natsConnection* m_connection = nullptr;
    __jsCtx* m_streams = nullptr;
    mutable std::mutex m_mutex; ///< guards what follows
    std::string m_refusal;      ///< what the server last said we may not do
};

} // namespace posewire::stage
