// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/server.h"

#include <nats/nats.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace posewire::stage {
namespace {

using net::NetError;
using net::NetResult;

constexpr std::chrono::milliseconds kAnswer(2000);
// Messages that wait to be read.
constexpr int kMostMessages = 1 << 16;
constexpr int kMostBytes = 128 << 20;

std::string streamOf(const std::string& site) {
    return "POSEWIRE_" + site;
}

struct Options {
    natsOptions* own = nullptr;
    Options() { natsOptions_Create(&own); }
    ~Options() { natsOptions_Destroy(own); }
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;
};

NetResult<std::string> passwordOf(const ServerChoice& choice) {
    if (choice.passwordFile.empty()) {
        const char* const given = std::getenv("POSEWIRE_NATS_PASSWORD");
        return given == nullptr ? "" : given;
    }
    std::ifstream file(choice.passwordFile);
    std::string line;
    if (!std::getline(file, line)) {
        return net::netError(NetError::Kind::Other, choice.passwordFile +
                                                        ": has no password on its first line, or cannot be "
                                                        "read");
    }
    return line;
}

/// "UABC…": the line of a file that has the public key of a user.
NetResult<std::string> publicKeyOf(const std::string& path) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with('U')) {
            return line.substr(0, line.find_last_not_of(" \r\t") + 1);
        }
    }
    return net::netError(NetError::Kind::Other,
                         path + ": has no line with the public key of a user (U…), or cannot be read; "
                                "`nk -gen user -pubout` writes such a file");
}

/// The library's words for the last failure of this thread.
std::string detail() {
    natsStatus status = NATS_OK;
    const char* const text = nats_GetLastError(&status);
    return text == nullptr ? "" : text;
}

/// Cuts the place in the library's source: "(jsm.c:1033): no room" becomes "no room".
std::string saidBy(const std::string& text) {
    const std::size_t end = text.starts_with('(') ? text.find("): ") : std::string::npos;
    return end == std::string::npos ? text : text.substr(end + 3);
}

NetResult<void> setFiles(natsOptions* options, const ServerChoice& choice) {
    const auto refuse = [](const std::string& file) {
        return net::netError(NetError::Kind::Other, file + ": cannot be read, or is not what it should be (" +
                                                        saidBy(detail()) + ")");
    };
    for (const std::string& file :
         {choice.credentials, choice.nkey, choice.authorities, choice.certificate, choice.key}) {
        if (!file.empty() && !std::ifstream(file)) {
            return net::netError(NetError::Kind::Other, file + ": cannot be read");
        }
    }
    if (!choice.credentials.empty() &&
        natsOptions_SetUserCredentialsFromFiles(options, choice.credentials.c_str(), nullptr) != NATS_OK) {
        return refuse(choice.credentials);
    }
    if (!choice.nkey.empty()) {
        const auto key = publicKeyOf(choice.nkey);
        if (!key) {
            return tl::unexpected(key.error());
        }
        if (natsOptions_SetNKeyFromSeed(options, key->c_str(), choice.nkey.c_str()) != NATS_OK) {
            return refuse(choice.nkey);
        }
    }
    if (!choice.authorities.empty() &&
        natsOptions_LoadCATrustedCertificates(options, choice.authorities.c_str()) != NATS_OK) {
        return refuse(choice.authorities);
    }
    if (!choice.certificate.empty() && natsOptions_LoadCertificatesChain(options, choice.certificate.c_str(),
                                                                         choice.key.c_str()) != NATS_OK) {
        return refuse(choice.certificate);
    }
    return {};
}

NetResult<void> setAddresses(natsOptions* options, const std::vector<std::string>& addresses) {
    std::vector<const char*> list;
    for (const std::string& address : addresses) {
        const std::size_t host = address.find("://");
        const std::size_t user = address.find('@');
        if (user != std::string::npos && address.find(':', host == std::string::npos ? 0 : host + 1) < user) {
            return net::netError(NetError::Kind::BadEndpoint,
                                 "a password in the address of a server can be seen by all users of this "
                                 "computer; write it into a file, and name that with --nats-password-file");
        }
        list.push_back(address.c_str());
    }
    natsOptions_SetSecure(options, std::ranges::any_of(addresses, [](const std::string& address) {
                              return address.starts_with("tls://");
                          }));
    if (natsOptions_SetServers(options, list.data(), static_cast<int>(list.size())) != NATS_OK) {
        return net::netError(NetError::Kind::BadEndpoint, addresses.front() +
                                                              ": is no address of a server; write "
                                                              "nats://HOST:PORT, or tls://HOST:PORT");
    }
    return {};
}

