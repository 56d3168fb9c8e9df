// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

struct __natsConnection;
struct __natsMsg;
struct __natsSubscription;
struct __jsCtx;

/// A stage of many computers, joined by servers of NATS with JetStream. See packaging/stage.md.
namespace posewire::stage {

/// Addresses of servers and the files of secrets that they ask for.
struct ServerChoice {
    std::vector<std::string> addresses; ///< "nats://HOST:PORT", "tls://HOST:PORT"; any of them will do
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
[[nodiscard]] inline std::string_view textOf(const Message& message) {
    const auto bytes = bytesOf(message);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
/// Empty if it has none of that name.
[[nodiscard]] std::string headerOf(const Message& message, const char* name);
/// The sequence number in the stream; 0 if it is not stored.
[[nodiscard]] std::uint64_t sequenceOf(const Message& message);
/// The time of storing, by the server's clock.
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

/// A connection that is restored by itself. Calls block, for two seconds at most unless said otherwise. Safe
/// from any thread.
class Server {
public:
    /// Fails if no server answers, or it refuses us. Operators of the servers see `name`.
    static net::NetResult<std::unique_ptr<Server>> connect(const ServerChoice& choice,
                                                           const std::string& name);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    using Header = std::pair<const char*, std::string>;
    /// Returns once the stream of the subject has stored it. The stream ignores an ID that it has stored
    /// within two minutes.
    net::NetResult<void> store(const std::string& subject, std::span<const std::byte> bytes,
                               std::span<const Header> headers, const std::string& id);
    /// Reaches those who listen just now; is not stored.
    net::NetResult<void> publish(const std::string& subject, const std::string& text);
    net::NetResult<Message> request(const std::string& subject, const std::string& text,
                                    std::chrono::milliseconds patience);
    /// Answers a request.
    void reply(const Message& request, const std::string& text);

    net::NetResult<Subscription> listen(const std::string& subject);
    /// Reads the stream of a site in order: from a sequence number on, or, if that is 0, from a time on.
    net::NetResult<Subscription> read(const std::string& site, const std::string& subject, std::uint64_t from,
                                      log::WallTime since);
    /// Null if none comes in time.
    [[nodiscard]] static Message next(const Subscription& subscription, std::chrono::milliseconds patience);

    /// Fails if there is no stream, or we may not ask.
    net::NetResult<StreamState> stream(const std::string& site);
    /// Makes it, or sets its limits.
    net::NetResult<StreamState> setStream(const std::string& site, const StreamLimits& limits);

    [[nodiscard]] bool isConnected() const;
    /// The permission that the server denied last; empty if it denied none.
    [[nodiscard]] std::string refusal() const;
    [[nodiscard]] const std::string& place() const { return m_place; }

private:
    explicit Server(std::string place) : m_place(std::move(place)) {}
    /// The sentence for a failure.
    [[nodiscard]] tl::unexpected<net::NetError> failure(int status, int streamError) const;

    std::string m_place;
    __natsConnection* m_connection = nullptr;
    __jsCtx* m_streams = nullptr;
    mutable std::mutex m_mutex; ///< guards what follows
    std::string m_refusal;      ///< the server's own words
};

} // namespace posewire::stage
