// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/ip_endpoint.h"

#include <vector>

namespace posewire::log {

/// Appends an IP packet that carries `payload` over UDP, with right lengths and checksums (RFC 791, 768,
/// 8200). What is too long for IPv4 goes with mapped addresses (RFC 4291 section 2.5.5.2) over IPv6; what is
/// too long for that as well is a jumbogram (RFC 2675). Both addresses must be of the same version.
void appendUdpFrame(std::vector<std::byte>& out, const IpEndpoint& sender, const IpEndpoint& target,
                    std::span<const std::byte> payload);

} // namespace posewire::log