std::string joined(const std::vector<std::string>& addresses) {
    std::string text;
    for (const std::string& address : addresses) {
        text += (text.empty() ? "" : ", ") + address;
    }
    return text;
}

using Stored = std::unique_ptr<jsMsgMetaData, decltype(&jsMsgMetaData_Destroy)>;
Stored storedOf(const Message& message) {
    jsMsgMetaData* meta = nullptr;
    natsMsg_GetMetaData(&meta, message.get());
    return {meta, &jsMsgMetaData_Destroy};
}

/// Explains a failure, and says what to do.
std::string meaningOf(int status, int streamError) {
    switch (streamError) {
    case JSNotEnabledErr:
    case JSNotEnabledForAccountErr:
        status = NATS_NO_RESPONDERS;
        break;
    case JSStreamNotFoundErr:
        return "the server has no stream of this site; `posewire-cli stage --keep HOURS` makes it";
    case JSClusterNotAvailErr:
        return "the servers are choosing a leader just now; it is tried again";
    case JSStorageResourcesExceededErr:
    case JSInsufficientResourcesErr:
        return "the server has no room for more; free its disk, or give the stream a limit of bytes";
    default:
        break;
    }
    switch (status) {
    case NATS_NO_SERVER:
    case NATS_CONNECTION_CLOSED:
    case NATS_CONNECTION_DISCONNECTED:
    case NATS_STALE_CONNECTION:
        return "no server answers there; see that nats-server runs, and that its port (4222) can be reached";
    case NATS_CONNECTION_AUTH_FAILED:
        return "the server does not know this user, password or key; see its accounts";
    case NATS_NOT_PERMITTED:
        return "the server does not allow this user to do that; see the permissions of its account";
    case NATS_SECURE_CONNECTION_WANTED:
        return "the server speaks no TLS; write nats:// instead of tls://";
    case NATS_SECURE_CONNECTION_REQUIRED:
        return "the server wants TLS; write tls:// instead of nats://";
    case NATS_SSL_ERROR:
        return "TLS failed; see that the certificate is of that host name, and signed by what --nats-ca "
               "names";
    case NATS_NO_RESPONDERS:
        return "no server keeps what is published: the site has no stream yet (`posewire-cli stage --keep "
               "HOURS` makes it), a leader is being chosen, or jetstream is off in their configuration";
    case NATS_TIMEOUT:
        return "the server does not answer in time; it is tried again";
    case NATS_MAX_PAYLOAD:
        return "the server takes no messages of that size; raise its max_payload to 1 MB";
    case NATS_NO_SERVER_SUPPORT:
        return "the server is too old; version 2.9 is needed";
    case NATS_PROTOCOL_ERROR:
        return "the server ended the connection; if it asks for a certificate, name one with "
               "--nats-certificate and --nats-key";
    default:
        return streamError != 0 ? "the server refuses" : natsStatus_GetText(static_cast<natsStatus>(status));
    }
}

} // namespace

void MessageFreer::operator()(natsMsg* message) const {
    natsMsg_Destroy(message);
}

void SubscriptionEnder::operator()(natsSubscription* subscription) const {
    natsSubscription_Destroy(subscription);
}

std::string subjectOf(const Message& message) {
    return natsMsg_GetSubject(message.get());
}

std::span<const std::byte> bytesOf(const Message& message) {
    return std::as_bytes(std::span(natsMsg_GetData(message.get()),
                                   static_cast<std::size_t>(natsMsg_GetDataLength(message.get()))));
}

std::string headerOf(const Message& message, const char* name) {
    const char* value = nullptr;
    return natsMsgHeader_Get(message.get(), name, &value) == NATS_OK && value != nullptr ? value : "";
}

std::uint64_t sequenceOf(const Message& message) {
    const Stored stored = storedOf(message);
    return stored ? stored->Sequence.Stream : 0;
}

log::WallTime storedAt(const Message& message) {
    const Stored stored = storedOf(message);
    return log::WallTime(log::Duration(stored ? stored->Timestamp : 0));
}

