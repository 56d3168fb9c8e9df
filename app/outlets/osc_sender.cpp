// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/osc_sender.h"

#include <lo/lo.h>

#include <cstdlib>
#include <utility>

namespace posewire::outlets {
namespace {

/// Seconds since 1900 and their 32-bit fraction, as NTP has them.
lo_timetag timeTagOf(log::WallTime time) {
    constexpr std::uint64_t kSecond = 1'000'000'000;
    constexpr std::uint64_t kFrom1900 = 2'208'988'800;
    const auto nanoseconds = static_cast<std::uint64_t>(log::nanosecondsOf(time));
    return {static_cast<std::uint32_t>(nanoseconds / kSecond + kFrom1900),
            static_cast<std::uint32_t>(((nanoseconds % kSecond) << 32) / kSecond)};
}

struct Adding {
    lo_message message;

    void operator()(std::int32_t value) const { lo_message_add_int32(message, value); }
    void operator()(float value) const { lo_message_add_float(message, value); }
    void operator()(const std::string& value) const { lo_message_add_string(message, value.c_str()); }
};

} // namespace

void OscSender::FreeBundle::operator()(void* bundle) const {
    lo_bundle_free_recursive(bundle);
}

net::NetResult<OscSender> OscSender::connect(const std::string& place) {
    const auto target = net::parseTarget(place);
    if (!target) {
        return tl::unexpected(target.error());
    }
    auto sender = net::DatagramSender::connect({*target});
    if (!sender) {
        return tl::unexpected(std::move(sender.error()));
    }
    return OscSender(std::move(*sender), net::textOf(*target));
}

void OscSender::begin(log::WallTime time) {
    finish();
    m_time = time;
}

void OscSender::add(const std::string& address, std::initializer_list<OscValue> values) {
    constexpr std::size_t kLength = 4; // before each message
    const lo_message message = lo_message_new();
    for (const OscValue& value : values) {
        std::visit(Adding{message}, value);
    }
    const std::size_t more = kLength + lo_message_length(message, address.c_str());
    if (m_bundle != nullptr && lo_bundle_length(m_bundle.get()) + more > kMostBytes) {
        finish();
    }
    if (m_bundle == nullptr) {
        m_bundle.reset(lo_bundle_new(timeTagOf(m_time)));
    }
    lo_bundle_add_message(m_bundle.get(), address.c_str(), message);
}

void OscSender::finish() {
    if (m_bundle == nullptr) {
        return;
    }
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> bytes(
        lo_bundle_serialise(m_bundle.get(), nullptr, &size), &std::free);
    static_cast<void>(
        m_sender.send({static_cast<const std::byte*>(bytes.get()), size})); // it counts refusals
    m_bundle.reset();
}

} // namespace posewire::outlets
