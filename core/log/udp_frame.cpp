// SPDX-License-Identifier: MIT
#include "core/log/udp_frame.h"

#include "core/wire/byte_order.h"

#include <algorithm>

namespace posewire::log {
namespace {

constexpr std::size_t kUdpHeader = 8;
constexpr std::size_t kLongest = 0xffff;

/// Writes numbers in network order.
class Bytes {
public:
    explicit Bytes(std::vector<std::byte>& out) : m_out(out) {}
    void number8(unsigned value) { m_out.push_back(static_cast<std::byte>(value)); }
    void number16(std::size_t value) {
        number8(static_cast<unsigned>(value >> 8) & 0xffU);
        number8(static_cast<unsigned>(value) & 0xffU);
    }
    void number32(std::size_t value) {
        number16(value >> 16);
        number16(value);
    }
    void bytes(std::span<const std::byte> more) { m_out.insert(m_out.end(), more.begin(), more.end()); }
    void address(const IpAddress& address) { bytes(std::span(address.bytes).first(address.isIpv6 ? 16 : 4)); }

private:
    std::vector<std::byte>& m_out;
};

/// RFC 1071; an odd last byte counts as if a zero followed.
class Checksum {
public:
    void add(std::span<const std::byte> bytes) {
        for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
            m_sum += wire::load16(bytes.data() + i);
        }
        if (bytes.size() % 2 != 0) {
            m_sum += std::to_integer<std::uint64_t>(bytes.back()) << 8;
        }
    }
    void add(std::size_t number) { m_sum += (number >> 16) + (number & 0xffffU); }
    [[nodiscard]] std::uint16_t value() const {
        std::uint64_t sum = m_sum;
        while (sum >> 16 != 0) {
            sum = (sum >> 16) + (sum & 0xffffU);
        }
        return static_cast<std::uint16_t>(~sum);
    }

private:
    std::uint64_t m_sum = 0;
};

void appendIpv4(std::vector<std::byte>& out, const IpAddress& sender, const IpAddress& target,
                std::size_t size) {
    constexpr std::size_t headerSize = 20;
    const std::size_t start = out.size();
    Bytes bytes(out);
    bytes.number16(0x4500);
    bytes.number16(headerSize + size);
    bytes.number32(0x4000); // one piece
    bytes.number8(64);
    bytes.number8(kUdp);
    bytes.number16(0);
    bytes.address(sender);
    bytes.address(target);
    Checksum checksum;
    checksum.add(std::span(out).subspan(start));
    wire::store16(out.data() + start + 10, checksum.value());
}

void appendIpv6(std::vector<std::byte>& out, const IpAddress& sender, const IpAddress& target,
                std::size_t size) {
    constexpr unsigned hopByHop = 0;
    const bool isJumbo = size > kLongest;
    Bytes bytes(out);
    bytes.number32(0x60000000);
    bytes.number16(isJumbo ? 0 : size);
    bytes.number8(isJumbo ? hopByHop : kUdp);
    bytes.number8(64);
    bytes.address(sender);
    bytes.address(target);
    if (isJumbo) {
        bytes.number16(std::size_t{kUdp} << 8);
        bytes.number16(0xc204);
        bytes.number32(kUdpHeader + size);
    }
}

void appendUdp(std::vector<std::byte>& out, const IpEndpoint& sender, const IpEndpoint& target,
               std::span<const std::byte> payload) {
    const std::size_t start = out.size();
    const std::size_t size = kUdpHeader + payload.size();
    Bytes bytes(out);
    bytes.number16(sender.port);
    bytes.number16(target.port);
    bytes.number16(size > kLongest ? 0 : size);
    bytes.number16(0);
    bytes.bytes(payload);
    Checksum checksum;
    checksum.add(sender.address.bytes); // of IPv4 the rest is zeros
    checksum.add(target.address.bytes);
    checksum.add(kUdp);
    checksum.add(size);
    checksum.add(std::span(out).subspan(start));
    const std::uint16_t value = checksum.value();
    wire::store16(out.data() + start + 6, value != 0 ? value : std::uint16_t{0xffff});
}

IpEndpoint mapped(const IpEndpoint& endpoint) {
    IpEndpoint result{{{}, true}, endpoint.port};
    result.address.bytes[10] = result.address.bytes[11] = std::byte{0xff};
    std::copy_n(endpoint.address.bytes.begin(), 4, result.address.bytes.begin() + 12);
    return result;
}

} // namespace

void appendUdpFrame(std::vector<std::byte>& out, const IpEndpoint& sender, const IpEndpoint& target,
                    std::span<const std::byte> payload) {
    const std::size_t size = kUdpHeader + payload.size();
    constexpr std::size_t ipv4Header = 20;
    if (sender.address.isIpv6) {
        appendIpv6(out, sender.address, target.address, size);
    } else if (size + ipv4Header <= kLongest) {
        appendIpv4(out, sender.address, target.address, size);
    } else {
        appendUdpFrame(out, mapped(sender), mapped(target), payload);
        return;
    }
    appendUdp(out, sender, target, payload);
}

} // namespace posewire::log