NetResult<std::unique_ptr<Server>> Server::connect(const ServerChoice& choice, const std::string& name) {
    std::unique_ptr<Server> server(new Server(joined(choice.addresses)));
    Options options;
    const auto password = passwordOf(choice);
    if (!password) {
        return tl::unexpected(password.error());
    }
    if (const auto set = setAddresses(options.own, choice.addresses).and_then([&] {
            return setFiles(options.own, choice);
        });
        !set) {
        return tl::unexpected(set.error());
    }
    if (!choice.user.empty()) {
        natsOptions_SetUserInfo(options.own, choice.user.c_str(), password->c_str());
    }
    natsOptions_SetName(options.own, name.c_str());
    natsOptions_SetTimeout(options.own, kAnswer.count());
    natsOptions_SetMaxReconnect(options.own, -1);
    natsOptions_SetReconnectWait(options.own, 200); // ms
    natsOptions_SetPingInterval(options.own, 1000); // ms: finds a server dead that is silent
    natsOptions_SetMaxPingsOut(options.own, 2);
    natsOptions_SetMaxPendingMsgs(options.own, kMostMessages);
    natsOptions_SetFailRequestsOnDisconnect(options.own, true);
    const auto note = [](natsConnection* connection, natsSubscription* /*subscription*/, natsStatus status,
                         void* own) {
        const char* text = nullptr;
        natsConnection_GetLastError(connection, &text);
        auto& self = *static_cast<Server*>(own);
        const std::lock_guard lock(self.m_mutex);
        if (status == NATS_NOT_PERMITTED && text != nullptr) {
            self.m_refusal = text;
        }
    };
    natsOptions_SetErrorHandler(options.own, note, server.get());
    const natsStatus status = natsConnection_Connect(&server->m_connection, options.own);
    if (status != NATS_OK) {
        return server->failure(status, 0);
    }
    if (const natsStatus able = natsConnection_HasHeaderSupport(server->m_connection); able != NATS_OK) {
        return server->failure(able, 0);
    }
    jsOptions streams;
    jsOptions_Init(&streams);
    streams.Wait = kAnswer.count();
    natsConnection_JetStream(&server->m_streams, server->m_connection, &streams);
    return server;
}

Server::~Server() {
    jsCtx_Destroy(m_streams);
    natsConnection_Destroy(m_connection);
}

tl::unexpected<NetError> Server::failure(int status, int streamError) const {
    const std::lock_guard lock(m_mutex);
    if (!m_refusal.empty() && (status == NATS_TIMEOUT || status == NATS_NO_RESPONDERS)) {
        status = NATS_NOT_PERMITTED; // the server reports that apart, and leaves the request unanswered
    }
    const std::string more = status == NATS_SSL_ERROR || streamError != 0 ? saidBy(detail())
                             : status == NATS_NOT_PERMITTED               ? m_refusal
                                                                          : "";
    return tl::unexpected(
        NetError{NetError::Kind::NotConnected,
                 m_place + ": " + meaningOf(status, streamError) + (more.empty() ? "" : " (" + more + ")")});
}

NetResult<void> Server::store(const std::string& subject, std::span<const std::byte> bytes,
                              std::span<const Header> headers, const std::string& id) {
    if (!isConnected()) { // else the library buffers it and times out
        return failure(NATS_CONNECTION_DISCONNECTED, 0);
    }
    natsMsg* made = nullptr;
    natsMsg_Create(&made, subject.c_str(), nullptr, reinterpret_cast<const char*>(bytes.data()),
                   static_cast<int>(bytes.size()));
    const Message message(made);
    for (const auto& [name, value] : headers) {
        natsMsgHeader_Set(made, name, value.c_str());
    }
    jsPubOptions options;
    jsPubOptions_Init(&options);
    options.MsgId = id.c_str();
    options.MaxWait = 1000; // ms
    jsErrCode error{};
    const natsStatus status = js_PublishMsg(nullptr, m_streams, made, &options, &error);
    return status == NATS_OK ? NetResult<void>() : failure(status, error);
}

NetResult<void> Server::publish(const std::string& subject, const std::string& text) {
    const natsStatus status = isConnected()
                                  ? natsConnection_Publish(m_connection, subject.c_str(), text.data(),
                                                           static_cast<int>(text.size()))
                                  : NATS_CONNECTION_DISCONNECTED;
    return status == NATS_OK ? NetResult<void>() : failure(status, 0);
}

NetResult<Message> Server::request(const std::string& subject, const std::string& text,
                                   std::chrono::milliseconds patience) {
    natsMsg* answer = nullptr;
    const natsStatus status = natsConnection_Request(&answer, m_connection, subject.c_str(), text.data(),
                                                     static_cast<int>(text.size()), patience.count());
    return status == NATS_OK ? NetResult<Message>(Message(answer)) : failure(status, 0);
}

