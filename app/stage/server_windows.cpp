// SPDX-License-Identifier: GPL-3.0-or-later
// The client library of NATS is not packaged there.
#include "app/stage/server.h"

namespace posewire::stage {
namespace {

tl::unexpected<net::NetError> notHere() {
    return net::netError(net::NetError::Kind::Other,
                         "servers of NATS are not reached from Windows; use Posewire on Linux");
}

} // namespace

void MessageFreer::operator()(__natsMsg* /*message*/) const {}
void SubscriptionEnder::operator()(__natsSubscription* /*subscription*/) const {}

std::string subjectOf(const Message& /*message*/) {
    return {};
}
std::span<const std::byte> bytesOf(const Message& /*message*/) {
    return {};
}
std::string headerOf(const Message& /*message*/, const char* /*name*/) {
    return {};
}
std::uint64_t sequenceOf(const Message& /*message*/) {
    return 0;
}
log::WallTime storedAt(const Message& /*message*/) {
    return {};
}

net::NetResult<std::unique_ptr<Server>> Server::connect(const ServerChoice& /*choice*/,
                                                        const std::string& /*name*/) {
    return notHere();
}
Server::~Server() = default;
net::NetResult<void> Server::store(const std::string& /*subject*/, std::span<const std::byte> /*bytes*/,
                                   std::span<const Header> /*headers*/, const std::string& /*id*/) {
    return notHere();
}
net::NetResult<void> Server::publish(const std::string& /*subject*/, const std::string& /*text*/) {
    return notHere();
}
net::NetResult<Message> Server::request(const std::string& /*subject*/, const std::string& /*text*/,
                                        std::chrono::milliseconds /*patience*/) {
    return notHere();
}
void Server::reply(const Message& /*request*/, const std::string& /*text*/) {}
net::NetResult<Subscription> Server::listen(const std::string& /*subject*/) {
    return notHere();
}
net::NetResult<Subscription> Server::read(const std::string& /*site*/, const std::string& /*subject*/,
                                          std::uint64_t /*from*/, log::WallTime /*since*/) {
    return notHere();
}
Message Server::next(const Subscription& /*subscription*/, std::chrono::milliseconds /*patience*/) {
    return nullptr;
}
net::NetResult<StreamState> Server::stream(const std::string& /*site*/) {
    return notHere();
}
net::NetResult<StreamState> Server::setStream(const std::string& /*site*/, const StreamLimits& /*limits*/) {
    return notHere();
}
std::string Server::refusal() const {
    return {};
}
bool Server::isConnected() const {
    return false;
}

} // namespace posewire::stage