void Server::reply(const Message& request, const std::string& text) {
    if (const char* const subject = natsMsg_GetReply(request.get())) {
        natsConnection_Publish(m_connection, subject, text.data(), static_cast<int>(text.size()));
    }
}

NetResult<Subscription> Server::listen(const std::string& subject) {
    natsSubscription* made = nullptr;
    const natsStatus status = natsConnection_SubscribeSync(&made, m_connection, subject.c_str());
    return status == NATS_OK ? NetResult<Subscription>(Subscription(made)) : failure(status, 0);
}

NetResult<Subscription> Server::read(const std::string& site, const std::string& subject, std::uint64_t from,
                                     log::WallTime since) {
    const std::string name = streamOf(site);
    jsSubOptions options;
    jsSubOptions_Init(&options);
    options.Ordered = true;
    options.Stream = name.c_str();
    if (from != 0) {
        options.Config.DeliverPolicy = js_DeliverByStartSequence;
        options.Config.OptStartSeq = from;
    } else {
        options.Config.DeliverPolicy = js_DeliverByStartTime;
        options.Config.OptStartTime = log::nanosecondsOf(since);
    }
    natsSubscription* made = nullptr;
    jsErrCode error{};
    const natsStatus status = js_SubscribeSync(&made, m_streams, subject.c_str(), nullptr, &options, &error);
    if (status == NATS_OK) {
        natsSubscription_SetPendingLimits(made, kMostMessages, kMostBytes);
    }
    return status == NATS_OK ? NetResult<Subscription>(Subscription(made)) : failure(status, error);
}

Message Server::next(const Subscription& subscription, std::chrono::milliseconds patience) {
    natsMsg* message = nullptr;
    return natsSubscription_NextMsg(&message, subscription.get(), patience.count()) == NATS_OK
               ? Message(message)
               : nullptr;
}

namespace {

StreamState stateOf(jsStreamInfo* info) {
    const jsStreamConfig& config = *info->Config;
    StreamState state{{log::Duration(config.MaxAge), config.MaxBytes, static_cast<int>(config.Replicas)},
                      info->State.Msgs,
                      info->State.Bytes,
                      info->State.LastSeq,
                      {}};
    if (info->Cluster != nullptr && info->Cluster->Leader != nullptr) {
        state.leader = info->Cluster->Leader;
    }
    jsStreamInfo_Destroy(info);
    return state;
}

} // namespace

NetResult<StreamState> Server::stream(const std::string& site) {
    jsStreamInfo* info = nullptr;
    jsErrCode error{};
    const natsStatus status = js_GetStreamInfo(&info, m_streams, streamOf(site).c_str(), nullptr, &error);
    if (status == NATS_OK) {
        return stateOf(info);
    }
    return failure(status, status == NATS_NOT_FOUND ? JSStreamNotFoundErr : error);
}

NetResult<StreamState> Server::setStream(const std::string& site, const StreamLimits& limits) {
    const std::string name = streamOf(site);
    const std::string subject = "posewire." + site + ".*.batch";
    const char* subjects[] = {subject.c_str()};
    jsStreamConfig config;
    jsStreamConfig_Init(&config);
    config.Name = name.c_str();
    config.Subjects = subjects;
    config.SubjectsLen = 1;
    config.Storage = js_FileStorage;
    config.MaxAge = limits.age.count();
    config.MaxBytes = limits.bytes;
    config.Replicas = limits.replicas;
    // A probe repeats a batch whose acknowledgement was lost.
    const log::Duration again = std::chrono::minutes(2);
    config.Duplicates = (limits.age == log::Duration::zero() ? again : std::min(again, limits.age)).count();
    jsOptions patient;
    jsOptions_Init(&patient);
    patient.Wait = 10'000; // ms
    jsStreamInfo* info = nullptr;
    jsErrCode error{};
    natsStatus status = js_AddStream(&info, m_streams, &config, &patient, &error);
    if (status != NATS_OK && error == JSStreamNameExistErr) {
        error = {};
        status = js_UpdateStream(&info, m_streams, &config, &patient, &error);
    }
    return status == NATS_OK ? NetResult<StreamState>(stateOf(info)) : failure(status, error);
}

std::string Server::refusal() const {
    const std::lock_guard lock(m_mutex);
    return m_refusal.empty() ? ""
                             : m_place + ": " + meaningOf(NATS_NOT_PERMITTED, 0) + " (" + m_refusal + ")";
}

bool Server::isConnected() const {
    return natsConnection_Status(m_connection) == NATS_CONN_STATUS_CONNECTED;
}

} // namespace posewire::stage
